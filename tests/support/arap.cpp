// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/arap.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>

namespace toile::test {
namespace {

using Eigen::Vector2d;

/// A face in its own plane and the cotangents of its angles; cotangent k is opposite to side k.
struct Rest {
  std::array<Vector2d, 3> at;
  std::array<double, 3> cotangent{};
};

Rest restOf(const Mesh& mesh, const Triangle& t) {
  const Eigen::Vector3d u = mesh.position(t[1]) - mesh.position(t[0]);
  const Eigen::Vector3d w = mesh.position(t[2]) - mesh.position(t[0]);
  const double length = u.norm();
  Rest rest;
  rest.at = {Vector2d(0, 0), {length, 0}, {u.dot(w) / length, u.cross(w).norm() / length}};
  for (std::size_t k = 0; k < 3; ++k) {
    // Side k runs from corner k to k + 1.
    const Vector2d a = rest.at[k] - rest.at[(k + 2) % 3];
    const Vector2d b = rest.at[(k + 1) % 3] - rest.at[(k + 2) % 3];
    rest.cotangent[k] = a.dot(b) / std::abs(a.x() * b.y() - a.y() * b.x());
  }
  return rest;
}

}  // namespace

std::vector<Vector2d> arapPlane(const Mesh& mesh, std::vector<Vector2d> plane) {
  constexpr int kMaxRounds = 300;
  std::vector<Rest> rest;
  std::vector<Eigen::Triplet<double>> entries;
  for (const Triangle& t : mesh.triangles()) {
    rest.push_back(restOf(mesh, t));
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = static_cast<int>(t[k].index()), b = static_cast<int>(t[(k + 1) % 3].index());
      const double weight = rest.back().cotangent[k];
      entries.emplace_back(a, a, weight);
      entries.emplace_back(b, b, weight);
      entries.emplace_back(a, b, -weight);
      entries.emplace_back(b, a, -weight);
    }
  }
  entries.emplace_back(0, 0, 1.0);  // holds the place
  const auto n = static_cast<Eigen::Index>(mesh.vertexCount());
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  for (int round = 0; round < kMaxRounds; ++round) {
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
    right.row(0) = plane[0].transpose();
    for (std::size_t f = 0; f < rest.size(); ++f) {
      const Triangle& t = mesh.triangles()[f];
      double dot = 0, cross = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d was = rest[f].at[(k + 1) % 3] - rest[f].at[k];
        const Vector2d is = plane[t[(k + 1) % 3].index()] - plane[t[k].index()];
        dot += rest[f].cotangent[k] * was.dot(is);
        cross += rest[f].cotangent[k] * (was.x() * is.y() - was.y() * is.x());
      }
      const double size = std::hypot(dot, cross);
      const double c = dot / size, s = cross / size;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d was = rest[f].cotangent[k] * (rest[f].at[(k + 1) % 3] - rest[f].at[k]);
        const Vector2d turned(c * was.x() - s * was.y(), s * was.x() + c * was.y());
        right.row(static_cast<Eigen::Index>(t[(k + 1) % 3].index())) += turned.transpose();
        right.row(static_cast<Eigen::Index>(t[k].index())) -= turned.transpose();
      }
    }
    const Eigen::MatrixX2d solved = solver.solve(right);
    double moved = 0;
    for (Eigen::Index v = 0; v < n; ++v) {
      const Vector2d to = solved.row(v).transpose();
      moved = std::max(moved, (to - plane[static_cast<std::size_t>(v)]).norm());
      plane[static_cast<std::size_t>(v)] = to;
    }
    if (moved < 1e-4) break;
  }
  return plane;
}

double meanAreaError(const Mesh& mesh, const std::vector<Vector2d>& plane) {
  double error = 0, area = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.triangles()[f];
    const Vector2d u = plane[t[1].index()] - plane[t[0].index()];
    const Vector2d w = plane[t[2].index()] - plane[t[0].index()];
    const double rest = mesh.area(FaceId(f));
    error += std::abs(0.5 * (u.x() * w.y() - u.y() * w.x()) - rest);
    area += rest;
  }
  return error / area;
}

double meanLengthError(const Mesh& mesh, const std::vector<Vector2d>& plane) {
  double error = 0, length = 0;
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const double rest = mesh.length(EdgeId(e));
    const double flat =
        (plane[mesh.head(EdgeId(e)).index()] - plane[mesh.tail(EdgeId(e)).index()]).norm();
    error += std::abs(flat - rest);
    length += rest;
  }
  return error / length;
}

}  // namespace toile::test
