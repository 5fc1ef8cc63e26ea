// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/wire_bending.h"

#include <cmath>
#include <numbers>

namespace toile::unfolding {
namespace {

using Vector2 = Eigen::Vector2d;

double angleBetween(const Vector2& from, const Vector2& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

/// Second derivatives of a vector's direction by the vector.
Eigen::Matrix2d bendOfDirection(const Vector2& v) {
  const double square = v.squaredNorm();
  const double diagonal = 2 * v.x() * v.y() / (square * square);
  const double other = (v.y() * v.y() - v.x() * v.x()) / (square * square);
  Eigen::Matrix2d bend;
  bend << diagonal, other, other, -diagonal;
  return bend;
}

}  // namespace

std::vector<double> cornerAngles(const Problem& problem, const Plane& q) {
  std::vector<double> angles;
  angles.reserve(problem.corners.size());
  for (const Corner& corner : problem.corners) {
    double sum = 0;
    for (std::uint32_t s = corner.sectorBegin; s < corner.sectorEnd; ++s) {
      const std::uint32_t index = problem.sectorCorners[s];
      const RestTriangle& t = problem.triangles[index / 3];
      const Vector2 here = at(q, t.vertex[index % 3]);
      sum += angleBetween(at(q, t.vertex[(index + 1) % 3]) - here,
                          at(q, t.vertex[(index + 2) % 3]) - here);
    }
    angles.push_back(sum);
  }
  return angles;
}

WireBending::WireBending(const Problem& problem, const BlockPattern& pattern,
                         std::vector<double> theta)
    : problem_(&problem), theta_(std::move(theta)), stiffness_(theta_.size(), 0) {
  places_.reserve(problem.corners.size());
  for (const Corner& c : problem.corners) {
    places_.push_back({pattern.find(c.at, c.before), pattern.find(c.at, c.after),
                       pattern.find(c.before, c.after)});
  }
}

double WireBending::angle(std::size_t corner, const Plane& q) const {
  const Corner& c = problem_->corners[corner];
  const Vector2 here = at(q, c.at);
  const double principal = angleBetween(at(q, c.before) - here, at(q, c.after) - here);
  constexpr double kTurn = 2 * std::numbers::pi;
  return principal + kTurn * std::round((theta_[corner] - principal) / kTurn);
}

double WireBending::energy(const Plane& q) const {
  double sum = 0;
  for (std::size_t i = 0; i < theta_.size(); ++i) {
    const double change = angle(i, q) - problem_->corners[i].alpha;
    sum += stiffness_[i] * change * change / problem_->corners[i].span;
  }
  return sum;
}

void WireBending::addDerivatives(const Plane& q, double indefinite, Eigen::VectorXd& gradient,
                                 BlockMatrix& hessian) const {
  const double second = secondDerivatives_ ? indefinite : 0;
  for (std::size_t i = 0; i < theta_.size(); ++i) {
    if (stiffness_[i] == 0) continue;
    const Corner& c = problem_->corners[i];
    const double weight = 2 * stiffness_[i] / c.span;
    const Vector2 u = at(q, c.before) - at(q, c.at);
    const Vector2 w = at(q, c.after) - at(q, c.at);
    const Vector2 before = Vector2(u.y(), -u.x()) / u.squaredNorm();
    const Vector2 after = Vector2(-w.y(), w.x()) / w.squaredNorm();
    const Vector2 here = -(before + after);
    const double pull = weight * (angle(i, q) - c.alpha);
    gradient.segment<2>(2 * Eigen::Index{c.before}) += pull * before;
    gradient.segment<2>(2 * Eigen::Index{c.after}) += pull * after;
    gradient.segment<2>(2 * Eigen::Index{c.at}) += pull * here;
    const auto addSelf = [&](std::uint32_t node, const Vector2& d) {
      hessian.addDiagonal(node, weight * d.x() * d.x(), weight * d.x() * d.y(),
                          weight * d.y() * d.y());
    };
    addSelf(c.before, before);
    addSelf(c.after, after);
    addSelf(c.at, here);
    hessian.add(places_[i][0], weight * here * before.transpose());
    hessian.add(places_[i][1], weight * here * after.transpose());
    hessian.add(places_[i][2], weight * before * after.transpose());
    if (second == 0) continue;
    // theta = direction of w - direction of u.
    const Eigen::Matrix2d byU = -second * pull * bendOfDirection(u);
    const Eigen::Matrix2d byW = second * pull * bendOfDirection(w);
    const auto addBlock = [&](std::uint32_t node, const Eigen::Matrix2d& b) {
      hessian.addDiagonal(node, b(0, 0), b(0, 1), b(1, 1));
    };
    addBlock(c.before, byU);
    addBlock(c.after, byW);
    addBlock(c.at, byU + byW);
    hessian.add(places_[i][0], -byU);
    hessian.add(places_[i][1], -byW);
  }
}

void WireBending::moveTo(const Plane& q) {
  for (std::size_t i = 0; i < theta_.size(); ++i) theta_[i] = angle(i, q);
}

}  // namespace toile::unfolding
