#include "implicit/primitives/profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "implicit/primitives/profile-inl.hpp"

namespace blendwright::detail {
namespace {

/// Largest |dq/dtheta|.
double steepest(const Profile& p) {
  if (p.kind == Profile::Kind::rose) {
    // eps k sin x / (1 + eps cos x)^2 is largest where eps c^2 - c - 2 eps = 0, c = cos x.
    const double c = -4.0 * p.eps / (1.0 + std::sqrt(1.0 + 8.0 * p.eps * p.eps)), d = 1.0 + p.eps * c;
    return (1.0 + p.eps) / p.a * p.eps * p.k * std::sqrt(1.0 - c * c) / (d * d);
  }
  // s^(m-1) sqrt(1 - s^2) is largest where s^2 = (m - 1)/m.
  const double m = p.m.exponent;
  return p.sigma * m * p.k / (2.0 * p.a) * std::pow((m - 1.0) / m, 0.5 * (m - 1.0)) / std::sqrt(m);
}

}  // namespace

Profile Profile::lp(double a, double b, double n) {
  Profile p;
  p.a = a;
  p.b = b;
  p.n = Power(n);
  p.inverse_n = Power(1.0 / n);
  return p;
}

Profile Profile::rose(int k, double a, double eps) {
  Profile p;
  p.kind = Kind::rose;
  p.k = k;
  p.a = a;
  p.eps = eps;
  return p;
}

Profile Profile::star(int k, double a, double sigma, double m) {
  Profile p;
  p.kind = Kind::star;
  p.k = k;
  p.a = a;
  p.sigma = sigma;
  p.m = Power(m);
  return p;
}

Range Profile::radius() const {
  switch (kind) {
    case Kind::rose:
      return {a * (1.0 - eps) / (1.0 + eps), a};
    case Kind::star:
      return {a / (1.0 + sigma), a};
    case Kind::lp:
      break;
  }
  const Range axes{std::min(a, b), std::max(a, b)};
  const double e = n.exponent;
  if (e == 2.0) return axes;
  // The radius between the axes, where the gradient is radial: (a^p + b^p)^(1/p), p = 2n/(n - 2).
  const double p = 2.0 * e / (e - 2.0), lead = p > 0.0 ? axes.hi : axes.lo;
  const double between =
      lead * std::pow(1.0 + std::pow(p > 0.0 ? axes.lo / lead : axes.hi / lead, p), 1.0 / p);
  return p > 0.0 ? Range{axes.lo, between} : Range{between, axes.hi};
}

std::pair<double, double> Profile::extent() const { return {a, kind == Kind::lp ? b : a}; }

double Profile::lipschitz() const {
  const double q = 1.0 / radius().lo;
  if (kind == Kind::lp) return n.exponent < 1.0 ? std::numeric_limits<double>::infinity() : q;  // g is a norm
  return std::hypot(q, steepest(*this));
}

bool Profile::same_after_turn(double angle) const {
  const double period = kind != Kind::lp ? 2.0 * std::numbers::pi / k
                        : a == b         ? 0.5 * std::numbers::pi
                                         : std::numbers::pi;
  if (kind == Kind::lp && a == b && n.exponent == 2.0) return true;
  return std::abs(std::remainder(angle, period)) <= 1e-12 * (1.0 + std::abs(angle));
}

double Profile::gauge(double u, double v) const { return HWY_NAMESPACE::gauge(*this, u, v); }

Profile::Slopes Profile::slopes(double u, double v) const {
  HWY_NAMESPACE::Dual<double> x = u, y = v;
  x.d[0] = 1.0;
  y.d[1] = 1.0;
  const HWY_NAMESPACE::Dual<double> g = HWY_NAMESPACE::gauge(*this, x, y);
  return {g.v, g.d[0], g.d[1]};
}

}  // namespace blendwright::detail
