// Cardinal functions of the sixth-order families, all with real roots. L = r^2:
//   quintic L^3 = 0;  tension1 L^2 (L - q^2) = 0;  tension2 L (L - q^2)^2 = 0;  triple (L - q^2)^3 = 0 (1)
// Every solution is the sum of three even and three odd functions about u = 1/2; the end-1 functions follow
// from three conditions at u = 1 per parity, the i-th derivative scaled by rate^-i:
//   sum_k f_k^(i)(1) X_ki' = delta_ii',  end function i' = sum_k X_ki' f_k (2)
// Stiffness q <= 3: power series in u - 1/2. Larger: the layer functions x^j e^{-x}, y^j e^{-y} (x = q u,
// y = q (1 - u)) and polynomials in u - 1/2, so that nothing overflows. After the formula sheet, section 3.
#include <algorithm>
#include <cmath>
#include <utility>

#include "parametric/ode/cardinal_routes.hpp"

namespace blendwright::detail {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;
using Functions = std::array<std::array<double, 4>, 3>;  // [function][derivative]
struct Parity {
  Functions even, odd;
};

/// X of (2): Gaussian elimination with row exchanges, right sides diag(rate^-i).
Matrix3 end_coefficients(const Functions& at_one, double rate) {
  Matrix3 A, X{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const double scale = i == 0 ? 1.0 : (i == 1 ? 1.0 / rate : 1.0 / (rate * rate));
      A[i][k] = at_one[k][i] * scale;
      X[i][i] = scale;
    }
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < 3; ++i)
      if (std::abs(A[i][k]) > std::abs(A[best][k])) best = i;
    std::swap(A[k], A[best]);
    std::swap(X[k], X[best]);
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double f = A[i][k] / A[k][k];
      for (std::size_t j = 0; j < 3; ++j) {
        A[i][j] -= f * A[k][j];
        X[i][j] -= f * X[k][j];
      }
    }
  }
  for (std::size_t k = 3; k-- > 0;)
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t i = k + 1; i < 3; ++i) X[k][j] -= A[k][i] * X[i][j];
      X[k][j] /= A[k][k];
    }
  return X;
}

EndFunctions combined(const Functions& f, const Matrix3& X) {
  EndFunctions end{};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 3; ++i) end[j][i] = f[0][j] * X[0][i] + f[1][j] * X[1][i] + f[2][j] * X[2][i];
  return end;
}

/// `Shape` gives the even and odd functions and the rate that their derivatives grow with.
template <class Shape>
class ParityRoute final : public CardinalBasis::Impl {
 public:
  ParityRoute(const Shape& shape, double stiffness_) : Impl(6, 1.0, stiffness_), shape_(shape) {
    const Parity f = shape_(1.0, 0.0);
    even_ = end_coefficients(f.even, shape_.rate());
    odd_ = end_coefficients(f.odd, shape_.rate());
  }
  CardinalValues at(double u, double w) const override {
    const Parity f = shape_(u, w);
    return from_parity(3, combined(f.even, even_), combined(f.odd, odd_));
  }

 private:
  Shape shape_;
  Matrix3 even_, odd_;
};

