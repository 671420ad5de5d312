#include "kernel/math/taylor_model.hpp"

#include <limits>

namespace blendwright {
namespace {

constexpr std::size_t places = TaylorModel::order + 1;
// Unit of rounding to nearest, with room for the rounding of the bounds themselves: each is a sum of fewer
// than 64 terms that are not negative, so that its own relative error stays below 64 * 2^-53 < 1e-14.
constexpr double unit = 0x1p-53 * (1.0 + 1e-12);
constexpr double own_rounding = 1.0 + 1e-13;
constexpr double tiny = 0x1p-1000;  // above everything that underflow can lose

double bound(double x) { return std::isnan(x) ? std::numeric_limits<double>::infinity() : x * own_rounding; }

}  // namespace

TaylorModel::TaylorModel(const Bounds& x) : radius_(x.radius()) {
  c_[0] = x.middle();
  if (!x.finite()) {
    c_[0] = 0.0;
    radius_ = std::numeric_limits<double>::infinity();
  }
}

TaylorModel TaylorModel::parameter(double lo, double hi) {
  TaylorModel m;
  m.c_[0] = 0.5 * lo + 0.5 * hi;
  m.c_[1] = std::max(rounded_up(hi - m.c_[0]), rounded_up(m.c_[0] - lo));
  m.degree_ = 1;
  return m;
}

double TaylorModel::norm(std::size_t from) const {
  double sum = 0.0;
  for (std::size_t k = from; k <= static_cast<std::size_t>(degree_); ++k) sum += std::abs(c_[k]);
  return sum * own_rounding;
}

void TaylorModel::trim() {
  while (degree_ > 0 && c_[static_cast<std::size_t>(degree_)] == 0.0) --degree_;
}

bool TaylorModel::finite() const { return std::isfinite(norm()) && std::isfinite(radius_); }

Bounds TaylorModel::range() const {
  if (!finite()) return unbounded();
  double up = 0.0, down = 0.0;  // of the powers: even ones lie in [0, 1], odd ones in [-1, 1]
  for (std::size_t k = 1; k <= static_cast<std::size_t>(degree_); ++k) {
    const double c = c_[k];
    up += k % 2 == 0 ? std::max(c, 0.0) : std::abs(c);
    down += k % 2 == 0 ? std::max(-c, 0.0) : std::abs(c);
  }
  return outward(c_[0] - bound(down + radius_), c_[0] + bound(up + radius_));
}

Bounds TaylorModel::at(double x) const {
  if (!finite()) return unbounded();
  Bounds sum(c_[static_cast<std::size_t>(degree_)]);
  for (std::size_t k = static_cast<std::size_t>(degree_); k-- > 0;) sum = sum * Bounds(x) + Bounds(c_[k]);
  return sum + Bounds(-radius_, radius_);
}

TaylorModel TaylorModel::with_radius(double r) const {
  TaylorModel m = *this;
  m.radius_ = r;
  return m;
}

TaylorModel TaylorModel::mean_from(const Bounds& x0) const {
  if (!finite()) return unknown();
  TaylorModel m;
  m.degree_ = degree_;
  double rounding = 0.0;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(degree_); ++j) {
    Bounds sum;
    for (std::size_t k = static_cast<std::size_t>(degree_) + 1; k-- > j;)
      sum = sum * x0 + Bounds(c_[k]) / Bounds(static_cast<double>(k + 1));
    m.c_[j] = sum.middle();
    rounding += sum.radius();
  }
  m.radius_ = bound(radius_ + rounding);
  m.trim();
  return m;
}

TaylorModel TaylorModel::hull(const TaylorModel& a, const TaylorModel& b) {
  if (!a.finite() || !b.finite()) return unknown();
  const double apart = (b.with_radius(0.0) - a.with_radius(0.0)).range().magnitude();
  return a.with_radius(bound(std::max(a.radius_, b.radius_ + apart)));
}

TaylorModel operator+(const TaylorModel& a, const TaylorModel& b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  TaylorModel r;
  r.degree_ = std::max(a.degree_, b.degree_);
  double sum = 0.0;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(r.degree_); ++k) {
    r.c_[k] = a.c_[k] + b.c_[k];
    if (a.c_[k] != 0.0 && b.c_[k] != 0.0) sum += std::abs(r.c_[k]);
  }
  r.radius_ = bound(a.radius_ + b.radius_ + unit * sum);
  r.trim();
  return r;
}

