#include "kernel/math/dense_solve.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "kernel/base/error.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using test::for_all;
using test::integer;
using test::Rng;
using test::uniform;

constexpr double eps = std::numeric_limits<double>::epsilon();

MatrixXd random_matrix(Rng& rng, Index rows, Index cols) {
  MatrixXd A(rows, cols);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < cols; ++j) A(i, j) = uniform(rng, -1, 1);
  return A;
}

TEST(BandedSolve, SolvesOpenAndCyclicDominantSystemsOfAnySize) {
  for_all([](Rng& rng) {
    const int n = integer(rng, 1, 60), lower = integer(rng, 0, 3), upper = integer(rng, 0, 3);
    const bool cyclic = integer(rng, 0, 1) == 1;
    MatrixXd bands = random_matrix(rng, n, lower + 1 + upper), A = MatrixXd::Zero(n, n);
    bands.col(lower).array() += 8.0;  // dominant by at least 8 - 1 - 6: condition <= 15
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < bands.cols(); ++k) {
        const Index c = i - lower + k;
        if (cyclic)
          A(i, ((c % n) + n) % n) += bands(i, k);
        else if (c >= 0 && c < n)
          A(i, c) += bands(i, k);
        else
          bands(i, k) = 0.0;
      }
    const MatrixXd x = random_matrix(rng, n, 3);
    EXPECT_LE((solve_banded(bands, lower, cyclic, A.lazyProduct(x)) - x).cwiseAbs().maxCoeff(),
              15 * 60 * eps);
  });
}

TEST(BandedSolve, RefusesASingularMatrix) {
  MatrixXd bands = MatrixXd::Zero(4, 3);
  bands.col(1).setOnes();
  EXPECT_NO_THROW((void)solve_banded(bands, 1, false, MatrixXd::Ones(4, 1)));
  bands(2, 1) = 0.0;
  EXPECT_THROW((void)solve_banded(bands, 1, false, MatrixXd::Ones(4, 1)), GeometryError);
  // Cyclic differences x_i - x_{i+1}: constants are in the kernel.
  MatrixXd difference(20, 2);
  difference << MatrixXd::Ones(20, 1), -MatrixXd::Ones(20, 1);
  EXPECT_THROW((void)solve_banded(difference, 0, true, MatrixXd::Ones(20, 1)), GeometryError);
}

TEST(DenseSolve, SolvesAndRefusesSingularMatrices) {
  for_all([](Rng& rng) {
    const int n = integer(rng, 1, 20);
    MatrixXd A = random_matrix(rng, n, n);
    A.diagonal().array() += 2.0 * n;  // condition <= 3
    const MatrixXd x = random_matrix(rng, n, 2);
    EXPECT_LE((solve(A, A.lazyProduct(x)) - x).cwiseAbs().maxCoeff(), 3 * 20 * 20 * eps);
    if (n == 1) return;
    A.row(0) = A.row(n - 1);
    EXPECT_THROW((void)solve(A, x), GeometryError);
  });
}

TEST(LeastSquares, LeavesAResidualOrthogonalToTheColumns) {
  for_all([](Rng& rng) {
    const int n = integer(rng, 1, 8), m = n + integer(rng, 0, 20);
    const MatrixXd A = random_matrix(rng, m, n), b = random_matrix(rng, m, 2);
    const LeastSquares fit = least_squares(A, b);
    EXPECT_EQ(fit.rank, n);
    EXPECT_GE(fit.condition, 1.0);
    // Residual of size sqrt(m), columns of size sqrt(m); the error of x is amplified by the condition.
    EXPECT_LE(A.transpose().lazyProduct(MatrixXd(b - A.lazyProduct(fit.x))).cwiseAbs().maxCoeff(),
              200 * eps * m * fit.condition);
  });
}

TEST(LeastSquares, FindsTheConditionAndTheRank) {
  MatrixXd A = MatrixXd::Zero(5, 3);
  A(0, 0) = 2.0;
  A(1, 1) = 1e-6;
  A(4, 2) = -0.5;
  EXPECT_NEAR(least_squares(A, MatrixXd::Ones(5, 1)).condition, 2e6, 1e-6);
  // Two equal columns share the coefficient: the shortest solution.
  MatrixXd twin(3, 2);
  twin << 1, 1, 2, 2, 3, 3;
  const LeastSquares shared = least_squares(twin, twin.col(0));
  EXPECT_EQ(shared.rank, 1);
  EXPECT_NEAR(shared.x(0, 0), 0.5, 20 * eps);
  EXPECT_NEAR(shared.x(1, 0), 0.5, 20 * eps);
  EXPECT_GT(shared.condition, 1e15);
  EXPECT_EQ(least_squares(MatrixXd::Zero(3, 2), MatrixXd::Ones(3, 1)).rank, 0);
}

TEST(LeastSquares, TakesTheShortestSolutionOfAWideSystem) {
  for_all([](Rng& rng) {
    const MatrixXd A = random_matrix(rng, 3, 6), b = random_matrix(rng, 3, 1);
    const LeastSquares fit = least_squares(A, b);
    EXPECT_EQ(fit.rank, 3);
    EXPECT_LE((A.lazyProduct(fit.x) - b).norm(), 100 * eps * fit.condition);
    // Shortest: x = A^T y for some y, so x is orthogonal to every vector that A takes to zero.
    const MatrixXd y = solve(A.lazyProduct(A.transpose()), b);
    EXPECT_LE((fit.x - A.transpose().lazyProduct(y)).norm(),
              100 * eps * fit.condition * fit.condition * (1 + y.norm()));
  });
}

}  // namespace
}  // namespace blendwright
