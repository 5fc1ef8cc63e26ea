// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/rigid_relaxation.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace toile::detail {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kSteps = 20;

/// A triangle in its own plane: the edges opposite to its corners and their weights.
struct FlatTriangle {
  std::array<Vector2d, 3> edge;
  std::array<double, 3> weight{};  ///< half the cotangent of the angle at the corner, not below 0
};

FlatTriangle flattened(const ConformalPatch& patch, std::size_t t) {
  constexpr double kLeastWeight = 1e-3;
  constexpr double kMostWeight = 50;  // of slivers
  const auto& triangle = patch.triangles[t];
  const Eigen::Vector3d e1 = patch.positions[triangle[1]] - patch.positions[triangle[0]];
  const Eigen::Vector3d e2 = patch.positions[triangle[2]] - patch.positions[triangle[0]];
  const double length = e1.norm();
  const Vector2d p1(length, 0);
  Vector2d p2 = Vector2d::Zero();
  if (length > 0) p2 = {e2.dot(e1) / length, e1.cross(e2).norm() / length};
  FlatTriangle flat;
  flat.edge = {p2 - p1, -p2, p1};
  const double twiceArea = length * p2.y();
  for (std::size_t k = 0; k < 3; ++k) {
    const double dot = -flat.edge[(k + 1) % 3].dot(flat.edge[(k + 2) % 3]);
    flat.weight[k] =
        0.5 * std::clamp(twiceArea > 0 ? dot / twiceArea : 0.0, kLeastWeight, kMostWeight);
  }
  return flat;
}

/// One coordinate of all vertices by its free values: mirrored vertices have the same or, for x,
/// the opposite one.
class Coordinate {
 public:
  Coordinate(const ConformalPatch& patch, const std::vector<FlatTriangle>& flat, double mirrored)
      : slot_(patch.positions.size(), -1), sign_(patch.positions.size(), 1) {
    Index count = 0;
    for (std::size_t v = 0; v < slot_.size(); ++v) {
      const std::size_t w = patch.partner.empty() ? v : patch.partner[v];
      if (w < v) {
        slot_[v] = slot_[w];
        sign_[v] = mirrored;
      } else if (patch.partner.empty() || w != v || mirrored > 0) {
        slot_[v] = count++;
      }
    }
    // Lifts a shift of the whole off zero.
    constexpr double kLift = 1e-9;
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < count; ++i) entries.emplace_back(i, i, kLift);
    const auto add = [&](std::uint32_t a, std::uint32_t b, double value) {
      if (slot_[a] >= slot_[b] && slot_[b] >= 0)
        entries.emplace_back(slot_[a], slot_[b], sign_[a] * sign_[b] * value);
    };
    for (std::size_t t = 0; t < flat.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = patch.triangles[t][(k + 1) % 3];
        const std::uint32_t b = patch.triangles[t][(k + 2) % 3];
        const double weight = flat[t].weight[k];
        add(a, a, weight);
        add(b, b, weight);
        add(a, b, -weight);
        add(b, a, -weight);
      }
    }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(matrix);
    right_ = VectorXd::Zero(count);
  }
  [[nodiscard]] bool isReady() const { return factor_.info() == Eigen::Success; }
  void clear() { right_.setZero(); }
  void add(std::uint32_t v, double value) {
    if (slot_[v] >= 0) right_[slot_[v]] += sign_[v] * value;
  }
  [[nodiscard]] VectorXd solve() const { return factor_.solve(right_); }
  [[nodiscard]] double valueOf(std::size_t v, const VectorXd& solution) const {
    return slot_[v] < 0 ? 0 : sign_[v] * solution[slot_[v]];
  }

 private:
  std::vector<Index> slot_;
  std::vector<double> sign_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
  VectorXd right_;
};

}  // namespace

void relaxRigid(const ConformalPatch& patch, std::vector<Vector2d>& places) {
  std::vector<FlatTriangle> flat;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) flat.push_back(flattened(patch, t));
  Coordinate x(patch, flat, -1);
  Coordinate y(patch, flat, 1);
  if (!x.isReady() || !y.isReady()) return;
  for (int step = 0; step < kSteps; ++step) {
    x.clear();
    y.clear();
    for (std::size_t t = 0; t < flat.size(); ++t) {
      const auto& triangle = patch.triangles[t];
      Vector2d turn = Vector2d::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d now = places[triangle[(k + 2) % 3]] - places[triangle[(k + 1) % 3]];
        const Vector2d& rest = flat[t].edge[k];
        turn +=
            flat[t].weight[k] * Vector2d(rest.dot(now), rest.x() * now.y() - rest.y() * now.x());
      }
      const double size = turn.norm();
      if (!(size > 0)) continue;
      turn /= size;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d& rest = flat[t].edge[k];
        const Vector2d wanted =
            flat[t].weight[k] * Vector2d(turn.x() * rest.x() - turn.y() * rest.y(),
                                         turn.y() * rest.x() + turn.x() * rest.y());
        const std::uint32_t from = triangle[(k + 1) % 3];
        const std::uint32_t to = triangle[(k + 2) % 3];
        x.add(from, -wanted.x());
        y.add(from, -wanted.y());
        x.add(to, wanted.x());
        y.add(to, wanted.y());
      }
    }
    const VectorXd atX = x.solve();
    const VectorXd atY = y.solve();
    if (!atX.allFinite() || !atY.allFinite()) return;
    for (std::size_t v = 0; v < places.size(); ++v)
      places[v] = {x.valueOf(v, atX), y.valueOf(v, atY)};
  }
}

}  // namespace toile::detail
