// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/invented.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "fit/kd_tree.h"
#include "toile/core/parallel.h"

namespace toile::scanning {
namespace {

// Of the spacing: a face farther from every point is invented for sure; those that hang together
// with it belong to it as long as they are not as near as faces between measured points are.
constexpr double kSurely = 2.5;
constexpr double kPerhaps = 1.3;

/// The closed paths along the edges between the patch and the rest, patch on the left.
std::vector<SurfacePath> bordersOf(const Mesh& mesh, const std::vector<FaceId>& patch,
                                   const std::vector<std::uint32_t>& patchOfFace) {
  const std::uint32_t own = patchOfFace[patch.front().index()];
  const auto isBorder = [&](HalfedgeId h) {
    const HalfedgeId across = mesh.opposite(h);
    return !across.isValid() || patchOfFace[mesh.face(across).index()] != own;
  };
  std::vector<HalfedgeId> sides;
  for (const FaceId f : patch) {
    for (int k = 0; k < 3; ++k) {
      if (isBorder(mesh.halfedge(f, k))) sides.push_back(mesh.halfedge(f, k));
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<SurfacePath> borders;
  std::vector<char> isDone(sides.size(), 0);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (isDone[i] != 0) continue;
    SurfacePath path;
    path.closed = true;
    for (HalfedgeId h = sides[i];;) {
      const auto at = std::lower_bound(sides.begin(), sides.end(), h) - sides.begin();
      if (isDone[static_cast<std::size_t>(at)] != 0) break;
      isDone[static_cast<std::size_t>(at)] = 1;
      path.points.push_back({mesh.from(h)});
      path.faceOfSegment.push_back(mesh.face(h));
      // Around the end of h, through the patch, to the next side of it.
      for (h = mesh.next(h); !isBorder(h); h = mesh.next(mesh.opposite(h))) {
      }
    }
    if (path.points.size() >= 3) borders.push_back(std::move(path));
  }
  return borders;
}

}  // namespace

std::vector<Invented> findInvented(const Mesh& mesh, const OrientedPoints& points) {
  const fitting::KdTree tree(points.points);
  std::vector<double> distance(mesh.faceCount());
  constexpr std::size_t kBlock = 4096;
  parallelFor((mesh.faceCount() + kBlock - 1) / kBlock, [&](std::size_t block) {
    const std::size_t end = std::min(mesh.faceCount(), (block + 1) * kBlock);
    for (std::size_t f = block * kBlock; f < end; ++f) {
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const VertexId v : mesh.vertices(FaceId(f))) middle += mesh.position(v) / 3;
      distance[f] = std::sqrt(tree.nearest(middle).squaredDistance) / points.spacing;
    }
  });
  std::vector<std::uint32_t> patchOfFace(mesh.faceCount(), 0);  // 0: none, or not yet
  std::vector<Invented> all;
  for (std::size_t seed = 0; seed < mesh.faceCount(); ++seed) {
    if (patchOfFace[seed] != 0 || distance[seed] < kSurely) continue;
    const auto number = static_cast<std::uint32_t>(all.size() + 1);
    std::vector<FaceId> patch{FaceId(seed)};
    patchOfFace[seed] = number;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId across = mesh.opposite(mesh.halfedge(patch[i], k));
        if (!across.isValid()) continue;
        const FaceId next = mesh.face(across);
        if (patchOfFace[next.index()] != 0 || distance[next.index()] < kPerhaps) continue;
        patchOfFace[next.index()] = number;
        patch.push_back(next);
      }
    }
    Invented one{0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), {}};
    for (const FaceId f : patch) {
      const double area = mesh.area(f);
      one.area += area;
      one.normal += area * mesh.normal(f);
      for (const VertexId v : mesh.vertices(f)) one.centre += area / 3 * mesh.position(v);
    }
    one.centre /= std::max(one.area, 1e-12);
    one.borders = bordersOf(mesh, patch, patchOfFace);
    all.push_back(std::move(one));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Invented& a, const Invented& b) { return a.area > b.area; });
  return all;
}

}  // namespace toile::scanning
