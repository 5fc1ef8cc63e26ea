// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout/part_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "layout/clearance.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kClearMm = 1e-3;  // so that rounding leaves no overlap

enum class Side { Left, Right, Middle };

/// What moves as one: a piece, or a piece and its mirror image.
struct Item {
  struct Member {
    std::size_t piece = 0;
    Side side = Side::Middle;
  };
  std::vector<Member> members;
  [[nodiscard]] bool isMiddle() const { return members.front().side == Side::Middle; }
  /// Whether what moves this one takes the other along: they have a group in common.
  [[nodiscard]] bool sharesGroup(const Item& other) const {
    return std::any_of(members.begin(), members.end(), [&](const Member& a) {
      return std::any_of(other.members.begin(), other.members.end(),
                         [&](const Member& b) { return a.side == b.side; });
    });
  }
};

Side sideOf(const PlacedPiece& placed) {
  constexpr double kMiddle = 0.01;  // of the width
  const Box2 box = boxOf(placed.cut);
  const double off = 0.5 * (box.min.x() + box.max.x());
  if (std::abs(off) <= kMiddle * box.size().x()) return Side::Middle;
  return off < 0 ? Side::Left : Side::Right;
}

double outwards(Side side) {
  return side == Side::Left ? -1 : 1;
}

class Parting {
 public:
  Parting(std::vector<PlacedPiece>& placed, const std::vector<std::size_t>& pieces,
          const std::vector<std::optional<std::size_t>>& mirror)
      : placed_(placed) {
    for (const std::size_t p : pieces) {
      Item item;
      const bool isPaired = mirror[p] && *mirror[p] != p;
      if (isPaired && *mirror[p] < p) continue;
      item.members.push_back({p, mirror[p] == p ? Side::Middle : sideOf(placed[p])});
      if (isPaired) {
        // A pair is one even where both its halves hang over the axis.
        const bool isLeft = boxOf(placed[p].cut).min.x() < boxOf(placed[*mirror[p]].cut).min.x();
        item.members.front().side = isLeft ? Side::Left : Side::Right;
        item.members.push_back({*mirror[p], isLeft ? Side::Right : Side::Left});
      }
      (placed[p].byHand ? fixed_ : free_).push_back(std::move(item));
    }
  }

  void run() {
    while (!free_.empty()) {
      const auto next = nextOf(free_);
      Item item = std::move(*next);
      free_.erase(next);
      if (item.members.size() == 2) move(item, true, leastParting(item));
      const double up = leastShift(item, false);
      if (item.isMiddle()) {
        move(item, false, up);
      } else if (up > 0) {
        const double out = leastShift(item, true);
        move(item, out <= up, std::min(out, up));
      }
      fixed_.push_back(std::move(item));
    }
  }

 private:
  /// The lowest by its bottom edge; of those about as low the one nearest to the axis, so that
  /// what is inside on the body stays inside.
  [[nodiscard]] std::vector<Item>::iterator nextOf(std::vector<Item>& items) const {
    constexpr double kAsLowMm = 30;
    const auto bottom = [&](const Item& item) {
      double y = std::numeric_limits<double>::infinity();
      for (const Item::Member& m : item.members)
        y = std::min(y, boxOf(placed_[m.piece].cut).min.y());
      return y;
    };
    const auto fromAxis = [&](const Item& item) {
      if (item.isMiddle()) return -std::numeric_limits<double>::infinity();
      double x = std::numeric_limits<double>::infinity();
      for (const Item::Member& m : item.members) {
        const Box2 box = boxOf(placed_[m.piece].cut);
        x = std::min(x, m.side == Side::Left ? -box.max.x() : box.min.x());
      }
      return x;
    };
    double lowest = std::numeric_limits<double>::infinity();
    for (const Item& item : items) lowest = std::min(lowest, bottom(item));
    auto best = items.end();
    for (auto item = items.begin(); item != items.end(); ++item) {
      if (bottom(*item) > lowest + kAsLowMm) continue;
      if (best == items.end() || fromAxis(*item) < fromAxis(*best)) best = item;
    }
    return best;
  }

  /// The least move, outwards or up, that frees an item of all that is fixed.
  [[nodiscard]] double leastShift(const Item& item, bool outward) const {
    std::vector<ShiftRange> blocked;
    for (const Item::Member& m : item.members) {
      for (const Item& other : fixed_) {
        for (const Item::Member& f : other.members) {
          std::vector<ShiftRange> ranges;
          addBlockedShifts(placed_[m.piece].grownBy, placed_[f.piece].grownBy, outward ? 0 : 1,
                           ranges);
          const bool toTheLeft = outward && m.side == Side::Left;
          for (const ShiftRange& range : ranges)
            blocked.push_back(toTheLeft ? ShiftRange{-range.to, -range.from} : range);
        }
      }
    }
    const double shift = leastFreeShift(std::move(blocked));
    return shift > 0 ? shift + kClearMm : 0;
  }

  /// By how much the halves of a mirrored pair must part so as not to overlap each other.
  [[nodiscard]] double leastParting(const Item& item) const {
    const bool firstIsLeft = item.members[0].side == Side::Left;
    const PlacedPiece& left = placed_[item.members[firstIsLeft ? 0 : 1].piece];
    const PlacedPiece& right = placed_[item.members[firstIsLeft ? 1 : 0].piece];
    std::vector<ShiftRange> between;
    addBlockedShifts(right.grownBy, left.grownBy, 0, between);
    const double shift = 0.5 * leastFreeShift(std::move(between));
    return shift > 0 ? shift + kClearMm : 0;
  }

  /// Moves an item and what is still free in its group.
  void move(const Item& item, bool outward, double by) {
    if (by <= 0) return;
    moveAlone(item, outward, by);
    for (const Item& other : free_)
      if (item.sharesGroup(other)) moveAlone(other, outward, by);
  }
  void moveAlone(const Item& item, bool outward, double by) {
    for (const Item::Member& m : item.members)
      placed_[m.piece].shift(outward ? Vector2d(outwards(m.side) * by, 0) : Vector2d(0, by));
  }

  std::vector<PlacedPiece>& placed_;
  std::vector<Item> free_;
  std::vector<Item> fixed_;
};

}  // namespace

void partPieces(std::vector<PlacedPiece>& placed, const std::vector<std::size_t>& pieces,
                const std::vector<std::optional<std::size_t>>& mirror) {
  Parting(placed, pieces, mirror).run();
}

}  // namespace toile
