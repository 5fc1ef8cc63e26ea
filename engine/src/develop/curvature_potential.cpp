// SPDX-License-Identifier: GPL-3.0-or-later
#include "develop/curvature_potential.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace toile::developing {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Vertices with less area than this share of the mean belong to slivers.
constexpr double kLeastArea = 0.3;
/// The cotangent of 6 degrees, and a weight that keeps the maximum principle at obtuse pairs.
constexpr double kMaxWeight = 10;
constexpr double kMinWeight = 1e-3;

double cotangent(const Vector3d& u, const Vector3d& w) {
  return u.dot(w) / std::max(u.cross(w).norm(), 1e-300);
}

}  // namespace

VectorXd vertexAreas(const Mesh& mesh, const FreeVertices& free) {
  VectorXd area = VectorXd::Zero(free.count());
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    for (const VertexId v : mesh.vertices(FaceId(f))) {
      if (free.number[v] >= 0) area[free.number[v]] += mesh.area(FaceId(f)) / 3;
    }
  }
  return free.count() == 0 ? area : VectorXd(area.cwiseMax(kLeastArea * area.mean()));
}

Eigen::SparseMatrix<double> makeStiffness(const Mesh& mesh, const FreeVertices& free) {
  EdgeData<double> weight(mesh.edgeCount(), 0.0);
  for (std::size_t h = 0; h < mesh.halfedgeCount(); ++h) {
    const HalfedgeId side{h};
    const Vector3d& tip = mesh.position(mesh.from(mesh.previous(side)));
    weight[mesh.edge(side)] +=
        0.5 * cotangent(mesh.position(mesh.from(side)) - tip, mesh.position(mesh.to(side)) - tip);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const double w = std::clamp(weight[EdgeId(e)], kMinWeight, kMaxWeight);
    const std::int32_t i = free.number[mesh.tail(EdgeId(e))];
    const std::int32_t j = free.number[mesh.head(EdgeId(e))];
    if (i >= 0) entries.emplace_back(i, i, w);
    if (j >= 0) entries.emplace_back(j, j, w);
    if (i >= 0 && j >= 0) {
      entries.emplace_back(i, j, -w);
      entries.emplace_back(j, i, -w);
    }
  }
  Eigen::SparseMatrix<double> stiffness(free.count(), free.count());
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

VertexData<double> curvaturePotential(const Mesh& mesh, const FreeVertices& free) {
  VertexData<double> potential(mesh.vertexCount(), 0.0);
  if (free.count() == 0) return potential;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(makeStiffness(mesh, free));
  const VectorXd psi = factor.solve(defects(mesh, free, mesh.positions()));
  for (Eigen::Index i = 0; i < free.count(); ++i) {
    potential[free.vertices[static_cast<std::size_t>(i)]] = psi[i];
  }
  return potential;
}

double areaErrorOf(const Mesh& mesh, const VertexData<double>& potential) {
  double error = 0, total = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    double mean = 0;
    for (const VertexId v : mesh.vertices(FaceId(f))) mean += potential[v] / 3;
    error += mesh.area(FaceId(f)) * std::abs(std::expm1(-2 * mean));
    total += mesh.area(FaceId(f));
  }
  return error / total;
}

}  // namespace toile::developing
