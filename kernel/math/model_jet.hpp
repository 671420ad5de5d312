#pragma once
// Second-order jets whose coefficients are Taylor models: a formula of two variables and its first and second
// derivatives, enclosed along a curve through its domain.
//
//   F(u(x) + g, v(x) + h) = sum_{i+j<=2} c(i,j)(x) g^i h^j + higher order,   c(i,j) = F_{u^i v^j}/(i! j!) (1)
// for every x in [-1, 1]. The same templates that are evaluated with Taylor2 are evaluated with this type.
#include <array>

#include "kernel/math/taylor_model.hpp"

namespace blendwright {

struct ModelJet {
  std::array<TaylorModel, 6> c{};  ///< (0,0), (1,0), (0,1), (2,0), (1,1), (0,2)
  ModelJet() = default;
  ModelJet(double x) { c[0] = x; }                       // NOLINT: constants mix freely with jets
  explicit ModelJet(const TaylorModel& x) { c[0] = x; }  ///< a constant of g and h
  [[nodiscard]] static ModelJet u_variable(const TaylorModel& u) {
    ModelJet j(u);
    j.c[1] = 1.0;
    return j;
  }
  [[nodiscard]] static ModelJet v_variable(const TaylorModel& v) {
    ModelJet j(v);
    j.c[2] = 1.0;
    return j;
  }
};

[[nodiscard]] ModelJet operator+(const ModelJet& a, const ModelJet& b);
[[nodiscard]] ModelJet operator-(const ModelJet& a, const ModelJet& b);
[[nodiscard]] ModelJet operator-(const ModelJet& a);
[[nodiscard]] ModelJet operator*(const ModelJet& a, const ModelJet& b);
[[nodiscard]] ModelJet operator/(const ModelJet& a, const ModelJet& b);
[[nodiscard]] ModelJet operator*(double s, const ModelJet& a);
[[nodiscard]] inline ModelJet operator*(const ModelJet& a, double s) { return s * a; }
[[nodiscard]] inline ModelJet operator+(const ModelJet& a, double b) { return a + ModelJet(b); }
[[nodiscard]] inline ModelJet operator+(double a, const ModelJet& b) { return ModelJet(a) + b; }
[[nodiscard]] inline ModelJet operator-(const ModelJet& a, double b) { return a + ModelJet(-b); }
[[nodiscard]] inline ModelJet operator-(double a, const ModelJet& b) { return ModelJet(a) - b; }
[[nodiscard]] inline ModelJet operator/(double a, const ModelJet& b) { return ModelJet(a) / b; }
[[nodiscard]] inline ModelJet operator/(const ModelJet& a, double b) { return a / ModelJet(b); }

/// f(a) from f, f' and f''/2 at the constant term of a.
[[nodiscard]] ModelJet composed(const TaylorModel& f, const TaylorModel& f1, const TaylorModel& f2,
                                const ModelJet& a);
[[nodiscard]] ModelJet sin(const ModelJet& a);
[[nodiscard]] ModelJet cos(const ModelJet& a);
[[nodiscard]] std::array<ModelJet, 2> sin_cos(const ModelJet& a);
[[nodiscard]] ModelJet tan(const ModelJet& a);
[[nodiscard]] ModelJet asin(const ModelJet& a);
[[nodiscard]] ModelJet acos(const ModelJet& a);
[[nodiscard]] ModelJet atan(const ModelJet& a);
[[nodiscard]] ModelJet atan2(const ModelJet& y, const ModelJet& x);
[[nodiscard]] ModelJet sinh(const ModelJet& a);
[[nodiscard]] ModelJet cosh(const ModelJet& a);
[[nodiscard]] ModelJet tanh(const ModelJet& a);
[[nodiscard]] ModelJet exp(const ModelJet& a);
[[nodiscard]] ModelJet log(const ModelJet& a);
[[nodiscard]] ModelJet sqrt(const ModelJet& a);
[[nodiscard]] ModelJet pow(const ModelJet& a, double p);
[[nodiscard]] ModelJet pow(const ModelJet& a, const ModelJet& b);
/// Unbounded where the constant term may vanish: the derivatives jump there.
[[nodiscard]] ModelJet abs(const ModelJet& a);
/// The branch that is taken over the whole range; unbounded where neither is.
[[nodiscard]] ModelJet min(const ModelJet& a, const ModelJet& b);
[[nodiscard]] ModelJet max(const ModelJet& a, const ModelJet& b);
/// Nothing known of any coefficient.
[[nodiscard]] ModelJet unknown_jet();

/// A parameter of a closed range, brought into it by whole periods; what stands beyond an end by less than
/// 1e-9 of the range belongs to the continuation, and a model that crosses an end by more is unbounded (a
/// smaller piece of the curve will not cross it). Open ranges only bound: beyond, nothing is known.
/// `turns`: whole periods taken off, when asked for.
[[nodiscard]] TaylorModel inside_range(const TaylorModel& t, double lo, double hi, bool closed,
                                       double* turns = nullptr);
[[nodiscard]] ModelJet in_closed_range(const ModelJet& t, double lo, double hi);

}  // namespace blendwright
