// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "unfold/orientation.h"
#include "unfold/wire_bending.h"

namespace toile::unfolding {
namespace {

/// Wire nodes turned by less than this against straight are no corners.
constexpr double kCornerTurn = 35 * std::numbers::pi / 180;

double distanceToLine(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const Eigen::Vector2d to = p - a;
  return std::abs(along.x() * to.y() - along.y() * to.x()) / along.norm();
}

bool crosses(const Problem& problem, const Plane& q, std::uint32_t first, std::uint32_t second) {
  const WireEdge& e = problem.wireEdges[first];
  const WireEdge& f = problem.wireEdges[second];
  if (e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b) return false;
  const Eigen::Vector2d ea = at(q, e.a), eb = at(q, e.b), fa = at(q, f.a), fb = at(q, f.b);
  if (orientation(ea, eb, fa) * orientation(ea, eb, fb) >= 0) return false;
  if (orientation(fa, fb, ea) * orientation(fa, fb, eb) >= 0) return false;
  const double depth = std::min({distanceToLine(ea, fa, fb), distanceToLine(eb, fa, fb),
                                 distanceToLine(fa, ea, eb), distanceToLine(fb, ea, eb)});
  return depth > kContactDepthMm;
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> findCrossings(const Problem& problem,
                                                                   const Plane& q) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  const std::size_t count = problem.wireEdges.size();
  Eigen::Vector2d low = at(q, problem.wireEdges.front().a);
  Eigen::Vector2d high = low;
  double longest = 0;
  for (const WireEdge& edge : problem.wireEdges) {
    const Eigen::Vector2d a = at(q, edge.a), b = at(q, edge.b);
    low = low.cwiseMin(a).cwiseMin(b);
    high = high.cwiseMax(a).cwiseMax(b);
    longest = std::max(longest, (a - b).norm());
  }
  // Cells of about an edge; no more of them than a few per edge, however long the piece is.
  const double extent = (high - low).maxCoeff();
  const double cell = std::max(
      {extent / (1.0 + 4.0 * std::sqrt(static_cast<double>(count))), 0.25 * longest, 1e-300});
  const auto cellsAlong = [&](int axis) {
    return static_cast<std::int64_t>((high[axis] - low[axis]) / cell) + 1;
  };
  const std::int64_t columns = cellsAlong(0);
  std::vector<std::pair<std::int64_t, std::uint32_t>> entries;  // cell, edge
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector2d a = at(q, problem.wireEdges[i].a), b = at(q, problem.wireEdges[i].b);
    const Eigen::Vector2d from = (a.cwiseMin(b) - low) / cell;
    const Eigen::Vector2d to = (a.cwiseMax(b) - low) / cell;
    for (auto y = static_cast<std::int64_t>(from.y()); y <= static_cast<std::int64_t>(to.y());
         ++y) {
      for (auto x = static_cast<std::int64_t>(from.x()); x <= static_cast<std::int64_t>(to.x());
           ++x) {
        entries.emplace_back(y * columns + x, i);
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin;
    while (end < entries.size() && entries[end].first == entries[begin].first) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        if (crosses(problem, q, entries[i].second, entries[j].second)) {
          found.emplace_back(entries[i].second, entries[j].second);
        }
      }
    }
    begin = end;
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<std::uint32_t> findFlips(const Problem& problem, const Plane& q) {
  std::vector<std::uint32_t> flips;
  for (std::uint32_t i = 0; i < problem.triangles.size(); ++i) {
    const auto& v = problem.triangles[i].vertex;
    if (orientation(at(q, v[0]), at(q, v[1]), at(q, v[2])) <= 0) flips.push_back(i);
  }
  return flips;
}

UnfoldCheck makeCheck(const Problem& problem, const Plane& q, std::size_t flips,
                      std::size_t crossings) {
  UnfoldCheck check;
  check.flippedFaces = flips;
  check.crossings = crossings;
  // Walking a loop by the target lengths in the flat directions must come back: the sum of the
  // edges' errors as vectors, found from the end of each edge that runs along the loop.
  std::vector<std::vector<std::pair<std::uint32_t, double>>> targetFrom(problem.vertexCount);
  for (const WireEdge& edge : problem.wireEdges) {
    const double flat = (at(q, edge.a) - at(q, edge.b)).norm();
    check.maxLengthError =
        std::max(check.maxLengthError, std::abs(flat - edge.target) / std::max(edge.target, 1.0));
    if (edge.inner) continue;
    targetFrom[edge.a].emplace_back(edge.b, edge.target);
    targetFrom[edge.b].emplace_back(edge.a, edge.target);
  }
  for (const auto& loop : problem.loops) {
    Eigen::Vector2d gap = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t to = loop[(i + 1) % loop.size()];
      const Eigen::Vector2d step = at(q, to) - at(q, loop[i]);
      for (const auto& [neighbour, target] : targetFrom[loop[i]]) {
        if (neighbour == to) gap += target / step.norm() * step;
      }
    }
    check.maxClosureGap = std::max(check.maxClosureGap, gap.norm());
  }
  const std::vector<double> theta = cornerAngles(problem, q);
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double alpha = problem.corners[i].alpha;
    if (std::abs(std::numbers::pi - alpha) >= kCornerTurn) continue;
    check.maxTurnError = std::max(check.maxTurnError, std::abs(theta[i] - alpha));
  }
  return check;
}

}  // namespace toile::unfolding
