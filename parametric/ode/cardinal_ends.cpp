#include "parametric/ode/cardinal_ends.hpp"

#include <cstddef>

namespace blendwright {
namespace {

/// H1'' and K1'' at u = 0 and u = 1.
struct EndOneBends {
  Bounds H0, K0, H1, K1;
};

/// All functions: H0(u) = H1(1 - u), K0(u) = -K1(1 - u).
EndBends reflected(const EndOneBends& f) {
  EndBends all;
  all.value[0] = {f.H1, -f.K1, f.H0, f.K0};
  all.value[1] = {f.H0, -f.K0, f.H1, f.K1};
  return all;
}

/// (1). g_m as in the recurrence g_(m + 2) = p g_(m + 1) - s g_m, |g_m| <= r^(m - 1) with r^2 = |p| r + |s|.
EndOneBends series_bends(const Bounds& p, const Bounds& s) {
  constexpr int terms = 24;
  Bounds f3, f2, d1, d2, previous, g(1.0), factorial(2.0);  // (2m)!
  for (int m = 1; m <= terms; ++m) {
    const double n = 2.0 * m;
    const Bounds term = g / factorial;  // g_m / (2m)!
    f3 = f3 + term / Bounds(n + 1.0);
    f2 = f2 + term;
    d1 = d1 + Bounds(n) * term;
    d2 = d2 + Bounds(n * (n - 1.0)) * term;
    const Bounds next = p * g - s * previous;
    previous = g;
    g = next;
    factorial = factorial * Bounds((n + 1.0) * (n + 2.0));
  }
  // The terms left out fall by more than half each: r <= 6.5 for |p|, sqrt|s| <= 4, against (2m + 1)(2m + 2).
  const double P = p.magnitude();
  const Bounds r = Bounds(0.5) * (Bounds(P) + sqrt(square(Bounds(P)) + Bounds(4.0 * s.magnitude())));
  Bounds tail(2.0);
  for (int m = 1; m <= terms; ++m) tail = tail * r;
  const double n = 2.0 * (terms + 1);
  const double left = (tail * Bounds(n * (n - 1.0)) / factorial).magnitude();
  const Bounds rest(-left, left);
  f3 = f3 + rest;
  f2 = f2 + rest;
  d1 = d1 + rest;
  d2 = d2 + rest;
  const Bounds W = square(f2) - f3 * d1;
  return {f2 / W, -(f3 / W), (d2 * f2 - square(d1)) / W, (d1 * f2 - d2 * f3) / W};
}

Bounds sin_cos(const Bounds& x, double (*function)(double)) {
  const double slack = x.radius();  // both have slopes of at most 1
  return of_library(function(x.middle())) + Bounds(-slack, slack);
}
double sine(double x) { return std::sin(x); }
double cosine(double x) { return std::cos(x); }

/// C = cosh(sqrt(l) t) and F = sinh(sqrt(l) t)/sqrt(l), entire in l, without the factor exp(rate t).
struct Entire {
  Bounds C, F, rate{};
  Entire(const Bounds& l, double t) {
    if (l.lo > 0.25) {
      rate = sqrt(l);
      const Bounds e = exp(Bounds(-2.0 * t) * rate);
      C = Bounds(0.5) * (Bounds(1.0) + e);
      F = (Bounds(1.0) - e) / (Bounds(2.0) * rate);
    } else if (l.hi < -0.25) {
      const Bounds om = sqrt(-l);
      C = sin_cos(Bounds(t) * om, cosine);
      F = sin_cos(Bounds(t) * om, sine) / om;
    } else {
      power_series(l * square(Bounds(t)), t);
    }
  }

