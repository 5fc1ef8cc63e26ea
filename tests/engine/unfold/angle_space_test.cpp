// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "support/generated_pieces.h"
#include "support/result_printing.h"
#include "toile/unfold/unfold.h"
#include "unfold/problem.h"
#include "unfold/wire_bending.h"

// A second solver of WireWarping that shares nothing with the engine's: the unknowns are the angles
// of the corners, the constraints that each patch of wires closes and that angles around an inner
// vertex are 2 pi, as in the paper; dense Lagrange-Newton with all second derivatives.
// Notation: theta_k = angle of corner k, phi_i = direction of the edge after corner i, l_i its
// length, x = sum l cos phi, y = sum l sin phi, lambda = multipliers.
namespace toile {
namespace {

using std::numbers::pi;
using unfolding::Problem;

/// A walk around a patch with the patch on the left; a corner without unknown is the tip of a wire.
struct Walk {
  struct Step {
    Eigen::Index unknown = -1;
    double length = 0;  ///< of the edge that leaves the corner
  };
  std::vector<Step> steps;
};

class AngleSolver {
 public:
  /// Nothing for networks of several parts, whose patches have more than one walk each.
  static std::optional<AngleSolver> make(const Piece& piece) {
    AngleSolver solver(*unfolding::makeProblem(piece));
    if (solver.problem_.loops.size() != 1 || !solver.isConnected()) return std::nullopt;
    solver.addWalks();
    solver.addVertices(*piece.mesh);
    return solver;
  }

  [[nodiscard]] const Problem& problem() const { return problem_; }
  [[nodiscard]] Eigen::VectorXd alpha() const {
    Eigen::VectorXd alpha(unknowns());
    for (Eigen::Index k = 0; k < alpha.size(); ++k) {
      alpha[k] = problem_.corners[static_cast<std::size_t>(k)].alpha;
    }
    return alpha;
  }
  [[nodiscard]] double objective(const Eigen::VectorXd& theta) const {
    return (theta - alpha()).squaredNorm();
  }

  /// @return the stationary point that Newton steps reach from theta; nothing if they reach none.
  [[nodiscard]] std::optional<Eigen::VectorXd> solve(Eigen::VectorXd theta) const {
    const Eigen::Index n = unknowns(), m = rows();
    Eigen::VectorXd lambda = Eigen::VectorXd::Zero(m);
    for (int step = 0; step < 60; ++step) {
      Eigen::VectorXd c;
      Eigen::MatrixXd jacobian;
      Eigen::MatrixXd hessian = 2 * Eigen::MatrixXd::Identity(n, n);
      evaluate(theta, lambda, c, jacobian, hessian);
      const Eigen::VectorXd gradient = 2 * (theta - alpha());
      const Eigen::VectorXd residual = gradient + jacobian.transpose() * lambda;
      if (c.cwiseAbs().maxCoeff() < 1e-11 && residual.cwiseAbs().maxCoeff() < 1e-10) return theta;
      Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(n + m, n + m);
      kkt.topLeftCorner(n, n) = hessian;
      kkt.topRightCorner(n, m) = jacobian.transpose();
      kkt.bottomLeftCorner(m, n) = jacobian;
      kkt.bottomRightCorner(m, m) = -1e-13 * Eigen::MatrixXd::Identity(m, m);
      Eigen::VectorXd right(n + m);
      right << -gradient, -c;
      const Eigen::VectorXd solution = kkt.partialPivLu().solve(right);
      if (!solution.allFinite()) return std::nullopt;
      const double longest = solution.head(n).cwiseAbs().maxCoeff();
      const double share = std::min(1.0, 0.3 / longest);
      theta += share * solution.head(n);
      lambda += share * (solution.tail(m) - lambda);
    }
    return std::nullopt;
  }

 private:
  explicit AngleSolver(Problem problem) : problem_(std::move(problem)) {
    for (const auto& edge : problem_.wireEdges) {
      length_[std::minmax(edge.a, edge.b)] = edge.target;
    }
  }
  [[nodiscard]] Eigen::Index unknowns() const {
    return static_cast<Eigen::Index>(problem_.corners.size());
  }
  [[nodiscard]] Eigen::Index rows() const {
    return static_cast<Eigen::Index>(3 * walks_.size() + around_.size());
  }

  [[nodiscard]] bool isConnected() const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> next;
    for (const auto& edge : problem_.wireEdges) {
      next[edge.a].push_back(edge.b);
      next[edge.b].push_back(edge.a);
    }
    std::set<std::uint32_t> seen{next.begin()->first};
    std::vector<std::uint32_t> stack{next.begin()->first};
    while (!stack.empty()) {
      const std::uint32_t v = stack.back();
      stack.pop_back();
      for (const std::uint32_t w : next[v]) {
        if (seen.insert(w).second) stack.push_back(w);
      }
    }
    return seen.size() == next.size();
  }

  void addWalks() {
    // A walk comes to a corner from `after` and leaves it to `before`.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> cornerFrom;
    for (std::size_t k = 0; k < problem_.corners.size(); ++k) {
      cornerFrom[{problem_.corners[k].after, problem_.corners[k].at}] = k;
    }
    std::vector<bool> isDone(problem_.corners.size(), false);
    for (std::size_t first = 0; first < problem_.corners.size(); ++first) {
      if (isDone[first]) continue;
      Walk walk;
      std::uint32_t from = problem_.corners[first].after, at = problem_.corners[first].at;
      const auto start = std::pair(from, at);
      do {
        const auto corner = cornerFrom.find({from, at});
        const bool isTip = corner == cornerFrom.end();
        const std::uint32_t to = isTip ? from : problem_.corners[corner->second].before;
        if (!isTip) isDone[corner->second] = true;
        walk.steps.push_back({isTip ? -1 : static_cast<Eigen::Index>(corner->second),
                              length_.at(std::minmax(at, to))});
        from = at;
        at = to;
      } while (std::pair(from, at) != start);
      walks_.push_back(std::move(walk));
    }
  }

