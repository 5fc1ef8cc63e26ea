// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/elimination.h"

#include <cholmod.h>

#include <algorithm>
#include <new>
#include <numeric>

namespace toile::unfolding {
namespace {

/// A supernode of at most kAlwaysMerged pivots joins its parent anyway; larger ones as long as the
/// share of zeros stays small. Fewer and larger dense blocks are worth a few zeros.
constexpr int kAlwaysMerged = 3;
constexpr int kSmall = 16;
constexpr double kZerosOfSmall = 0.3;
constexpr double kZeros = 0.07;

/// The upper triangle of the pattern with its nodes numbered backward.
struct Backward {
  std::vector<int> start, row;

  explicit Backward(const BlockPattern& pattern)
      : start(pattern.nodeCount() + 1, 0), row(pattern.nodeRow().size()) {
    const int n = static_cast<int>(pattern.nodeCount());
    for (const int i : pattern.nodeRow()) ++start[static_cast<std::size_t>(n - i)];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<int> fill(start.begin(), start.end() - 1);
    for (int j = n - 1; j >= 0; --j) {
      const auto column = static_cast<std::size_t>(j);
      for (int k = pattern.nodeStart()[column]; k < pattern.nodeStart()[column + 1]; ++k) {
        const auto turned =
            static_cast<std::size_t>(n - 1 - pattern.nodeRow()[static_cast<std::size_t>(k)]);
        row[static_cast<std::size_t>(fill[turned]++)] = n - 1 - j;
      }
    }
  }
};

/// @param start, row the upper triangle in compressed columns, rows ascending.
std::vector<int> minimumDegreeOrder(const std::vector<int>& start, const std::vector<int>& row) {
  const std::size_t n = start.size() - 1;
  cholmod_common common{};
  cholmod_start(&common);
  common.print = 0;
  cholmod_sparse a{};
  a.nrow = a.ncol = n;
  a.nzmax = row.size();
  a.p = const_cast<int*>(start.data());
  a.i = const_cast<int*>(row.data());
  a.stype = 1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_PATTERN;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  std::vector<int> order(n);
  const bool done = cholmod_amd(&a, nullptr, 0, order.data(), &common) != 0;
  cholmod_finish(&common);
  if (!done) throw std::bad_alloc();
  return order;
}

/// The neighbours of each place that are eliminated before it.
struct Earlier {
  std::vector<int> start, place;
};

Earlier earlierNeighbours(const BlockPattern& pattern, const std::vector<int>& placeOfNode) {
  const std::size_t n = pattern.nodeCount();
  Earlier earlier{std::vector<int>(n + 1, 0), std::vector<int>(pattern.nodeRow().size())};
  const auto forEachPair = [&](const auto& visit) {
    for (std::size_t j = 0; j < n; ++j) {
      for (int k = pattern.nodeStart()[j]; k < pattern.nodeStart()[j + 1]; ++k) {
        const int a = placeOfNode[j];
        const int b =
            placeOfNode[static_cast<std::size_t>(pattern.nodeRow()[static_cast<std::size_t>(k)])];
        visit(static_cast<std::size_t>(std::max(a, b)), std::min(a, b));
      }
    }
  };
  forEachPair([&](std::size_t later, int) { ++earlier.start[later + 1]; });
  std::partial_sum(earlier.start.begin(), earlier.start.end(), earlier.start.begin());
  std::vector<int> fill(earlier.start.begin(), earlier.start.end() - 1);
  forEachPair([&](std::size_t later, int first) {
    earlier.place[static_cast<std::size_t>(fill[later]++)] = first;
  });
  return earlier;
}

/// For each place the first later one that its column reaches: the elimination tree.
std::vector<int> eliminationTree(const Earlier& earlier) {
  const std::size_t n = earlier.start.size() - 1;
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = earlier.start[i]; k < earlier.start[i + 1]; ++k) {
      int j = earlier.place[static_cast<std::size_t>(k)];
      while (j != -1 && j != static_cast<int>(i)) {
        int& up = ancestor[static_cast<std::size_t>(j)];
        const int next = up;
        up = static_cast<int>(i);
        if (next == -1) parent[static_cast<std::size_t>(j)] = static_cast<int>(i);
        j = next;
      }
    }
  }
  return parent;
}

