// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/coarse.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "toile/core/parallel.h"

// The unknowns: per node k an affine map, written X_k (4 x 3, the last row its shift), which takes
// a vertex i at v_i to X_k^T (v_i - g_k, 1) + g_k where g_k is the node's place; after them one
// number c_b per member of the family. A vertex lies at
//     p_i = sum_k w_ik (X_k^T y_ik + g_k) + sum_b c_b D_b,i ,   y_ik = ((v_i - g_k) / unit, 1)
// which is linear in all of them, so that every round is one linear least squares problem.
namespace toile::fitting {
namespace {

constexpr Eigen::Index kPerNode = 12;
constexpr double kTangential = 0.02;  // price of sliding, against that of leaving the surface
constexpr double kFamilyPrice = 0.03;
constexpr double kAgreement = 0.5;  // least dot product of normals
constexpr std::array kStiffness = {10.0, 1.0, 0.1, 0.01, 0.001, 0.0001};
static_assert(kStiffness.size() == CoarseSchedule{}.end);
constexpr std::array kPinWeight = {10.0, 10.0, 3.0, 1.0, 0.3, 0.1};
/// Beyond four medians and this share of the scan's diagonal no pair counts: wide at first, so that
/// a hand that lies beside the scan's still finds it.
constexpr std::array kReach = {0.03, 0.02, 0.012, 0.006, 0.003, 0.003};

using Block = Eigen::Matrix<double, kPerNode, kPerNode>;
using Column = Eigen::Matrix<double, kPerNode, 1>;
using Lever = Eigen::Vector4d;
using FamilyColumns = Eigen::Matrix<double, kPerNode, Eigen::Dynamic>;  // one per member
using Added = Eigen::Matrix<double, 3, Eigen::Dynamic>;

class System {
 public:
  System(const CoarseProblem& problem, const Target& target)
      : problem_(problem),
        target_(target),
        graph_(problem.graph),
        nodes_(problem.graph.vertexOfNode.size()),
        members_(problem.family.size()),
        size_(kPerNode * static_cast<Eigen::Index>(nodes_) + static_cast<Eigen::Index>(members_)) {
    unit_ = std::sqrt(problem.rest.totalArea / static_cast<double>(nodes_));
    prepareLevers();
    preparePairs();
    prepareMatrix();
  }

  CoarseFit start() {
    solution_ = Eigen::VectorXd::Zero(size_);
    for (std::size_t k = 0; k < nodes_; ++k) {
      for (Eigen::Index d = 0; d < 3; ++d) solution_[at(k) + 3 * d + d] = unit_;
    }
    return read();
  }

  /// One round from the nearest points of where the shape lies now.
  bool step(const Shape& now, double stiffness, double pinWeight, double reach) {
    weigh(now, reach);
    weighPins(now, pinWeight);
    assemble(stiffness);
    solver_.factorize(matrix_);
    if (solver_.info() != Eigen::Success) return false;
    solution_ = solver_.solve(right_);
    return solution_.allFinite();
  }

  CoarseFit read() const {
    CoarseFit fit;
    fit.positions.resize(problem_.rest.positions.size());
    for (std::size_t v = 0; v < fit.positions.size(); ++v) {
      Eigen::Vector3d p = base_[v];
      for (std::size_t a = 0; a < Graph::kPerVertex; ++a) {
        const Graph::Share& share = graph_.ofVertex[v][a];
        const Eigen::Index first = at(share.node);
        for (Eigen::Index j = 0; j < 4; ++j) {
          p += levers_[v][a][j] * solution_.segment<3>(first + 3 * j);
        }
      }
      for (std::size_t b = 0; b < members_; ++b) {
        p += solution_[familyAt(b)] * problem_.family[b][v];
      }
      fit.positions[v] = p;
    }
    for (std::size_t k = 0; k < nodes_; ++k) {
      Eigen::Matrix3d linear;
      for (Eigen::Index j = 0; j < 3; ++j) {
        linear.col(j) = solution_.segment<3>(at(k) + 3 * j) / unit_;
      }
      fit.linear.push_back(linear);
    }
    for (std::size_t b = 0; b < members_; ++b) fit.coefficients.push_back(solution_[familyAt(b)]);
    return fit;
  }

