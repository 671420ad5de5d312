#pragma once
// An exponent, with the cheapest way to apply it decided once.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace blendwright::detail {

/// x^exponent for x >= 0, exponent > 0.
struct Power {
  enum class Kind { integer, square_root, real };
  double exponent = 1.0;
  Kind kind = Kind::integer;
  int integer = 1;
  /// Of real exponents: where the power counts as 0 (it is below 2^-1020, or x is no normal number) and as
  /// infinite (above 2^1023).
  double floor = std::numeric_limits<double>::min(), ceiling = std::numeric_limits<double>::max();
  Power() = default;
  explicit Power(double n) : exponent(n), kind(Kind::real) {
    if (n == std::floor(n) && n >= 1.0 && n <= 64.0) {
      kind = Kind::integer;
      integer = static_cast<int>(n);
    } else if (n == 0.5) {
      kind = Kind::square_root;
    } else {
      floor = std::max(floor, std::exp2(-1020.0 / n));
      ceiling = std::min(ceiling, std::exp2(1023.0 / n));
    }
  }
};

}  // namespace blendwright::detail
