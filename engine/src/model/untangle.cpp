// SPDX-License-Identifier: GPL-3.0-or-later
// Notation: J = Jacobian of a triangle's map from its own plane, d = its determinant,
// chi(d) = (d + sqrt(eps^2 + d^2)) / 2, which is positive for every d and nearly d where d is well
// above eps. Minimised is the sum over area * (|J|^2 + 1 + d^2) / chi(d), eps going to 0.
#include "model/untangle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

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

/// The energy of some triangles as a function of the vertices that may move.
class Tangle {
 public:
  Tangle(const ConformalPatch& patch, const std::vector<RestTriangle>& rest,
         std::vector<Vector2d>& places, const std::vector<char>& isInRegion)
      : patch_(patch), rest_(rest), places_(places), slot_(places.size(), kFixed) {
    std::vector<char> mayMove(places.size(), 1);
    for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
      if (isInRegion[t] != 0) {
        triangles_.push_back(t);
        continue;
      }
      for (const std::uint32_t v : patch.triangles[t]) mayMove[v] = 0;
    }
    std::vector<char> isTouched(places.size(), 0);
    for (const std::size_t t : triangles_)
      for (const std::uint32_t v : patch.triangles[t]) isTouched[v] = 1;
    for (std::size_t v = 0; v < places.size(); ++v) {
      if (mayMove[v] == 0 || isTouched[v] == 0) continue;
      const std::size_t w = partner(v);
      slot_[v] = w < v ? slot_[w] : 2 * count_++;
      moving_.push_back(v);
    }
  }

  /// @return whether no triangle is turned over any more
  bool solve() {
    VectorXd x(2 * count_);
    for (const std::size_t v : moving_)
      if (partner(v) >= v) x.segment<2>(slot_[v]) = places_[v];
    for (int round = 0; round < kMostRounds; ++round) {
      place(x);
      const double least = leastDeterminant();
      if (least > 0) return true;
      eps_ = std::sqrt(kLeastEps * kLeastEps + 0.04 * least * least);
      if (!minimise(x)) break;
    }
    place(x);
    return leastDeterminant() > 0;
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
  [[nodiscard]] Matrix2d jacobian(std::size_t t) const {
    const auto& c = patch_.triangles[t];
    Matrix2d edges;
    edges << places_[c[1]] - places_[c[0]], places_[c[2]] - places_[c[0]];
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

  /// Quasi-Newton steps (L-BFGS) with halving. @return whether the energy went down
  bool minimise(VectorXd& x) {
    struct Change {
      VectorXd step, slope;
      double share = 0;
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
      if (!memory.empty()) way /= memory.back().share * memory.back().slope.squaredNorm();
      for (std::size_t i = 0; i < memory.size(); ++i)
        way += (parts[i] - memory[i].share * memory[i].slope.dot(way)) * memory[i].step;
      const double descent = gradient.dot(way);
      if (!(descent < 0)) break;
      // The first step has no scale yet: no vertex goes farther than 1 mm.
      double length = memory.empty() ? 1 / std::max(way.cwiseAbs().maxCoeff(), 1e-300) : 1;
      double nextValue = value;
      bool isDown = false;
      for (int halving = 0; halving < 30 && !isDown; ++halving, length *= 0.5) {
        next = x + length * way;
        nextValue = energy(next, nextGradient);
        isDown = nextValue <= value + 1e-4 * length * descent;
      }
      if (!isDown) break;
      Change change{next - x, nextGradient - gradient, 0};
      const double curvature = change.step.dot(change.slope);
      if (curvature > 0) {
        change.share = 1 / curvature;
        memory.push_back(std::move(change));
        if (memory.size() > kMemory) memory.pop_front();
      }
      const double gained = value - nextValue;
      x = next;
      gradient = nextGradient;
      value = nextValue;
      if (gained < 1e-5 * value) break;
    }
    return value < first;
  }

  const ConformalPatch& patch_;
  const std::vector<RestTriangle>& rest_;
  std::vector<Vector2d>& places_;
  std::vector<Index> slot_;
  std::vector<std::size_t> moving_;
  Index count_ = 0;
  double eps_ = kLeastEps;
  std::vector<std::size_t> triangles_;
};

/// The triangles that share a vertex with one of the region, too.
std::vector<char> grownByARing(const ConformalPatch& patch, const std::vector<char>& region) {
  std::vector<char> touched(patch.positions.size(), 0);
  for (std::size_t t = 0; t < region.size(); ++t)
    if (region[t] != 0)
      for (const std::uint32_t v : patch.triangles[t]) touched[v] = 1;
  std::vector<char> grown(region.size(), 0);
  for (std::size_t t = 0; t < region.size(); ++t)
    for (const std::uint32_t v : patch.triangles[t])
      if (touched[v] != 0) grown[t] = 1;
  return grown;
}

}  // namespace

void untangle(const ConformalPatch& patch, std::vector<Vector2d>& places) {
  std::vector<RestTriangle> rest;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) rest.push_back(restOf(patch, t));
  for (const int rings : {8, 20}) {
    std::vector<char> region(patch.triangles.size(), 0);
    bool isTangled = false;
    for (std::size_t t = 0; t < region.size(); ++t) {
      const auto& c = patch.triangles[t];
      const Vector2d a = places[c[1]] - places[c[0]];
      const Vector2d b = places[c[2]] - places[c[0]];
      if (a.x() * b.y() - a.y() * b.x() > 0) continue;
      region[t] = 1;
      isTangled = true;
    }
    if (!isTangled) return;
    for (int ring = 0; ring < rings; ++ring) region = grownByARing(patch, region);
    if (Tangle(patch, rest, places, region).solve()) return;
  }
}

}  // namespace toile::detail
