// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/sparse_factor.h"

#include <cblas.h>
#include <cholmod.h>
#include <dlfcn.h>

#include <new>

#include "toile/core/assert.h"

namespace toile::unfolding {
namespace {

/// A view of compressed columns that CHOLMOD reads but does not own.
cholmod_sparse view(const std::vector<int>& start, const std::vector<int>& row,
                    const std::vector<double>* values) {
  cholmod_sparse a{};
  a.nrow = a.ncol = start.size() - 1;
  a.nzmax = row.size();
  a.p = const_cast<int*>(start.data());
  a.i = const_cast<int*>(row.data());
  a.x = values != nullptr ? const_cast<double*>(values->data()) : nullptr;
  a.stype = 1;  // the upper triangle: CHOLMOD then transposes once less
  a.itype = CHOLMOD_INT;
  a.xtype = values != nullptr ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

/// CHOLMOD may be built with OpenMP, whose threads spin beside ours for loops of microseconds. Its
/// runtime is then loaded, and is asked not to start any for the calling thread.
void holdToOneThread() {
  openblas_set_num_threads(1);  // idle BLAS threads cost, and sums depend on their number
  using SetLevels = void (*)(int);
  static const auto setLevels =
      reinterpret_cast<SetLevels>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
  if (setLevels != nullptr) setLevels(0);
}

}  // namespace

struct SparseFactor::State {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* x = nullptr;
  cholmod_dense* y = nullptr;
  cholmod_dense* e = nullptr;

  State() { cholmod_start(&common); }
  ~State() {
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  void check() const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) {
      throw std::bad_alloc();
    }
    TOILE_ASSERT(common.status >= CHOLMOD_OK);
  }
};

SparseFactor::SparseFactor(const BlockPattern& pattern) : state_(std::make_unique<State>()) {
  holdToOneThread();
  cholmod_common& common = state_->common;
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 1;
  // Its simplicial code would make L D L^T and take negative pivots without a word.
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = 1;
  common.quick_return_if_not_posdef = 1;

  // The two numbers of a node have the same neighbours: ordering nodes is the same and cheaper.
  cholmod_sparse nodes = view(pattern.nodeStart(), pattern.nodeRow(), nullptr);
  std::vector<int> order(pattern.nodeCount());
  cholmod_amd(&nodes, nullptr, 0, order.data(), &common);
  state_->check();
  std::vector<int> expanded;
  expanded.reserve(2 * order.size());
  for (const int node : order) {
    expanded.push_back(2 * node);
    expanded.push_back(2 * node + 1);
  }
  cholmod_sparse a = view(pattern.columnStart(), pattern.row(), nullptr);
  state_->factor = cholmod_analyze_p(&a, expanded.data(), nullptr, 0, &common);
  state_->check();
}

SparseFactor::~SparseFactor() = default;

bool SparseFactor::factor(const BlockMatrix& matrix) {
  const BlockPattern& pattern = matrix.pattern();
  cholmod_sparse a = view(pattern.columnStart(), pattern.row(), &matrix.values());
  cholmod_factorize(&a, state_->factor, &state_->common);
  if (state_->common.status == CHOLMOD_NOT_POSDEF) return false;
  state_->check();
  return true;
}

void SparseFactor::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  cholmod_dense right{};
  right.nrow = right.d = right.nzmax = static_cast<std::size_t>(b.size());
  right.ncol = 1;
  right.x = const_cast<double*>(b.data());
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(CHOLMOD_A, state_->factor, &right, nullptr, &state_->x, nullptr, &state_->y,
                 &state_->e, &state_->common);
  state_->check();
  x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(state_->x->x), b.size());
}

}  // namespace toile::unfolding
