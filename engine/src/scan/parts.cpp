// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/parts.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>

#include "fit/kd_tree.h"
#include "fit/surface.h"
#include "scan/oriented_points.h"
#include "toile/core/parallel.h"

namespace toile::scanning {
namespace {

constexpr std::size_t kNeighbours = 8;
/// A point is alone when its neighbours are that many times as far as those of others.
constexpr double kAlone = 3.5;
/// That share of the edges may be run along wrongly.
constexpr double kMostContradictions = 0.005;

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

double extentWithoutSpecks(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d extent;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const Eigen::Vector3d& p : points) values.push_back(p[axis]);
    extent[axis] = fitting::quantile(values, 0.98) - fitting::quantile(values, 0.02);
  }
  return extent.norm();
}

Parts findParts(const Scan& scan, double link) {
  std::unordered_map<Eigen::Vector3i, std::uint32_t, CubeHash> numberOf;
  std::vector<Eigen::Vector3i> cubes;
  std::vector<std::uint32_t> cubeOfPoint;
  for (const Eigen::Vector3d& p : scan.points) {
    const Eigen::Vector3i cube = cubeOf(p, link);
    const auto [at, isNew] = numberOf.try_emplace(cube, static_cast<std::uint32_t>(cubes.size()));
    if (isNew) cubes.push_back(cube);
    cubeOfPoint.push_back(at->second);
  }
  std::vector<std::uint32_t> parent(cubes.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    a = rootOf(parent, a);
    b = rootOf(parent, b);
    parent[std::max(a, b)] = std::min(a, b);
  };
  for (std::uint32_t c = 0; c < cubes.size(); ++c) {
    for (int k = 0; k < 27; ++k) {
      const Eigen::Vector3i beside =
          cubes[c] + Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      if (const auto found = numberOf.find(beside); found != numberOf.end()) join(c, found->second);
    }
  }
  for (const Triangle& t : scan.triangles) {
    join(cubeOfPoint[t[0].index()], cubeOfPoint[t[1].index()]);
    join(cubeOfPoint[t[1].index()], cubeOfPoint[t[2].index()]);
  }
  std::vector<std::size_t> sizeOfRoot(cubes.size(), 0);
  for (std::uint32_t c = 0; c < cubes.size(); ++c) ++sizeOfRoot[rootOf(parent, c)];
  std::vector<std::uint32_t> roots;
  for (std::uint32_t c = 0; c < cubes.size(); ++c) {
    if (sizeOfRoot[c] > 0) roots.push_back(c);
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return sizeOfRoot[a] > sizeOfRoot[b]; });
  Parts parts;
  std::vector<std::uint32_t> partOfRoot(cubes.size(), 0);
  for (std::uint32_t i = 0; i < roots.size(); ++i) {
    partOfRoot[roots[i]] = i;
    parts.size.push_back(sizeOfRoot[roots[i]]);
  }
  for (const std::uint32_t cube : cubeOfPoint) {
    parts.ofPoint.push_back(partOfRoot[rootOf(parent, cube)]);
  }
  return parts;
}

Crowding findCrowding(const std::vector<Eigen::Vector3d>& points) {
  const fitting::KdTree tree(points);
  std::vector<double> reach(points.size(), 0.0);
  constexpr std::size_t kBlock = 4096;
  parallelFor((points.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    std::vector<fitting::KdTree::Neighbour> found;
    for (std::size_t i = block * kBlock; i < std::min(points.size(), (block + 1) * kBlock); ++i) {
      tree.nearest(points[i], kNeighbours + 1, found);
      reach[i] = std::sqrt(found.back().squaredDistance);
    }
  });
  Crowding crowding{fitting::quantile(reach, 0.5), {}};
  for (const double r : reach) crowding.isAlone.push_back(r > kAlone * crowding.reach ? 1 : 0);
  return crowding;
}

Scan keepPoints(const Scan& scan, const std::function<bool(std::size_t)>& isKept) {
  Scan kept{scan.name, {}, {}, scan.findings};
  std::vector<VertexId> number(scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (!isKept(i)) continue;
    number[i] = VertexId(kept.points.size());
    kept.points.push_back(scan.points[i]);
  }
  for (const Triangle& t : scan.triangles) {
    const Triangle renamed{number[t[0].index()], number[t[1].index()], number[t[2].index()]};
    if (renamed[0].isValid() && renamed[1].isValid() && renamed[2].isValid()) {
      kept.triangles.push_back(renamed);
    }
  }
  return kept;
}

bool isConsistentlyOriented(const Scan& scan) {
  std::vector<std::array<std::uint32_t, 2>> sides;
  sides.reserve(3 * scan.triangles.size());
  for (const Triangle& t : scan.triangles) {
    for (std::size_t k = 0; k < 3; ++k) sides.push_back({t[k].index(), t[(k + 1) % 3].index()});
  }
  std::sort(sides.begin(), sides.end());
  std::size_t again = 0;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i] == sides[i - 1]) ++again;
  }
  return static_cast<double>(again) <= kMostContradictions * static_cast<double>(sides.size());
}

}  // namespace toile::scanning
