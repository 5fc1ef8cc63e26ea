// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "toile/core/units.h"
#include "toile/curve/geodesic.h"

namespace toile {

/// What an end of an open line keeps while it is faired.
enum class FairEnd {
  Clamped,  ///< its place and its direction
  Pinned    ///< its place; the direction is free
};

/// A line of a network to be faired.
struct FairLine {
  SurfacePath path;
  /// Where it passes through nodes of the network; any order. At an end: arc 0 or the length.
  struct Stop {
    double arc = 0;         ///< mm along the path
    std::size_t node = 0;   ///< index into FairNetwork::nodes
    bool isCorner = false;  ///< the line turns sharply here, and shall go on doing so
  };
  std::vector<Stop> stops;
  FairEnd start = FairEnd::Clamped;  ///< where there is no stop
  FairEnd end = FairEnd::Clamped;
  bool isFixed = false;  ///< is not moved; nodes on it neither
  /// Bends that the line is meant to have (its source's, after a transfer); absent: found.
  std::optional<int> inflections{};
};

/// A point that lines share, or a point of one line that stays where it is.
struct FairNode {
  SurfacePoint point;
  bool isFixed = false;
};

struct FairNetwork {
  std::vector<FairLine> lines;
  std::vector<FairNode> nodes;
};

struct FairingOptions {
  /// Ripples shorter than about this vanish, longer shapes stay. Absent: chosen for every line, the
  /// least that leaves it the bends it is meant to have; where these are not known, those that are
  /// left when everything shorter than half of the line is taken away.
  std::optional<Length> wavelength;
  /// A line that would move farther is faired less.
  Length maxDeviation = Length::mm(25);
};

struct FairedLine {
  std::vector<SurfacePoint> points;  ///< data points, about evenly spaced, with the nodes
  SurfacePath path;
  Length wavelength;  ///< that was used; zero for a fixed line
  int inflectionsBefore = 0, inflectionsAfter = 0;
  double variationBefore = 0, variationAfter = 0;  ///< of geodesic curvature, 1/mm
  Length deviation;  ///< the farthest that old and new line are apart, either way
};

struct FairedNetwork {
  std::vector<FairedLine> lines;
  std::vector<SurfacePoint> nodes;
};

/// Smooths lines on the surface, all at once: least variation of geodesic curvature, held to where
/// they were. Points stay on the surface in every step; nodes are common unknowns, so lines that
/// shared them still do, bit for bit.
///
/// Each line is sampled evenly; minimised is the integral of (d kg / ds)^2 plus (2 pi /
/// wavelength)^6 times the squared distance sideways from the old line: a low-pass filter of sixth
/// order. Ripples are taken out first, two steps in frames that are carried along the surface,
/// where the problem is nearly linear however wildly a line winds; then a few Gauss-Newton steps in
/// the line's own frames. Every step is put on the surface by the nearest point on the same limb. A
/// node is held sideways by each of its lines, and may slide along a line that does not mind.
///
/// @return CurveInvalid when a line is too short to have three samples, or everything is fixed.
/// @par Cost  some dozen sparse factorisations of one row per sample, and the links
/// @see Hofer, Pottmann, "Energy-minimizing splines in manifolds", ACM TOG 23(3), 2004; here with
///   the intrinsic curvature in place of derivatives in space.
Result<FairedNetwork> fairNetwork(GeodesicLinker& linker, std::shared_ptr<const Mesh> mesh,
                                  const FairNetwork& network, const FairingOptions& options = {});

}  // namespace toile
