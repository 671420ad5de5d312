#pragma once
// Linear systems of a few unknowns, of a size known when compiling: Eigen's decompositions of that size cost
// seconds of compile time in each file that includes them.
#include <Eigen/Core>
#include <cmath>
#include <utility>

namespace blendwright {

/// Solves A x = b, n x n with n small and known, by elimination with partial pivoting. Where A is singular
/// the result is not finite.
template <int n, int channels>
[[nodiscard]] Eigen::Matrix<double, n, channels> solve_small(Eigen::Matrix<double, n, n> A,
                                                             Eigen::Matrix<double, n, channels> b) {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(A(i, k)) > std::abs(A(pivot, k))) pivot = i;
    if (pivot != k) {
      for (int j = 0; j < n; ++j) std::swap(A(k, j), A(pivot, j));
      for (int j = 0; j < channels; ++j) std::swap(b(k, j), b(pivot, j));
    }
    for (int i = k + 1; i < n; ++i) {
      const double factor = A(i, k) / A(k, k);
      for (int j = k; j < n; ++j) A(i, j) -= factor * A(k, j);
      for (int j = 0; j < channels; ++j) b(i, j) -= factor * b(k, j);
    }
  }
  for (int k = n; k-- > 0;)
    for (int j = 0; j < channels; ++j) {
      for (int i = k + 1; i < n; ++i) b(k, j) -= A(k, i) * b(i, j);
      b(k, j) /= A(k, k);
    }
  return b;
}

}  // namespace blendwright
