// SPDX-License-Identifier: GPL-3.0-or-later
// Notation: J = Jacobian of a triangle's map from its own plane, d = its determinant,
// chi(d) = (d + sqrt(eps^2 + d^2)) / 2, which is positive for every d and nearly d where d is well
// above eps. Minimised is the sum over area * (|J|^2 + 1 + d^2) / chi(d), eps going to 0.
#include "model/untangle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <numeric>

#include "toile/core/parallel.h"

namespace toile::detail {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kMostRounds = 10;  // of smaller and smaller eps
constexpr int kMostSteps = 60;   // of a round
constexpr double kLeastEps = 1e-3;
constexpr std::size_t kMemory = 8;

struct RestTriangle {
  Matrix2d toUnit;  ///< of edge vectors in the plane of the triangle
  double area = 0;
};

RestTriangle restOf(const ConformalPatch& patch, std::size_t t) {
  constexpr double kLeastHeight = 0.05;  // of the base: slivers would outweigh everything
  const auto& c = patch.triangles[t];
  const Eigen::Vector3d e1 = patch.positions[c[1]] - patch.positions[c[0]];
  const Eigen::Vector3d e2 = patch.positions[c[2]] - patch.positions[c[0]];
  const double base = std::max(e1.norm(), 1e-9);
  Matrix2d edges;
  edges << base, e2.dot(e1) / base, 0, std::max(e1.cross(e2).norm() / base, kLeastHeight * base);
  return {edges.inverse(), 0.5 * edges.determinant()};
}

/// A heap of triangles that are turned over and what lies around it.
struct Region {
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> inner;  ///< vertices of no other triangle, ascending
};

/// The energy of some triangles as a function of the vertices that may move.
class Tangle {
 public:
  Tangle(const ConformalPatch& patch, const std::vector<RestTriangle>& rest,
         std::vector<Vector2d>& places, const Region& region)
      : patch_(patch),
        rest_(rest),
        places_(places),
        slot_(places.size(), kFixed),
        triangles_(region.triangles) {
    for (const std::uint32_t v : region.inner) {
      const std::size_t w = partner(v);
      slot_[v] = w < v ? slot_[w] : 2 * count_++;
      moving_.push_back(v);
    }
    factorise();
  }

  /// Turns over what is turned over, as far as that succeeds.
  void solve() {
    VectorXd x(2 * count_);
    for (const std::size_t v : moving_)
      if (partner(v) >= v) x.segment<2>(slot_[v]) = places_[v];
    for (int round = 0; round < kMostRounds; ++round) {
      place(x);
      const double least = leastDeterminant();
      if (least > 0) return;
      eps_ = std::sqrt(kLeastEps * kLeastEps + 0.04 * least * least);
      if (!minimise(x)) break;
    }
    place(x);
  }

 private:
  static constexpr Index kFixed = -1;

