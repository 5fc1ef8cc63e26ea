// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/layout/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "finish/polygon.h"
#include "layout/clearance.h"
#include "layout/guiding_map.h"

namespace toile {
namespace {

enum class Side { Left, Right, Middle };

/// A pattern piece on its chart.
struct Placed {
  std::size_t piece = 0;
  Placement placement;
  Points2 cut;      ///< cut line in place
  Points2 grownBy;  ///< the same grown by half the gap: grown lines may touch, not overlap
  Side side = Side::Middle;
  void shift(const Eigen::Vector2d& by) {
    placement.offset += by;
    for (Eigen::Vector2d& p : cut) p += by;
    for (Eigen::Vector2d& p : grownBy) p += by;
  }
};

/// What moves as one: a piece, or a piece and its mirror image on the other side.
struct Item {
  std::vector<std::size_t> members;  ///< indices in the list of placed pieces
  bool operator==(const Item&) const = default;
};

/// Which items move together: mirrored pairs, pieces on the left, on the right, in the middle.
int groupOf(const Item& item, const std::vector<Placed>& placed) {
  if (item.members.size() == 2) return 0;
  return 1 + static_cast<int>(placed[item.members.front()].side);
}

double outwards(Side side) {
  return side == Side::Left ? -1.0 : side == Side::Right ? 1.0 : 0.0;
}

bool isMirrorImage(const Placed& a, const Placed& b, double axis) {
  constexpr double kSameMm = 3;
  const Box2 x = boxOf(a.cut);
  const Box2 y = boxOf(b.cut);
  return std::abs(x.min.y() - y.min.y()) < kSameMm && std::abs(x.max.y() - y.max.y()) < kSameMm &&
         std::abs((x.min.x() - axis) + (y.max.x() - axis)) < kSameMm &&
         std::abs((x.max.x() - axis) + (y.min.x() - axis)) < kSameMm &&
         std::abs(signedArea(a.cut) - signedArea(b.cut)) < 0.01 * std::abs(signedArea(a.cut));
}

std::vector<Item> makeItems(std::vector<Placed>& placed, double axis) {
  constexpr double kMiddle = 0.02;  // of the width: a piece that near to the axis lies on it
  for (Placed& p : placed) {
    const Box2 box = boxOf(p.cut);
    const double off = 0.5 * (box.min.x() + box.max.x()) - axis;
    if (std::abs(off) > kMiddle * box.size().x()) p.side = off < 0 ? Side::Left : Side::Right;
  }
  std::vector<Item> items;
  std::vector<char> used(placed.size(), 0);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (used[i] != 0) continue;
    used[i] = 1;
    Item item{{i}};
    for (std::size_t j = i + 1; j < placed.size() && placed[i].side != Side::Middle; ++j) {
      if (used[j] != 0 || placed[j].side == Side::Middle || placed[j].side == placed[i].side ||
          !isMirrorImage(placed[i], placed[j], axis))
        continue;
      used[j] = 1;
      item.members.push_back(j);
      break;
    }
    items.push_back(std::move(item));
  }
  return items;
}

/// Section 6.3 of the article's layout: from the lowest item on, each that overlaps what is fixed
/// moves up or outwards, whichever is shorter, and the items of its group that are still free move
/// with it, so that their arrangement stays.
void eliminateOverlaps(std::vector<Placed>& placed, double axis) {
  std::vector<Item> free = makeItems(placed, axis);
  std::vector<std::size_t> fixed;
  const auto order = [&](const Item& item) {
    double bottom = std::numeric_limits<double>::infinity();
    double fromAxis = bottom;
    for (const std::size_t m : item.members) {
      const Box2 box = boxOf(placed[m].cut);
      bottom = std::min(bottom, box.min.y());
      fromAxis = std::min(fromAxis, std::abs(0.5 * (box.min.x() + box.max.x()) - axis));
    }
    return std::make_tuple(bottom, fromAxis, item.members.front());
  };
  while (!free.empty()) {
    const auto lowest =
        std::min_element(free.begin(), free.end(),
                         [&](const Item& a, const Item& b) { return order(a) < order(b); });
    const Item item = *lowest;
    free.erase(lowest);
    const bool canMoveOut =
        std::all_of(item.members.begin(), item.members.end(),
                    [&](std::size_t m) { return placed[m].side != Side::Middle; });

    std::vector<ShiftRange> up;
    std::vector<ShiftRange> out;
    for (const std::size_t m : item.members) {
      const Placed& moving = placed[m];
      for (const std::size_t f : fixed) {
        addBlockedShifts(moving.grownBy, placed[f].grownBy, 1, up);
        if (!canMoveOut) continue;
        std::vector<ShiftRange> toTheRight;
        addBlockedShifts(moving.grownBy, placed[f].grownBy, 0, toTheRight);
        for (const ShiftRange& range : toTheRight)
          out.push_back(moving.side == Side::Left ? ShiftRange{-range.to, -range.from} : range);
      }
    }
    bool isMutual = false;  // whether a pair's own halves overlap: up does not part them
    if (item.members.size() == 2) {
      const auto [left, right] = placed[item.members[0]].side == Side::Left
                                     ? std::pair(item.members[0], item.members[1])
                                     : std::pair(item.members[1], item.members[0]);
      std::vector<ShiftRange> between;
      addBlockedShifts(placed[right].grownBy, placed[left].grownBy, 0, between);
      for (const ShiftRange& range : between) {
        if (range.from < 0 && range.to > 0) isMutual = true;
        out.push_back({0.5 * range.from, 0.5 * range.to});  // both halves move
      }
    }
    const double upBy = leastFreeShift(up);
    const double outBy = canMoveOut ? leastFreeShift(out) : 0;
    const bool moveOut = canMoveOut && (isMutual || outBy < upBy);
    const double by = moveOut ? outBy : upBy;
    const int group = groupOf(item, placed);
    const auto move = [&](const Item& which) {
      for (const std::size_t m : which.members)
        placed[m].shift(moveOut ? Eigen::Vector2d(outwards(placed[m].side) * by, 0)
                                : Eigen::Vector2d(0, by));
    };
    if (by > 0) {
      move(item);
      for (const Item& other : free)
        if (groupOf(other, placed) == group) move(other);
    }
    fixed.insert(fixed.end(), item.members.begin(), item.members.end());
  }
}

Box2 boxOfAll(const std::vector<Placed>& placed) {
  Points2 corners;
  for (const Placed& p : placed) {
    const Box2 box = boxOf(p.cut);
    corners.push_back(box.min);
    corners.push_back(box.max);
  }
  return boxOf(corners);
}

double axisOf(const ReferenceModel& model, Chart chart) {
  if (!model.symmetry || std::abs(model.symmetry->normal.x()) < 0.9) {
    const double middle = 0.5 * (model.mesh->boxMin().x() + model.mesh->boxMax().x());
    return chart == Chart::Back ? -middle : middle;
  }
  const double x = model.symmetry->offset / model.symmetry->normal.x();
  return chart == Chart::Back ? -x : x;
}

}  // namespace

