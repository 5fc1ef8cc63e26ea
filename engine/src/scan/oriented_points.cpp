// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/oriented_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace toile::scanning {
namespace {

/// Faces are looked at in so many points per side of a cube.
constexpr double kSamplesPerCube = 2;
constexpr int kMostSamplesPerSide = 2000;

/// Which way a surface faces, roughly: the axis that its normal is nearest to, with its sign.
int directionOf(const Eigen::Vector3d& n) {
  Eigen::Index axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

class Gatherer {
 public:
  explicit Gatherer(double spacing) : spacing_(spacing) {}

  void add(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, double weight) {
    auto [at, isNew] = cubes_.try_emplace(cubeOf(p, spacing_));
    if (isNew) at->second.fill(-1);
    int& place = at->second[static_cast<std::size_t>(directionOf(normal))];
    if (place < 0) {
      place = static_cast<int>(sums_.size());
      sums_.push_back({});
    }
    Sum& sum = sums_[static_cast<std::size_t>(place)];
    sum.point += weight * p;
    sum.normal += weight * normal;
    sum.weight += weight;
  }

  /// In the order in which their cubes were met.
  [[nodiscard]] OrientedPoints mean() const {
    OrientedPoints result;
    result.spacing = spacing_;
    for (const Sum& sum : sums_) {
      if (!(sum.weight > 0) || !(sum.normal.norm() > 0)) continue;
      result.points.push_back(sum.point / sum.weight);
      result.normals.push_back(sum.normal.normalized());
    }
    return result;
  }

 private:
  struct Sum {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double weight = 0;
  };
  double spacing_;
  std::unordered_map<Eigen::Vector3i, std::array<int, 6>, CubeHash> cubes_;
  std::vector<Sum> sums_;
};

}  // namespace

OrientedPoints spreadEvenly(const Scan& scan, const std::vector<Eigen::Vector3d>& normals,
                            double spacing) {
  Gatherer gatherer(spacing);
  if (scan.triangles.empty()) {
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      gatherer.add(scan.points[i], normals[i], normals[i].norm() > 0 ? 1 : 0);
    }
    return gatherer.mean();
  }
  for (const Triangle& t : scan.triangles) {
    const std::array<Eigen::Vector3d, 3> p{scan.points[t[0].index()], scan.points[t[1].index()],
                                           scan.points[t[2].index()]};
    const std::array<Eigen::Vector3d, 3> n{normals[t[0].index()], normals[t[1].index()],
                                           normals[t[2].index()]};
    const double area = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
    const double longest =
        std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
    const int parts = static_cast<int>(std::clamp(std::ceil(kSamplesPerCube * longest / spacing),
                                                  1.0, double{kMostSamplesPerSide}));
    // The middles of the upright triangles of a regular division.
    const double weight = 2 * area / (parts * (parts + 1));
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        const double b = (i + 1.0 / 3) / parts;
        const double c = (j + 1.0 / 3) / parts;
        const double a = 1 - b - c;
        const Eigen::Vector3d normal = a * n[0] + b * n[1] + c * n[2];
        if (normal.norm() > 0) gatherer.add(a * p[0] + b * p[1] + c * p[2], normal, weight);
      }
    }
  }
  return gatherer.mean();
}

}  // namespace toile::scanning
