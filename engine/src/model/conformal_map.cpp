// SPDX-License-Identifier: GPL-3.0-or-later
// Notation: u = (x, y) of all vertices, E(u) = u' L u the conformal energy (Dirichlet energy minus
// area), B = the border's length around each vertex. The map is the least eigenvector of L u = k B
// u beside the translations; with partners u is written in the free coordinates of one half.
#include "model/conformal_map.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>

namespace toile::detail {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// The free coordinates: those of one vertex of each mirrored pair, x of the mid-line being 0.
class Unknowns {
 public:
  explicit Unknowns(const ConformalPatch& patch) {
    const std::size_t n = patch.positions.size();
    slot_.assign(2 * n, -1);
    sign_.assign(2 * n, 1);
    for (std::size_t v = 0; v < n; ++v) {
      const std::size_t w = patch.partner.empty() ? v : patch.partner[v];
      if (w < v) {
        slot_[2 * v] = slot_[2 * w];
        slot_[2 * v + 1] = slot_[2 * w + 1];
        sign_[2 * v] = -1;
        continue;
      }
      if (patch.partner.empty() || w != v) slot_[2 * v] = count_++;
      slot_[2 * v + 1] = count_++;
    }
  }
  [[nodiscard]] Index count() const { return count_; }
  /// Of coordinate 2v (x) or 2v + 1 (y) of vertex v: -1 where it is 0.
  [[nodiscard]] Index slot(std::size_t coordinate) const { return slot_[coordinate]; }
  [[nodiscard]] double sign(std::size_t coordinate) const { return sign_[coordinate]; }
  [[nodiscard]] std::vector<Vector2d> expand(const VectorXd& u) const {
    std::vector<Vector2d> out(slot_.size() / 2, Vector2d::Zero());
    for (std::size_t c = 0; c < slot_.size(); ++c) {
      if (slot_[c] >= 0) out[c / 2][static_cast<Index>(c % 2)] = sign_[c] * u[slot_[c]];
    }
    return out;
  }

 private:
  Index count_ = 0;
  std::vector<Index> slot_;
  std::vector<double> sign_;
};

/// The length of border around each vertex; of a closed surface the area.
std::vector<double> borderMass(const ConformalPatch& patch) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : patch.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  }
  std::vector<double> mass(patch.positions.size(), 0);
  double sum = 0;
  for (const auto& [edge, count] : uses) {
    if (count != 1) continue;
    const double half = 0.5 * (patch.positions[edge.first] - patch.positions[edge.second]).norm();
    mass[edge.first] += half;
    mass[edge.second] += half;
    sum += 2 * half;
  }
  if (sum > 0) return mass;
  for (const auto& t : patch.triangles) {
    const double third = (patch.positions[t[1]] - patch.positions[t[0]])
                             .cross(patch.positions[t[2]] - patch.positions[t[0]])
                             .norm() /
                         6;
    for (const std::uint32_t v : t) mass[v] += third;
  }
  return mass;
}

Eigen::SparseMatrix<double> conformalEnergy(const ConformalPatch& patch, const Unknowns& unknowns) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * patch.triangles.size());
  const auto add = [&](std::size_t a, std::size_t b, double value) {
    const Index i = unknowns.slot(a);
    const Index j = unknowns.slot(b);
    if (i >= j && j >= 0) entries.emplace_back(i, j, unknowns.sign(a) * unknowns.sign(b) * value);
  };
  for (const auto& t : patch.triangles) {
    const Eigen::Vector3d& origin = patch.positions[t[0]];
    const Eigen::Vector3d e1 = patch.positions[t[1]] - origin;
    const Eigen::Vector3d e2 = patch.positions[t[2]] - origin;
    const Eigen::Vector3d normal = e1.cross(e2);
    const double area = 0.5 * normal.norm();
    // A sliver says nothing about shape and would drown what its neighbours say.
    if (!(area > 1e-9 * std::max(e1.squaredNorm(), e2.squaredNorm()))) continue;
    // Edges opposite to the corners, in the triangle's plane: gradient of corner k = J e_k / 2A.
    const Eigen::Vector3d axis = e1.normalized();
    const Eigen::Vector3d across = normal.normalized().cross(axis);
    const Vector2d p1(e1.norm(), 0);
    const Vector2d p2(e2.dot(axis), e2.dot(across));
    const std::array<Vector2d, 3> opposite{p2 - p1, -p2, p1};
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double dot = opposite[j].dot(opposite[k]) / (4 * area);
        // The area term couples x of one corner with y of the next.
        const double turn = j == k ? 0.0 : (k == (j + 1) % 3 ? -0.25 : 0.25);
        add(2 * t[j], 2 * t[k], 0.5 * dot);
        add(2 * t[j] + 1, 2 * t[k] + 1, 0.5 * dot);
        add(2 * t[j], 2 * t[k] + 1, turn);
        add(2 * t[j] + 1, 2 * t[k], -turn);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns.count(), unknowns.count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

std::vector<Vector2d> conformalMap(const ConformalPatch& patch) {
  constexpr int kMostSteps = 60;
  constexpr double kStill = 1e-9;  // of the map's size: when the iteration stands
  const Unknowns unknowns(patch);
  const std::size_t n = patch.positions.size();
  const std::vector<double> perVertex = borderMass(patch);
  VectorXd mass = VectorXd::Zero(unknowns.count());
  VectorXd u = VectorXd::Zero(unknowns.count());
  std::array<VectorXd, 2> shift{VectorXd::Zero(unknowns.count()), VectorXd::Zero(unknowns.count())};
  for (std::size_t c = 0; c < 2 * n; ++c) {
    const Index i = unknowns.slot(c);
    if (i < 0) continue;
    mass[i] += perVertex[c / 2];
    if (unknowns.sign(c) > 0) u[i] = patch.start[c / 2][static_cast<Index>(c % 2)];
    // A mirrored map cannot be shifted across.
    if (c % 2 == 1 || patch.partner.empty()) shift[c % 2][i] = 1;
  }
  Eigen::SparseMatrix<double> matrix = conformalEnergy(patch, unknowns);
  // Lifts the translations (and vertices in slivers alone) off zero; far below what shape costs.
  constexpr double kLift = 1e-9;
  for (Index i = 0; i < unknowns.count(); ++i) matrix.coeffRef(i, i) += kLift;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor(matrix);
  if (factor.info() != Eigen::Success) return {};

  const auto normalise = [&](VectorXd& v) {
    for (const VectorXd& s : shift) {
      const double total = s.dot(mass.cwiseProduct(s));
      if (total > 0) v -= (v.dot(mass.cwiseProduct(s)) / total) * s;
    }
    const double size = std::sqrt(v.dot(mass.cwiseProduct(v)));
    if (size > 0) v /= size;
    return size > 0 && std::isfinite(size);
  };
  if (!normalise(u)) return {};
  for (int step = 0; step < kMostSteps; ++step) {
    VectorXd next = factor.solve(mass.cwiseProduct(u));
    if (!normalise(next)) return {};
    const VectorXd change = next - u;
    u = std::move(next);
    if (change.dot(mass.cwiseProduct(change)) < kStill * kStill) break;
  }
  return unknowns.expand(u);
}

}  // namespace toile::detail
