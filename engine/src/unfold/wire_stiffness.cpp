// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/wire_stiffness.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace toile::unfolding {
namespace {

/// Waves longer than this share of the piece's size are its shape, not crinkles.
constexpr double kMaxRaised = 0.2;

}  // namespace

WireStiffness::WireStiffness(const Problem& problem, const UnfoldOptions& options)
    : problem_(&problem),
      least_(options.wireStiffness),
      highest_(std::max(kMaxRaised, options.wireStiffness)),
      modulus_(2 * (options.areaWeight + 1) / (options.areaWeight + 2)) {
  if (options.cloth) {
    modulus_ *= std::sqrt(options.cloth->weights.along * options.cloth->weights.across);
  }
  std::uint32_t count = 0;
  for (const WireEdge& edge : problem.wireEdges) {
    if (edge.wire != WireEdge::kNoWire) count = std::max(count, edge.wire + 1);
  }
  beta_.resize(count + std::size_t{1});
  wireOfEdge_.reserve(problem.wireEdges.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> wireBetween;
  for (const WireEdge& edge : problem.wireEdges) {
    const std::uint32_t wire = edge.wire == WireEdge::kNoWire ? count : edge.wire;
    wireOfEdge_.push_back(wire);
    wireBetween[std::minmax(edge.a, edge.b)] = wire;
  }
  wiresOfCorner_.reserve(problem.corners.size());
  for (const Corner& c : problem.corners) {
    wiresOfCorner_.emplace_back(wireBetween.at(std::minmax(c.at, c.before)),
                                wireBetween.at(std::minmax(c.at, c.after)));
  }
  reset();
}

void WireStiffness::reset() {
  std::fill(beta_.begin(), beta_.end(), least_);
}

std::vector<double> WireStiffness::ofCorners() const {
  std::vector<double> stiffness;
  stiffness.reserve(wiresOfCorner_.size());
  for (const auto& [before, after] : wiresOfCorner_) {
    const double length = std::max(beta_[before], beta_[after]) * std::sqrt(problem_->area);
    stiffness.push_back(length * length * length);
  }
  return stiffness;
}

double WireStiffness::loadOf(double beta) const {
  return 6 * std::cbrt(modulus_ * modulus_) * beta * std::sqrt(problem_->area);
}

std::vector<double> WireStiffness::compressions(const Eigen::VectorXd& lambda) const {
  std::vector<double> highest(beta_.size(), 0);
  for (std::size_t i = 0; i < wireOfEdge_.size(); ++i) {
    const double compression = -lambda[static_cast<Eigen::Index>(i)];
    double& own = highest[wireOfEdge_[i]];
    own = std::max(own, problem_->wireEdges[i].inner ? compression / 2 : compression);
  }
  return highest;
}

double WireStiffness::buckling(const Eigen::VectorXd& lambda) const {
  if (least_ == 0) return 0;
  const std::vector<double> compression = compressions(lambda);
  double highest = 0;
  for (std::size_t w = 0; w < beta_.size(); ++w) {
    highest = std::max(highest, compression[w] / loadOf(beta_[w]));
  }
  return highest;
}

bool WireStiffness::raise(const Eigen::VectorXd& lambda, double most) {
  if (least_ == 0) return false;
  const std::vector<double> compression = compressions(lambda);
  bool changed = false;
  for (std::size_t w = 0; w < beta_.size(); ++w) {
    const double share = compression[w] / loadOf(beta_[w]);
    if (!(share > kBucklingLimit) || beta_[w] >= highest_) continue;
    beta_[w] = std::min(highest_, beta_[w] * std::min(most, share));
    changed = true;
  }
  return changed;
}

void WireStiffness::doubleAll() {
  for (double& beta : beta_) beta *= 2;
}

double WireStiffness::greatest() const {
  double greatest = least_;
  for (const std::uint32_t wire : wireOfEdge_) greatest = std::max(greatest, beta_[wire]);
  return greatest;
}

std::vector<std::uint32_t> WireStiffness::raised() const {
  std::vector<std::uint32_t> wires;
  for (std::uint32_t w = 0; w < beta_.size(); ++w) {
    if (beta_[w] > least_) wires.push_back(w + 1 == beta_.size() ? WireEdge::kNoWire : w);
  }
  return wires;
}

}  // namespace toile::unfolding
