// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "layout/row_shape.h"
#include "toile/core/progress.h"

namespace toile::nesting {

/// A copy to place: the shapes that it may have, by turn. Copies of one kind are alike.
struct Copy {
  std::uint32_t kind = 0;
  std::vector<std::uint32_t> shapes;
  bool onFold = false;  ///< only in row 0
};

/// Where things are placed, in millimetres from its left edge and rows from its bottom.
struct Bin {
  double rowHeight = 5;
  double height = 1000;          ///< mm that the shapes may take
  std::optional<double> length;  ///< of each sheet; nothing: no end
  std::uint32_t mostSheets = 1;
  std::vector<Rows> blocked;  ///< per shape, the places it may not take; empty: none
};

struct Placed {
  std::uint32_t shape = 0;
  std::uint32_t sheet = 0;
  int row = 0;
  double x = 0;
};

/// An order of the copies and where it puts them.
struct Fill {
  std::vector<std::uint32_t> order;
  std::vector<Placed> places;  ///< in that order
  double length = 0;           ///< mm, of all sheets before the last and what is used of that
  double value = 0;            ///< the length, and a little of how far left everything ends
};

/// Left fill with no-fit rows.
class Filler {
 public:
  Filler(std::span<const RowShape> shapes, std::vector<Copy> copies, Bin bin);

  /// Places the copies in their order; those before `from` stay as they are. Gives up once the
  /// value exceeds `most`. @return false then, or where a copy finds no place.
  bool fill(Fill& fill, std::size_t from, double most) const;
  [[nodiscard]] const std::vector<Copy>& copies() const { return copies_; }
  [[nodiscard]] const RowShape& shape(std::uint32_t s) const { return shapes_[s]; }

 private:
  struct Frontier;
  [[nodiscard]] static double clearOf(const Rows& noFit, int index, double offset, double x);
  [[nodiscard]] std::optional<Placed> findPlace(const Copy& copy, std::span<const Placed> placed,
                                                std::uint32_t sheet, Frontier& frontier) const;

  std::span<const RowShape> shapes_;
  std::vector<Copy> copies_;
  Bin bin_;
  NoFitTable noFit_;
};

/// The best fill that a search of so many rounds finds; nothing where a copy finds no place in any.
/// The same for any number of threads.
std::optional<Fill> searchFill(const Filler& filler, int rounds,
                               const std::function<void(double)>& onBetter, Progress* progress);

}  // namespace toile::nesting