  [[nodiscard]] std::size_t partner(std::size_t v) const {
    return patch_.partner.empty() ? v : patch_.partner[v];
  }
  void place(const VectorXd& x) {
    for (const std::size_t v : moving_) {
      places_[v] = x.segment<2>(slot_[v]);
      if (patch_.partner.empty()) continue;
      if (partner(v) == v) places_[v].x() = 0;
      if (partner(v) < v) places_[v].x() = -places_[v].x();
    }
  }
  [[nodiscard]] double sign(std::size_t v, int axis) const {
    if (patch_.partner.empty() || axis == 1) return 1;
    return partner(v) == v ? 0 : partner(v) < v ? -1 : 1;
  }
  /// The Laplacian of the region for either coordinate: what the energy's second derivative is near
  /// where nothing is bent, but for a factor.
  void factorise() {
    constexpr double kLift = 1e-9;  // where nothing is fixed
    for (const int axis : {0, 1}) {
      std::vector<Eigen::Triplet<double>> entries;
      for (Index i = 0; i < count_; ++i) entries.emplace_back(i, i, kLift);
      for (const std::size_t t : triangles_) {
        const Matrix2d& m = rest_[t].toUnit;
        const std::array<Vector2d, 3> slope = {-(m.row(0) + m.row(1)).transpose(),
                                               m.row(0).transpose(), m.row(1).transpose()};
        const auto& c = patch_.triangles[t];
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t k = 0; k < 3; ++k) {
            const Index a = slot_[c[i]] / 2;
            const Index b = slot_[c[k]] / 2;
            if (slot_[c[i]] == kFixed || slot_[c[k]] == kFixed || a < b) continue;
            entries.emplace_back(
                a, b, sign(c[i], axis) * sign(c[k], axis) * rest_[t].area * slope[i].dot(slope[k]));
          }
        }
      }
      Eigen::SparseMatrix<double> matrix(count_, count_);
      matrix.setFromTriplets(entries.begin(), entries.end());
      laplacian_.at(static_cast<std::size_t>(axis)).compute(matrix);
    }
  }
  [[nodiscard]] VectorXd smoothed(const VectorXd& gradient) const {
    VectorXd way(gradient.size());
    for (const int axis : {0, 1}) {
      Eigen::Map<VectorXd, 0, Eigen::InnerStride<2>> part(way.data() + axis, count_);
      part = laplacian_.at(static_cast<std::size_t>(axis))
                 .solve(VectorXd(Eigen::Map<const VectorXd, 0, Eigen::InnerStride<2>>(
                     gradient.data() + axis, count_)));
    }
    return way;
  }
  [[nodiscard]] Matrix2d jacobian(std::size_t t) const {
    const auto& c = patch_.triangles[t];
    Matrix2d edges;
    edges.col(0) = places_[c[1]] - places_[c[0]];
    edges.col(1) = places_[c[2]] - places_[c[0]];
    return edges * rest_[t].toUnit;
  }
  [[nodiscard]] double leastDeterminant() const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t t : triangles_) least = std::min(least, jacobian(t).determinant());
    return least;
  }
  double energy(const VectorXd& x, VectorXd& gradient) {
    place(x);
    gradient.setZero(x.size());
    double sum = 0;
    for (const std::size_t t : triangles_) {
      const Matrix2d j = jacobian(t);
      const double d = j.determinant();
      const double root = std::sqrt(eps_ * eps_ + d * d);
      // For d far below 0 the difference would be lost.
      const double chi = d > 0 ? 0.5 * (d + root) : 0.5 * eps_ * eps_ / (root - d);
      const double slope = chi / root;
      const double top = j.squaredNorm() + 1 + d * d;
      sum += rest_[t].area * top / chi;
      Matrix2d turned;  // the gradient of d
      turned << j(1, 1), -j(1, 0), -j(0, 1), j(0, 0);
      const Matrix2d slopeOfJ =
          rest_[t].area * (2 * j / chi + (2 * d / chi - top * slope / (chi * chi)) * turned);
      const Matrix2d byEdges = slopeOfJ * rest_[t].toUnit.transpose();
      const auto& c = patch_.triangles[t];
      add(gradient, c[0], -byEdges.col(0) - byEdges.col(1));
      add(gradient, c[1], byEdges.col(0));
      add(gradient, c[2], byEdges.col(1));
    }
    return sum;
  }
  void add(VectorXd& gradient, std::size_t v, Vector2d by) const {
    if (slot_[v] == kFixed) return;
    if (!patch_.partner.empty()) {
      if (partner(v) == v) by.x() = 0;
      if (partner(v) < v) by.x() = -by.x();
    }
    gradient.segment<2>(slot_[v]) += by;
  }

  /// Quasi-Newton steps (L-BFGS, the first guess of the curvature a Laplacian) with halving.
  /// @return whether the energy went down
  bool minimise(VectorXd& x) {
    struct Change {
      VectorXd step, slope;
      double share = 0;
      double scale = 0;  ///< of the Laplacian, so that it has the energy's curvature
    };
    std::deque<Change> memory;
    VectorXd gradient;
    double value = energy(x, gradient);
    const double first = value;
    VectorXd next;
    VectorXd nextGradient;
    for (int step = 0; step < kMostSteps; ++step) {
      VectorXd way = -gradient;
      std::vector<double> parts(memory.size());
      for (std::size_t i = memory.size(); i-- > 0;) {
        parts[i] = memory[i].share * memory[i].step.dot(way);
        way -= parts[i] * memory[i].slope;
      }
      way = smoothed(way);
      if (!memory.empty()) way /= memory.back().scale;
      for (std::size_t i = 0; i < memory.size(); ++i)
        way += (parts[i] - memory[i].share * memory[i].slope.dot(way)) * memory[i].step;
      const double descent = gradient.dot(way);
      if (!(descent < 0)) break;
      // The first step has no scale yet: no vertex goes farther than 1 mm.
      double length = memory.empty() ? 1 / std::max(1.0, way.cwiseAbs().maxCoeff()) : 1;
      double nextValue = value;
      bool isDown = false;
      for (int halving = 0; halving < 30 && !isDown; ++halving, length *= 0.5) {
        next = x + length * way;
        nextValue = energy(next, nextGradient);
        isDown = nextValue <= value + 1e-4 * length * descent;
      }
      if (!isDown) break;
      Change change{next - x, nextGradient - gradient, 0, 0};
      const double curvature = change.step.dot(change.slope);
      if (curvature > 0) {
        change.share = 1 / curvature;
        change.scale = change.share * change.slope.dot(smoothed(change.slope));
        memory.push_back(std::move(change));
        if (memory.size() > kMemory) memory.pop_front();
      }
      const double gained = value - nextValue;
      x = next;
      gradient = nextGradient;
      value = nextValue;
      if (gained < 1e-4 * value) break;
    }
    return value < first;
  }

  const ConformalPatch& patch_;
  const std::vector<RestTriangle>& rest_;
  std::vector<Vector2d>& places_;
  std::vector<Index> slot_;
  std::vector<std::size_t> moving_;
  Index count_ = 0;
  std::array<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>, 2> laplacian_;
  double eps_ = kLeastEps;
  const std::vector<std::uint32_t>& triangles_;
};