  void addVertices(const Mesh& mesh) {
    std::map<std::uint32_t, std::vector<Eigen::Index>> at;
    for (std::size_t k = 0; k < problem_.corners.size(); ++k) {
      const std::uint32_t v = problem_.corners[k].at;
      if (!mesh.isBorder(VertexId(v))) at[v].push_back(static_cast<Eigen::Index>(k));
    }
    for (auto& [v, corners] : at) around_.push_back(std::move(corners));
  }

  /// c, its Jacobian, and the second derivatives of lambda . c added to the Hessian.
  void evaluate(const Eigen::VectorXd& theta, const Eigen::VectorXd& lambda, Eigen::VectorXd& c,
                Eigen::MatrixXd& jacobian, Eigen::MatrixXd& hessian) const {
    c = Eigen::VectorXd::Zero(rows());
    jacobian = Eigen::MatrixXd::Zero(rows(), unknowns());
    Eigen::Index row = 0;
    for (const Walk& walk : walks_) {
      const std::size_t n = walk.steps.size();
      double perimeter = 0;
      for (const Walk::Step& step : walk.steps) perimeter += step.length;
      double sum = -(static_cast<double>(n) - 2) * pi, phi = 0;
      std::vector<Eigen::Vector2d> edge;
      for (const Walk::Step& step : walk.steps) {
        const double angle = step.unknown < 0 ? 2 * pi : theta[step.unknown];
        sum += angle;
        phi += pi - angle;
        edge.push_back(step.length / perimeter * Eigen::Vector2d(std::cos(phi), std::sin(phi)));
        c.segment<2>(row + 1) += edge.back();
        if (step.unknown >= 0) jacobian(row, step.unknown) = 1;
      }
      c[row] = sum;
      // The edges from corner k on turn with theta_k.
      std::vector<Eigen::Vector2d> rest(n, Eigen::Vector2d::Zero());
      for (std::size_t k = n; k-- > 0;) rest[k] = edge[k] + (k + 1 < n ? rest[k + 1] : rest[k]);
      for (std::size_t k = 0; k < n; ++k) {
        const Eigen::Index i = walk.steps[k].unknown;
        if (i < 0) continue;
        jacobian(row + 1, i) += rest[k].y();
        jacobian(row + 2, i) -= rest[k].x();
        for (std::size_t l = 0; l < n; ++l) {
          const Eigen::Index j = walk.steps[l].unknown;
          if (j >= 0) hessian(i, j) -= lambda.segment<2>(row + 1).dot(rest[std::max(k, l)]);
        }
      }
      row += 3;
    }
    for (const std::vector<Eigen::Index>& corners : around_) {
      c[row] = -2 * pi;
      for (const Eigen::Index k : corners) {
        c[row] += theta[k];
        jacobian(row, k) = 1;
      }
      ++row;
    }
  }

  Problem problem_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> length_;
  std::vector<Walk> walks_;
  std::vector<std::vector<Eigen::Index>> around_;
};

TEST(WireWarping, AgreesWithASolverInTheSpaceOfAngles) {
  std::size_t compared = 0, same = 0;
  for (const test::GeneratedPiece& each : test::generatedPieces()) {
    if (!each.isFeasible || each.wiresCross) continue;
    const auto solver = AngleSolver::make(each.piece);
    if (!solver) continue;
    SCOPED_TRACE(each.name);
    const Result<FlatPiece> flat = unfold(
        each.piece, {.objective = UnfoldObjective::WireWarping, .weights = WireWeights::Unit});
    ASSERT_TRUE(flat) << flat.error();
    ++compared;
    unfolding::Plane q(2 * static_cast<Eigen::Index>(flat->position.size()));
    for (std::size_t v = 0; v < flat->position.size(); ++v) {
      q.segment<2>(2 * static_cast<Eigen::Index>(v)) = flat->position[VertexId(v)];
    }
    const std::vector<double> angles = unfolding::cornerAngles(solver->problem(), q);
    const Eigen::VectorXd ours =
        Eigen::Map<const Eigen::VectorXd>(angles.data(), static_cast<Eigen::Index>(angles.size()));
    const double j = flat->wireBending;
    EXPECT_NEAR(solver->objective(ours), j, 1e-9 * (1 + j));

    // From near our answer it comes back to it, angle by angle.
    std::mt19937 random(7);
    Eigen::VectorXd near = ours;
    for (double& angle : near) {
      angle += 1e-3 * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1);
    }
    const auto back = solver->solve(near);
    if (back) {
      EXPECT_LT((*back - ours).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_NEAR(solver->objective(*back), j, 1e-6 * j + 1e-12);
    } else {
      ADD_FAILURE() << "does not come back to our answer";
    }
    // From the surface's angles it finds no lower minimum, on most pieces the same.
    const auto theirs = solver->solve(solver->alpha());
    if (!theirs) continue;
    const double other = solver->objective(*theirs);
    EXPECT_LE(j, other * (1 + 1e-6) + 1e-12);
    if (std::abs(j - other) <= 1e-6 * other + 1e-12) ++same;
  }
  EXPECT_GE(compared, 25U);
  EXPECT_GE(same, 20U);
  RecordProperty("compared", static_cast<int>(compared));
  RecordProperty("same", static_cast<int>(same));
}

}  // namespace
}  // namespace toile
