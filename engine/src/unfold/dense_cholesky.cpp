// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/dense_cholesky.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// Every function is compiled for wider vectors too and chosen when the program starts. Each element
// is computed by the same multiplications and additions in the same order in all of them (there are
// no fused ones: -ffp-contract=off), only more at a time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TOILE_FOR_WIDE_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define TOILE_FOR_WIDE_VECTORS
#endif

namespace toile::unfolding {
namespace {

constexpr std::size_t kTileRows = 8;
constexpr std::size_t kTileColumns = 4;
/// Columns factored before the rest of the panel is told of them.
constexpr std::size_t kStrip = 16;

using Vector = double __attribute__((vector_size(64), aligned(8), may_alias));

/// Rows [from, rows) of the panel's columns [begin, end), in tiles of eight rows: for each tile the
/// columns one after the other, eight numbers each; zeros below the last row.
void pack(const double* panel, std::size_t rows, std::size_t from, std::size_t begin,
          std::size_t end, std::vector<double>& packed) {
  const std::size_t tiles = (rows - from + kTileRows - 1) / kTileRows;
  const std::size_t depth = end - begin;
  if (packed.size() < tiles * depth * kTileRows) packed.resize(tiles * depth * kTileRows);
  double* out = packed.data();
  for (std::size_t t = 0; t < tiles; ++t) {
    const std::size_t row = from + t * kTileRows;
    const std::size_t count = std::min(kTileRows, rows - row);
    for (std::size_t c = begin; c < end; ++c, out += kTileRows) {
      const double* in = panel + c * rows + row;
      for (std::size_t i = 0; i < count; ++i) out[i] = in[i];
      for (std::size_t i = count; i < kTileRows; ++i) out[i] = 0;
    }
  }
}

/// out (column-major, `stride` apart) -= a tile of rows times four columns of another tile.
[[gnu::always_inline]] inline void subtractTile(const double* a, const double* b, std::size_t depth,
                                                double* out, std::size_t stride,
                                                std::size_t rowCount, std::size_t columnCount) {
  Vector sum[kTileColumns] = {};
  for (std::size_t p = 0; p < depth; ++p, a += kTileRows, b += kTileRows) {
    const Vector rows = *reinterpret_cast<const Vector*>(a);
    sum[0] += rows * b[0];
    sum[1] += rows * b[1];
    sum[2] += rows * b[2];
    sum[3] += rows * b[3];
  }
  if (rowCount == kTileRows && columnCount == kTileColumns) {
    for (std::size_t c = 0; c < kTileColumns; ++c) {
      *reinterpret_cast<Vector*>(out + c * stride) -= sum[c];
    }
    return;
  }
  for (std::size_t c = 0; c < columnCount; ++c) {
    for (std::size_t i = 0; i < rowCount; ++i) out[c * stride + i] -= sum[c][i];
  }
}

/// out -= (packed rows) (packed rows)^T, for its columns [0, columns) and the rows from the
/// diagonal's tile on; out starts at the first packed row and column.
TOILE_FOR_WIDE_VECTORS void subtractPacked(const double* packed, std::size_t rows,
                                           std::size_t columns, std::size_t depth, double* out,
                                           std::size_t stride) {
  for (std::size_t j = 0; j < columns; j += kTileColumns) {
    const double* b = packed + (j / kTileRows) * depth * kTileRows + j % kTileRows;
    const std::size_t columnCount = std::min(kTileColumns, columns - j);
    for (std::size_t i = j - j % kTileRows; i < rows; i += kTileRows) {
      subtractTile(packed + i * depth, b, depth, out + j * stride + i, stride,
                   std::min(kTileRows, rows - i), columnCount);
    }
  }
}

/// Factors columns [begin, end) with all their rows; earlier columns have been subtracted.
TOILE_FOR_WIDE_VECTORS bool factorStrip(double* panel, std::size_t rows, std::size_t begin,
                                        std::size_t end) {
  for (std::size_t j = begin; j < end; ++j) {
    double* column = panel + j * rows;
    const double pivot = column[j];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    const double inverse = 1 / std::sqrt(pivot);
    column[j] = inverse;
    for (std::size_t i = j + 1; i < rows; ++i) column[i] *= inverse;
    for (std::size_t k = j + 1; k < end; ++k) {
      double* other = panel + k * rows;
      const double factor = column[k];
      for (std::size_t i = k; i < rows; ++i) other[i] -= factor * column[i];
    }
  }
  return true;
}

}  // namespace

bool factorPanel(double* panel, std::size_t rows, std::size_t pivots, std::vector<double>& packed) {
  for (std::size_t begin = 0; begin < pivots; begin += kStrip) {
    const std::size_t end = std::min(begin + kStrip, pivots);
    if (!factorStrip(panel, rows, begin, end)) return false;
    if (end == pivots) break;
    pack(panel, rows, end, begin, end, packed);
    subtractPacked(packed.data(), rows - end, pivots - end, end - begin, panel + end * rows + end,
                   rows);
  }
  return true;
}

void subtractOuterProduct(const double* panel, std::size_t rows, std::size_t pivots, double* update,
                          std::vector<double>& packed) {
  pack(panel, rows, pivots, 0, pivots, packed);
  subtractPacked(packed.data(), rows - pivots, rows - pivots, pivots, update, rows - pivots);
}

TOILE_FOR_WIDE_VECTORS void solveForward(const double* panel, std::size_t rows, std::size_t pivots,
                                         double* x) {
  for (std::size_t j = 0; j < pivots; ++j) {
    const double* column = panel + j * rows;
    const double value = x[j] * column[j];
    x[j] = value;
    for (std::size_t i = j + 1; i < rows; ++i) x[i] -= value * column[i];
  }
}

TOILE_FOR_WIDE_VECTORS void solveBackward(const double* panel, std::size_t rows, std::size_t pivots,
                                          double* x) {
  const auto total = [](const Vector& v) {
    return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
  };
  // Two columns at a time, so that x is read half as often; an odd one first.
  std::size_t j = pivots;
  if (pivots % 2 == 1) {
    --j;
    const double* column = panel + j * rows;
    double sum = 0;
    for (std::size_t i = j + 1; i < rows; ++i) sum += column[i] * x[i];
    x[j] = (x[j] - sum) * column[j];
  }
  while (j > 0) {
    j -= 2;
    const double* first = panel + j * rows;
    const double* second = first + rows;
    Vector sums1 = {}, sums2 = {};
    std::size_t i = j + 2;
    for (; i + kTileRows <= rows; i += kTileRows) {
      const Vector part = *reinterpret_cast<const Vector*>(x + i);
      sums1 += *reinterpret_cast<const Vector*>(first + i) * part;
      sums2 += *reinterpret_cast<const Vector*>(second + i) * part;
    }
    double sum1 = total(sums1), sum2 = total(sums2);
    for (; i < rows; ++i) {
      sum1 += first[i] * x[i];
      sum2 += second[i] * x[i];
    }
    x[j + 1] = (x[j + 1] - sum2) * second[j + 1];
    x[j] = (x[j] - sum1 - first[j + 1] * x[j + 1]) * first[j];
  }
}

}  // namespace toile::unfolding
