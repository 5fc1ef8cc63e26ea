// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/sparse_factor.h"

#include <algorithm>

#include "unfold/dense_cholesky.h"

// Every node is kPerNode rows and columns. The front of a supernode is the dense matrix of its
// pivots and the rows below them: the panel (the pivots' columns, kept: they become L) and the
// update (what is left for the rows below, given to the parent).
namespace toile::unfolding {
namespace {

template <std::size_t kPerNode>
std::size_t pivotsOf(const Supernode& node) {
  return kPerNode * static_cast<std::size_t>(node.pivots());
}
template <std::size_t kPerNode>
std::size_t belowOf(const Supernode& node) {
  return kPerNode * node.rows.size();
}

/// Numbers of an update: its lower part, column by column.
template <std::size_t kPerNode>
std::size_t updateSize(const Supernode& node) {
  const std::size_t below = belowOf<kPerNode>(node);
  return below * (below + 1) / 2;
}

/// Adds a child's update to the front of its parent.
template <std::size_t kPerNode>
void addUpdate(const Supernode& child, const double* update, std::size_t parentPivots,
               std::size_t parentRows, double* panel, double* front) {
  const std::size_t size = belowOf<kPerNode>(child);
  const std::size_t below = parentRows - parentPivots;
  const double* in = update;  // the number of row r of a column lies at in[r]
  for (std::size_t c = 0; c < child.rowsInPanel.size(); ++c) {
    const std::size_t column = kPerNode * static_cast<std::size_t>(child.rowsInPanel[c]);
    for (std::size_t side = 0; side < kPerNode; ++side) {
      const std::size_t own = column + side;
      // Rows of the front count from its first pivot in the panel, from its first row in the
      // update.
      double* out = own < parentPivots ? panel + own * parentRows
                                       : front + (own - parentPivots) * below - parentPivots;
      for (std::size_t r = side; r < kPerNode; ++r) out[column + r] += in[kPerNode * c + r];
      for (std::size_t r = c + 1; r < child.rowsInPanel.size(); ++r) {
        const std::size_t row = kPerNode * static_cast<std::size_t>(child.rowsInPanel[r]);
        for (std::size_t k = 0; k < kPerNode; ++k) out[row + k] += in[kPerNode * r + k];
      }
      in += size - (kPerNode * c + side) - 1;
    }
  }
}

}  // namespace

template <std::size_t kPerNode>
MultifrontalFactor<kPerNode>::MultifrontalFactor(const BlockPattern& pattern,
                                                 std::shared_ptr<const Elimination> elimination)
    : elimination_(std::move(elimination)) {
  const std::vector<Supernode>& nodes = elimination_->supernodes;
  panelStart_.reserve(nodes.size() + 1);
  panelStart_.push_back(0);
  std::size_t deepest = 0, depth = 0, largest = 0;
  std::vector<std::size_t> waiting(nodes.size(), 0);  // numbers of the children's updates
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const std::size_t pivots = pivotsOf<kPerNode>(nodes[s]), below = belowOf<kPerNode>(nodes[s]);
    panelStart_.push_back(panelStart_.back() + pivots * (pivots + below));
    const std::size_t update = updateSize<kPerNode>(nodes[s]);
    depth = depth - waiting[s] + update;
    deepest = std::max(deepest, depth + waiting[s]);
    largest = std::max({largest, below * below, pivots + below});
    if (nodes[s].parent >= 0) waiting[static_cast<std::size_t>(nodes[s].parent)] += update;
  }
  stackSize_ = deepest;
  front_.resize(largest);

