// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "unfold/edge_grid.h"
#include "unfold/orientation.h"
#include "unfold/wire_bending.h"

namespace toile::unfolding {
namespace {

/// Wire nodes turned by less than this against straight are no corners.
constexpr double kCornerTurn = 35 * std::numbers::pi / 180;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double distanceToLine(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const Eigen::Vector2d to = p - a;
  return std::abs(cross(along, to)) / along.norm();
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

/// A boundary vertex and the ways that leave it along the boundary.
struct Bend {
  Eigen::Vector2d at, before, after;
};

/// Whether the boundary passes through an edge at one of its own vertices, which lies on the edge
/// within the contact depth: the ways to both sides of it end on different sides of the edge.
bool passesThrough(const Bend& bend, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double length = (b - a).norm();
  const Eigen::Vector2d along = (b - a) / length;
  const double foot = along.dot(bend.at - a);
  const double height = cross(along, bend.at - a);
  if (std::abs(height) > kContactDepthMm || foot < kContactDepthMm ||
      foot > length - kContactDepthMm) {
    return false;
  }
  const auto depth = [&](const Eigen::Vector2d& way) {  // as far as it stays beside the edge
    const double ahead = along.dot(way);
    const double room = ahead > 0 ? length - foot : foot;
    const double share = std::abs(ahead) > room ? room / std::abs(ahead) : 1;
    return height + share * cross(along, way);
  };
  const double before = depth(bend.before), after = depth(bend.after);
  return std::min(std::abs(before), std::abs(after)) > kContactDepthMm && before * after < 0;
}

/// Whether two parts of the boundary pass through each other at vertices that coincide within the
/// contact depth: their ways alternate around the place.
bool passesThrough(const Bend& bend, const Bend& other) {
  if ((bend.at - other.at).norm() > 2 * kContactDepthMm) return false;
  const auto isClear = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    return u.dot(v) < 0 ||
           std::abs(cross(u, v)) > 2 * kContactDepthMm * std::max(u.norm(), v.norm());
  };
  for (const Eigen::Vector2d& u : {bend.before, bend.after}) {
    if (!isClear(u, other.before) || !isClear(u, other.after)) return false;
  }
  const auto angle = [&](const Eigen::Vector2d& u) {
    const double from = std::atan2(cross(other.before, u), other.before.dot(u));
    return from < 0 ? from + 2 * std::numbers::pi : from;
  };
  const double turn = angle(other.after);
  return (angle(bend.before) < turn) != (angle(bend.after) < turn);
}

/// Pairs of boundary edges that pass through each other at a vertex.
void addCrossingsAtVertices(const Problem& problem, const Plane& q,
                            std::vector<std::pair<std::uint32_t, std::uint32_t>>& found) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> wireEdge;
  for (std::uint32_t i = 0; i < problem.wireEdges.size(); ++i) {
    wireEdge[std::minmax(problem.wireEdges[i].a, problem.wireEdges[i].b)] = i;
  }
  struct Step {
    std::uint32_t from = 0, to = 0;
    Bend bend;  ///< at `from`
  };
  std::vector<Step> steps;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> segments;
  for (const auto& loop : problem.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t before = loop[(i + loop.size() - 1) % loop.size()];
      const std::uint32_t to = loop[(i + 1) % loop.size()];
      const Eigen::Vector2d here = at(q, loop[i]);
      steps.push_back({loop[i], to, {here, at(q, before) - here, at(q, to) - here}});
      segments.emplace_back(here, at(q, to));
    }
  }
  const auto passes = [&](const Step& point, const Step& edge) {
    if (point.from == edge.from || point.from == edge.to) return false;
    return passesThrough(point.bend, edge.bend.at, at(q, edge.to)) ||
           (point.from < edge.from && passesThrough(point.bend, edge.bend));
  };
  for (const auto& [i, j] : nearSegments(segments, 2 * kContactDepthMm)) {
    if (!passes(steps[i], steps[j]) && !passes(steps[j], steps[i])) continue;
    found.push_back(std::minmax(wireEdge.at(std::minmax(steps[i].from, steps[i].to)),
                                wireEdge.at(std::minmax(steps[j].from, steps[j].to))));
  }
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> findCrossings(const Problem& problem,
                                                                   const Plane& q) {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> segments;
  segments.reserve(problem.wireEdges.size());
  for (const WireEdge& edge : problem.wireEdges)
    segments.emplace_back(at(q, edge.a), at(q, edge.b));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found = nearSegments(segments, 0);
  std::erase_if(found,
                [&](const auto& pair) { return !crosses(problem, q, pair.first, pair.second); });
  addCrossingsAtVertices(problem, q, found);
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
