// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/sparse_factor.h"

#include <algorithm>

#include "unfold/dense_cholesky.h"

// Every node is two rows and columns. The front of a supernode is the dense matrix of its pivots
// and the rows below them: the panel (the pivots' columns, kept: they become L) and the update
// (what is left for the rows below, given to the parent).
namespace toile::unfolding {
namespace {

constexpr std::size_t kPerNode = 2;

std::size_t pivotsOf(const Supernode& node) {
  return kPerNode * static_cast<std::size_t>(node.pivots());
}
std::size_t belowOf(const Supernode& node) {
  return kPerNode * node.rows.size();
}

/// Adds the lower part of a child's update to the front of its parent.
void addUpdate(const Supernode& child, const double* update, std::size_t parentPivots,
               std::size_t parentRows, double* panel, double* front) {
  const std::size_t size = belowOf(child);
  const std::size_t below = parentRows - parentPivots;
  for (std::size_t c = 0; c < child.rowsInPanel.size(); ++c) {
    const std::size_t column = kPerNode * static_cast<std::size_t>(child.rowsInPanel[c]);
    for (std::size_t side = 0; side < kPerNode; ++side) {
      const double* in = update + (kPerNode * c + side) * size;
      const std::size_t own = column + side;
      // Rows of the front count from its first pivot in the panel, from its first row in the
      // update.
      double* out = own < parentPivots ? panel + own * parentRows
                                       : front + (own - parentPivots) * below - parentPivots;
      if (side == 0) out[own] += in[kPerNode * c];
      out[column + 1] += in[kPerNode * c + 1];
      for (std::size_t r = c + 1; r < child.rowsInPanel.size(); ++r) {
        const std::size_t row = kPerNode * static_cast<std::size_t>(child.rowsInPanel[r]);
        out[row] += in[kPerNode * r];
        out[row + 1] += in[kPerNode * r + 1];
      }
    }
  }
}

}  // namespace

SparseFactor::SparseFactor(const BlockPattern& pattern) : elimination_(pattern) {
  const std::vector<Supernode>& nodes = elimination_.supernodes;
  panelStart_.reserve(nodes.size() + 1);
  panelStart_.push_back(0);
  std::size_t deepest = 0, depth = 0, largest = 0;
  std::vector<std::size_t> waiting(nodes.size(), 0);  // numbers of the children's updates
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const std::size_t pivots = pivotsOf(nodes[s]), below = belowOf(nodes[s]);
    panelStart_.push_back(panelStart_.back() + pivots * (pivots + below));
    depth = depth - waiting[s] + below * below;
    deepest = std::max(deepest, depth + waiting[s]);
    largest = std::max({largest, below * below, pivots + below});
    if (nodes[s].parent >= 0) waiting[static_cast<std::size_t>(nodes[s].parent)] += below * below;
  }
  panels_.resize(panelStart_.back());
  stack_.resize(deepest);
  front_.resize(largest);

  // Where the numbers of the matrix go: into the panel of the node that is eliminated first.
  std::vector<std::uint32_t> supernodeOf(pattern.nodeCount());
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    std::fill(supernodeOf.begin() + nodes[s].first, supernodeOf.begin() + nodes[s].end,
              static_cast<std::uint32_t>(s));
  }
  const auto forEachNumber = [&](const auto& visit) {
    for (std::size_t column = 0; column < 2 * pattern.nodeCount(); ++column) {
      for (int k = pattern.columnStart()[column]; k < pattern.columnStart()[column + 1]; ++k) {
        const auto row = static_cast<std::size_t>(pattern.row()[static_cast<std::size_t>(k)]);
        std::size_t a =
            kPerNode * static_cast<std::size_t>(elimination_.placeOfNode[row / 2]) + row % 2;
        std::size_t b =
            kPerNode * static_cast<std::size_t>(elimination_.placeOfNode[column / 2]) + column % 2;
        if (a < b) std::swap(a, b);
        visit(k, a, b);  // row a, column b, a >= b
      }
    }
  };
  moveStart_.assign(nodes.size() + 1, 0);
  forEachNumber([&](int, std::size_t, std::size_t b) { ++moveStart_[supernodeOf[b / 2] + 1]; });
  for (std::size_t s = 0; s < nodes.size(); ++s) moveStart_[s + 1] += moveStart_[s];
  moveFrom_.resize(pattern.row().size());
  moveTo_.resize(pattern.row().size());
  std::vector<std::size_t> fill(moveStart_.begin(), moveStart_.end() - 1);
  forEachNumber([&](int k, std::size_t a, std::size_t b) {
    const std::uint32_t s = supernodeOf[b / 2];
    const Supernode& node = nodes[s];
    const std::size_t first = kPerNode * static_cast<std::size_t>(node.first);
    const int place = static_cast<int>(a / 2);
    std::size_t row = a - first;
    if (place >= node.end) {
      const auto found = std::lower_bound(node.rows.begin(), node.rows.end(), place);
      row = pivotsOf(node) + kPerNode * static_cast<std::size_t>(found - node.rows.begin()) + a % 2;
    }
    const std::size_t at = fill[s]++;
    moveFrom_[at] = k;
    moveTo_[at] = static_cast<std::uint32_t>((b - first) * (pivotsOf(node) + belowOf(node)) + row);
  });
  x_.resize(kPerNode * pattern.nodeCount());
}