 private:
  struct Pair {
    std::uint32_t a, b;  // a <= b
    struct Use {
      std::uint32_t vertex;
      std::uint8_t slotA, slotB;
    };
    std::vector<Use> uses;
    Block block;
    std::array<Eigen::Index, kPerNode> start;  // in the matrix's values, per column of the block
  };

  [[nodiscard]] static Eigen::Index at(std::size_t node) {
    return kPerNode * static_cast<Eigen::Index>(node);
  }
  [[nodiscard]] Eigen::Index familyAt(std::size_t member) const {
    return at(nodes_) + static_cast<Eigen::Index>(member);
  }
  [[nodiscard]] const Eigen::Vector3d& place(std::size_t node) const {
    return problem_.rest.positions[graph_.vertexOfNode[node]];
  }

  void prepareLevers() {
    const std::size_t vertices = problem_.rest.positions.size();
    levers_.resize(vertices);
    base_.assign(vertices, Eigen::Vector3d::Zero());
    for (std::size_t v = 0; v < vertices; ++v) {
      for (std::size_t a = 0; a < Graph::kPerVertex; ++a) {
        const Graph::Share& share = graph_.ofVertex[v][a];
        const Eigen::Vector3d& g = place(share.node);
        levers_[v][a].head<3>() = share.weight / unit_ * (problem_.rest.positions[v] - g);
        levers_[v][a][3] = share.weight;
        base_[v] += share.weight * g;
      }
    }
  }

  void preparePairs() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Pair::Use>> uses;
    usesOfNode_.resize(nodes_);
    for (std::uint32_t k = 0; k < nodes_; ++k) uses[{k, k}];
    for (const Graph::Edge& edge : graph_.edges) uses[{edge.a, edge.b}];
    for (std::uint32_t v = 0; v < levers_.size(); ++v) {
      for (std::uint8_t a = 0; a < Graph::kPerVertex; ++a) {
        const Graph::Share& one = graph_.ofVertex[v][a];
        if (one.weight == 0) continue;
        usesOfNode_[one.node].push_back({v, a, a});
        for (std::uint8_t b = 0; b < Graph::kPerVertex; ++b) {
          const Graph::Share& other = graph_.ofVertex[v][b];
          if (other.weight == 0 || other.node < one.node) continue;
          uses[{one.node, other.node}].push_back({v, a, b});
        }
      }
    }
    for (auto& [ends, list] : uses) {
      pairs_.push_back({ends.first, ends.second, std::move(list), Block::Zero(), {}});
    }
    const auto columns = static_cast<Eigen::Index>(members_);
    familyColumns_.assign(nodes_, FamilyColumns::Zero(kPerNode, columns));
    added_.assign(levers_.size(), Added(3, columns));
    for (std::size_t b = 0; b < members_; ++b) {
      for (std::size_t v = 0; v < added_.size(); ++v) {
        added_[v].col(static_cast<Eigen::Index>(b)) = problem_.family[b][v];
      }
    }
    weight_.resize(levers_.size());
    pull_.resize(levers_.size());
  }

