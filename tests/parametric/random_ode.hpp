#pragma once
// Random sweep equations of every regime, for property tests.
#include <array>
#include <optional>

#include "parametric/ode/cardinal_basis.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

inline constexpr std::array<Regime, 9> all_regimes{Regime::A,     Regime::B,      Regime::C,
                                                   Regime::Dplus, Regime::Dminus, Regime::E0,
                                                   Regime::F,     Regime::Eplus,  Regime::Eminus};

/// An equation of the regime with |roots| log-uniform in [lo, hi]; b takes both signs.
inline SweepOde random_ode(Rng& rng, Regime r, double lo, double hi) {
  const double b = (integer(rng, 0, 1) == 0 ? -1.0 : 1.0) * log_uniform(rng, 0.1, 10.0);
  const double x = log_uniform(rng, lo, hi), y = log_uniform(rng, lo, hi), X = x * x, Y = y * y;
  const auto roots = [&](double L1, double L2) { return SweepOde{b, -b * (L1 + L2), b * L1 * L2}; };
  switch (r) {
    case Regime::A:
      return roots(X, Y * 1.01);
    case Regime::B:
      return roots(X, -Y);
    case Regime::C:
      return roots(-X, -Y * 1.01);
    case Regime::Dplus:
      return roots(X, 0.0);
    case Regime::Dminus:
      return roots(-X, 0.0);
    case Regime::E0:
      return {b, 0.0, 0.0};
    case Regime::F:
      return {b, b * 2.0 * X * uniform(rng, -0.99, 0.99), b * X * X};
    case Regime::Eplus:
    case Regime::Eminus:
      break;
  }
  // c^2 = 4 b d holds exactly: c is a whole number of 2^-20, b a power of two.
  const double power = integer(rng, 0, 1) == 0 ? -2.0 : 0.5, c = std::max(1.0, std::round(X * 64.0)) / 64.0;
  return {power, (r == Regime::Eplus) == (power > 0.0) ? -c : c, c * c / (4.0 * power)};
}

/// Nothing at a resonance.
inline std::optional<CardinalBasis> basis_unless_resonant(const SweepOde& ode) {
  try {
    return CardinalBasis::fourth_order(ode);
  } catch (const ResonanceError&) {
    return std::nullopt;
  }
}

inline SixthOrderFamily random_family(Rng& rng) { return static_cast<SixthOrderFamily>(integer(rng, 0, 3)); }

}  // namespace blendwright::test
