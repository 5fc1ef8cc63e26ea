// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "cut/face_triangulation.h"

namespace toile::cutting {
namespace {

/// By how much the angles opposite an edge must exceed pi (as a sine) for a flip: more than
/// rounding.
constexpr double kFlipMargin = 1e-12;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Triangles with their neighbours: side k of a triangle is opposite its corner k.
class FlipNet {
 public:
  FlipNet(const FaceFrame& frame, std::span<const LatticePoint> points,
          std::span<const LocalEdge> fixed, std::vector<LocalTriangle>& triangles)
      : areaScale_(frame.areaScale()), points_(points), triangles_(triangles) {
    for (const LatticePoint& p : points) flat_.push_back(frame.flat(p));
    for (const auto& [a, b] : fixed) fixed_.push_back(std::minmax({a, b}));
    std::sort(fixed_.begin(), fixed_.end());
    connect();
  }

  void flipAll() {
    if (!(areaScale_ > 0)) return;
    // Each flip improves the triangulation, so the work ends; rounding cannot undo that beyond
    // this bound.
    std::size_t flipsLeft = triangles_.size() * triangles_.size() + 64;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
          if (!shouldFlip(t, k)) continue;
          if (flipsLeft-- == 0) return;
          flip(t, k);
          changed = true;
        }
      }
    }
  }

 private:
  using Side = std::pair<LocalEdge, std::pair<std::uint32_t, std::uint32_t>>;

  void connect() {
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        sides.push_back({std::minmax({corner(t, k + 1), corner(t, k + 2)}), {t, k}});
      }
    }
    std::sort(sides.begin(), sides.end());
    neighbours_.assign(triangles_.size(), {kNone, kNone, kNone});
    isFixed_.assign(triangles_.size(), {true, true, true});
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      if (sides[i].first != sides[i + 1].first) continue;
      const auto [t, k] = sides[i].second;
      const auto [u, l] = sides[i + 1].second;
      neighbours_[t][k] = u;
      neighbours_[u][l] = t;
      isFixed_[t][k] = isFixed_[u][l] =
          std::binary_search(fixed_.begin(), fixed_.end(), sides[i].first);
    }
  }

  [[nodiscard]] std::uint32_t corner(std::uint32_t t, std::uint32_t k) const {
    return triangles_[t][k % 3];
  }
  [[nodiscard]] std::uint32_t sideTowards(std::uint32_t t, std::uint32_t neighbour) const {
    std::uint32_t k = 0;
    while (neighbours_[t][k] != neighbour) ++k;
    return k;
  }
  [[nodiscard]] double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return areaScale_ * static_cast<double>(orientation(points_[a], points_[b], points_[c]));
  }

  [[nodiscard]] bool shouldFlip(std::uint32_t t, std::uint32_t k) const {
    if (isFixed_[t][k]) return false;
    const std::uint32_t u = neighbours_[t][k];
    const std::uint32_t a = corner(t, k);
    const std::uint32_t b = corner(t, k + 1);
    const std::uint32_t c = corner(t, k + 2);
    const std::uint32_t d = corner(u, sideTowards(u, t));
    if (orientation(points_[a], points_[b], points_[d]) <= 0 ||
        orientation(points_[a], points_[d], points_[c]) <= 0) {
      return false;
    }
    // The angles at a and d add up to more than pi when the sine of their sum is negative.
    const Eigen::Vector2d ab = flat_[b] - flat_[a];
    const Eigen::Vector2d ac = flat_[c] - flat_[a];
    const Eigen::Vector2d db = flat_[b] - flat_[d];
    const Eigen::Vector2d dc = flat_[c] - flat_[d];
    const double sine = area(a, b, c) * db.dot(dc) + area(d, c, b) * ab.dot(ac);
    return sine < -kFlipMargin * ab.norm() * ac.norm() * db.norm() * dc.norm();
  }

  /// Triangles abc and dcb become abd and adc.
  void flip(std::uint32_t t, std::uint32_t k) {
    const std::uint32_t u = neighbours_[t][k];
    const std::uint32_t l = sideTowards(u, t);
    const std::uint32_t a = corner(t, k);
    const std::uint32_t b = corner(t, k + 1);
    const std::uint32_t c = corner(t, k + 2);
    const std::uint32_t d = corner(u, l);
    const auto side = [this](std::uint32_t triangle, std::uint32_t i) {
      return std::pair{neighbours_[triangle][i % 3], isFixed_[triangle][i % 3]};
    };
    const auto [beyondCa, fixedCa] = side(t, k + 1);
    const auto [beyondAb, fixedAb] = side(t, k + 2);
    const auto [beyondBd, fixedBd] = side(u, l + 1);  // u = (d, c, b): side opposite c is b-d
    const auto [beyondDc, fixedDc] = side(u, l + 2);
    triangles_[t] = {a, b, d};
    neighbours_[t] = {beyondBd, u, beyondAb};
    isFixed_[t] = {fixedBd, false, fixedAb};
    triangles_[u] = {a, d, c};
    neighbours_[u] = {beyondDc, beyondCa, t};
    isFixed_[u] = {fixedDc, fixedCa, false};
    if (beyondBd != kNone) neighbours_[beyondBd][sideTowards(beyondBd, u)] = t;
    if (beyondCa != kNone) neighbours_[beyondCa][sideTowards(beyondCa, t)] = u;
  }

  double areaScale_;
  std::span<const LatticePoint> points_;
  std::vector<LocalTriangle>& triangles_;
  std::vector<Eigen::Vector2d> flat_;
  std::vector<LocalEdge> fixed_;
  std::vector<std::array<std::uint32_t, 3>> neighbours_;
  std::vector<std::array<bool, 3>> isFixed_;
};

}  // namespace

void makeDelaunay(const FaceFrame& frame, std::span<const LatticePoint> points,
                  std::span<const LocalEdge> edges, std::vector<LocalTriangle>& triangles) {
  FlipNet(frame, points, edges, triangles).flipAll();
}

}  // namespace toile::cutting