TaylorModel operator-(const TaylorModel& a) {
  TaylorModel r = a;
  for (double& x : r.c_) x = -x;
  return r;
}

TaylorModel operator-(const TaylorModel& a, const TaylorModel& b) { return a + (-b); }

TaylorModel operator*(double s, const TaylorModel& a) {
  if (s == 1.0 || a.is_zero()) return a;
  if (s == 0.0) return a.finite() ? TaylorModel() : TaylorModel::unknown();
  TaylorModel r = a;
  double sum = 0.0;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(r.degree_); ++k) {
    r.c_[k] *= s;
    sum += std::abs(r.c_[k]);
  }
  const bool power_of_two = s == -1.0 || std::abs(s) == 2.0;
  r.radius_ = bound(std::abs(s) * a.radius_ + (power_of_two ? 0.0 : unit * sum + tiny));
  r.trim();
  return r;
}

TaylorModel operator*(const TaylorModel& a, const TaylorModel& b) {
  if (a.exact()) return a.c_[0] * b;
  if (b.exact()) return b.c_[0] * a;
  TaylorModel r;
  double beyond = 0.0;
  const auto da = static_cast<std::size_t>(a.degree_), db = static_cast<std::size_t>(b.degree_);
  for (std::size_t i = 0; i <= da; ++i) {
    const double x = a.c_[i];
    if (x == 0.0) continue;
    const std::size_t inside = std::min(db, places - 1 - i);
    for (std::size_t j = 0; j <= inside; ++j) r.c_[i + j] += x * b.c_[j];
    double tail = 0.0;
    for (std::size_t j = inside + 1; j <= db; ++j) tail += std::abs(b.c_[j]);
    beyond += std::abs(x) * tail;
  }
  r.degree_ = std::min(a.degree_ + b.degree_, TaylorModel::order);
  // Every coefficient is a sum of at most min(da, db) + 1 products.
  const double terms = static_cast<double>(std::min(da, db)) + 2.0;
  const double A = a.norm(), B = b.norm();
  const double rounding = terms * unit * A * B + tiny;
  r.radius_ = bound(beyond + rounding + a.radius_ * (B + b.radius_) + b.radius_ * A);
  r.trim();
  return r;
}

TaylorModel composed(const std::array<Bounds, places>& f, double remainder, const TaylorModel& a) {
  if (!a.finite()) return TaylorModel::unknown();
  TaylorModel d = a;
  d.c_[0] = 0.0;
  TaylorModel r;
  if (!d.is_zero()) {
    r = TaylorModel(f[places - 1]);
    for (std::size_t k = places - 1; k-- > 0;) r = r * d + TaylorModel(f[k]);
    double power = remainder;
    const double D = d.norm() + d.radius_;
    for (std::size_t k = 0; k < places; ++k) power *= D * own_rounding;
    r.radius_ = bound(r.radius_ + power);
  } else {
    r = TaylorModel(f[0]);
  }
  return r.finite() ? r : TaylorModel::unknown();
}

namespace {

using Coefficients = std::array<Bounds, places>;

double factorial(std::size_t n) {
  double f = 1.0;
  for (std::size_t k = 2; k <= n; ++k) f *= static_cast<double>(k);
  return f;  // exact up to 18!
}

/// f, f', s f, s f', ... / k!
TaylorModel periodic(const Bounds& f0, const Bounds& f1, double s, double largest, const TaylorModel& a) {
  Coefficients f;
  for (std::size_t k = 0; k < places; ++k) {
    const Bounds value = k % 2 == 0 ? f0 : f1;
    f[k] = ((k / 2) % 2 == 1 && s < 0.0 ? -value : value) / Bounds(factorial(k));
  }
  return composed(f, rounded_up(largest / factorial(places)), a);
}

}  // namespace

