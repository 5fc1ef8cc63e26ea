// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/layout/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "finish/polygon.h"
#include "layout/clearance.h"
#include "layout/guiding_map.h"

namespace toile {
namespace {

using Eigen::Vector2d;

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

/// Mean height and mean distance from the axis of an item's pieces.
struct ItemPlace {
  double height = 0, fromAxis = 0;
  double bottom = 0, top = 0;
  bool canMoveOut = true;
};

ItemPlace placeOf(const Item& item, const std::vector<Placed>& placed, double axis) {
  ItemPlace place;
  place.bottom = std::numeric_limits<double>::infinity();
  place.top = -place.bottom;
  const double share = 1.0 / static_cast<double>(item.members.size());
  for (const std::size_t m : item.members) {
    const Box2 box = boxOf(placed[m].cut);
    place.height += share * 0.5 * (box.min.y() + box.max.y());
    place.fromAxis += share * std::abs(0.5 * (box.min.x() + box.max.x()) - axis);
    place.bottom = std::min(place.bottom, box.min.y());
    place.top = std::max(place.top, box.max.y());
    place.canMoveOut = place.canMoveOut && placed[m].side != Side::Middle;
  }
  return place;
}

void moveItem(const Item& item, bool outward, double by, std::vector<Placed>& placed) {
  for (const std::size_t m : item.members)
    placed[m].shift(outward ? Vector2d(outwards(placed[m].side) * by, 0) : Vector2d(0, by));
}

/// Shifts of `moving` along its way that would overlap `fixed`.
std::vector<ShiftRange> blockedShifts(const Item& moving, const Item& fixed, bool outward,
                                      const std::vector<Placed>& placed) {
  std::vector<ShiftRange> blocked;
  for (const std::size_t m : moving.members) {
    for (const std::size_t f : fixed.members) {
      std::vector<ShiftRange> ranges;
      addBlockedShifts(placed[m].grownBy, placed[f].grownBy, outward ? 0 : 1, ranges);
      const bool toTheLeft = outward && placed[m].side == Side::Left;
      for (const ShiftRange& range : ranges)
        blocked.push_back(toTheLeft ? ShiftRange{-range.to, -range.from} : range);
    }
  }
  return blocked;
}

/// By how much the halves of a mirrored pair must part so as not to overlap each other.
double leastParting(const Item& item, const std::vector<Placed>& placed) {
  if (item.members.size() != 2) return 0;
  const bool firstIsLeft = placed[item.members[0]].side == Side::Left;
  const Placed& left = placed[item.members[firstIsLeft ? 0 : 1]];
  const Placed& right = placed[item.members[firstIsLeft ? 1 : 0]];
  std::vector<ShiftRange> between;
  addBlockedShifts(right.grownBy, left.grownBy, 0, between);
  return 0.5 * leastFreeShift(std::move(between));
}

/// How a piece that overlaps another gets free of it.
struct Move {
  std::size_t item, against;
  bool outward;
  double by;
};

/// How far one item lies above the other on the body: 0 = side by side, 1 = one upon the other.
double stacking(const ItemPlace& a, const ItemPlace& b) {
  const double heights = 0.5 * ((a.top - a.bottom) + (b.top - b.bottom));
  return std::abs(a.height - b.height) / std::max(heights, 1e-9);
}

/// The move that parts two items, or nothing if they do not overlap. Which one is the upper or
/// outer, and which way suits them, is told by where they lie on the body.
std::optional<Move> findMove(std::size_t i, std::size_t j, const std::vector<Item>& items,
                             const std::vector<ItemPlace>& onBody,
                             const std::vector<Placed>& placed) {
  constexpr double kSuits = 4;       // how much farther a move may be that suits better
  constexpr double kClearMm = 1e-3;  // so that rounding leaves no overlap
  const auto [upper, lower] =
      onBody[i].height >= onBody[j].height ? std::pair(i, j) : std::pair(j, i);
  const double up = leastFreeShift(blockedShifts(items[upper], items[lower], false, placed));
  if (up <= 0) return std::nullopt;
  const auto [outer, inner] =
      onBody[i].fromAxis >= onBody[j].fromAxis ? std::pair(i, j) : std::pair(j, i);
  const Move upMove{upper, lower, false, up + kClearMm};
  if (!onBody[outer].canMoveOut) return upMove;
  const double out = leastFreeShift(blockedShifts(items[outer], items[inner], true, placed));
  const double stacked = stacking(onBody[i], onBody[j]);
  const double price = stacked < 0.3 ? 1 / kSuits : stacked > 0.55 ? kSuits : 1;
  return price * out < up ? Move{outer, inner, true, out + kClearMm} : upMove;
}

/// Moves pieces up and outwards until none overlap, in the order that they have on the body; what
/// lies beyond a moved piece moves with it, so that the arrangement stays.
/// @return false if it did not come to an end
bool spreadOut(std::vector<Placed>& placed, double axis) {
  const std::vector<Item> items = makeItems(placed, axis);
  std::vector<ItemPlace> onBody;
  for (const Item& item : items) onBody.push_back(placeOf(item, placed, axis));
  for (const Item& item : items)
    if (const double by = leastParting(item, placed); by > 0) moveItem(item, true, by, placed);
  const std::size_t mostSteps = 20 * items.size();
  for (std::size_t step = 0; step < mostSteps; ++step) {
    std::vector<ItemPlace> now;
    for (const Item& item : items) now.push_back(placeOf(item, placed, axis));
    // What is nearest to the ground, then to the axis, is settled first and stays settled.
    const auto order = [&](const Move& move) {
      return std::make_tuple(move.outward,
                             move.outward ? onBody[move.item].fromAxis : onBody[move.item].bottom);
    };
    std::optional<Move> best;
    for (std::size_t i = 0; i < items.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (now[i].bottom - 2 * kLayoutGapMm > now[j].top ||
            now[j].bottom - 2 * kLayoutGapMm > now[i].top)
          continue;
        const std::optional<Move> move = findMove(i, j, items, onBody, placed);
        if (move && (!best || order(*move) < order(*best))) best = move;
      }
    }
    if (!best) return true;
    const ItemPlace& moved = now[best->item];
    const ItemPlace& still = now[best->against];
    for (std::size_t k = 0; k < items.size(); ++k) {
      const bool isBeyond = best->outward
                                ? onBody[k].canMoveOut &&
                                      onBody[k].fromAxis >= onBody[best->item].fromAxis &&
                                      now[k].top > moved.bottom && now[k].bottom < moved.top
                                : now[k].height > still.height && now[k].bottom >= still.height;
      if (k == best->item || (k != best->against && isBeyond))
        moveItem(items[k], best->outward, best->by, placed);
    }
  }
  return false;
}

/// The article's rule, which always ends: from the lowest item on, each that overlaps what is fixed
/// moves up or outwards, whichever is shorter, and the items of its group that are still free move
/// with it, so that their arrangement stays.
void eliminateOverlaps(std::vector<Placed>& placed, double axis) {
  std::vector<Item> free = makeItems(placed, axis);
  std::vector<Item> fixed;
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
    const bool canMoveOut = placeOf(item, placed, axis).canMoveOut;
    const double parting = leastParting(item, placed);
    if (parting > 0) moveItem(item, true, parting, placed);
    std::vector<ShiftRange> up;
    std::vector<ShiftRange> out;
    for (const Item& other : fixed) {
      for (const ShiftRange& range : blockedShifts(item, other, false, placed)) up.push_back(range);
      if (!canMoveOut) continue;
      for (const ShiftRange& range : blockedShifts(item, other, true, placed)) out.push_back(range);
    }
    const double upBy = leastFreeShift(up);
    const double outBy = canMoveOut ? leastFreeShift(out) : 0;
    const bool moveOut = canMoveOut && outBy < upBy;
    const double by = moveOut ? outBy : upBy;
    const int group = groupOf(item, placed);
    if (by > 0) {
      moveItem(item, moveOut, by, placed);
      for (const Item& other : free)
        if (groupOf(other, placed) == group) moveItem(other, moveOut, by, placed);
    }
    fixed.push_back(item);
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
    const std::vector<Placed> onMap = placed;
    if (spreadOut(placed, axisOf(model, chart))) continue;
    placed = onMap;
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
