// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/smoothing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace toile {
namespace {

using Eigen::Vector2d;

double distanceTo(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d d = b - a;
  const double squared = d.squaredNorm();
  if (squared == 0) return (p - a).norm();
  return (a + std::clamp((p - a).dot(d) / squared, 0.0, 1.0) * d - p).norm();
}

double lengthOf(std::span<const Vector2d> points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// A run, and with it its mate point by point.
struct Strand {
  std::vector<Points2> sides;  ///< one or two, all in the order of the first
  std::vector<char> keep;
  [[nodiscard]] std::size_t last() const { return keep.size() - 1; }
};

/// Keeps the points farthest from the chords until all are near; several that are equally far are
/// kept together, so that the way the run is walked does not matter.
void keepFarPoints(const Strand& strand, std::size_t from, std::size_t to, double tolerance,
                   std::vector<char>& keep) {
  if (to - from < 2) return;
  std::vector<double> off(to - from + 1, 0);
  double most = 0;
  for (std::size_t k = from + 1; k < to; ++k) {
    for (const Points2& side : strand.sides)
      off[k - from] = std::max(off[k - from], distanceTo(side[from], side[to], side[k]));
    most = std::max(most, off[k - from]);
  }
  if (most <= tolerance) return;
  std::size_t begin = from;
  for (std::size_t k = from + 1; k <= to; ++k) {
    if (k < to && off[k - from] < most - 1e-7) continue;
    if (k < to) keep[k] = 1;
    keepFarPoints(strand, begin, k, tolerance, keep);
    begin = k;
  }
}

/// What is kept at a tolerance that costs no side more than kSmoothingMm.
std::vector<char> chooseKept(const Strand& strand) {
  for (double tolerance = kSmoothingDistanceMm; tolerance > 1e-4; tolerance *= 0.5) {
    std::vector<char> keep = strand.keep;
    std::size_t begin = 0;
    for (std::size_t k = 1; k <= strand.last(); ++k) {
      if (strand.keep[k] == 0) continue;
      keepFarPoints(strand, begin, k, tolerance, keep);
      begin = k;
    }
    const bool isNear =
        std::all_of(strand.sides.begin(), strand.sides.end(), [&](const auto& side) {
          Points2 kept;
          for (std::size_t k = 0; k < keep.size(); ++k)
            if (keep[k] != 0) kept.push_back(side[k]);
          return lengthOf(side) - lengthOf(kept) <= kSmoothingMm;
        });
    if (isNear) return keep;
  }
  return std::vector<char>(strand.keep.size(), 1);
}

std::vector<std::size_t> chooseArcs(const Strand& strand, const std::vector<char>& corner) {
  std::vector<std::size_t> ends{0};
  const auto fits = [&](std::size_t from, std::size_t to) {
    return std::all_of(strand.sides.begin(), strand.sides.end(), [&](const Points2& side) {
      return equalArc(std::span(side).subspan(from, to - from + 1)).has_value();
    });
  };
  while (ends.back() < strand.last()) {
    std::size_t to = ends.back() + 1;
    while (to < strand.last() && corner[to] == 0 && fits(ends.back(), to + 1)) ++to;
    ends.push_back(to);
  }
  return ends;
}

}  // namespace

std::optional<EqualArc> equalArc(std::span<const Vector2d> points) {
  const Vector2d chord = points.back() - points.front();
  const double c = chord.norm();
  const double length = lengthOf(points);
  if (length <= 0) return std::nullopt;
  double area = 0;
  for (const Vector2d& p : points) area += cross(chord, p - points.front());
  if (length - c <= 1e-7 * length) return EqualArc{};  // straight
  // sin(h) / h = chord / length for the half angle h.
  const double ratio = c / length;
  double low = 0;
  double high = std::numbers::pi / 2;
  if (std::sin(high) / high > ratio) return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    const double h = 0.5 * (low + high);
    (std::sin(h) > ratio * h ? low : high) = h;
  }
  const double h = 0.5 * (low + high);
  EqualArc arc;
  arc.radius = length / (2 * h);
  // The points lie to the right of the chord where the way bends to the left.
  arc.toLeft = area < 0;
  const Vector2d left = Vector2d(-chord.y(), chord.x()) / c;
  const Vector2d centre = 0.5 * (points.front() + points.back()) +
                          (arc.toLeft ? 1 : -1) * arc.radius * std::cos(h) * left;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs((points[i] - centre).norm() - arc.radius) > kSmoothingDistanceMm)
      return std::nullopt;
    if (i == 0) continue;
    const Vector2d middle = 0.5 * (points[i] + points[i - 1]);
    if (std::abs((middle - centre).norm() - arc.radius) > 2 * kSmoothingDistanceMm)
      return std::nullopt;
  }
  return arc;
}

