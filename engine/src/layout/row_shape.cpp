// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout/row_shape.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace toile::nesting {
namespace {

/// The ranges of x in which polygons have points between two heights.
void addBand(std::span<const Points2> polygons, double low, double high,
             std::vector<ShiftRange>& ranges) {
  std::vector<double> cuts;
  std::vector<ShiftRange> sides;
  for (const Points2& polygon : polygons) {
    cuts.assign({low, high});
    for (const Eigen::Vector2d& p : polygon)
      if (p.y() > low && p.y() < high) cuts.push_back(p.y());
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      if (cuts[c] == cuts[c + 1]) continue;
      // Where each edge enters and leaves the slab; edges do not cross inside it.
      sides.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector2d* a = &polygon[i];
        const Eigen::Vector2d* b = &polygon[(i + 1) % polygon.size()];
        if (a->y() > b->y()) std::swap(a, b);
        if (a->y() > cuts[c] || b->y() < cuts[c + 1] || a->y() == b->y()) continue;
        const double slope = (b->x() - a->x()) / (b->y() - a->y());
        sides.push_back(
            {a->x() + slope * (cuts[c] - a->y()), a->x() + slope * (cuts[c + 1] - a->y())});
      }
      std::sort(sides.begin(), sides.end(), [](const ShiftRange& a, const ShiftRange& b) {
        return a.from + a.to < b.from + b.to;
      });
      for (std::size_t i = 0; i + 1 < sides.size(); i += 2)
        ranges.push_back(
            {std::min(sides[i].from, sides[i].to), std::max(sides[i + 1].from, sides[i + 1].to)});
    }
  }
}

}  // namespace

void Rows::add(std::vector<ShiftRange>& ranges) {
  std::sort(ranges.begin(), ranges.end(),
            [](const ShiftRange& a, const ShiftRange& b) { return a.from < b.from; });
  const std::size_t first = ranges_.size();
  for (const ShiftRange& range : ranges) {
    if (ranges_.size() > first && range.from < ranges_.back().to)
      ranges_.back().to = std::max(ranges_.back().to, range.to);
    else
      ranges_.push_back(range);
  }
  start_.push_back(ranges_.size());
}

RowShape makeRowShape(const Points2& polygon, double rowHeight) {
  const Box2 box = boxOf(polygon);
  Points2 moved = polygon;
  for (Eigen::Vector2d& p : moved) p -= box.min;
  RowShape shape;
  shape.width = box.size().x();
  shape.height = box.size().y();
  const int count = std::max(1, static_cast<int>(std::ceil(shape.height / rowHeight - 1e-9)));
  shape.rows = coveringRows({&moved, 1}, rowHeight, count);
  return shape;
}

Rows coveringRows(std::span<const Points2> polygons, double rowHeight, int count) {
  Rows rows;
  std::vector<ShiftRange> ranges;
  for (int r = 0; r < count; ++r) {
    ranges.clear();
    addBand(polygons, r * rowHeight, (r + 1) * rowHeight, ranges);
    rows.add(ranges);
  }
  return rows;
}

Rows noFitRows(const Rows& fixed, const Rows& moving) {
  Rows out;
  std::vector<ShiftRange> ranges;
  for (int shift = 1 - moving.count(); shift < fixed.count(); ++shift) {
    ranges.clear();
    const int last = std::min(fixed.count(), shift + moving.count());
    for (int r = std::max(0, shift); r < last; ++r)
      for (const ShiftRange& f : fixed[r])
        for (const ShiftRange& m : moving[r - shift])
          ranges.push_back({f.from - m.to, f.to - m.from});
    out.add(ranges);
  }
  return out;
}

NoFitTable::~NoFitTable() {
  for (const std::atomic<const Rows*>& rows : known_) delete rows.load();
}

const Rows& NoFitTable::of(std::uint32_t fixed, std::uint32_t moving) const {
  std::atomic<const Rows*>& known = known_[fixed * shapes_.size() + moving];
  if (const Rows* rows = known.load(std::memory_order_acquire)) return *rows;
  auto made = std::make_unique<const Rows>(noFitRows(shapes_[fixed].rows, shapes_[moving].rows));
  const Rows* none = nullptr;  // another thread may have made the same in the meantime
  if (known.compare_exchange_strong(none, made.get(), std::memory_order_acq_rel))
    return *made.release();
  return *none;
}

}  // namespace toile::nesting
