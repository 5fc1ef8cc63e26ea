// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/tube_symmetry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "toile/mesh/surface_index.h"

namespace toile::cutting {
namespace {

struct Moments {
  double area = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Of the surface, each face taken as if it were at its middle.
Moments momentsOf(const Mesh& mesh) {
  Moments sums;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const Triangle& t : mesh.triangles()) {
    const Eigen::Vector3d& a = mesh.position(t[0]);
    const Eigen::Vector3d& b = mesh.position(t[1]);
    const Eigen::Vector3d& c = mesh.position(t[2]);
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const Eigen::Vector3d at = (a + b + c) / 3;
    sums.area += area;
    sums.middle += area * at;
    second += area * at * at.transpose();
  }
  sums.middle /= sums.area;
  second = second / sums.area - sums.middle * sums.middle.transpose();
  sums.axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second).eigenvectors();
  return sums;
}

double distanceToEnd(const Mesh& mesh, const TubeEnd& end, const Eigen::Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < end.size(); ++i) {
    const Eigen::Vector3d& a = mesh.position(end[i]);
    const Eigen::Vector3d along = mesh.position(end[(i + 1) % end.size()]) - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + t * along - p).norm());
  }
  return least;
}

bool liesOn(const Mesh& mesh, const TubeSymmetry& plane, const TubeEnd& end, const TubeEnd& other) {
  return std::all_of(end.begin(), end.end(), [&](VertexId v) {
    return distanceToEnd(mesh, other, plane.image(mesh.position(v))) <= plane.tolerance;
  });
}

bool findImages(const Mesh& mesh, const std::vector<TubeEnd>& ends, TubeSymmetry& plane) {
  plane.imageOf.clear();
  for (const TubeEnd& end : ends) {
    const auto image = std::find_if(ends.begin(), ends.end(), [&](const TubeEnd& other) {
      return liesOn(mesh, plane, end, other) && liesOn(mesh, plane, other, end);
    });
    if (image == ends.end()) return false;
    plane.imageOf.push_back(static_cast<std::size_t>(image - ends.begin()));
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (plane.imageOf[plane.imageOf[i]] != i) return false;
  }
  return true;
}

}  // namespace

std::vector<VertexId> TubeSymmetry::middleOf(const Mesh& mesh, const TubeEnd& end) const {
  std::vector<VertexId> found;
  for (std::size_t i = 0; i < end.size(); ++i) {
    const VertexId a = end[i], b = end[(i + 1) % end.size()];
    const double ha = height(mesh.position(a)), hb = height(mesh.position(b));
    if ((ha < 0) == (hb < 0)) continue;
    found.push_back(std::abs(ha) <= std::abs(hb) ? a : b);
  }
  return found;
}

std::optional<TubeSymmetry> findTubeSymmetry(const std::shared_ptr<const Mesh>& mesh,
                                             const std::vector<TubeEnd>& ends, double tolerance) {
  const Moments moments = momentsOf(*mesh);
  if (!(moments.area > 0)) return std::nullopt;
  const SurfaceIndex index(mesh);
  const std::array<Eigen::Vector3d, 5> normals{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                               moments.axes.col(0), moments.axes.col(1),
                                               moments.axes.col(2)};
  for (const Eigen::Vector3d& normal : normals) {
    TubeSymmetry plane{normal, normal.dot(moments.middle), tolerance * std::sqrt(moments.area), {}};
    if (!findImages(*mesh, ends, plane)) continue;
    const bool hasMiddle = std::any_of(ends.begin(), ends.end(), [&](const TubeEnd& end) {
      return !plane.middleOf(*mesh, end).empty();
    });
    if (!hasMiddle) continue;
    const bool isMirrored =
        std::all_of(mesh->positions().begin(), mesh->positions().end(), [&](const auto& p) {
          const Eigen::Vector3d image = plane.image(p);
          return (index.closestPoint(image).position - image).norm() <= plane.tolerance;
        });
    if (isMirrored) return plane;
  }
  return std::nullopt;
}

}  // namespace toile::cutting