Result<Layout> arrange(const ReferenceModel& model, const CutResult& cut,
                       const std::vector<std::shared_ptr<const FlatPiece>>& flats,
                       const std::vector<PatternPiece>& pattern,
                       const std::vector<std::uint32_t>& pieceIndex) {
  if (pieceIndex.size() != pattern.size())
    return Error{ErrorCode::InvalidArgument, "the layout needs the index of each piece", {}};
  std::array<std::vector<Placed>, 2> charts;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const std::uint32_t index = pieceIndex[i];
    if (index >= cut.pieces.size() || index >= flats.size() || flats[index] == nullptr ||
        pattern[i].cutLines.empty())
      return Error{
          ErrorCode::InvalidArgument,
          fmt::format("piece \"{}\" has no flat piece or no cut line to lay out", pattern[i].name),
          {Element::piece(pattern[i].id)}};
    const ChartPlace place = placeOnChart(cut.pieces[index], *flats[index]);
    Placed placed;
    placed.piece = i;
    placed.placement = place.placement;
    for (const OutlinePoint& p : pattern[i].cutLines.front())
      placed.cut.push_back(place.placement.apply(p.position));
    placed.grownBy = grown(placed.cut, 0.5 * kLayoutGapMm);
    charts[place.chart == Chart::Back ? 1 : 0].push_back(std::move(placed));
  }
  for (const Chart chart : {Chart::Front, Chart::Back}) {
    std::vector<Placed>& placed = charts[chart == Chart::Back ? 1 : 0];
    eliminateOverlaps(placed, axisOf(model, chart));
  }
  constexpr double kBetweenChartsMm = 4 * kLayoutGapMm;
  if (!charts[0].empty()) {
    const double right = boxOfAll(charts[0]).max.x();
    const double left = boxOfAll(charts[1]).min.x();
    for (Placed& placed : charts[1]) placed.shift({right + kBetweenChartsMm - left, 0});
  }

  std::vector<Placed> all = std::move(charts[0]);
  all.insert(all.end(), charts[1].begin(), charts[1].end());
  Layout layout;
  // The promise itself, measured on the true lines: a piece that breaks it goes to the far right.
  constexpr double kRoundingMm = 1e-3;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Box2 a = boxOf(all[i].cut);
      const Box2 b = boxOf(all[j].cut);
      if ((a.min - b.max).maxCoeff() > kLayoutGapMm || (b.min - a.max).maxCoeff() > kLayoutGapMm)
        continue;
      if (distanceBetween(all[i].cut, all[j].cut) >= kLayoutGapMm - kRoundingMm) continue;
      all[i].shift({boxOfAll(all).max.x() + kLayoutGapMm - a.min.x(), 0});
      layout.findings.push_back(
          {"layout-moved-aside",
           fmt::format("piece \"{}\" found no place beside \"{}\" and lies on the right of the "
                       "sheet",
                       pattern[all[i].piece].name, pattern[all[j].piece].name),
           {Element::piece(pattern[all[i].piece].id)}});
      break;
    }
  }
  const Box2 box = boxOfAll(all);
  layout.placements.resize(pattern.size());
  for (Placed& placed : all) {
    placed.shift(-box.min);
    layout.placements[placed.piece] = placed.placement;
  }
  layout.max = box.size();
  return layout;
}

}  // namespace toile
