// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/wire_lengths.h"

#include <algorithm>
#include <cmath>

namespace toile::unfolding {

WireLengths::WireLengths(const Problem& problem, const BlockPattern& pattern)
    : problem_(&problem), direction_(problem.wireEdges.size()), length_(problem.wireEdges.size()) {
  places_.reserve(problem.wireEdges.size());
  for (const WireEdge& edge : problem.wireEdges) places_.push_back(pattern.find(edge.a, edge.b));
}

Eigen::VectorXd WireLengths::residual(const Plane& q, const Eigen::VectorXd& ratios) const {
  Eigen::VectorXd c(static_cast<Eigen::Index>(count()));
  Eigen::Index i = 0;
  for (const WireEdge& edge : problem_->wireEdges) {
    const double target =
        edge.elastic == WireEdge::kNoWire ? edge.target : edge.target * (1 + ratios[edge.elastic]);
    c[i++] = (at(q, edge.a) - at(q, edge.b)).norm() - target;
  }
  return c;
}

Eigen::VectorXd WireLengths::ranges() const {
  Eigen::VectorXd ranges(static_cast<Eigen::Index>(elasticCount()));
  for (std::size_t k = 0; k < elasticCount(); ++k) {
    ranges[static_cast<Eigen::Index>(k)] = problem_->elastics[k].range;
  }
  return ranges;
}

Eigen::VectorXd WireLengths::targetsOf(std::size_t elastic) const {
  Eigen::VectorXd targets = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count()));
  Eigen::Index i = 0;
  for (const WireEdge& edge : problem_->wireEdges) {
    if (edge.elastic == elastic) targets[i] = edge.target;
    ++i;
  }
  return targets;
}

double WireLengths::worst(const Eigen::VectorXd& residual) const {
  const double floor = 1e-3 * problem_->meanWireEdge;
  double worst = 0;
  Eigen::Index i = 0;
  for (const WireEdge& edge : problem_->wireEdges) {
    worst = std::max(worst, std::abs(residual[i++]) / std::max(edge.target, floor));
  }
  return worst;
}

double WireLengths::worstForUser(const Eigen::VectorXd& residual) const {
  double worst = 0;
  Eigen::Index i = 0;
  for (const WireEdge& edge : problem_->wireEdges) {
    worst = std::max(worst, std::abs(residual[i++]) / std::max(edge.target, 1.0));
  }
  return worst;
}

void WireLengths::linearise(const Plane& q) {
  for (std::size_t i = 0; i < count(); ++i) {
    const WireEdge& edge = problem_->wireEdges[i];
    const Eigen::Vector2d along = at(q, edge.a) - at(q, edge.b);
    length_[i] = along.norm();
    direction_[i] = along / length_[i];
  }
}

Eigen::VectorXd WireLengths::jacobianTimes(const Eigen::VectorXd& d) const {
  Eigen::VectorXd product(static_cast<Eigen::Index>(count()));
  for (std::size_t i = 0; i < count(); ++i) {
    const WireEdge& edge = problem_->wireEdges[i];
    product[static_cast<Eigen::Index>(i)] = direction_[i].dot(at(d, edge.a) - at(d, edge.b));
  }
  return product;
}

void WireLengths::addTransposeTimes(const Eigen::VectorXd& y, Eigen::VectorXd& out) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const WireEdge& edge = problem_->wireEdges[i];
    const Eigen::Vector2d pull = y[static_cast<Eigen::Index>(i)] * direction_[i];
    out.segment<2>(2 * Eigen::Index{edge.a}) += pull;
    out.segment<2>(2 * Eigen::Index{edge.b}) -= pull;
  }
}

void WireLengths::addCurvature(const Eigen::VectorXd& lambda, double compression, double penalty,
                               BlockMatrix& matrix) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const WireEdge& edge = problem_->wireEdges[i];
    double across = lambda[static_cast<Eigen::Index>(i)] / length_[i];
    if (across < 0) across *= compression;
    const Eigen::Vector2d& u = direction_[i];
    const double along = penalty - across;
    const double xx = across + along * u.x() * u.x();
    const double xy = along * u.x() * u.y();
    const double yy = across + along * u.y() * u.y();
    matrix.addDiagonal(edge.a, xx, xy, yy);
    matrix.addDiagonal(edge.b, xx, xy, yy);
    Eigen::Matrix2d block;
    block << -xx, -xy, -xy, -yy;
    matrix.add(places_[i], block);
  }
}

}  // namespace toile::unfolding