/// Power series in t = u - w = 2u - 1 of the solutions with one of the derivatives 0..5 equal to 1 at t = 0.
class MiddleSeries {
 public:
  MiddleSeries(SixthOrderFamily family, double q) {
    const auto [a4, a2, a0] = characteristic(family, 0.25 * q * q);  // d/du = 2 d/dt
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, terms> g{};
      g[k] = 1.0;
      for (std::size_t n = 3; n < terms; ++n) g[n] = -a4 * g[n - 1] - a2 * g[n - 2] - a0 * g[n - 3];
      double factorial = 1.0;  // (2n)!
      for (std::size_t n = 0; n < terms; ++n) {
        const double top = static_cast<double>(2 * n);
        if (n > 0) factorial *= top * (top - 1.0);
        double even = g[n] / factorial, odd = even / (top + 1.0);  // times t^(2n), t^(2n + 1)
        for (std::size_t j = 0; j < 4; ++j) {
          const double order = static_cast<double>(j);
          even_[k][j][n] = even;
          odd_[k][j][n] = odd;
          even *= 2.0 * std::max(0.0, top - order);
          odd *= 2.0 * std::max(0.0, top + 1.0 - order);
        }
      }
    }
  }
  [[nodiscard]] static double rate() { return 2.0; }
  [[nodiscard]] Parity operator()(double u, double w) const {
    const double t = u - w, x = t * t;
    Parity f;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 4; ++j) {
        // The lowest power of t in the j-th derivative: 0 or 1 for j <= 1; the leading coefficients are 0
        // above.
        f.even[k][j] = sum(even_[k][j], (j + 1) / 2, x) * (j % 2 == 0 ? 1.0 : t);
        f.odd[k][j] = sum(odd_[k][j], j / 2, x) * (j % 2 == 0 ? t : 1.0);
      }
    return f;
  }

 private:
  static constexpr std::size_t terms = 17;  // (q/2)^32/32! < 2e-30 at q = 3
  using Coefficients = std::array<double, terms>;
  struct Characteristic {
    double a4, a2, a0;
  };
  /// L^3 + a4 L^2 + a2 L + a0 of (1), Q = q^2.
  static Characteristic characteristic(SixthOrderFamily family, double Q) {
    switch (family) {
      case SixthOrderFamily::quintic:
        break;
      case SixthOrderFamily::tension1:
        return {-Q, 0.0, 0.0};
      case SixthOrderFamily::tension2:
        return {-2.0 * Q, Q * Q, 0.0};
      case SixthOrderFamily::triple:
        return {-3.0 * Q, 3.0 * Q * Q, -Q * Q * Q};
    }
    return {0.0, 0.0, 0.0};
  }
  static double sum(const Coefficients& c, std::size_t first, double x) {
    double s = 0.0;
    for (std::size_t n = terms; n-- > first;) s = s * x + c[n];
    return s;
  }
  std::array<std::array<Coefficients, 4>, 3> even_{}, odd_{};  // [function][derivative by u]
};

class Layers {
 public:
  Layers(SixthOrderFamily family, double q)
      : q_(q),
        polynomials_(family == SixthOrderFamily::triple ? 0
                                                        : (family == SixthOrderFamily::tension2 ? 1 : 2)) {}
  [[nodiscard]] double rate() const { return q_; }
  [[nodiscard]] Parity operator()(double u, double w) const {
    Parity f{};
    const double t = u - w;  // twice the distance from the middle: powers stay in [-1, 1]
    if (polynomials_ > 0) {
      f.even[0] = {1.0, 0.0, 0.0, 0.0};
      f.odd[0] = {t, 2.0, 0.0, 0.0};
    }
    if (polynomials_ > 1) {
      f.even[1] = {t * t, 4.0 * t, 8.0, 0.0};
      f.odd[1] = {t * t * t, 6.0 * t * t, 24.0 * t, 48.0};
    }
    const double ex = std::exp(-q_ * u), ey = std::exp(-q_ * w);
    for (std::size_t k = 0; k + polynomials_ < 3; ++k) {
      double power = 1.0;  // q^j: d/du of y^k e^{-y} is -q d/dy
      for (std::size_t j = 0; j < 4; ++j, power *= q_) {
        const double near_one = power * ey * minus_derivative(k, j, q_ * w);
        const double near_zero = (j % 2 == 0 ? power : -power) * ex * minus_derivative(k, j, q_ * u);
        f.even[polynomials_ + k][j] = near_one + near_zero;
        f.odd[polynomials_ + k][j] = near_one - near_zero;
      }
    }
    return f;
  }

 private:
  /// (-d/dy)^j of y^k e^{-y}, without e^{-y}.
  static double minus_derivative(std::size_t k, std::size_t j, double y) {
    const double n = static_cast<double>(j);
    if (k == 0) return 1.0;
    if (k == 1) return y - n;
    return y * y - 2.0 * n * y + n * (n - 1.0);
  }
  double q_;
  std::size_t
      polynomials_;  // of each parity; they come first, so that elimination leaves the layers well scaled
};

}  // namespace

Route sixth_series_route(SixthOrderFamily family, double q) {
  return std::make_shared<ParityRoute<MiddleSeries>>(MiddleSeries(family, q), q);
}
Route sixth_layer_route(SixthOrderFamily family, double q) {
  return std::make_shared<ParityRoute<Layers>>(Layers(family, q), q);
}

}  // namespace blendwright::detail