/// How many places each column reaches, itself included.
std::vector<int> columnCounts(const Earlier& earlier, const std::vector<int>& parent) {
  const std::size_t n = parent.size();
  std::vector<int> count(n, 1), seen(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    seen[i] = static_cast<int>(i);
    for (int k = earlier.start[i]; k < earlier.start[i + 1]; ++k) {
      auto j = static_cast<std::size_t>(earlier.place[static_cast<std::size_t>(k)]);
      while (seen[j] != static_cast<int>(i)) {
        seen[j] = static_cast<int>(i);
        ++count[j];
        j = static_cast<std::size_t>(parent[j]);
      }
    }
  }
  return count;
}

/// Children before parents; the child with the longest column last, so that it can join.
std::vector<int> postorder(const std::vector<int>& parent, const std::vector<int>& count) {
  const std::size_t n = parent.size();
  std::vector<int> byCount(n);
  std::iota(byCount.begin(), byCount.end(), 0);
  std::stable_sort(byCount.begin(), byCount.end(), [&](int a, int b) {
    return count[static_cast<std::size_t>(a)] < count[static_cast<std::size_t>(b)];
  });
  std::vector<int> firstChild(n, -1), sibling(n, -1);
  std::vector<int> stack;
  // Pushed to the front of the list, the largest would come first: go through them backwards.
  for (auto it = byCount.rbegin(); it != byCount.rend(); ++it) {
    const auto child = static_cast<std::size_t>(*it);
    if (parent[child] < 0) {
      stack.push_back(*it);
      continue;
    }
    const auto p = static_cast<std::size_t>(parent[child]);
    sibling[child] = firstChild[p];
    firstChild[p] = *it;
  }
  std::vector<int> order;
  order.reserve(n);
  while (!stack.empty()) {
    const auto top = static_cast<std::size_t>(stack.back());
    const int child = firstChild[top];
    if (child >= 0) {
      firstChild[top] = sibling[static_cast<std::size_t>(child)];
      stack.push_back(child);
    } else {
      order.push_back(static_cast<int>(top));
      stack.pop_back();
    }
  }
  return order;
}

/// Ranges of places that become supernodes.
std::vector<int> supernodeStarts(const std::vector<int>& parent, const std::vector<int>& count) {
  struct Range {
    int first, end, below;  ///< places, and rows below the last
    double zeros;           ///< blocks that the factor need not hold
  };
  std::vector<Range> ranges;
  const int n = static_cast<int>(parent.size());
  for (int j = 0; j < n; ++j) {
    Range range{j, j + 1, count[static_cast<std::size_t>(j)] - 1, 0};
    // The last range may join if its parent is the place that follows.
    while (!ranges.empty() &&
           parent[static_cast<std::size_t>(ranges.back().end - 1)] == range.first) {
      const Range& child = ranges.back();
      const double pivots = child.end - child.first;
      const double more = range.end - range.first + range.below - child.below;
      const double zeros = child.zeros + range.zeros + pivots * more;
      const double all = range.end - child.first;
      const double size = all * (all + 1) / 2 + all * range.below;
      const bool small = all <= kSmall;
      const bool joins =
          more == 0 || all <= kAlwaysMerged || zeros < size * (small ? kZerosOfSmall : kZeros);
      if (!joins) break;
      range = {child.first, range.end, range.below, zeros};
      ranges.pop_back();
    }
    ranges.push_back(range);
  }
  std::vector<int> starts;
  for (const Range& range : ranges) starts.push_back(range.first);
  starts.push_back(n);
  return starts;
}

}  // namespace