bool isTurned(const ConformalPatch& patch, const std::vector<Vector2d>& places, std::size_t t) {
  const auto& c = patch.triangles[t];
  const Vector2d a = places[c[1]] - places[c[0]];
  const Vector2d b = places[c[2]] - places[c[0]];
  return !(a.x() * b.y() - a.y() * b.x() > 0);
}

/// Per triangle whether it shares a vertex with one of those.
std::vector<char> grownByARing(const ConformalPatch& patch, const std::vector<char>& isIn) {
  std::vector<char> touched(patch.positions.size(), 0);
  for (std::size_t t = 0; t < isIn.size(); ++t)
    if (isIn[t] != 0)
      for (const std::uint32_t v : patch.triangles[t]) touched[v] = 1;
  std::vector<char> grown(isIn.size(), 0);
  for (std::size_t t = 0; t < isIn.size(); ++t)
    for (const std::uint32_t v : patch.triangles[t])
      if (touched[v] != 0) grown[t] = 1;
  return grown;
}

/// Parts that share no vertex with each other, nor with each other's mirror images.
std::vector<Region> connectedRegions(const ConformalPatch& patch, const std::vector<char>& isIn) {
  std::vector<std::uint32_t> parent(patch.positions.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto rootOf = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<char> isInner(patch.positions.size(), 1);
  for (std::size_t t = 0; t < isIn.size(); ++t) {
    for (const std::uint32_t v : patch.triangles[t]) {
      if (isIn[t] == 0) {
        isInner[v] = 0;
        continue;
      }
      parent[rootOf(v)] = rootOf(patch.triangles[t][0]);
      if (!patch.partner.empty()) parent[rootOf(patch.partner[v])] = rootOf(v);
    }
  }
  std::map<std::uint32_t, Region> regions;
  for (std::uint32_t t = 0; t < isIn.size(); ++t)
    if (isIn[t] != 0) regions[rootOf(patch.triangles[t][0])].triangles.push_back(t);
  for (std::uint32_t v = 0; v < parent.size(); ++v) {
    const auto region = regions.find(rootOf(v));
    if (isInner[v] != 0 && region != regions.end()) region->second.inner.push_back(v);
  }
  std::vector<Region> list;
  for (auto& [root, region] : regions) list.push_back(std::move(region));
  return list;
}

}  // namespace

void untangle(const ConformalPatch& patch, std::vector<Vector2d>& places) {
  std::vector<RestTriangle> rest;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) rest.push_back(restOf(patch, t));
  for (const int rings : {8, 20}) {
    std::vector<char> isIn(patch.triangles.size(), 0);
    for (std::size_t t = 0; t < isIn.size(); ++t) isIn[t] = isTurned(patch, places, t) ? 1 : 0;
    if (std::count(isIn.begin(), isIn.end(), 1) == 0) return;
    for (int ring = 0; ring < rings; ++ring) isIn = grownByARing(patch, isIn);
    const std::vector<Region> regions = connectedRegions(patch, isIn);
    parallelFor(regions.size(),
                [&](std::size_t i) { Tangle(patch, rest, places, regions[i]).solve(); });
  }
}

}  // namespace toile::detail