  /// The lower triangle: the rows of the larger node under the columns of the smaller.
  void prepareMatrix() {
    std::vector<std::vector<std::size_t>> below(nodes_);
    for (std::size_t i = 0; i < pairs_.size(); ++i) below[pairs_[i].a].push_back(i);
    std::vector<Eigen::Triplet<double>> entries;
    for (const Pair& pair : pairs_) {
      for (Eigen::Index c = 0; c < kPerNode; ++c) {
        for (Eigen::Index r = pair.a == pair.b ? c : 0; r < kPerNode; ++r) {
          entries.emplace_back(at(pair.b) + r, at(pair.a) + c, 1.0);
        }
      }
    }
    for (Eigen::Index column = 0; column < size_; ++column) {
      for (std::size_t b = 0; b < members_; ++b) {
        if (familyAt(b) >= column) entries.emplace_back(familyAt(b), column, 1.0);
      }
    }
    matrix_.resize(size_, size_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    for (std::size_t k = 0; k < nodes_; ++k) {
      for (Eigen::Index c = 0; c < kPerNode; ++c) {
        Eigen::Index next = matrix_.outerIndexPtr()[at(k) + c];
        for (const std::size_t i : below[k]) {
          pairs_[i].start[static_cast<std::size_t>(c)] = next;
          next += pairs_[i].a == pairs_[i].b ? kPerNode - c : kPerNode;
        }
      }
    }
    solver_.analyzePattern(matrix_);
  }

  /// Nearest points, and how much each counts: weight_ (3 x 3) and pull_ = weight_ times where to.
  void weigh(const Shape& now, double reach) {
    const Target& target = target_;
    const std::size_t count = now.positions.size();
    std::vector<KdTree::Neighbour> near(count);
    constexpr std::size_t kChunk = 512;
    parallelFor((count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
      for (std::size_t v = chunk * kChunk; v < std::min(count, (chunk + 1) * kChunk); ++v) {
        near[v] = target.tree.nearest(now.positions[v]);
      }
    });
    std::vector<double> distances(count);
    for (std::size_t v = 0; v < count; ++v) distances[v] = std::sqrt(near[v].squaredDistance);
    const double median = quantile(distances, 0.5);
    const double gate = 4 * median + reach * target.diagonal;
    const double trusted = 4 * median + kReach.back() * target.diagonal;
    for (std::size_t v = 0; v < count; ++v) {
      weight_[v].setZero();
      pull_[v].setZero();
      const std::uint32_t q = near[v].point;
      const Eigen::Vector3d& n = target.normals[q];
      if (distances[v] >= gate || target.isBorder[q] != 0 || now.normals[v].dot(n) <= kAgreement) {
        continue;
      }
      const double share = 2 * distances[v] / trusted;
      const double trust = now.area[v] / now.totalArea / (1 + share * share);
      weight_[v] = trust * ((1 - kTangential) * n * n.transpose() +
                            kTangential * Eigen::Matrix3d::Identity());
      pull_[v] = weight_[v] * (target.points[q] - base_[v]);
    }
  }

  /// A pin acts on its nearest vertex, which shall come as far beside the pin's place as it lies
  /// beside the pin now.
  void weighPins(const Shape& now, double weight) {
    for (const Pin& pin : problem_.pins) {
      Eigen::Index nearest = 0;
      pin.weights.maxCoeff(&nearest);
      const std::uint32_t v = pin.vertices[static_cast<std::size_t>(nearest)];
      Eigen::Vector3d beside = now.positions[v];
      for (std::size_t c = 0; c < 3; ++c) {
        beside -= pin.weights[static_cast<Eigen::Index>(c)] * now.positions[pin.vertices[c]];
      }
      const Eigen::Matrix3d price =
          weight * pin.weight *
          (pin.along ? Eigen::Matrix3d(*pin.along * pin.along->transpose())
                     : Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
      weight_[v] += price;
      pull_[v] += price * (pin.place + beside - base_[v]);
    }
  }

  void assemble(double stiffness) {
    std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
    right_ = Eigen::VectorXd::Zero(size_);
    parallelFor(pairs_.size(), [&](std::size_t i) { sumPair(pairs_[i]); });
    std::vector<Column> pulls(nodes_, Column::Zero());
    parallelFor(nodes_, [&](std::size_t k) { sumNode(k, pulls[k]); });
    for (std::size_t k = 0; k < nodes_; ++k) right_.segment<kPerNode>(at(k)) = pulls[k];
    addStiffness(stiffness);
    for (const Pair& pair : pairs_) {
      for (Eigen::Index c = 0; c < kPerNode; ++c) {
        double* out = matrix_.valuePtr() + pair.start[static_cast<std::size_t>(c)];
        const Eigen::Index first = pair.a == pair.b ? c : 0;
        // Of an off-diagonal block the larger node's rows are wanted: its transpose.
        for (Eigen::Index r = first; r < kPerNode; ++r) *out++ = pair.block(c, r);
      }
    }
    addFamily();
    // Towards where it is, so that what nothing holds stays.
    for (Eigen::Index i = 0; i < size_; ++i) {
      matrix_.valuePtr()[matrix_.outerIndexPtr()[i]] += 1e-9;
      right_[i] += 1e-9 * solution_[i];
    }
  }

  void sumPair(Pair& pair) const {
    // sum of y_a y_b^T (x) W, the six numbers of the symmetric W apart.
    std::array<Eigen::Matrix4d, 6> sums;
    for (auto& sum : sums) sum.setZero();
    for (const auto& use : pair.uses) {
      const Eigen::Matrix3d& w = weight_[use.vertex];
      if (w.trace() == 0) continue;
      const Eigen::Matrix4d outer =
          levers_[use.vertex][use.slotA] * levers_[use.vertex][use.slotB].transpose();
      sums[0] += w(0, 0) * outer;
      sums[1] += w(0, 1) * outer;
      sums[2] += w(0, 2) * outer;
      sums[3] += w(1, 1) * outer;
      sums[4] += w(1, 2) * outer;
      sums[5] += w(2, 2) * outer;
    }
    constexpr std::array<std::array<std::size_t, 3>, 3> kPlace = {
        {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
    for (Eigen::Index j = 0; j < 4; ++j) {
      for (Eigen::Index l = 0; l < 4; ++l) {
        for (std::size_t d = 0; d < 3; ++d) {
          for (std::size_t e = 0; e < 3; ++e) {
            pair.block(3 * j + Eigen::Index(d), 3 * l + Eigen::Index(e)) = sums[kPlace[d][e]](j, l);
          }
        }
      }
    }
  }

  void sumNode(std::size_t k, Column& pull) {
    FamilyColumns& columns = familyColumns_[k];
    columns.setZero();
    Added moved(3, columns.cols());
    for (const auto& use : usesOfNode_[k]) {
      const Lever& y = levers_[use.vertex][use.slotA];
      for (Eigen::Index j = 0; j < 4; ++j) pull.segment<3>(3 * j) += y[j] * pull_[use.vertex];
      moved.noalias() = weight_[use.vertex].lazyProduct(added_[use.vertex]);
      for (Eigen::Index j = 0; j < 4; ++j) columns.middleRows<3>(3 * j) += y[j] * moved;
    }
  }

  Pair& pairOf(std::uint32_t a, std::uint32_t b) {
    return *std::lower_bound(
        pairs_.begin(), pairs_.end(), std::pair(a, b),
        [](const Pair& pair, const std::pair<std::uint32_t, std::uint32_t>& x) {
          return std::pair(pair.a, pair.b) < x;
        });
  }

  /// Adds the square of  X_a^T p - X_b^T q - r  with a weight.
  void addJoint(double weight, std::uint32_t a, const Lever& p, std::uint32_t b, const Lever& q,
                const Eigen::Vector3d& r) {
    addOuter(pairOf(a, a).block, weight, p, p);
    addOuter(pairOf(b, b).block, weight, q, q);
    if (a < b) {
      addOuter(pairOf(a, b).block, -weight, p, q);
    } else {
      addOuter(pairOf(b, a).block, -weight, q, p);
    }
    for (Eigen::Index j = 0; j < 4; ++j) {
      right_.segment<3>(at(a) + 3 * j) += weight * p[j] * r;
      right_.segment<3>(at(b) + 3 * j) -= weight * q[j] * r;
    }
  }

  static void addOuter(Block& block, double weight, const Lever& p, const Lever& q) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      for (Eigen::Index l = 0; l < 4; ++l) {
        for (Eigen::Index d = 0; d < 3; ++d) block(3 * j + d, 3 * l + d) += weight * p[j] * q[l];
      }
    }
  }

  /// Neighbours' maps agree: their linear parts, and on where they take each other's place.
  void addStiffness(double stiffness) {
    const double price = stiffness / static_cast<double>(graph_.edges.size());
    for (const Graph::Edge& edge : graph_.edges) {
      const Eigen::Vector3d between = place(edge.b) - place(edge.a);
      for (Eigen::Index j = 0; j < 3; ++j) {
        const Lever one = edge.length / unit_ * Lever::Unit(j);
        addJoint(price, edge.a, one, edge.b, one, Eigen::Vector3d::Zero());
      }
      Lever reach;
      reach << between / unit_, 1;
      addJoint(price, edge.a, reach, edge.b, Lever::Unit(3), between);
      reach << -between / unit_, 1;
      addJoint(price, edge.b, reach, edge.a, Lever::Unit(3), -between);
    }
  }

  /// The family among itself and with the nodes, from the vertices' weights.
  void addFamily() {
    // In parts of fixed size, so that sums do not depend on the threads.
    constexpr std::size_t kPart = 1024;
    const auto columns = static_cast<Eigen::Index>(members_);
    std::vector<Eigen::MatrixXd> sums((added_.size() + kPart - 1) / kPart,
                                      Eigen::MatrixXd::Zero(columns, columns + 1));
    parallelFor(sums.size(), [&](std::size_t part) {
      Added moved(3, columns);
      for (std::size_t v = part * kPart; v < std::min(added_.size(), (part + 1) * kPart); ++v) {
        moved.noalias() = weight_[v].lazyProduct(added_[v]);
        sums[part].leftCols(columns).noalias() += added_[v].transpose().lazyProduct(moved);
        sums[part].col(columns).noalias() += added_[v].transpose().lazyProduct(pull_[v]);
      }
    });
    for (std::size_t part = 1; part < sums.size(); ++part) sums.front() += sums[part];
    for (Eigen::Index b = 0; b < columns; ++b) {
      for (std::size_t k = 0; k < nodes_; ++k) {
        for (Eigen::Index j = 0; j < kPerNode; ++j) {
          const Eigen::Index end = matrix_.outerIndexPtr()[at(k) + j + 1];
          matrix_.valuePtr()[end - (columns - b)] = familyColumns_[k](j, b);
        }
      }
      const Eigen::Index own = familyAt(static_cast<std::size_t>(b));
      double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[own];
      for (Eigen::Index c = b; c < columns; ++c) column[c - b] = sums.front()(c, b);
      column[0] += kFamilyPrice;
      right_[own] = sums.front()(b, columns);
    }
  }

  const CoarseProblem& problem_;
  const Target& target_;
  const Graph& graph_;
  std::size_t nodes_, members_;
  Eigen::Index size_;
  double unit_ = 1;
  std::vector<std::array<Lever, Graph::kPerVertex>> levers_;
  std::vector<Eigen::Vector3d> base_;
  std::vector<Pair> pairs_;
  std::vector<std::vector<Pair::Use>> usesOfNode_;
  std::vector<FamilyColumns> familyColumns_;  // per node
  std::vector<Added> added_;                  // per vertex, what the family adds
  std::vector<Eigen::Matrix3d> weight_;
  std::vector<Eigen::Vector3d> pull_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
  Eigen::VectorXd right_;
  Eigen::VectorXd solution_;
};

}  // namespace

std::optional<CoarseFit> fitCoarse(const std::vector<Triangle>& triangles,
                                   const CoarseProblem& problem, const Target& target,
                                   const CoarseSchedule& schedule, Progress* progress) {
  System system(problem, target);
  CoarseFit fit = system.start();
  for (std::size_t level = schedule.first; level < schedule.end; ++level) {
    for (int round = 0; round < schedule.rounds; ++round) {
      if (isCancelled(progress)) return std::nullopt;
      const Shape now = makeShape(triangles, std::move(fit.positions));
      // A factorisation can fail only by rounding; what is reached then is still a fit.
      const bool isDone = system.step(now, kStiffness[level], kPinWeight[level], kReach[level]);
      fit = system.read();
      if (!isDone) return fit;
    }
  }
  return fit;
}

}  // namespace toile::fitting
