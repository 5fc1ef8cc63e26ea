// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/posture.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "fit/laplacian.h"
#include "fit/lay_out.h"
#include "fit/surface.h"

namespace toile::fitting {
namespace {

constexpr double kLeastScale = 0.85;  // of a segment against the whole
constexpr double kMostScale = 1.15;
constexpr double kBlend = 0.02;   // length over which segments blend, of the box's diagonal
constexpr double kStiff = 0.995;  // share of one segment from which on a vertex follows it alone

/// The segment that a segment hangs on, in the order of bodySegments(); the trunk on itself.
constexpr std::array<std::size_t, 15> kParent = {1, 1, 1, 1, 3, 4, 2, 6, 7, 1, 9, 10, 2, 12, 13};

struct Pairs {
  std::vector<Eigen::Vector3d> own, wanted;
};

Pairs pairsOf(const Segment& segment, const Places& own, const Places& wanted) {
  Pairs pairs;
  for (const std::string& name : segment.all()) {
    const auto there = wanted.find(name);
    const auto here = own.find(name);
    if (there == wanted.end() || here == own.end()) continue;
    pairs.own.push_back(here->second);
    pairs.wanted.push_back(there->second);
  }
  return pairs;
}

/// How far the points are from lying in one line, over their extent.
double spreadBesideLine(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) spread += (p - mean) * (p - mean).transpose();
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread, Eigen::EigenvaluesOnly).eigenvalues();
  return std::sqrt(std::max(0.0, values[1]) / std::max(values[2], 1e-30));
}

std::optional<Similarity> similarityOf(const Pairs& pairs) {
  if (pairs.own.size() < 3 || spreadBesideLine(pairs.own) < 0.03) return std::nullopt;
  const std::vector<double> weights(pairs.own.size(), 1.0);
  Similarity at = bestSimilarity(pairs.own, pairs.wanted, weights);
  at.scale = std::clamp(at.scale, kLeastScale, kMostScale);
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < pairs.own.size(); ++i) {
    shift += pairs.wanted[i] - at.scale * (at.rotation * pairs.own[i]);
  }
  at.shift = shift / static_cast<double>(pairs.own.size());
  return at;
}

/// Per vertex the share of every segment, smooth: one step of diffusion from all or nothing.
Eigen::MatrixXd shares(const Mesh& mesh, const Shape& shape,
                       const std::vector<std::uint32_t>& segmentOf, std::size_t segments,
                       double length) {
  const auto count = static_cast<Eigen::Index>(shape.positions.size());
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(segments));
  Eigen::SparseMatrix<double> matrix =
      length * length * cotangentLaplacian(mesh.triangles(), shape.positions);
  for (Eigen::Index v = 0; v < count; ++v) {
    const double area = shape.area[static_cast<std::size_t>(v)] + 1e-12;
    matrix.coeffRef(v, v) += area;
    right(v, segmentOf[static_cast<std::size_t>(v)]) = area;
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
  Eigen::MatrixXd share = solver.solve(right);
  for (Eigen::Index v = 0; v < count; ++v) share.row(v) /= share.row(v).sum();
  return share;
}

}  // namespace

std::optional<Posed> poseByLandmarks(const Mesh& connectivity,
                                     const std::vector<Eigen::Vector3d>& positions,
                                     const Places& own, const Places& wanted) {
  const std::vector<std::uint32_t> segmentOf = segmentOfPoints(positions, own);
  if (segmentOf.empty()) return std::nullopt;
  const std::vector<Segment>& segments = bodySegments();
  std::vector<std::optional<Similarity>> found;
  for (const Segment& segment : segments) {
    found.push_back(similarityOf(pairsOf(segment, own, wanted)));
  }
  if (!found[1] || !found[2]) return std::nullopt;
  // What has too few of its own goes with what it hangs on; parents stand before their children.
  for (const std::size_t s : {0, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}) {
    if (!found[s]) found[s] = found[kParent[s]];
  }

  std::vector<Similarity> motions;
  for (const auto& motion : found) motions.push_back(*motion);
  return poseBySegments(connectivity, positions, segmentOf, motions);
}

Posed poseBySegments(const Mesh& connectivity, const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::uint32_t>& segmentOf,
                     const std::vector<Similarity>& motions) {
  const Shape shape = makeShape(connectivity.triangles(), positions);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : positions) box.extend(p);
  const Eigen::MatrixXd share =
      shares(connectivity, shape, segmentOf, motions.size(), kBlend * box.diagonal().norm());
  // Where segments are short no vertex follows one alone; the stiffest then holds the rest.
  const double stiff = std::min(kStiff, share.maxCoeff());
  Posed posed;
  std::vector<char> isFree(positions.size(), 0);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const auto row = share.row(static_cast<Eigen::Index>(v));
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    double scale = 0;
    for (std::size_t s = 0; s < motions.size(); ++s) {
      const double weight = row[static_cast<Eigen::Index>(s)];
      rotation += weight * motions[s].rotation;
      scale += weight * motions[s].scale;
      at += weight * motions[s].apply(positions[v]);
    }
    posed.linear.emplace_back(scale * nearestRotation(rotation));
    posed.positions.push_back(at);
    isFree[v] = row.maxCoeff() < stiff ? 1 : 0;
  }
  layOut(connectivity, positions, posed.linear, isFree, posed.positions);
  return posed;
}

}  // namespace toile::fitting
