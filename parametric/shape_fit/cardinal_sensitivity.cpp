#include "parametric/shape_fit/cardinal_sensitivity.hpp"

#include <cmath>

#include "kernel/math/dense_solve.hpp"
#include "kernel/math/quadrature.hpp"

namespace blendwright::detail {
namespace {

constexpr int mode_count = 48;
constexpr int quadrature_points = 64;

/// Legendre polynomials P_n(2u - 1) and their derivatives along u, n < count.
struct Legendre {
  Eigen::VectorXd value, slope;
  Legendre(double u, int count) : value(count), slope(count) {
    const double t = 2.0 * u - 1.0;
    value[0] = 1.0;
    slope[0] = 0.0;
    value[1] = t;
    slope[1] = 2.0;
    for (int n = 1; n + 1 < count; ++n) {
      value[n + 1] = ((2.0 * n + 1.0) * t * value[n] - n * value[n - 1]) / (n + 1.0);
      slope[n + 1] = slope[n - 1] + 2.0 * (2.0 * n + 1.0) * value[n];
    }
  }
};

/// What (3) needs of psi once per order: values at the quadrature points and <psi^(j), psi^(j)>.
struct Galerkin {
  std::vector<Modes> modes;
  std::array<Eigen::MatrixXd, 3> gram;
  explicit Galerkin(int n) {
    const QuadratureRule& rule = gauss_legendre(quadrature_points);
    for (Eigen::MatrixXd& g : gram) g = Eigen::MatrixXd::Zero(mode_count, mode_count);
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      modes.push_back(modes_at(n, rule.x[i]));
      for (int j = 0; j < n; ++j)
        gram[static_cast<std::size_t>(j)].noalias() +=
            (rule.w[i] * modes.back().row(j).transpose()) * modes.back().row(j);
    }
  }
};

const Galerkin& galerkin(int n) {
  static const Galerkin fourth(2), sixth(3);
  return n == 2 ? fourth : sixth;
}

double sign(int k) { return k % 2 == 0 ? 1.0 : -1.0; }

}  // namespace

Modes modes_at(int n, double u) {
  const Legendre P(u, mode_count + 2 * n + 1);
  Modes modes(4, mode_count);
  for (int m = 0; m < mode_count; ++m) {
    // Coefficients of psi^(n - i) on P_{m+n-i}, P_{m+n-i+2}, ..: the integral of P_k is (P_{k+1} -
    // P_{k-1})/(2(2k+1)).
    std::array<double, 4> c{std::sqrt(2.0 * (m + n) + 1.0), 0.0, 0.0, 0.0};
    if (n == 2) modes(3, m) = c[0] * P.slope[m + n];
    for (int i = 0; i <= n; ++i) {
      double sum = 0.0;
      for (int l = 0; l <= i; ++l) sum += c[static_cast<std::size_t>(l)] * P.value[m + n - i + 2 * l];
      modes(n - i, m) = sum;
      std::array<double, 4> integral{};
      for (int l = 0; l <= i && i < n; ++l) {
        const double part = c[static_cast<std::size_t>(l)] / (2.0 * (2.0 * (m + n - i + 2 * l) + 1.0));
        integral[static_cast<std::size_t>(l)] -= part;
        integral[static_cast<std::size_t>(l) + 1] += part;
      }
      c = integral;
    }
  }
  return modes;
}

CardinalSensitivity::CardinalSensitivity(const CardinalBasis& basis, const EvenOperator& a,
                                         const std::vector<EvenOperator>& by)
    : half_order_(basis.count() / 2) {
  if (by.empty()) return;
  const int n = half_order_, functions = basis.count();
  const Galerkin& g = galerkin(n);
  const QuadratureRule& rule = gauss_legendre(quadrature_points);
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(mode_count, mode_count);
  for (int j = 0; j < n; ++j)
    A += (sign(j + n) * a[static_cast<std::size_t>(j)]) * g.gram[static_cast<std::size_t>(j)];
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(mode_count, functions * static_cast<Eigen::Index>(by.size()));
  for (std::size_t q = 0; q < rule.x.size(); ++q) {
    const CardinalValues phi = basis(rule.x[q]);
    for (std::size_t i = 0; i < by.size(); ++i)
      for (int j = 0; j < n; ++j) {
        const double factor = -sign(j + n) * by[i][static_cast<std::size_t>(j)] * rule.w[q];
        if (factor == 0.0) continue;
        for (int k = 0; k < functions; ++k)
          f.col(functions * static_cast<Eigen::Index>(i) + k) +=
              (factor * phi.value[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)]) *
              g.modes[q].row(j).transpose();
      }
  }
  const Eigen::MatrixXd c = solve(A, f);
  for (std::size_t i = 0; i < by.size(); ++i)
    coefficients_.push_back(c.middleCols(functions * static_cast<Eigen::Index>(i), functions));
}

CardinalValues CardinalSensitivity::at(std::size_t i, const Modes& modes) const {
  CardinalValues W;
  const Eigen::MatrixXd& c = coefficients_[i];
  for (Eigen::Index j = 0; j < 4; ++j)
    for (Eigen::Index k = 0; k < c.cols(); ++k)
      W.value[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] = modes.row(j).dot(c.col(k));
  return W;
}

}  // namespace blendwright::detail
