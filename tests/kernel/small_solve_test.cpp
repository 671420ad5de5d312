#include "kernel/math/small_solve.hpp"

#include <gtest/gtest.h>

#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

template <int n>
void solves_what_it_should() {
  for_all([](Rng& rng) {
    Eigen::Matrix<double, n, n> A;
    Eigen::Matrix<double, n, 2> x;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) A(i, j) = uniform(rng, -1, 1);
      for (int j = 0; j < 2; ++j) x(i, j) = uniform(rng, -1, 1);
    }
    const Eigen::Matrix<double, n, 2> b = A * x, found = solve_small<n, 2>(A, b);
    // Backward stable: the residual is of the order of n^2 eps of |A| |x|; growth of pivots is at most 8 for
    // n = 4.
    const double size = A.cwiseAbs().maxCoeff() * found.cwiseAbs().maxCoeff();
    EXPECT_LE((A * found - b).cwiseAbs().maxCoeff(), 8 * n * n * 2.3e-16 * size);
  });
}

TEST(SmallSolve, LeavesAResidualOfRounding) {
  solves_what_it_should<2>();
  solves_what_it_should<3>();
  solves_what_it_should<4>();
}

TEST(SmallSolve, PivotsWhereTheDiagonalIsZero) {
  Eigen::Matrix2d A;
  A << 0, 1, 1, 0;
  const Eigen::Vector2d x = solve_small<2, 1>(A, Eigen::Vector2d(3, 4));
  EXPECT_EQ(x, Eigen::Vector2d(4, 3));
}

TEST(SmallSolve, OfASingularMatrixIsNotFinite) {
  Eigen::Matrix2d A;
  A << 1, 2, 2, 4;
  EXPECT_FALSE((solve_small<2, 1>(A, Eigen::Vector2d(1, 1)).allFinite()));
}

}  // namespace
}  // namespace blendwright::test
