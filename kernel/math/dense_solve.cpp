#include "kernel/math/dense_solve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;
constexpr double eps = std::numeric_limits<double>::epsilon();

// A = W V^T with orthogonal columns of W: one-sided Jacobi (Hestenes), accurate for small singular values too
// and much cheaper to compile than the decompositions of Eigen.
struct Jacobi {
  Eigen::MatrixXd W, V;
};

Jacobi orthogonalised(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  Jacobi j{A, Eigen::MatrixXd::Identity(A.cols(), A.cols())};
  for (int sweep = 0; sweep < 60; ++sweep) {
    bool turned = false;
    for (Index p = 0; p < A.cols(); ++p)
      for (Index q = p + 1; q < A.cols(); ++q) {
        const double a = j.W.col(p).squaredNorm(), b = j.W.col(q).squaredNorm(),
                     c = j.W.col(p).dot(j.W.col(q));
        if (!(std::abs(c) > 4.0 * eps * std::sqrt(a * b)) ||
            std::min(a, b) <= eps * eps * eps * eps * std::max(a, b))
          continue;
        turned = true;
        const double zeta = (b - a) / (2.0 * c);
        const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
        const double cosine = 1.0 / std::hypot(1.0, t), sine = cosine * t;
        for (Eigen::MatrixXd* m : {&j.W, &j.V})
          for (Index i = 0; i < m->rows(); ++i) {
            const double x = (*m)(i, p), y = (*m)(i, q);
            (*m)(i, p) = cosine * x - sine * y;
            (*m)(i, q) = sine * x + cosine * y;
          }
      }
    if (!turned) break;
  }
  return j;
}

Eigen::MatrixXd dense(const Eigen::Ref<const Eigen::MatrixXd>& bands, Index lower, bool cyclic) {
  const Index n = bands.rows();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < bands.cols(); ++k) {
      Index c = i - lower + k;
      if (cyclic) c = ((c % n) + n) % n;
      if (c >= 0 && c < n) A(i, c) += bands(i, k);
    }
  return A;
}

// Rows 0..m-1 of a banded matrix, eliminated in place together with the rows of `right`.
// Throws when a pivot vanishes against its own row.
void eliminate(RowMajor& band, Index lower, RowMajor& right, Index m) {
  const Index width = band.cols(), upper = width - 1 - lower;
  for (Index i = 0; i < m; ++i) {
    for (Index k = std::max<Index>(0, i - lower); k < i; ++k) {
      const double f = band(i, k - i + lower) / band(k, lower);
      if (f == 0.0) continue;
      for (Index c = 1; c <= std::min(upper, m - 1 - k); ++c)
        band(i, k - i + lower + c) -= f * band(k, lower + c);
      right.row(i).noalias() -= f * right.row(k);
    }
    if (!(std::abs(band(i, lower)) > eps * band.row(i).cwiseAbs().maxCoeff()))
      throw GeometryError("banded system: pivot " + std::to_string(i) + " vanishes, the matrix is singular");
  }
  for (Index i = m - 1; i >= 0; --i) {
    for (Index c = 1; c <= std::min(upper, m - 1 - i); ++c)
      right.row(i).noalias() -= band(i, lower + c) * right.row(i + c);
    right.row(i) /= band(i, lower);
  }
}

// Arrow form of a cyclic band: the last k unknowns form the border, the rest is an ordinary band.
Eigen::MatrixXd solve_cyclic(const Eigen::Ref<const Eigen::MatrixXd>& bands, Index lower, Index k,
                             const Eigen::Ref<const Eigen::MatrixXd>& b) {
  const Index n = bands.rows(), m = n - k, channels = b.cols();
  RowMajor band = RowMajor::Zero(m, bands.cols());
  RowMajor right(m, channels + k);  // right sides, then the columns of the border
  right.leftCols(channels) = b.topRows(m);
  right.rightCols(k).setZero();
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < bands.cols(); ++j) {
      const Index c = (i - lower + j + n) % n;
      if (c >= m)
        right(i, channels + c - m) += bands(i, j);
      else
        band(i, j) = bands(i, j);
    }
  eliminate(band, lower, right, m);
  Eigen::MatrixXd schur = Eigen::MatrixXd::Zero(k, k), rest = b.bottomRows(k);
  for (Index i = 0; i < k; ++i)
    for (Index j = 0; j < bands.cols(); ++j) {
      const Index c = (m + i - lower + j) % n;
      if (c >= m) {
        schur(i, c - m) += bands(m + i, j);
      } else {
        schur.row(i) -= bands(m + i, j) * right.row(c).tail(k);
        rest.row(i) -= bands(m + i, j) * right.row(c).head(channels);
      }
    }
  Eigen::MatrixXd x(n, channels);
  x.bottomRows(k) = solve(schur, rest);
  x.topRows(m) = right.leftCols(channels);
  x.topRows(m).noalias() -= right.rightCols(k).lazyProduct(x.bottomRows(k));
  return x;
}

}  // namespace

