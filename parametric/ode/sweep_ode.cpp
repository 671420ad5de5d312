#include "parametric/ode/sweep_ode.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/number_text.hpp"
#include "parametric/ode/characteristic.hpp"

namespace blendwright {
namespace {

/// x * y as an unevaluated sum: value + error is exact (barring underflow).
struct Product {
  double value, error;
  Product(double x, double y) : value(x * y), error(std::fma(x, y, -value)) {}
};

/// c^2 - 4bd with the exact sign: the leading parts cancel exactly when they are close.
double discriminant(const SweepOde& ode) {
  const Product cc(ode.c, ode.c), bd(4.0 * ode.b, ode.d);
  return (cc.value - bd.value) + (cc.error - bd.error);
}

/// The same equation with the largest coefficient in [1/2, 1): squares neither overflow nor vanish
/// needlessly.
SweepOde scaled(const SweepOde& ode) {
  int exponent = 0;
  (void)std::frexp(std::max({std::abs(ode.b), std::abs(ode.c), std::abs(ode.d)}), &exponent);
  return {std::ldexp(ode.b, -exponent), std::ldexp(ode.c, -exponent), std::ldexp(ode.d, -exponent)};
}

void check(const SweepOde& ode) {
  const auto finite = [](const char* where, double x) {
    if (!std::isfinite(x)) throw InputError(where, number_text(x) + " is not a finite number");
  };
  finite("b", ode.b);
  finite("c", ode.c);
  finite("d", ode.d);
  if (ode.b == 0.0)
    throw InputError(
        "b", "0 leaves an equation of order two, which cannot meet four end conditions; b must not be 0");
  if (!std::isfinite(ode.c / ode.b) || !std::isfinite(ode.d / ode.b))
    throw InputError("b", number_text(ode.b) + " is too small beside c and d: c/b and d/b must be finite");
}

Regime classify(const SweepOde& ode, double D) {
  const double c = std::copysign(1.0, ode.b) * ode.c,
               d = std::copysign(1.0, ode.b) * ode.d;  // signs of c/b, d/b
  if (d < 0.0) return Regime::B;
  if (d == 0.0) return c < 0.0 ? Regime::Dplus : (c > 0.0 ? Regime::Dminus : Regime::E0);
  if (D < 0.0) return Regime::F;
  if (D == 0.0) return c < 0.0 ? Regime::Eplus : Regime::Eminus;
  return c < 0.0 ? Regime::A : Regime::C;
}

std::string resonance_text(const std::string& family, double kappa, Regime r, double nearest_mode) {
  return "the sweep equation is in resonance: regime " + std::string(name(r)) + ", " + family +
         " family, nearest mode at the oscillatory root " + number_text(nearest_mode, 12) +
         ", condition number " + scientific_text(kappa) +
         " (must be at most 1e8); move c or d away from it, or take c/b <= 0 and d/b >= 0";
}

}  // namespace

const char* name(Regime r) {
  switch (r) {
    case Regime::A:
      return "A";
    case Regime::B:
      return "B";
    case Regime::C:
      return "C";
    case Regime::Dplus:
      return "D+";
    case Regime::Dminus:
      return "D-";
    case Regime::E0:
      return "E0";
    case Regime::Eplus:
      return "E+";
    case Regime::Eminus:
      return "E-";
    case Regime::F:
      return "F";
  }
  return "?";
}

Regime regime(const SweepOde& ode) { return detail::characteristic(ode).regime; }

ResonanceError::ResonanceError(std::string family_, double kappa_, Regime r, double nearest_mode_)
    : GeometryError(resonance_text(family_, kappa_, r, nearest_mode_)),
      family(std::move(family_)),
      kappa(kappa_),
      root_regime(r),
      nearest_mode(nearest_mode_) {}

namespace detail {

Characteristic characteristic(const SweepOde& ode) {
  check(ode);
  const SweepOde unit = scaled(ode);
  const double D = discriminant(unit);
  return {.p = -ode.c / ode.b, .s = ode.d / ode.b, .Delta = D / unit.b / unit.b, .regime = classify(ode, D)};
}

double Characteristic::size() const { return std::max(std::abs(p), std::sqrt(std::abs(s))); }

double Characteristic::stiffness() const {
  if (s > 0.0 && Delta < 0.0) return std::sqrt(std::sqrt(s));  // complex pair: |L| = sqrt s
  return std::sqrt(std::abs(real_squares(*this).L1));
}

RealSquares real_squares(const Characteristic& ch) {
  const double root = std::sqrt(std::max(ch.Delta, 0.0));
  const double L1 = 0.5 * (ch.p + std::copysign(root, ch.p));
  return {L1, L1 == 0.0 ? 0.0 : ch.s / L1};
}

HalfSquares half_squares(const Characteristic& ch) {
  // (p + 2 sqrt s)(p - 2 sqrt s) = Delta: the factor that would cancel comes from the other one.
  const double twice = 2.0 * std::sqrt(ch.s);
  if (ch.p >= 0.0) return {0.25 * (ch.p + twice), 0.25 * ch.Delta / (ch.p + twice)};
  return {0.25 * ch.Delta / (ch.p - twice), 0.25 * (ch.p - twice)};
}

namespace {

/// cosh(sqrt(L)/2) and sinh(sqrt(L)/2)/sqrt(L), for L > 0 both divided by the former.
struct EndValues {
  double c, s;
  explicit EndValues(double L) {
    const double r = std::sqrt(std::abs(L));
    c = L > 0.0 ? 1.0 : std::cos(0.5 * r);
    s = r == 0.0 ? 0.5 : (L > 0.0 ? std::tanh(0.5 * r) : std::sin(0.5 * r)) / r;
  }
};

/// The root of the resonance condition (3) next to `om`, the other root squared being L1. 0 if none within
/// reach.
double nearest_mode(double L1, double om, ModeFamily family) {
  const EndValues one(L1);
  const auto condition = [&](double x) {
    const EndValues two(-x * x);
    return family == ModeFamily::even ? -one.c * x * x * two.s - two.c * L1 * one.s
                                      : one.s * two.c - two.s * one.c;
  };
  constexpr double reach = 4.0;  // neighbouring modes are about 2 pi apart
  double step = 1e-12 * om, lo = om, hi = om;
  while (condition(lo) * condition(hi) > 0.0) {
    if (step > reach) return 0.0;
    lo = std::max(om - step, 0.0);
    hi = om + step;
    step *= 2.0;
  }
  for (int i = 0; i < 100 && hi - lo > 0.0; ++i) {
    const double middle = 0.5 * (lo + hi);
    if (middle <= lo || middle >= hi) break;
    (condition(lo) * condition(middle) <= 0.0 ? hi : lo) = middle;
  }
  return hi;
}

}  // namespace

void refuse_resonance(const Characteristic& ch, ModeFamily family, double kappa) {
  if (kappa <= 1e8) return;
  auto [fixed, moving] = real_squares(ch);
  if (fixed < moving) std::swap(fixed, moving);  // the more negative square carries the oscillatory root
  const double om = std::sqrt(std::max(-moving, 0.0));
  throw ResonanceError(family == ModeFamily::even ? "even" : "odd", kappa, ch.regime,
                       nearest_mode(fixed, om, family));
}

}  // namespace detail
}  // namespace blendwright
