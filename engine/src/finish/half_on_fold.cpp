// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "finish/marking.h"
#include "finish/polygon.h"
#include "toile/finish/pattern_piece.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kSymmetricMm = 0.05;
constexpr double kOnFoldMm = 1e-3;

/// The half plane that stays: side * (x - axis) >= 0.
struct Half {
  double axis = 0;
  double side = 1;
  [[nodiscard]] double depth(const Vector2d& p) const { return side * (p.x() - axis); }
  [[nodiscard]] Vector2d crossing(const Vector2d& a, const Vector2d& b) const {
    const double t = (axis - a.x()) / (b.x() - a.x());
    return {axis, a.y() + t * (b.y() - a.y())};
  }
};

bool isSymmetric(const std::vector<Outline>& loops, double axis) {
  const std::vector<Points2> points = positions(loops);
  const EdgeGrid grid(points);
  return std::all_of(points.front().begin(), points.front().end(), [&](const Vector2d& p) {
    return grid.nearest({2 * axis - p.x(), p.y()}).distance <= kSymmetricMm;
  });
}

/// A loop of which one half is kept, beginning after the fold.
struct HalfLoop {
  Outline points;  ///< the first and the last lie on the fold
  /// Per edge of `points`: the edge of the whole loop that it lies on.
  std::vector<std::size_t> edges;
};

/// Nothing where the axis does not part the loop in two.
std::optional<HalfLoop> halve(const Outline& loop, const Half& half) {
  const std::size_t count = loop.size();
  const auto depth = [&](std::size_t i) { return half.depth(loop[i % count].position); };
  std::size_t enters = count;
  std::size_t leaves = count;
  for (std::size_t i = 0; i < count; ++i) {
    // A point on the axis belongs to the half that goes.
    const bool isIn = depth(i) > kOnFoldMm;
    const bool isNextIn = depth(i + 1) > kOnFoldMm;
    if (isIn == isNextIn) continue;
    std::size_t& place = isNextIn ? enters : leaves;
    if (place != count) return std::nullopt;
    place = i;
  }
  if (enters == count || leaves == count) return std::nullopt;
  HalfLoop out;
  const auto at = [&](std::size_t i) -> const Vector2d& { return loop[i % count].position; };
  out.points.push_back({half.crossing(at(enters), at(enters + 1)), true});
  for (std::size_t i = enters; i % count != leaves; ++i) {
    out.edges.push_back(i % count);
    out.points.push_back(loop[(i + 1) % count]);
  }
  out.edges.push_back(leaves);
  out.points.push_back({half.crossing(at(leaves), at(leaves + 1)), true});
  return out;
}

/// Runs over the edges of the half, in its order, and the fold as the last one.
std::vector<OutlineRun> runsOf(const PatternPiece& pattern, const HalfLoop& half) {
  const std::size_t count = pattern.sewLines.front().size();
  std::vector<const OutlineRun*> owner(count, nullptr);
  for (const OutlineRun& run : pattern.runs)
    for (std::size_t k = 0; k < run.edgeCount; ++k) owner[(run.first + k) % count] = &run;
  std::vector<OutlineRun> runs;
  for (std::size_t e = 0; e < half.edges.size(); ++e) {
    const OutlineRun* run = owner[half.edges[e]];
    if (run == nullptr) continue;
    if (e == 0 || owner[half.edges[e - 1]] != run) {
      runs.push_back(*run);
      runs.back().first = e;
      runs.back().edgeCount = 0;
      runs.back().arcEnds = {0};
    }
    ++runs.back().edgeCount;
  }
  for (OutlineRun& run : runs) {
    const OutlineRun& whole = *owner[half.edges[run.first]];
    double length = 0;
    double drawn = 0;
    const Outline& loop = pattern.sewLines.front();
    for (std::size_t k = 0; k < whole.edgeCount; ++k)
      drawn +=
          (loop[(whole.first + k + 1) % count].position - loop[(whole.first + k) % count].position)
              .norm();
    for (std::size_t k = 0; k < run.edgeCount; ++k) {
      length +=
          (half.points[run.first + k + 1].position - half.points[run.first + k].position).norm();
      run.arcEnds.push_back(k + 1);
    }
    const double share = drawn > 0 ? length / drawn : 1;
    run.length = share > 1 - 1e-9 ? whole.length : share * whole.length;
  }
  OutlineRun fold;
  fold.kind = WireKind::Border;
  fold.curve = "fold";
  fold.first = half.edges.size();
  fold.edgeCount = 1;
  fold.length = (half.points.back().position - half.points.front().position).norm();
  fold.arcEnds = {0, 1};
  runs.push_back(fold);
  return runs;
}

std::vector<InternalLine> halved(const std::vector<InternalLine>& lines, const Half& half) {
  std::vector<InternalLine> out;
  for (const InternalLine& line : lines) {
    Points2 way = line.points;
    if (line.closed && !way.empty()) way.push_back(way.front());
    bool isOpen = false;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const bool fromIn = half.depth(way[i]) >= 0;
      const bool toIn = half.depth(way[i + 1]) >= 0;
      if (!fromIn && !toIn) {
        isOpen = false;
        continue;
      }
      if (!isOpen) {
        out.push_back(line);
        out.back().closed = false;
        out.back().points = {fromIn ? way[i] : half.crossing(way[i], way[i + 1])};
      }
      out.back().points.push_back(toIn ? way[i + 1] : half.crossing(way[i], way[i + 1]));
      isOpen = toIn;
    }
  }
  return out;
}

}  // namespace

bool foldInHalf(PatternPiece& pattern, const Piece& piece, const FlatPiece& flat) {
  if (pattern.sewLines.size() != 1 || pattern.cutLines.size() != 1 || pattern.fold) return false;
  const Box2 box = boxOf(positions(pattern.sewLines.front()));
  Half half{0.5 * (box.min.x() + box.max.x()), 1};
  if (!isSymmetric(pattern.sewLines, half.axis) || !isSymmetric(pattern.cutLines, half.axis))
    return false;
  // The wearer's left is at +x; on a piece of the back it lies on the left of the sheet.
  double left = 0;
  for (std::size_t v = 0; v < flat.position.size(); ++v)
    left += piece.mesh->position(VertexId(v)).x() * (flat.position[VertexId(v)].x() - half.axis);
  half.side = left >= 0 ? 1 : -1;
  const std::optional<HalfLoop> sew = halve(pattern.sewLines.front(), half);
  const std::optional<HalfLoop> cut = halve(pattern.cutLines.front(), half);
  if (!sew || !cut) return false;
  pattern.runs = runsOf(pattern, *sew);
  pattern.sewLines.front() = sew->points;
  pattern.cutLines.front() = cut->points;
  // The piece lies on the left of the way from the end of the half to its begin.
  pattern.fold = {cut->points.back().position, cut->points.front().position};
  constexpr double kNotchFromFoldMm = 1;
  std::erase_if(pattern.notches,
                [&](const Notch& notch) { return half.depth(notch.position) < kNotchFromFoldMm; });
  std::erase_if(pattern.drillHoles, [&](const Vector2d& hole) { return half.depth(hole) < 0; });
  pattern.internalLines = halved(pattern.internalLines, half);
  const std::vector<Points2> loops = positions(pattern.sewLines);
  pattern.labelPosition = inmostPoint(loops).position;
  pattern.grain = grainLine(loops, pattern.labelPosition);
  pattern.label.insert(
      pattern.label.begin() + std::min<std::ptrdiff_t>(1, std::ssize(pattern.label)),
      "Cut on fold");
  return true;
}

}  // namespace toile