bool SparseFactor::factor(const BlockMatrix& matrix) {
  const std::vector<Supernode>& nodes = elimination_.supernodes;
  std::fill(panels_.begin(), panels_.end(), 0.0);
  waiting_.clear();
  double* top = stack_.data();
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const Supernode& node = nodes[s];
    const std::size_t pivots = pivotsOf(node), below = belowOf(node), rows = pivots + below;
    double* panel = panels_.data() + panelStart_[s];
    for (std::size_t m = moveStart_[s]; m < moveStart_[s + 1]; ++m) {
      panel[moveTo_[m]] = matrix.values()[static_cast<std::size_t>(moveFrom_[m])];
    }
    double* front = front_.data();
    std::fill_n(front, below * below, 0.0);
    while (!waiting_.empty() && nodes[waiting_.back()].parent == static_cast<int>(s)) {
      const Supernode& child = nodes[waiting_.back()];
      top -= belowOf(child) * belowOf(child);
      addUpdate(child, top, pivots, rows, panel, front);
      waiting_.pop_back();
    }
    if (!factorPanel(panel, rows, pivots, packed_)) return false;
    if (below == 0) continue;
    subtractOuterProduct(panel, rows, pivots, front, packed_);
    std::copy_n(front, below * below, top);
    top += below * below;
    waiting_.push_back(s);
  }
  return true;
}

void SparseFactor::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  const std::vector<Supernode>& nodes = elimination_.supernodes;
  const std::vector<int>& placeOfNode = elimination_.placeOfNode;
  for (std::size_t v = 0; v < placeOfNode.size(); ++v) {
    const std::size_t place = kPerNode * static_cast<std::size_t>(placeOfNode[v]);
    x_[place] = b[static_cast<Eigen::Index>(2 * v)];
    x_[place + 1] = b[static_cast<Eigen::Index>(2 * v + 1)];
  }
  // The rows below a supernode are gathered behind its pivots, so that the kernels see one vector.
  const auto gather = [&](const Supernode& node) {
    double* out = front_.data();
    out = std::copy_n(x_.data() + kPerNode * static_cast<std::size_t>(node.first), pivotsOf(node),
                      out);
    for (const int row : node.rows) {
      out = std::copy_n(x_.data() + kPerNode * static_cast<std::size_t>(row), kPerNode, out);
    }
  };
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const Supernode& node = nodes[s];
    gather(node);
    const std::size_t pivots = pivotsOf(node);
    solveForward(panels_.data() + panelStart_[s], pivots + belowOf(node), pivots, front_.data());
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
    const std::size_t pivots = pivotsOf(node);
    solveBackward(panels_.data() + panelStart_[s], pivots + belowOf(node), pivots, front_.data());
    std::copy_n(front_.data(), pivots, x_.data() + kPerNode * static_cast<std::size_t>(node.first));
  }
  x.resize(b.size());
  for (std::size_t v = 0; v < placeOfNode.size(); ++v) {
    const std::size_t place = kPerNode * static_cast<std::size_t>(placeOfNode[v]);
    x[static_cast<Eigen::Index>(2 * v)] = x_[place];
    x[static_cast<Eigen::Index>(2 * v + 1)] = x_[place + 1];
  }
}

}  // namespace toile::unfolding
