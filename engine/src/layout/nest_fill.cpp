// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout/nest_fill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "toile/core/parallel.h"

namespace toile::nesting {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Of the value: how far left things end on the average, so that a search sees the way ahead.
constexpr double kCompactShare = 0.02;

/// Random numbers that are the same everywhere.
/// @see Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }

 private:
  std::uint64_t state_;
};

}  // namespace

Filler::Filler(std::span<const RowShape> shapes, std::vector<Copy> copies, Bin bin)
    : shapes_(shapes), copies_(std::move(copies)), bin_(std::move(bin)), noFit_(shapes) {}

/// Where a shape can lie in a row of a sheet, as far as it is known during one fill: pieces are
/// only added, so that the first free place only moves to the right.
struct Filler::Frontier {
  struct Row {
    double x = 0;             ///< nothing to the left of it is free
    std::size_t checked = 0;  ///< so many of the placed copies leave x itself free
  };
  std::vector<std::vector<Row>> rows;  ///< per shape; empty until asked for
};

/// How far to the right a shape at x must move to clear what lies there; x where it is free.
double Filler::clearOf(const Rows& noFit, int index, double offset, double x) {
  if (index < 0 || index >= noFit.count()) return x;
  for (const ShiftRange& range : noFit[index]) {
    if (range.from + offset >= x) break;
    if (range.to + offset > x) return range.to + offset;
  }
  return x;
}

std::optional<Placed> Filler::findPlace(const Copy& copy, std::span<const Placed> placed,
                                        std::uint32_t sheet, Frontier& frontier) const {
  std::optional<Placed> best;
  double bestEnd = bin_.length.value_or(kInfinity) + 1e-9;
  frontier.rows.resize(shapes_.size());
  for (const std::uint32_t s : copy.shapes) {
    const RowShape& shape = shapes_[s];
    const int rows = shape.rows.count();
    const double room = bin_.height - shape.height + 1e-9;
    if (room < 0) continue;
    const int last = copy.onFold ? 0 : static_cast<int>(room / bin_.rowHeight);
    std::vector<Frontier::Row>& known = frontier.rows[s];
    if (known.empty()) known.resize(static_cast<std::size_t>(room / bin_.rowHeight) + 1);
    for (int row = 0; row <= last; ++row) {
      Frontier::Row& first = known[static_cast<std::size_t>(row)];
      double x = first.x;
      bool isFree = false;
      while (!isFree && x + shape.width < bestEnd) {
        isFree = true;
        const auto moveTo = [&](double next) {
          if (next <= x) return;
          x = next;
          isFree = false;
        };
        if (first.checked == 0 && !bin_.blocked.empty())
          moveTo(clearOf(bin_.blocked[s], row + rows - 1, 0, x));
        for (std::size_t i = first.checked; i < placed.size() && x + shape.width < bestEnd; ++i) {
          const Placed& other = placed[i];
          if (other.sheet != sheet || other.row >= row + rows ||
              other.row + shapes_[other.shape].rows.count() <= row)
            continue;
          moveTo(clearOf(noFit_.of(other.shape, s), row - other.row + rows - 1, other.x, x));
        }
        first.checked = isFree ? placed.size() : 0;
      }
      first.x = x;
      if (!isFree || x + shape.width >= bestEnd) continue;
      bestEnd = x + shape.width;
      best = Placed{s, sheet, row, x};
    }
  }
  return best;
}

bool Filler::fill(Fill& fill, std::size_t from, double most) const {
  fill.places.resize(from);
  double lastEnd = 0;
  double ends = 0;
  std::uint32_t sheets = 0;
  const double perSheet = bin_.length.value_or(0);
  const auto count = [&](const Placed& place) {
    if (place.sheet > sheets) lastEnd = 0;
    sheets = std::max(sheets, place.sheet);
    const double end = place.x + shapes_[place.shape].width;
    if (place.sheet == sheets) lastEnd = std::max(lastEnd, end);
    ends += place.sheet * perSheet + end;
    fill.length = sheets * perSheet + lastEnd;
    fill.value = fill.length + kCompactShare * ends / static_cast<double>(copies_.size());
    return fill.value <= most;
  };
  for (const Placed& place : fill.places) count(place);
  std::vector<Frontier> frontiers;
  for (std::size_t i = from; i < fill.order.size(); ++i) {
    const Copy& copy = copies_[fill.order[i]];
    std::optional<Placed> place;
    for (std::uint32_t sheet = 0; !place; ++sheet) {
      // A copy that finds no place on an empty sheet finds none at all.
      if (sheet > sheets + 1 || sheet >= bin_.mostSheets) return false;
      if (sheet >= frontiers.size()) frontiers.emplace_back();
      place = findPlace(copy, fill.places, sheet, frontiers[sheet]);
    }
    fill.places.push_back(*place);
    if (!count(*place)) return false;
  }
  return true;
}

