#pragma once
// The only place of dynamic decompositions. They are our own and short: those of Eigen dominate compile time.
#include <Eigen/Core>

namespace blendwright {

struct LeastSquares {
  Eigen::MatrixXd x;  ///< n x channels
  int rank = 0;
  double condition = 0.0;  ///< ratio of largest to smallest singular value
};
/// Minimises |A x - b|, and |x| where A leaves it free; A is m x n, b is m x channels. One-sided Jacobi: O(m
/// n^2) a sweep, about 6 sweeps; singular values below max(m, n) eps of the largest count as zero.
[[nodiscard]] LeastSquares least_squares(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                         const Eigen::Ref<const Eigen::MatrixXd>& b);

/// A = U diag(values) V^T, values in descending order; V: n x n. One-sided Jacobi as above.
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
[[nodiscard]] SingularValues singular_values(const Eigen::Ref<const Eigen::MatrixXd>& A);

/// Solves A x = b by LU with row scaling and partial pivoting; throws GeometryError when A is singular to
/// working precision: a pivot below n eps of its row.
[[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                    const Eigen::Ref<const Eigen::MatrixXd>& b);

/// Solves a banded (optionally cyclic) system without pivoting: for diagonally dominant and totally positive
/// matrices, which spline collocation gives. O(n bandwidth (bandwidth + channels)); a cyclic band is solved
/// in arrow form, the last max(lower, upper) unknowns being the border. Throws GeometryError when a pivot
/// vanishes.
/// @param bands   n x (lower + 1 + upper); bands(i, k) multiplies unknown i - lower + k
/// @param cyclic  unknown indices wrap modulo n; else entries outside the matrix must be 0
[[nodiscard]] Eigen::MatrixXd solve_banded(const Eigen::Ref<const Eigen::MatrixXd>& bands, int lower,
                                           bool cyclic, const Eigen::Ref<const Eigen::MatrixXd>& b);

}  // namespace blendwright