Elimination::Elimination(const BlockPattern& pattern) : placeOfNode(pattern.nodeCount()) {
  // Minimum degree leaves many ties, which the numbering decides: backward, a mesh that is numbered
  // ring by ring from its middle costs a fifth less, and others the same.
  const Backward backward(pattern);
  const std::vector<int> order = minimumDegreeOrder(backward.start, backward.row);
  const int last = static_cast<int>(order.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    placeOfNode[static_cast<std::size_t>(last - order[static_cast<std::size_t>(i)])] = i;
  }
  std::vector<int> parent, count;
  {
    const Earlier earlier = earlierNeighbours(pattern, placeOfNode);
    parent = eliminationTree(earlier);
    count = columnCounts(earlier, parent);
  }
  // Renumber everything by the postorder.
  const std::vector<int> post = postorder(parent, count);
  std::vector<int> newPlace(post.size());
  for (std::size_t i = 0; i < post.size(); ++i) {
    newPlace[static_cast<std::size_t>(post[i])] = static_cast<int>(i);
  }
  for (int& place : placeOfNode) place = newPlace[static_cast<std::size_t>(place)];
  std::vector<int> parentOf(parent.size()), countOf(parent.size());
  for (std::size_t i = 0; i < post.size(); ++i) {
    const auto old = static_cast<std::size_t>(post[i]);
    parentOf[i] = parent[old] < 0 ? -1 : newPlace[static_cast<std::size_t>(parent[old])];
    countOf[i] = count[old];
  }

  const std::vector<int> starts = supernodeStarts(parentOf, countOf);
  supernodes.resize(starts.size() - 1);
  std::vector<int> supernodeOf(parent.size());
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    supernodes[s].first = starts[s];
    supernodes[s].end = starts[s + 1];
    for (int j = starts[s]; j < starts[s + 1]; ++j) {
      supernodeOf[static_cast<std::size_t>(j)] = static_cast<int>(s);
    }
  }

  // Later neighbours of the pivots and the children's rows give the rows.
  std::vector<std::vector<int>> children(supernodes.size());
  std::vector<int> start(parent.size() + 1, 0), later(pattern.nodeRow().size());
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<int> fill = start;
    for (std::size_t j = 0; j < placeOfNode.size(); ++j) {
      for (int k = pattern.nodeStart()[j]; k < pattern.nodeStart()[j + 1]; ++k) {
        const int a = placeOfNode[j];
        const int b =
            placeOfNode[static_cast<std::size_t>(pattern.nodeRow()[static_cast<std::size_t>(k)])];
        const auto first = static_cast<std::size_t>(std::min(a, b));
        if (pass == 0) {
          ++start[first + 1];
        } else {
          later[static_cast<std::size_t>(fill[first]++)] = std::max(a, b);
        }
      }
    }
    if (pass == 0) std::partial_sum(start.begin(), start.end(), start.begin());
  }
  std::vector<int> seen(parent.size(), -1);
  std::vector<int> localOf(parent.size(), -1);
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    Supernode& node = supernodes[s];
    const auto add = [&](int place) {
      if (place < node.end || seen[static_cast<std::size_t>(place)] == static_cast<int>(s)) return;
      seen[static_cast<std::size_t>(place)] = static_cast<int>(s);
      node.rows.push_back(place);
    };
    for (int k = start[static_cast<std::size_t>(node.first)];
         k < start[static_cast<std::size_t>(node.end)]; ++k) {
      add(later[static_cast<std::size_t>(k)]);
    }
    for (const int child : children[s]) {
      for (const int place : supernodes[static_cast<std::size_t>(child)].rows) add(place);
    }
    std::sort(node.rows.begin(), node.rows.end());
    for (int j = node.first; j < node.end; ++j) {
      localOf[static_cast<std::size_t>(j)] = j - node.first;
    }
    for (int r = 0; r < node.below(); ++r) {
      localOf[static_cast<std::size_t>(node.rows[static_cast<std::size_t>(r)])] = node.pivots() + r;
    }
    for (const int child : children[s]) {
      Supernode& below = supernodes[static_cast<std::size_t>(child)];
      below.rowsInPanel.reserve(below.rows.size());
      for (const int place : below.rows) {
        below.rowsInPanel.push_back(localOf[static_cast<std::size_t>(place)]);
      }
    }
    if (!node.rows.empty()) {
      node.parent = supernodeOf[static_cast<std::size_t>(node.rows.front())];
      children[static_cast<std::size_t>(node.parent)].push_back(static_cast<int>(s));
    }
  }
}

}  // namespace toile::unfolding
