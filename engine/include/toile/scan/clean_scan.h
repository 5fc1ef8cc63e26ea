// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "toile/core/progress.h"
#include "toile/fit/fit.h"
#include "toile/fit/scan.h"
#include "toile/model/reference_model.h"

namespace toile {

/// What was scanned: of a person it is known how it stands and how tall it may be.
enum class ScanKind { Body, Object };

/// What to make of faces that look inwards. Only who made the file knows which it is.
enum class InwardFaces {
  Ask,      ///< refuse with that question
  Turned,   ///< the faces alone are turned
  Mirrored  ///< the whole scan is a mirror image: it is mirrored back
};

struct CleanOptions {
  ScanKind kind = ScanKind::Body;
  /// Of the result; without it 8 mm for a body, a 200th of its diagonal for an object.
  std::optional<Length> edge = {};
  InwardFaces inwardFaces = InwardFaces::Ask;
  Ratio mostInvented = Ratio::percent(25);  ///< of the result's area; more is refused
};

/// A place where the scan had nothing and the surface was made up.
struct InventedPatch {
  std::string place;       ///< "left foot, below"; of an object the direction alone
  Eigen::Vector3d centre;  ///< mm, on the result
  double area = 0;         ///< mm2
};

struct CleanReport {
  std::size_t points = 0;               ///< of the scan
  std::size_t lonePoints = 0;           ///< left out: far from their neighbours
  std::size_t flyingParts = 0;          ///< left out: small, or not on the body
  std::size_t flyingPoints = 0;         ///< of those parts
  double spacing = 0;                   ///< mm, between the points that were used
  double edge = 0;                      ///< mm, asked of the result
  double height = 0;                    ///< mm, of the result
  DistanceSummary scanToModel;          ///< of the points that were used
  double inventedArea = 0;              ///< mm2
  double inventedShare = 0;             ///< of the result's area
  std::vector<InventedPatch> invented;  ///< largest first
  int handles = 0;                      ///< parts grown together, such as a hand and a thigh
  std::size_t crossings = 0;            ///< pairs of faces
  std::vector<Finding> findings;        ///< what was done and what to look at
};

struct CleanedScan {
  /// Closed; z up, on the floor z = 0; a body faces -y. Curves "invented 1", ... go round the
  /// invented places.
  ReferenceModel model;
  Eigen::Isometry3d standing = Eigen::Isometry3d::Identity();  ///< scan (mirrored back) to model
  CleanReport report;
};

/// Reads a scan for cleanScan(). A file without a unit, and a size that no person has, are asked
/// back: the message says what each unit would make of it.
/// @return as readScan(); UnitsMissing with that question
Result<Scan> readRawScan(const std::filesystem::path& path, std::optional<FileUnit> unit,
                         ScanKind kind);

/// Makes a clean closed model of a scan with noise, holes, flying parts, of several parts, or of
/// points without normals.
///
/// Flying parts and lone points are left out; a body is placed by the parametric body and stood
/// upright; evenly spread means of the points with their normals go through Poisson
/// reconstruction, which closes what is open; the result is divided evenly. Equal input gives
/// equal output, for any number of threads.
///
/// @return the model with a report of what was invented, or an Error:
///   InvalidArgument  nothing like a person, more than one, too sparse, an edge length out of
///   range,
///                    more invented than allowed
///   UnitsMissing     no person is that tall
///   NotOrientable    faces look inwards and `inwardFaces` does not say why
///   NotConverged     no closed surface through the points
///   Cancelled
/// @par Cost  about 10 s for a body with the usual edge length
/// @see docs/scanning.md
Result<CleanedScan> cleanScan(const Scan& scan, const CleanOptions& options = {},
                              Progress* progress = nullptr);

/// The report as JSON, "toile-scan" version 1 (docs/scanning.md).
[[nodiscard]] std::string writeCleanReport(const CleanedScan& cleaned);

}  // namespace toile
