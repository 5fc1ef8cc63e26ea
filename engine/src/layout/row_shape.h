// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "finish/polygon.h"
#include "layout/clearance.h"

namespace toile::nesting {

/// Lists of ranges, one a row; ascending and apart within a row.
class Rows {
 public:
  [[nodiscard]] int count() const { return static_cast<int>(start_.size()) - 1; }
  [[nodiscard]] std::span<const ShiftRange> operator[](int row) const {
    const auto r = static_cast<std::size_t>(row);
    return {ranges_.data() + start_[r], start_[r + 1] - start_[r]};
  }
  /// Sorts and joins the ranges and adds them as the next row.
  void add(std::vector<ShiftRange>& ranges);

 private:
  std::vector<std::size_t> start_{0};
  std::vector<ShiftRange> ranges_;
};

/// A polygon by rows of one height: in each the ranges of x that it has points in, so that the rows
/// cover it. Its left edge is x = 0, its bottom y = 0.
struct RowShape {
  Rows rows;
  double width = 0;
  double height = 0;  ///< mm, of the polygon itself
};
[[nodiscard]] RowShape makeRowShape(const Points2& polygon, double rowHeight);

/// Rows that cover polygons which stay where they are, in rows 0 to `count` - 1 over y = 0.
[[nodiscard]] Rows coveringRows(std::span<const Points2> polygons, double rowHeight, int count);

/// For each difference of rows, -(moving rows - 1) .. fixed rows - 1, the shifts of x at which the
/// moving shape shares a row with the fixed one: their no-fit region.
[[nodiscard]] Rows noFitRows(const Rows& fixed, const Rows& moving);

/// The no-fit regions of pairs of shapes, each made when it is first asked for. For many threads.
class NoFitTable {
 public:
  explicit NoFitTable(std::span<const RowShape> shapes)
      : shapes_(shapes), known_(shapes.size() * shapes.size()) {}
  ~NoFitTable();
  NoFitTable(const NoFitTable&) = delete;
  NoFitTable& operator=(const NoFitTable&) = delete;
  /// Of `moving` against `fixed`: row r is that of a difference of r - (moving rows - 1).
  [[nodiscard]] const Rows& of(std::uint32_t fixed, std::uint32_t moving) const;

 private:
  std::span<const RowShape> shapes_;
  mutable std::vector<std::atomic<const Rows*>> known_;
};

}  // namespace toile::nesting
