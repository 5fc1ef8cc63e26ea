// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace toile::unfolding {

// Dense kernels of the sparse factor. Written out so that the order of all sums is fixed: the
// answer has the same bits on every processor, whatever its vectors hold (no library promises
// that), and small blocks pay no call overhead.

/// Factors the first `pivots` columns of a symmetric matrix of `rows` rows, given by its lower part
/// in column-major order: the panel becomes [L11; L21]. The diagonal of L11 is stored inverted.
/// @param packed room to work in, kept between calls.
/// @return false if it is not positive definite.
[[nodiscard]] bool factorPanel(double* panel, std::size_t rows, std::size_t pivots,
                               std::vector<double>& packed);

/// update -= L21 L21^T, its lower part, for the rows of the panel below its pivots; column-major,
/// rows - pivots on a side.
void subtractOuterProduct(const double* panel, std::size_t rows, std::size_t pivots, double* update,
                          std::vector<double>& packed);

/// x of the pivots becomes L11^-1 x; x of the rows below loses L21 x.
void solveForward(const double* panel, std::size_t rows, std::size_t pivots, double* x);
/// x of the pivots becomes L11^-T (x - L21^T (x of the rows below)).
void solveBackward(const double* panel, std::size_t rows, std::size_t pivots, double* x);

}  // namespace toile::unfolding