std::optional<Fill> searchFill(const Filler& filler, int rounds,
                               const std::function<void(double)>& onBetter, Progress* progress) {
  const std::vector<Copy>& copies = filler.copies();
  // Largest first: by area of the box, by length along the roll, by height across it.
  std::array<Fill, 3> starts;
  std::array<char, 3> isWhole{};
  for (std::size_t s = 0; s < starts.size(); ++s) {
    std::vector<double> size;
    for (const Copy& copy : copies) {
      const RowShape& shape = filler.shape(copy.shapes.front());
      size.push_back(s == 0 ? shape.width * shape.height : s == 1 ? shape.width : shape.height);
    }
    starts[s].order.resize(copies.size());
    std::iota(starts[s].order.begin(), starts[s].order.end(), 0U);
    std::stable_sort(starts[s].order.begin(), starts[s].order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return size[a] > size[b]; });
  }
  parallelFor(starts.size(),
              [&](std::size_t s) { isWhole[s] = filler.fill(starts[s], 0, kInfinity) ? 1 : 0; });
  std::optional<Fill> best;
  for (std::size_t s = 0; s < starts.size(); ++s)
    if (isWhole[s] != 0 && (!best || starts[s].value < best->value)) best = starts[s];
  if (!best) return std::nullopt;
  if (onBetter) onBetter(best->length);
  if (copies.size() < 2) return best;

  // Each round tries a few changes of the order at once and takes the best of them, at first even
  // if it is a little worse: threshold accepting. A search of few rounds has no time for detours.
  constexpr std::size_t kTries = 8;
  const double firstThreshold = std::min(0.004, 1e-5 * rounds);
  Fill current = *best;
  for (int round = 0; round < rounds; ++round) {
    if (isCancelled(progress)) break;
    const double left = 1 - static_cast<double>(round) / rounds;
    const double most = current.value * (1 + firstThreshold * left * left);
    std::array<Fill, kTries> tries;
    std::array<char, kTries> isDone{};
    parallelFor(kTries, [&](std::size_t t) {
      Random random(static_cast<std::uint64_t>(round) * kTries + t + 1);
      Fill& fill = tries[t];
      fill.order = current.order;
      std::size_t a = random.below(copies.size());
      std::size_t b = random.below(copies.size());
      for (int i = 0; i < 20 && copies[fill.order[a]].kind == copies[fill.order[b]].kind; ++i) {
        a = random.below(copies.size());
        b = random.below(copies.size());
      }
      if (a == b) return;
      if (random.below(2) == 0) {
        std::swap(fill.order[a], fill.order[b]);
      } else {
        const auto at = [&](std::size_t i) {
          return fill.order.begin() + static_cast<std::ptrdiff_t>(i);
        };
        if (a < b)
          std::rotate(at(a), at(b), at(b) + 1);
        else
          std::rotate(at(b), at(b) + 1, at(a) + 1);
      }
      const std::size_t from = std::min(a, b);
      fill.places.assign(current.places.begin(),
                         current.places.begin() + static_cast<std::ptrdiff_t>(from));
      isDone[t] = filler.fill(fill, from, most) ? 1 : 0;
    });
    const Fill* next = nullptr;
    for (std::size_t t = 0; t < kTries; ++t)
      if (isDone[t] != 0 && (next == nullptr || tries[t].value < next->value)) next = &tries[t];
    if (next == nullptr) continue;
    current = *next;
    if (current.value >= best->value) continue;
    const bool isShorter = current.length < best->length;
    best = current;
    if (isShorter && onBetter) onBetter(best->length);
  }
  return best;
}

}  // namespace toile::nesting
