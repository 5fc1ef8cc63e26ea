// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "curve/bends.h"
#include "curve/path_walk.h"
#include "toile/core/assert.h"

namespace toile {

using Eigen::Vector3d;

namespace {

Vector3d vertexNormal(const Mesh& mesh, VertexId v) {
  Vector3d sum = Vector3d::Zero();
  HalfedgeId h = mesh.outgoing(v);
  do {
    const Vector3d a = mesh.position(mesh.to(h)) - mesh.position(v);
    const Vector3d b = mesh.position(mesh.from(mesh.previous(h))) - mesh.position(v);
    const Vector3d n = a.cross(b);
    const double size = n.norm();
    if (size > 0) sum += std::atan2(size, a.dot(b)) / size * n;
    h = mesh.opposite(mesh.previous(h));
  } while (h.isValid() && h != mesh.outgoing(v));
  const double size = sum.norm();
  return size > 0 ? Vector3d(sum / size) : Vector3d::UnitZ();
}

}  // namespace

Vector3d smoothNormal(const Mesh& mesh, const SurfacePoint& point) {
  if (const auto* v = std::get_if<VertexId>(&point.at)) return vertexNormal(mesh, *v);
  const FaceId face = commonFace(mesh, point, point);
  const Vector3d weights = barycentricIn(mesh, point, face);
  const Triangle& corners = mesh.vertices(face);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = weights[static_cast<Eigen::Index>(k)];
    if (weight > 0) sum += weight * vertexNormal(mesh, corners[k]);
  }
  const double size = sum.norm();
  return size > 0 ? Vector3d(sum / size) : mesh.normal(face);
}

std::vector<CurvatureSample> sampleCurvature(const Mesh& mesh, const SurfacePath& path,
                                             std::size_t count) {
  TOILE_ASSERT(count >= 3);
  std::vector<CurvatureSample> samples;
  const std::size_t total = path.closed ? count : count + 1;
  const double all = length(mesh, path);
  const double step = all / static_cast<double>(count);
  detail::PathWalk walk(mesh, path);
  for (std::size_t i = 0; i < total; ++i) {
    const double arc = step * static_cast<double>(i);
    CurvatureSample sample;
    sample.arc = arc;
    sample.point = !path.closed && i == count ? path.points.back() : walk.at(arc);
    sample.position = position(mesh, sample.point);
    sample.normal = smoothNormal(mesh, sample.point);
    samples.push_back(std::move(sample));
  }
  const std::size_t n = samples.size();
  for (std::size_t i = 0; i < n; ++i) {
    CurvatureSample& s = samples[i];
    const bool isFirst = !path.closed && i == 0, isLast = !path.closed && i + 1 == n;
    const Vector3d& p = samples[isFirst ? i : (i + n - 1) % n].position;
    const Vector3d& q = samples[isLast ? i : (i + 1) % n].position;
    const Vector3d chord = q - p;
    s.tangent = (chord - s.normal.dot(chord) * s.normal).normalized();
    if (isFirst || isLast) continue;
    const Vector3d in = s.position - p, out = q - s.position;
    if (!(in.norm() > 0 && out.norm() > 0)) continue;
    const Vector3d left = s.normal.cross(s.tangent);
    s.curvature = left.dot(out.normalized() - in.normalized()) / (0.5 * (in.norm() + out.norm()));
  }
  if (!path.closed) {
    samples.front().curvature = samples[1].curvature;
    samples.back().curvature = samples[n - 2].curvature;
  }
  return samples;
}

Restlessness measureRestlessness(const std::vector<CurvatureSample>& samples, bool closed,
                                 Angle leastBend, std::span<const double> corners) {
  Restlessness result;
  const std::size_t n = samples.size();
  const double step = n > 1 ? samples[1].arc - samples[0].arc : 0;
  const double all = step * static_cast<double>(n);  // of a closed path
  std::vector<bool> isAtCorner(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    for (const double corner : corners) {
      double distance = std::abs(samples[i].arc - corner);
      if (closed) distance = std::min(distance, all - distance);
      isAtCorner[i] = isAtCorner[i] || distance < step;
    }
  }
  std::vector<double> turns;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if ((closed || i + 1 < n) && !isAtCorner[i] && !isAtCorner[next]) {
      result.variation += std::abs(samples[next].curvature - samples[i].curvature);
    }
    const bool isEnd = !closed && (i == 0 || i + 1 == n);
    turns.push_back(isEnd || isAtCorner[i] ? 0.0 : samples[i].curvature * step);
  }
  result.inflections = detail::countInflections(turns, closed, leastBend.radians());
  return result;
}

}  // namespace toile