TaylorModel sin(const TaylorModel& a) {
  return periodic(of_library(std::sin(a.centre())), of_library(std::cos(a.centre())), -1.0, 1.0, a);
}
TaylorModel cos(const TaylorModel& a) {
  return periodic(of_library(std::cos(a.centre())), -of_library(std::sin(a.centre())), -1.0, 1.0, a);
}
TaylorModel sinh(const TaylorModel& a) {
  const double largest = of_library(std::cosh(a.range().magnitude())).hi;
  return periodic(of_library(std::sinh(a.centre())), of_library(std::cosh(a.centre())), 1.0, largest, a);
}
TaylorModel cosh(const TaylorModel& a) {
  const double largest = of_library(std::cosh(a.range().magnitude())).hi;
  return periodic(of_library(std::cosh(a.centre())), of_library(std::sinh(a.centre())), 1.0, largest, a);
}
TaylorModel exp(const TaylorModel& a) {
  const Bounds e = of_library(std::exp(a.centre()));
  return periodic(e, e, 1.0, of_library(std::exp(a.range().hi)).hi, a);
}

TaylorModel log(const TaylorModel& a) {
  const Bounds range = a.range();
  if (!(range.lo > 0.0)) return TaylorModel::unknown();
  const Bounds x(a.centre());
  Coefficients f;
  f[0] = log(x);
  Bounds p(1.0);
  for (std::size_t k = 1; k < places; ++k) {
    p = p / x;
    f[k] = (k % 2 == 1 ? p : -p) / Bounds(static_cast<double>(k));
  }
  Bounds last(1.0);
  for (std::size_t k = 0; k < places; ++k) last = last / Bounds(range.lo);
  return composed(f, last.hi, a);
}

TaylorModel inverse(const TaylorModel& a) {
  const Bounds range = a.range();
  if (!(range.mignitude() > 0.0)) return TaylorModel::unknown();
  const Bounds x(a.centre());
  Coefficients f;
  f[0] = Bounds(1.0) / x;
  for (std::size_t k = 1; k < places; ++k) f[k] = -(f[k - 1] / x);
  Bounds last(1.0);
  for (std::size_t k = 0; k <= places; ++k) last = last / Bounds(range.mignitude());
  return composed(f, last.hi, a);
}

TaylorModel operator/(const TaylorModel& a, const TaylorModel& b) { return a * inverse(b); }

TaylorModel pow(const TaylorModel& a, double p) {
  const Bounds range = a.range();
  if (!(range.lo > 0.0)) return TaylorModel::unknown();
  Coefficients f;
  Bounds binomial(1.0);
  for (std::size_t k = 0; k < places; ++k) {
    const double e = p - static_cast<double>(k);
    f[k] = binomial * power(Bounds(a.centre()), e);
    binomial = binomial * (Bounds(p) - Bounds(static_cast<double>(k))) / Bounds(static_cast<double>(k + 1));
  }
  return composed(f, (binomial * power(range, p - static_cast<double>(places))).magnitude(), a);
}

TaylorModel atan2(const TaylorModel& y, const TaylorModel& x) {
  if (!y.finite() || !x.finite()) return TaylorModel::unknown();
  if (!(x.range().lo > 0.0) && !(y.range().mignitude() > 0.0)) return TaylorModel::unknown();
  // The angle is a0 + atan(t), with t the tangent of the angle turned back by a0, and
  // |atan t - (t - t^3/3 + ... +- t^m/m)| <= |t|^(m+2)/(m+2) for every t.
  const double a0 = std::atan2(y.centre(), x.centre());
  const TaylorModel s(of_library(std::sin(a0))), c(of_library(std::cos(a0)));
  const TaylorModel along = x * c + y * s;
  if (!(along.range().lo > 0.0)) return TaylorModel::unknown();
  const TaylorModel t = (y * c - x * s) / along;
  const TaylorModel square = t * t;
  constexpr int last = TaylorModel::order + 1;  // odd
  TaylorModel sum;
  for (int k = last; k >= 1; k -= 2) {
    const Bounds f = Bounds(k % 4 == 1 ? 1.0 : -1.0) / Bounds(static_cast<double>(k));
    sum = sum * square + TaylorModel(f);
  }
  const double T = t.range().magnitude();
  double beyond = 1.0;
  for (int k = 0; k < last + 2; ++k) beyond = rounded_up(beyond * T);
  return t * sum + TaylorModel(Bounds(a0)) + TaylorModel(Bounds(-beyond, beyond));
}

}  // namespace blendwright