void smoothSewLines(std::vector<PieceInWork>& pieces, const SeamNet& net) {
  // Per piece and run: its points, corners, and what must stay.
  struct RunPoints {
    Points2 points;
    std::vector<char> corner, keep;
  };
  std::vector<std::vector<RunPoints>> runs(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    std::set<VertexId> ends;
    for (const Wire& wire : pieces[p].piece->wires) {
      if (isBoundary(wire.kind) || wire.vertices.empty()) continue;
      ends.insert(wire.vertices.front());
      ends.insert(wire.vertices.back());
    }
    for (const OutlineRun& run : pieces[p].sew.runs) {
      const Outline& loop = pieces[p].sew.loops[run.loop];
      const std::vector<VertexId>& vertices = pieces[p].piece->wires[run.wire].vertices;
      RunPoints& out = runs[p].emplace_back();
      for (std::size_t k = 0; k <= run.edgeCount; ++k) {
        const OutlinePoint& point = loop[(run.first + k) % loop.size()];
        out.points.push_back(point.position);
        out.corner.push_back(point.corner ? 1 : 0);
        const bool isEnd = k == 0 || k == run.edgeCount;
        out.keep.push_back(isEnd || point.corner || ends.contains(vertices[k]) ? 1 : 0);
      }
    }
  }

  std::vector<std::vector<char>> done(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) done[p].resize(runs[p].size(), 0);
  for (const RunId id : net.runs()) {
    if (done[id.piece][id.run] != 0) continue;
    done[id.piece][id.run] = 1;
    RunPoints& here = runs[id.piece][id.run];
    Strand strand{{here.points}, here.keep};
    std::vector<char> corner = here.corner;
    const auto mate = net.mate(id);
    const bool isPaired =
        mate && *mate != id && runs[mate->piece][mate->run].points.size() == here.points.size();
    const std::size_t last = here.points.size() - 1;
    if (isPaired) {
      const RunPoints& there = runs[mate->piece][mate->run];
      strand.sides.emplace_back(there.points.rbegin(), there.points.rend());
      for (std::size_t k = 0; k <= last; ++k) {
        strand.keep[k] = static_cast<char>(strand.keep[k] | there.keep[last - k]);
        corner[k] = static_cast<char>(corner[k] | there.corner[last - k]);
      }
    }
    const std::vector<char> keep = chooseKept(strand);
    Strand kept{std::vector<Points2>(strand.sides.size()), {}};
    std::vector<char> keptCorner;
    for (std::size_t k = 0; k <= last; ++k) {
      if (keep[k] == 0) continue;
      for (std::size_t s = 0; s < strand.sides.size(); ++s)
        kept.sides[s].push_back(strand.sides[s][k]);
      kept.keep.push_back(1);
      keptCorner.push_back(corner[k]);
    }
    std::vector<std::size_t> arcs = chooseArcs(kept, keptCorner);
    here.keep = keep;
    pieces[id.piece].sew.runs[id.run].arcEnds = arcs;
    if (!isPaired) continue;
    done[mate->piece][mate->run] = 1;
    runs[mate->piece][mate->run].keep.assign(keep.rbegin(), keep.rend());
    std::vector<std::size_t>& mirrored = pieces[mate->piece].sew.runs[mate->run].arcEnds;
    mirrored.clear();
    for (auto end = arcs.rbegin(); end != arcs.rend(); ++end)
      mirrored.push_back(kept.last() - *end);
  }

  for (std::size_t p = 0; p < pieces.size(); ++p) {
    SewOutline& sew = pieces[p].sew;
    std::vector<Outline> loops(sew.loops.size());
    for (std::size_t r = 0; r < sew.runs.size(); ++r) {
      OutlineRun& run = sew.runs[r];
      const RunPoints& from = runs[p][r];
      Outline& loop = loops[run.loop];
      run.first = loop.size();
      run.edgeCount = 0;
      for (std::size_t k = 0; k + 1 < from.points.size(); ++k) {
        if (from.keep[k] == 0) continue;
        loop.push_back({from.points[k], from.corner[k] != 0});
        ++run.edgeCount;
      }
    }
    // A round hole of few points stays a polygon.
    for (std::size_t l = 0; l < loops.size(); ++l) TOILE_ASSERT(loops[l].size() >= 2);
    sew.loops = std::move(loops);
  }
}

}  // namespace toile
