// SPDX-License-Identifier: GPL-3.0-or-later
#define CGAL_EIGEN3_ENABLED
#include "scan/poisson.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace toile::scanning {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using OrientedPoint = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Indicator = CGAL::Poisson_reconstruction_function<Kernel>;
using Corner = Eigen::Vector3i;

constexpr std::size_t kMostCubes = 20'000'000;
/// The surface keeps that share of a grid edge away from its ends: no face without area.
constexpr double kRim = 0.02;

/// Corners of a cube by the bits x, y, z of their number, and its six tetrahedra around the
/// diagonal 0-7, all of positive orientation. Equal diagonals on equal faces: neighbours fit.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra = {
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

/// Cuts the cubes that the surface passes, from those that hold points on to their neighbours.
class Contour {
 public:
  Contour(const Indicator& indicator, double cell) : indicator_(indicator), cell_(cell) {}

  Result<Mesh> follow(const std::vector<Eigen::Vector3d>& from, const Progress* progress) {
    for (const Eigen::Vector3d& p : from) visit(cubeOf(p, cell_));
    std::size_t done = 0;
    for (; !waiting_.empty(); ++done) {
      if (done % 4096 == 0 && isCancelled(progress)) {
        return Error{ErrorCode::Cancelled, "the reconstruction was cancelled", {}};
      }
      if (done > kMostCubes) {
        return Error{ErrorCode::NotConverged,
                     "the surface through the points does not end: their normals disagree, or the "
                     "edge length is too small for a scan of that size",
                     {}};
      }
      const Corner cube = waiting_.front();
      waiting_.pop_front();
      cut(cube);
    }
    return makeMesh(std::move(positions_), std::move(triangles_));
  }

 private:
  static Corner corner(const Corner& cube, int number) {
    return cube + Corner(number & 1, number >> 1 & 1, number >> 2 & 1);
  }

  void visit(const Corner& cube) {
    if (visited_.insert(cube).second) waiting_.push_back(cube);
  }

  double valueAt(const Corner& at) {
    const auto [known, isNew] = values_.try_emplace(at, 0.0);
    if (isNew) {
      const Eigen::Vector3d p = cell_ * at.cast<double>();
      known->second = indicator_(Kernel::Point_3(p.x(), p.y(), p.z()));
    }
    return known->second;
  }

  void cut(const Corner& cube) {
    std::array<double, 8> value{};
    for (int k = 0; k < 8; ++k) value[static_cast<std::size_t>(k)] = valueAt(corner(cube, k));
    const auto isInside = [&](int k) { return value[static_cast<std::size_t>(k)] < 0; };
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        int inside = 0;
        for (int k = 0; k < 8; ++k) {
          if ((k >> axis & 1) == side && isInside(k)) ++inside;
        }
        if (inside == 0 || inside == 4) continue;
        Corner next = cube;
        next[axis] += side == 0 ? -1 : 1;
        visit(next);
      }
    }
    for (const auto& tetrahedron : kTetrahedra) {
      std::array<int, 4> in{}, out{};
      std::size_t ins = 0, outs = 0;
      for (const int k : tetrahedron) (isInside(k) ? in[ins++] : out[outs++]) = k;
      if (ins == 0 || outs == 0) continue;
      const auto on = [&](int a, int b) {
        return crossing(corner(cube, a), corner(cube, b), value[static_cast<std::size_t>(a)],
                        value[static_cast<std::size_t>(b)]);
      };
      const Eigen::Vector3d outward = middle(cube, out, outs) - middle(cube, in, ins);
      if (ins == 1 || outs == 1) {
        const int tip = ins == 1 ? in[0] : out[0];
        const auto& rest = ins == 1 ? out : in;
        add({on(tip, rest[0]), on(tip, rest[1]), on(tip, rest[2])}, outward);
      } else {
        const VertexId a = on(in[0], out[0]);
        const VertexId c = on(in[1], out[1]);
        add({a, on(in[0], out[1]), c}, outward);
        add({a, c, on(in[1], out[0])}, outward);
      }
    }
  }

  Eigen::Vector3d middle(const Corner& cube, const std::array<int, 4>& corners,
                         std::size_t count) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < count; ++i) sum += corner(cube, corners[i]).cast<double>();
    return sum / static_cast<double>(count);
  }

  /// Whichever way round: the plane of the face parts the inner corners from the outer ones.
  void add(Triangle t, const Eigen::Vector3d& outward) {
    const Eigen::Vector3d& a = positions_[t[0].index()];
    const Eigen::Vector3d cross =
        (positions_[t[1].index()] - a).cross(positions_[t[2].index()] - a);
    if (cross.dot(outward) < 0) std::swap(t[1], t[2]);
    triangles_.push_back(t);
  }

  VertexId crossing(const Corner& a, const Corner& b, double valueA, double valueB) {
    // The same number for both directions.
    if (std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end())) {
      return crossing(b, a, valueB, valueA);
    }
    const Corner step = b - a;
    std::array<std::uint32_t, 7>& onEdges = crossings_.try_emplace(a).first->second;
    // Steps in -1..1; those that follow `a` in lexicographic order and occur are these seven.
    const auto edge = static_cast<std::size_t>(step.x() + 2 * step.y() + 4 * step.z() - 1);
    if (onEdges[edge] == 0) {
      const double t = std::clamp(valueA / (valueA - valueB), kRim, 1 - kRim);
      positions_.emplace_back(cell_ * (a.cast<double>() + t * step.cast<double>()));
      onEdges[edge] = static_cast<std::uint32_t>(positions_.size());
    }
    return VertexId(onEdges[edge] - 1);
  }

  const Indicator& indicator_;
  double cell_;
  std::deque<Corner> waiting_;
  std::unordered_set<Corner, CubeHash> visited_;
  std::unordered_map<Corner, double, CubeHash> values_;
  std::unordered_map<Corner, std::array<std::uint32_t, 7>, CubeHash> crossings_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Triangle> triangles_;
};

}  // namespace

Result<Mesh> reconstruct(const OrientedPoints& cloud, double cell, const Progress* progress) {
  std::vector<OrientedPoint> points;
  points.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    const Eigen::Vector3d& n = cloud.normals[i];
    points.push_back({{p.x(), p.y(), p.z()}, {n.x(), n.y(), n.z()}});
  }
  Indicator indicator(points.begin(), points.end(),
                      CGAL::First_of_pair_property_map<OrientedPoint>(),
                      CGAL::Second_of_pair_property_map<OrientedPoint>());
  if (isCancelled(progress)) {
    return Error{ErrorCode::Cancelled, "the reconstruction was cancelled", {}};
  }
  if (!indicator.compute_implicit_function()) {
    return Error{ErrorCode::NotConverged, "no surface could be laid through the points", {}};
  }
  return Contour(indicator, cell).follow(cloud.points, progress);
}

}  // namespace toile::scanning
