// SPDX-License-Identifier: GPL-3.0-or-later
#include "develop/angle_sums.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace toile::developing {
namespace {

using Eigen::Vector3d;

Vector3d doubleAreaNormal(const Positions& at, const Triangle& t) {
  const Vector3d& a = at[t[0].index()];
  return (at[t[1].index()] - a).cross(at[t[2].index()] - a);
}

}  // namespace

Positions vertexNormals(const Mesh& mesh, const Positions& at) {
  Positions normals(at.size(), Vector3d::Zero());
  for (const Triangle& t : mesh.triangles()) {
    const Vector3d normal = doubleAreaNormal(at, t);
    for (const VertexId v : t) normals[v.index()] += normal;
  }
  for (Vector3d& normal : normals) normal.normalize();
  return normals;
}

FreeVertices::FreeVertices(const Mesh& mesh) : number(mesh.vertexCount(), -1) {
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    if (mesh.isBorder(VertexId(i))) continue;
    number[VertexId(i)] = static_cast<std::int32_t>(vertices.size());
    vertices.emplace_back(i);
  }
}

FreeVertices::FreeVertices(const Mesh& mesh, const VertexData<char>& isHeld)
    : number(mesh.vertexCount(), -1) {
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    if (isHeld[VertexId(i)] != 0) continue;
    number[VertexId(i)] = static_cast<std::int32_t>(vertices.size());
    vertices.emplace_back(i);
  }
}

Eigen::VectorXd defects(const Mesh& mesh, const FreeVertices& inner, const Positions& at) {
  Eigen::VectorXd defect = Eigen::VectorXd::Constant(inner.count(), 2 * std::numbers::pi);
  for (const Triangle& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t row = inner.number[t[k]];
      if (row < 0) continue;
      const Vector3d u = at[t[(k + 1) % 3].index()] - at[t[k].index()];
      const Vector3d w = at[t[(k + 2) % 3].index()] - at[t[k].index()];
      defect[row] -= std::atan2(u.cross(w).norm(), u.dot(w));
    }
  }
  return defect;
}

Eigen::SparseMatrix<double> angleSumGradient(const Mesh& mesh, const FreeVertices& inner,
                                             const Positions& at, const Positions& direction) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * mesh.faceCount());
  for (const Triangle& t : mesh.triangles()) {
    const Vector3d normal = doubleAreaNormal(at, t).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t row = inner.number[t[k]];
      if (row < 0) continue;
      const VertexId tip = t[k], j = t[(k + 1) % 3], l = t[(k + 2) % 3];
      const Vector3d u = at[j.index()] - at[tip.index()];
      const Vector3d w = at[l.index()] - at[tip.index()];
      // The angle from u to w grows when its ends turn away from each other.
      const Vector3d byJ = -normal.cross(u) / u.squaredNorm();
      const Vector3d byL = normal.cross(w) / w.squaredNorm();
      const auto add = [&](VertexId v, const Vector3d& gradient) {
        const std::int32_t column = inner.number[v];
        if (column >= 0) entries.emplace_back(row, column, gradient.dot(direction[v.index()]));
      };
      add(j, byJ);
      add(l, byL);
      add(tip, -(byJ + byL));
    }
  }
  Eigen::SparseMatrix<double> gradient(inner.count(), inner.count());
  gradient.setFromTriplets(entries.begin(), entries.end());
  return gradient;
}

double roughness(const Mesh& mesh, const Positions& at) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.edgeCount(); ++i) {
    const HalfedgeId h = mesh.halfedge(EdgeId(i));
    const HalfedgeId other = mesh.opposite(h);
    if (!other.isValid()) continue;
    const Vector3d a = doubleAreaNormal(at, mesh.vertices(mesh.face(h)));
    const Vector3d b = doubleAreaNormal(at, mesh.vertices(mesh.face(other)));
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
    sum += angle * angle;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace toile::developing
