// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/interior_fill.h"

#include <array>

#include "unfold/constrained_newton.h"

namespace toile::unfolding {
namespace {

/// Of the springs, beside the cloth's own of about 10; at the last the wires are within a millionth
/// of an edge.
constexpr std::array<double, InteriorFill::kRounds> kStiffness = {1, 30, 1e3, 1e5, 1e8};
constexpr int kMaxSteps = 40;

/// Springs from vertices to places.
class Springs : public EnergyTerm {
 public:
  Springs(const std::vector<std::uint32_t>& vertices, const Plane& places, double stiffness)
      : vertices_(vertices), places_(places), stiffness_(stiffness) {}

  [[nodiscard]] double energy(const Plane& q) const override {
    double sum = 0;
    for (std::size_t i = 0; i < vertices_.size(); ++i) sum += gap(q, i).squaredNorm();
    return 0.5 * stiffness_ * sum;
  }
  void addDerivatives(const Plane& q, double /*indefinite*/, Eigen::VectorXd& gradient,
                      BlockMatrix& hessian) const override {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      gradient.segment<2>(2 * Eigen::Index{vertices_[i]}) += stiffness_ * gap(q, i);
      hessian.addDiagonal(vertices_[i], stiffness_, 0, stiffness_);
    }
  }

 private:
  [[nodiscard]] Eigen::Vector2d gap(const Plane& q, std::size_t i) const {
    return at(q, vertices_[i]) - at(places_, static_cast<std::uint32_t>(i));
  }
  const std::vector<std::uint32_t>& vertices_;
  const Plane& places_;
  double stiffness_;
};

}  // namespace

InteriorFill::InteriorFill(const Problem& problem, const BlockPattern& pattern,
                           SparseFactor& factor, const UnfoldOptions& options)
    : problem_(&problem),
      pattern_(&pattern),
      factor_(&factor),
      strain_(makeStrain(problem, pattern, options)) {
  withoutWires_.vertexCount = problem.vertexCount;
  withoutWires_.meanWireEdge = problem.meanWireEdge;
}

Result<void> InteriorFill::pullTo(Plane& q, const std::vector<std::uint32_t>& vertices,
                                  const Plane& places, int round, const Progress* progress) {
  Springs springs(vertices, places, kStiffness[static_cast<std::size_t>(round)]);
  WireLengths none(withoutWires_, *pattern_);
  ConstrainedNewton newton({strain_.get(), &springs}, none, *pattern_, *factor_, {},
                           problem_->area);
  NewtonState state;
  state.q = q;
  state.lambda = Eigen::VectorXd(0);
  const NewtonEnd end = newton.minimise(state, {.maxSteps = kMaxSteps}, progress);
  if (end == NewtonEnd::Cancelled) return Error{ErrorCode::Cancelled, "stopped", {}};
  q = std::move(state.q);
  return {};
}

}  // namespace toile::unfolding