 private:
  /// sum x^k/(2k)! and t sum x^k/(2k + 1)!; the terms left out sum to less than twice the first for |x| <= 1.
  void power_series(const Bounds& x, double t) {
    if (!(x.magnitude() <= 1.0)) {
      C = F = unbounded();
      return;
    }
    Bounds term(1.0);
    for (int k = 0; k < 12; ++k) {
      const double n = 2.0 * k;
      C = C + term;
      F = F + term / Bounds(n + 1.0);
      term = term * x / Bounds((n + 1.0) * (n + 2.0));
    }
    const double left = rounded_up(2.0 * 0x1p-79);  // 1/24! < 2^-79
    C = C + Bounds(-left, left);
    F = Bounds(t) * (F + Bounds(-left, left));
  }
};

/// (2), every product of two functions of the half sum divided by exp(2 rate).
EndOneBends product_bends(const Bounds& sg2, const Bounds& dl2) {
  const Entire S(sg2, 1.0), D(dl2, 1.0);
  const Bounds e = exp(D.rate - S.rate), both = square(e), two(2.0);
  const Bounds difference = sg2 - dl2;
  const Bounds Ps2 = square(S.F), Pd2 = both * square(D.F), Den = Ps2 - Pd2;
  return {two * difference * e * S.F * D.F / Den, two * e * (S.F * D.C - D.F * S.C) / Den,
          -(difference * (Ps2 + Pd2) / Den), two * (S.F * S.C - both * D.F * D.C) / Den};
}

/// (3); each column in its own scale, which cancels.
EndOneBends split_bends(const Bounds& L1, const Bounds& L2) {
  const Entire one(L1, 0.5), two(L2, 0.5);
  const Bounds We = one.C * L2 * two.F - two.C * L1 * one.F, Wo = one.F * two.C - two.F * one.C;
  const Bounds Pe = -(L1 * L2 * Wo / We), Qe = (L2 - L1) * one.C * two.C / We;
  const Bounds Po = -(We / Wo), Qo = (L2 - L1) * one.F * two.F / Wo, half(0.5);
  return {half * (Pe - Po), half * (Qe - Qo), half * (Pe + Po), half * (Qo + Qe)};
}

/// x y, exactly but for underflow, as a sum of two doubles.
struct Product {
  double value, error;
  Product(double x, double y) : value(x * y), error(std::fma(x, y, -value)) {}
};

/// (c^2 - 4 b d)/b^2 without cancellation: the leading parts cancel exactly when they are close. Scaled so
/// that the largest coefficient lies in [1/2, 1).
Bounds discriminant(const SweepOde& ode) {
  int exponent = 0;
  (void)std::frexp(std::max({std::abs(ode.b), std::abs(ode.c), std::abs(ode.d)}), &exponent);
  const double b = std::ldexp(ode.b, -exponent), c = std::ldexp(ode.c, -exponent);
  const double d = std::ldexp(ode.d, -exponent);
  const Product cc(c, c), bd(4.0 * b, d);
  const Bounds lost(-0x1p-1000, 0x1p-1000);  // what underflow may take
  const Bounds D = (Bounds(cc.value) - Bounds(bd.value)) + (Bounds(cc.error) - Bounds(bd.error)) + lost;
  return D / square(Bounds(b));
}

}  // namespace

EndBends end_bends(const SweepOde& ode) {
  const Bounds b(ode.b), p = -(Bounds(ode.c) / b), s = Bounds(ode.d) / b;
  if (!p.finite() || !s.finite()) return reflected({unbounded(), unbounded(), unbounded(), unbounded()});
  const double P = p.magnitude(), S = std::sqrt(s.magnitude());
  if (P <= 4.0 && S <= 4.0) return reflected(series_bends(p, s));
  const Bounds Delta = discriminant(ode);
  if (s.lo > 0.0 && S > 0.05 * P) {
    // (p + 2 sqrt s)(p - 2 sqrt s) = Delta: the factor that would cancel comes from the other one.
    const Bounds twice = Bounds(2.0) * sqrt(s), quarter(0.25);
    const Bounds sum = p.lo >= 0.0 ? p + twice : Delta / (p - twice);
    const Bounds difference = p.lo >= 0.0 ? Delta / (p + twice) : p - twice;
    return reflected(product_bends(quarter * sum, quarter * difference));
  }
  const Bounds root = sqrt(Delta);
  const Bounds L1 = Bounds(0.5) * (p.lo >= 0.0 ? p + root : p - root);
  return reflected(split_bends(L1, s / L1));
}

EndBends end_bends(double q) {
  const Bounds q2 = square(Bounds(q));
  if (q <= 1.0) return reflected(series_bends(Bounds(2.0) * q2, square(q2)));
  return reflected(product_bends(q2, Bounds(0.0)));
}

}  // namespace blendwright