  // Where the numbers of the matrix go: into the panel of the node that is eliminated first.
  std::vector<std::uint32_t> supernodeOf(pattern.nodeCount());
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    std::fill(supernodeOf.begin() + nodes[s].first, supernodeOf.begin() + nodes[s].end,
              static_cast<std::uint32_t>(s));
  }
  // visit(supernode, number k of the matrix, row and column in the supernode's panel), block by
  // block: the rows below are searched once for all numbers of a block.
  const auto columnOf = [&](std::size_t j, std::size_t side) {
    const auto before = static_cast<std::size_t>(pattern.nodeStart()[j]);
    const auto above = static_cast<std::size_t>(pattern.nodeStart()[j + 1]) - before;
    return kPerNode * kPerNode * before + kPerNode * (kPerNode + 1) / 2 * j +
           side * kPerNode * above + side * (side + 1) / 2;
  };
  const auto forEachNumber = [&](const auto& visit) {
    for (std::size_t j = 0; j < pattern.nodeCount(); ++j) {
      const int own = elimination_->placeOfNode[j];
      const int begin = pattern.nodeStart()[j], end = pattern.nodeStart()[j + 1];
      for (int entry = begin; entry < end; ++entry) {
        const int other = elimination_->placeOfNode[static_cast<std::size_t>(
            pattern.nodeRow()[static_cast<std::size_t>(entry)])];
        const int first = std::min(own, other), later = std::max(own, other);
        const std::uint32_t s = supernodeOf[static_cast<std::size_t>(first)];
        const Supernode& node = nodes[s];
        std::size_t row = 0;
        if (later < node.end) {
          row = kPerNode * static_cast<std::size_t>(later - node.first);
        } else {
          const auto found = std::lower_bound(node.rows.begin(), node.rows.end(), later);
          row = pivotsOf<kPerNode>(node) +
                kPerNode * static_cast<std::size_t>(found - node.rows.begin());
        }
        const std::size_t column = kPerNode * static_cast<std::size_t>(first - node.first);
        for (std::size_t side = 0; side < kPerNode; ++side) {
          const std::size_t k =
              columnOf(j, side) + kPerNode * static_cast<std::size_t>(entry - begin);
          for (std::size_t r = 0; r < kPerNode; ++r) {
            const bool isTurned = own > other;  // the matrix' column is a row of the factor
            visit(s, k + r, row + (isTurned ? side : r), column + (isTurned ? r : side));
          }
        }
      }
      const std::uint32_t s = supernodeOf[static_cast<std::size_t>(own)];
      const std::size_t at = kPerNode * static_cast<std::size_t>(own - nodes[s].first);
      for (std::size_t side = 0; side < kPerNode; ++side) {
        const std::size_t columnEnd = columnOf(j, side + 1);
        for (std::size_t r = 0; r <= side; ++r)
          visit(s, columnEnd - 1 - side + r, at + side, at + r);
      }
    }
  };
  moveStart_.assign(nodes.size() + 1, 0);
  forEachNumber(
      [&](std::uint32_t s, std::size_t, std::size_t, std::size_t) { ++moveStart_[s + 1]; });
  for (std::size_t s = 0; s < nodes.size(); ++s) moveStart_[s + 1] += moveStart_[s];
  moveFrom_.resize(moveStart_.back());
  moveTo_.resize(moveStart_.back());
  std::vector<std::size_t> fill(moveStart_.begin(), moveStart_.end() - 1);
  forEachNumber([&](std::uint32_t s, std::size_t k, std::size_t row, std::size_t column) {
    const std::size_t at = fill[s]++;
    moveFrom_[at] = static_cast<int>(k);
    moveTo_[at] = static_cast<std::uint32_t>(
        column * (pivotsOf<kPerNode>(nodes[s]) + belowOf<kPerNode>(nodes[s])) + row);
  });
  x_.resize(kPerNode * pattern.nodeCount());
}

