// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/target.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

#include "toile/core/parallel.h"

namespace toile::fitting {
namespace {

constexpr std::size_t kNeighbours = 16;
constexpr std::size_t kChunk = 4096;

template <class Body>
void parallelChunks(std::size_t count, const Body& body) {
  parallelFor((count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(count, (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) body(i);
  });
}

void takeFromFaces(const Scan& scan, Target& target) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
  sides.reserve(3 * scan.triangles.size());
  for (const Triangle& t : scan.triangles) {
    const Eigen::Vector3d& a = scan.points[t[0].index()];
    const Eigen::Vector3d cross =
        (scan.points[t[1].index()] - a).cross(scan.points[t[2].index()] - a);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k].index();
      const std::uint32_t to = t[(k + 1) % 3].index();
      target.normals[from] += cross;
      target.area[from] += cross.norm() / 6;
      sides.emplace_back(std::min(from, to), std::max(from, to));
    }
  }
  for (Eigen::Vector3d& n : target.normals) n.stableNormalize();
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool isAlone =
        (i == 0 || sides[i - 1] != sides[i]) && (i + 1 == sides.size() || sides[i + 1] != sides[i]);
    if (isAlone) target.isBorder[sides[i].first] = target.isBorder[sides[i].second] = 1;
  }
}

struct Link {
  float weight;
  std::uint32_t a, b;
};

/// Turns normals so that neighbours agree, the surest links first.
void orient(std::vector<Link> links, std::vector<Eigen::Vector3d>& normals) {
  std::sort(links.begin(), links.end(), [](const Link& x, const Link& y) {
    return x.weight != y.weight ? x.weight < y.weight : std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  // Union-find whose parents also say whether a point is turned against its root.
  std::vector<std::uint32_t> parent(normals.size());
  std::vector<char> isTurned(normals.size(), 0);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    char turned = 0;
    std::uint32_t top = v;
    for (; parent[top] != top; top = parent[top]) turned ^= isTurned[top];
    for (char rest = turned; parent[v] != v;) {
      const std::uint32_t next = parent[v];
      const char own = isTurned[v];
      isTurned[v] = rest;
      parent[v] = top;
      rest ^= own;
      v = next;
    }
    return std::pair(top, turned);
  };
  for (const Link& link : links) {
    const auto [a, aTurned] = root(link.a);
    const auto [b, bTurned] = root(link.b);
    if (a == b) continue;
    const bool disagree = normals[link.a].dot(normals[link.b]) < 0;
    const auto [low, high] = std::minmax(a, b);
    parent[high] = low;
    isTurned[high] = static_cast<char>(aTurned ^ bTurned ^ (disagree ? 1 : 0));
  }
  for (std::uint32_t v = 0; v < normals.size(); ++v) {
    if (root(v).second != 0) normals[v] = -normals[v];
  }
}

void takeFromNeighbours(Target& target) {
  const std::size_t count = target.points.size();
  std::vector<std::array<std::uint32_t, kNeighbours>> near(count);
  std::vector<char> hasGap(count, 0);
  parallelChunks(count, [&](std::size_t i) {
    std::vector<KdTree::Neighbour> found;
    target.tree.nearest(target.points[i], kNeighbours + 1, found);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& n : found) mean += target.points[n.point];
    mean /= static_cast<double>(found.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& n : found) {
      const Eigen::Vector3d d = target.points[n.point] - mean;
      spread += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    target.normals[i] = axes.eigenvectors().col(0);
    target.area[i] = std::numbers::pi * found.back().squaredDistance / double(found.size());
    std::array<double, kNeighbours> angles{};
    std::size_t n = 0;
    near[i].fill(static_cast<std::uint32_t>(i));
    for (const auto& one : found) {
      if (one.point == i || n == kNeighbours) continue;
      near[i][n] = one.point;
      const Eigen::Vector3d d = target.points[one.point] - target.points[i];
      angles[n++] =
          std::atan2(d.dot(axes.eigenvectors().col(1)), d.dot(axes.eigenvectors().col(2)));
    }
    std::sort(angles.begin(), angles.begin() + n);
    double gap = n == 0 ? 0 : angles[0] + 2 * std::numbers::pi - angles[n - 1];
    for (std::size_t k = 1; k < n; ++k) gap = std::max(gap, angles[k] - angles[k - 1]);
    hasGap[i] = gap > 130 * std::numbers::pi / 180 ? 1 : 0;
  });
  std::vector<Link> links;
  links.reserve(count * kNeighbours);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::size_t gaps = 0;
    for (const std::uint32_t j : near[i]) {
      gaps += static_cast<std::size_t>(hasGap[j]);
      if (i == j) continue;
      const double agree = std::abs(target.normals[i].dot(target.normals[j]));
      links.push_back({static_cast<float>(1 - agree), std::min(i, j), std::max(i, j)});
    }
    target.isBorder[i] = hasGap[i] != 0 && 10 * gaps > 3 * kNeighbours ? 1 : 0;
  }
  orient(std::move(links), target.normals);
}

}  // namespace

Target makeTarget(const Scan& scan) {
  const std::size_t count = scan.points.size();
  Target target{scan.points,
                scan.triangles,
                std::vector<Eigen::Vector3d>(count, Eigen::Vector3d::Zero()),
                std::vector<double>(count, 0.0),
                std::vector<char>(count, 0),
                scan.triangles.empty(),
                0,
                KdTree(scan.points)};
  Eigen::Vector3d low = scan.points.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : scan.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  target.diagonal = (high - low).norm();
  if (target.isCloud) {
    takeFromNeighbours(target);
  } else {
    takeFromFaces(scan, target);
  }
  return target;
}

}  // namespace toile::fitting