LeastSquares least_squares(const Eigen::Ref<const Eigen::MatrixXd>& A,
                           const Eigen::Ref<const Eigen::MatrixXd>& b) {
  const Index n = A.cols();
  LeastSquares result;
  result.x = Eigen::MatrixXd::Zero(n, b.cols());
  if (n == 0 || A.rows() == 0) return result;
  const Jacobi j = orthogonalised(A);
  const Eigen::VectorXd sigma = j.W.colwise().norm();
  const double largest = sigma.maxCoeff();
  // A wide matrix has n - m columns of rounding only: its condition is that of the m largest singular values.
  std::vector<double> sorted(sigma.data(), sigma.data() + n);
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const double smallest = sorted[static_cast<std::size_t>(std::min(n, A.rows()) - 1)];
  result.condition = smallest > 0.0 ? largest / smallest : std::numeric_limits<double>::infinity();
  const double cut = eps * static_cast<double>(std::max(n, A.rows())) * largest;
  for (Index i = 0; i < n; ++i) {
    if (!(sigma[i] > cut)) continue;
    ++result.rank;
    for (Index c = 0; c < b.cols(); ++c)
      result.x.col(c) += (j.W.col(i).dot(b.col(c)) / (sigma[i] * sigma[i])) * j.V.col(i);
  }
  return result;
}

SingularValues singular_values(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  const Jacobi j = orthogonalised(A);
  const Eigen::VectorXd sigma = j.W.colwise().norm();
  std::vector<Index> order(static_cast<std::size_t>(A.cols()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return sigma[a] > sigma[b]; });
  SingularValues s{Eigen::VectorXd(A.cols()), Eigen::MatrixXd(A.cols(), A.cols())};
  for (Index i = 0; i < A.cols(); ++i) {
    s.values[i] = sigma[order[static_cast<std::size_t>(i)]];
    s.V.col(i) = j.V.col(order[static_cast<std::size_t>(i)]);
  }
  return s;
}

Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& A,
                      const Eigen::Ref<const Eigen::MatrixXd>& b) {
  const Index n = A.rows();
  const auto singular = [n] {
    return GeometryError("linear system of " + std::to_string(n) + " unknowns: the matrix is singular");
  };
  RowMajor lu = A, x = b;
  for (Index i = 0; i < n; ++i) {  // every row to the same size, so that pivots can be compared with 1
    const double size = lu.row(i).cwiseAbs().maxCoeff();
    if (!(size > 0.0) || !std::isfinite(size)) throw singular();
    lu.row(i) /= size;
    x.row(i) /= size;
  }
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    lu.col(k).tail(n - k).cwiseAbs().maxCoeff(&pivot);
    pivot += k;
    lu.row(k).swap(lu.row(pivot));
    x.row(k).swap(x.row(pivot));
    if (!(std::abs(lu(k, k)) > eps * static_cast<double>(n))) throw singular();
    for (Index i = k + 1; i < n; ++i) {
      const double f = lu(i, k) / lu(k, k);
      if (f == 0.0) continue;
      lu.row(i).tail(n - k - 1) -= f * lu.row(k).tail(n - k - 1);
      x.row(i) -= f * x.row(k);
    }
  }
  for (Index k = n - 1; k >= 0; --k) {
    for (Index i = k + 1; i < n; ++i) x.row(k) -= lu(k, i) * x.row(i);
    x.row(k) /= lu(k, k);
  }
  return x;
}

Eigen::MatrixXd solve_banded(const Eigen::Ref<const Eigen::MatrixXd>& bands, int lower, bool cyclic,
                             const Eigen::Ref<const Eigen::MatrixXd>& b) {
  const Index n = bands.rows(), upper = bands.cols() - 1 - lower, k = std::max<Index>(lower, upper);
  if (n == 0) return Eigen::MatrixXd(0, b.cols());
  if (!cyclic) {
    RowMajor band = bands, right = b;
    eliminate(band, lower, right, n);
    return right;
  }
  // Short cycles: a band that meets itself is cheaper dense.
  if (n < 2 * bands.cols()) return solve(dense(bands, lower, true), b);
  return solve_cyclic(bands, lower, k, b);
}

}  // namespace blendwright