template <std::size_t kPerNode>
bool MultifrontalFactor<kPerNode>::factor(const std::vector<double>& values) {
  const std::vector<Supernode>& nodes = elimination_->supernodes;
  if (!panels_) {
    panels_.reset(new double[size()]);
    stack_.reset(new double[stackSize_]);
  }
  waiting_.clear();
  double* top = stack_.get();
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const Supernode& node = nodes[s];
    const std::size_t pivots = pivotsOf<kPerNode>(node), below = belowOf<kPerNode>(node),
                      rows = pivots + below;
    double* panel = panels_.get() + panelStart_[s];
    std::fill_n(panel, pivots * rows, 0.0);
    for (std::size_t m = moveStart_[s]; m < moveStart_[s + 1]; ++m) {
      panel[moveTo_[m]] = values[static_cast<std::size_t>(moveFrom_[m])];
    }
    double* front = front_.data();
    for (std::size_t c = 0; c < below; ++c) {  // the lower part is all that is used
      std::fill_n(front + c * below + c, below - c, 0.0);
    }
    while (!waiting_.empty() && nodes[waiting_.back()].parent == static_cast<int>(s)) {
      const Supernode& child = nodes[waiting_.back()];
      top -= updateSize<kPerNode>(child);
      addUpdate<kPerNode>(child, top, pivots, rows, panel, front);
      waiting_.pop_back();
    }
    if (!factorPanel(panel, rows, pivots, packed_)) return false;
    if (below == 0) continue;
    subtractOuterProduct(panel, rows, pivots, front, packed_);
    for (std::size_t c = 0; c < below; ++c) {
      top = std::copy_n(front + c * below + c, below - c, top);
    }
    waiting_.push_back(s);
  }
  return true;
}

template <std::size_t kPerNode>
void MultifrontalFactor<kPerNode>::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  const std::vector<Supernode>& nodes = elimination_->supernodes;
  const std::vector<int>& placeOfNode = elimination_->placeOfNode;
  for (std::size_t v = 0; v < placeOfNode.size(); ++v) {
    const std::size_t place = kPerNode * static_cast<std::size_t>(placeOfNode[v]);
    for (std::size_t k = 0; k < kPerNode; ++k) {
      x_[place + k] = b[static_cast<Eigen::Index>(kPerNode * v + k)];
    }
  }
  // The rows below a supernode are gathered behind its pivots, so that the kernels see one vector.
  const auto gather = [&](const Supernode& node) {
    double* out = front_.data();
    out = std::copy_n(x_.data() + kPerNode * static_cast<std::size_t>(node.first),
                      pivotsOf<kPerNode>(node), out);
    for (const int row : node.rows) {
      out = std::copy_n(x_.data() + kPerNode * static_cast<std::size_t>(row), kPerNode, out);
    }
  };
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const Supernode& node = nodes[s];
    gather(node);
    const std::size_t pivots = pivotsOf<kPerNode>(node);
    solveForward(panels_.get() + panelStart_[s], pivots + belowOf<kPerNode>(node), pivots,
                 front_.data());
    const double* in = front_.data();
    std::copy_n(in, pivots, x_.data() + kPerNode * static_cast<std::size_t>(node.first));
    in += pivots;
    for (const int row : node.rows) {
      std::copy_n(in, kPerNode, x_.data() + kPerNode * static_cast<std::size_t>(row));
      in += kPerNode;
    }
  }
  for (std::size_t s = nodes.size(); s-- > 0;) {
    const Supernode& node = nodes[s];
    gather(node);
    const std::size_t pivots = pivotsOf<kPerNode>(node);
    solveBackward(panels_.get() + panelStart_[s], pivots + belowOf<kPerNode>(node), pivots,
                  front_.data());
    std::copy_n(front_.data(), pivots, x_.data() + kPerNode * static_cast<std::size_t>(node.first));
  }
  x.resize(b.size());
  for (std::size_t v = 0; v < placeOfNode.size(); ++v) {
    const std::size_t place = kPerNode * static_cast<std::size_t>(placeOfNode[v]);
    for (std::size_t k = 0; k < kPerNode; ++k) {
      x[static_cast<Eigen::Index>(kPerNode * v + k)] = x_[place + k];
    }
  }
}

template class MultifrontalFactor<1>;
template class MultifrontalFactor<2>;

}  // namespace toile::unfolding
