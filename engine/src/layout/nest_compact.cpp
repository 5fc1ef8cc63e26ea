// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout/nest_compact.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "layout/clearance.h"

namespace toile::nesting {
namespace {

using Eigen::Vector2d;

constexpr int kMostPasses = 8;
constexpr double kClearMm = 1e-3;  // so that rounding leaves no overlap

class Compaction {
 public:
  Compaction(std::vector<Lying>& lying, const std::vector<Points2>& faults)
      : lying_(lying), faults_(faults) {
    for (const Lying& l : lying) boxes_.push_back(boxOf(l.outline));
    for (const Points2& fault : faults) faultBoxes_.push_back(boxOf(fault));
  }

  /// How far an outline can slide back along an axis.
  [[nodiscard]] double room(std::size_t i, int axis) const {
    double room = boxes_[i].min[axis];
    const auto consider = [&](const Points2& other, const Box2& box) {
      const int across = 1 - axis;
      if (box.min[axis] >= boxes_[i].max[axis] || box.max[axis] <= boxes_[i].min[axis] - room ||
          box.min[across] >= boxes_[i].max[across] || box.max[across] <= boxes_[i].min[across])
        return;
      std::vector<ShiftRange> blocked;
      addBlockedShifts(lying_[i].outline, other, axis, blocked);
      for (const ShiftRange& range : blocked)
        if (range.from < -kClearMm) room = std::min(room, -range.to);
    };
    for (std::size_t j = 0; j < lying_.size(); ++j)
      if (j != i) consider(lying_[j].outline, boxes_[j]);
    for (std::size_t f = 0; f < faults_.size(); ++f) consider(faults_[f], faultBoxes_[f]);
    return room - kClearMm;
  }
  void move(std::size_t i, int axis, double by) {
    for (Vector2d& p : lying_[i].outline) p[axis] -= by;
    boxes_[i].min[axis] -= by;
    boxes_[i].max[axis] -= by;
  }
  [[nodiscard]] const Box2& box(std::size_t i) const { return boxes_[i]; }

 private:
  std::vector<Lying>& lying_;
  const std::vector<Points2>& faults_;
  std::vector<Box2> boxes_, faultBoxes_;
};

}  // namespace

std::vector<Vector2d> compact(std::vector<Lying> lying, const std::vector<Points2>& faults) {
  std::vector<Vector2d> moved(lying.size(), Vector2d::Zero());
  Compaction compaction(lying, faults);
  std::vector<std::size_t> order(lying.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int pass = 0; pass < kMostPasses; ++pass) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return compaction.box(a).min.x() < compaction.box(b).min.x();
    });
    double most = 0;
    for (const std::size_t i : order) {
      for (const int axis : {0, 1}) {
        if (axis == 1 && lying[i].onFold) continue;
        const double by = compaction.room(i, axis);
        if (by <= 0) continue;
        compaction.move(i, axis, by);
        moved[i][axis] -= by;
        most = std::max(most, by);
      }
    }
    if (most < 0.01) break;
  }
  return moved;
}

}  // namespace toile::nesting
