// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/overlap.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace toile::unfolding {
namespace {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// mm^2: touching, not overlapping.
constexpr double kLeastArea = 1e-6;

double cross(const Vector2d& u, const Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

/// What of a convex polygon lies left of the line from a to b.
Polygon clipped(const Polygon& polygon, const Vector2d& a, const Vector2d& b) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& from = polygon[i];
    const Vector2d& to = polygon[(i + 1) % polygon.size()];
    const double sideFrom = cross(b - a, from - a), sideTo = cross(b - a, to - a);
    if (sideFrom >= 0) kept.push_back(from);
    if ((sideFrom < 0) != (sideTo < 0)) {
      kept.emplace_back(from + sideFrom / (sideFrom - sideTo) * (to - from));
    }
  }
  return kept;
}

struct Common {
  double area = 0;
  Vector2d moment = Vector2d::Zero();  ///< area times middle
};

Common commonPart(const std::array<Vector2d, 3>& s, const std::array<Vector2d, 3>& t) {
  Polygon polygon(s.begin(), s.end());
  for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
    polygon = clipped(polygon, t[k], t[(k + 1) % 3]);
  }
  Common common;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const double area = 0.5 * cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    common.area += area;
    common.moment += area / 3 * (polygon[0] + polygon[i] + polygon[i + 1]);
  }
  return common;
}

std::array<Vector2d, 3> cornersOf(const Problem& problem, const Plane& q, std::uint32_t t) {
  const auto& v = problem.triangles[t].vertex;
  return {at(q, v[0]), at(q, v[1]), at(q, v[2])};
}

/// Pairs of triangles whose boxes meet, found in a grid of cells of about a triangle.
std::vector<Pair> nearPairs(const Problem& problem, const Plane& q) {
  Vector2d low = at(q, 0), high = low;
  for (std::uint32_t v = 1; v < problem.vertexCount; ++v) {
    low = low.cwiseMin(at(q, v));
    high = high.cwiseMax(at(q, v));
  }
  const double cell = std::max(std::sqrt(2 * problem.area / problem.triangles.size()),
                               (high - low).maxCoeff() / 4096);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries;
  for (std::uint32_t t = 0; t < problem.triangles.size(); ++t) {
    const auto c = cornersOf(problem, q, t);
    const Vector2d from = (c[0].cwiseMin(c[1]).cwiseMin(c[2]) - low) / cell;
    const Vector2d to = (c[0].cwiseMax(c[1]).cwiseMax(c[2]) - low) / cell;
    for (auto y = static_cast<std::uint64_t>(from.y()); y <= static_cast<std::uint64_t>(to.y());
         ++y) {
      for (auto x = static_cast<std::uint64_t>(from.x()); x <= static_cast<std::uint64_t>(to.x());
           ++x) {
        entries.emplace_back(y << 32U | x, t);
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  std::vector<Pair> pairs;
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin;
    while (end < entries.size() && entries[end].first == entries[begin].first) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        pairs.emplace_back(entries[i].second, entries[j].second);
      }
    }
    begin = end;
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::vector<Overlap> findOverlaps(const Piece& piece, const Problem& problem, const Plane& q) {
  std::vector<std::pair<Pair, Common>> found;
  for (const Pair& pair : nearPairs(problem, q)) {
    const auto& u = problem.triangles[pair.first].vertex;
    const auto& w = problem.triangles[pair.second].vertex;
    if (std::find_first_of(u.begin(), u.end(), w.begin(), w.end()) != u.end()) continue;
    const Common common =
        commonPart(cornersOf(problem, q, pair.first), cornersOf(problem, q, pair.second));
    if (common.area > kLeastArea) found.emplace_back(pair, common);
  }

  // Two pairs belong together when their faces are the same or neighbours, both in one layer and
  // in the other. A layer may be either of a pair: each pair stands for both its orders.
  std::map<Pair, std::size_t> orders;
  for (const auto& [pair, common] : found) {
    orders.emplace(pair, orders.size());
    orders.emplace(Pair{pair.second, pair.first}, orders.size());
  }
  std::vector<std::size_t> root(orders.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto rootOf = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  const Mesh& mesh = *piece.mesh;
  for (const auto& [order, index] : orders) {
    for (int side = 0; side < 3; ++side) {
      const HalfedgeId other = mesh.opposite(mesh.halfedge(FaceId(order.first), side));
      if (!other.isValid()) continue;
      const auto neighbour =
          orders.find({static_cast<std::uint32_t>(mesh.face(other).index()), order.second});
      if (neighbour == orders.end()) continue;
      // The same step seen from the other layer joins the other orders.
      const std::size_t a = rootOf(index), b = rootOf(neighbour->second);
      root[std::max(a, b)] = std::min(a, b);
      const std::size_t c = rootOf(orders.at({order.second, order.first}));
      const std::size_t d = rootOf(orders.at({order.second, neighbour->first.first}));
      root[std::max(c, d)] = std::min(c, d);
    }
  }
  std::map<std::size_t, Overlap> parts;
  for (const auto& [pair, common] : found) {
    const std::size_t first = rootOf(orders.at(pair));
    const std::size_t second = rootOf(orders.at({pair.second, pair.first}));
    const bool swapped = second < first;
    Overlap& overlap = parts[std::min(first, second)];
    overlap.layers[swapped ? 1 : 0].emplace_back(pair.first);
    overlap.layers[swapped ? 0 : 1].emplace_back(pair.second);
    overlap.area += common.area;
    overlap.middle += common.moment;
  }
  std::vector<Overlap> overlaps;
  for (auto& [key, overlap] : parts) {
    overlap.middle /= overlap.area;
    for (std::vector<FaceId>& layer : overlap.layers) {
      std::sort(layer.begin(), layer.end());
      layer.erase(std::unique(layer.begin(), layer.end()), layer.end());
    }
    overlaps.push_back(std::move(overlap));
  }
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const Overlap& a, const Overlap& b) { return a.area > b.area; });
  return overlaps;
}

}  // namespace toile::unfolding
