// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "toile/io/sheet_drawing.h"
#include "toile/layout/nest.h"
#include "toile/layout/pattern.h"

namespace toile {

struct MarkerOptions {
  NestOptions nest;
  /// Of the material; width and length of a fabric's own roll are used where these say nothing.
  std::optional<Length> width;
  std::optional<Length> length;
  NestMaterial hide;           ///< its hide and faults, if it has a hide
  std::optional<Turns> turns;  ///< instead of what the fabric allows
  int copies = 1;              ///< of each order
  bool pairs = false;          ///< each piece also turned over: left and right shoe
  /// The cloth lies double, its fold at y = 0: symmetric pieces are cut as halves on the fold, and
  /// one outline gives both pieces of a mirrored pair. `width` is that of the cloth laid flat.
  bool fold = false;
};
inline constexpr double kUsualRollMm = 1400;

/// The pieces of one fabric on its material.
struct Marker {
  std::string fabric;  ///< id; empty where designs have none
  std::string name;    ///< for people
  double width = 0;    ///< mm, of the cloth laid flat
  bool folded = false;
  Nesting nesting;
  /// Every copy in its place, as nesting.places, sheets beside each other, on the edges and faults
  /// of the material. Numbers and edge codes are those of the order's own pattern; pieces tell
  /// their order where there are several.
  SheetDrawing sheet;
  std::vector<Finding> findings;  ///< pieces that folded cloth gives twice
};

/// Nests what several orders need, a marker per fabric; the fabric of each is that of its own
/// design, those of one id are cut together.
/// @return what nest() returns, naming the fabric
Result<std::vector<Marker>> makeMarkers(std::span<const Pattern> orders,
                                        const MarkerOptions& options = {},
                                        Progress* progress = nullptr);

/// The figures of markers for programs: material, length, utilisation, where each copy lies.
[[nodiscard]] std::string writeMarkersJson(std::span<const Marker> markers);

}  // namespace toile
