#pragma once
// The inner loop of grid evaluation: rows of points as linear combinations of a few rows.
#include <cstddef>

namespace blendwright::detail {

/// out[i * length + j] = sum_k coefficients[(i * count + k) * 3 + j % 3] * rows[k * stride + j] (1) for i in
/// [i0, i1), j in [j0, j1); j0 a multiple of 3. Products are rounded before they are summed, in the order of
/// k: the same bits for every vector width and alignment.
struct RowCombination {
  const double* rows;
  std::size_t
      stride;  ///< from one row k to the next; fastest when rows and out start alike within a cache line
  const double* coefficients;
  std::size_t count;   ///< number of rows k; vectorised for 4, 6, 8, 12, 14
  std::size_t length;  ///< doubles in a row
  double* out;
  bool uniform;  ///< the three coefficients of (i, k) are equal
  bool stream;   ///< write past the caches: for results that do not fit in them
};
void combine_rows(const RowCombination& task, std::size_t i0, std::size_t i1, std::size_t j0, std::size_t j1);

}  // namespace blendwright::detail
