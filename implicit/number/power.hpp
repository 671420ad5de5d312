#pragma once
// An exponent, with the cheapest way to apply it decided once.
#include <bit>
#include <cmath>

namespace blendwright::detail {

/// x^exponent for x >= 0, exponent > 0.
struct Power {
  enum class Kind { integer, square_root, real };
  double exponent = 1.0;
  Kind kind = Kind::integer;
  int integer = 1;
  Power() = default;
  explicit Power(double n) : exponent(n), kind(Kind::real) {
    if (n == std::floor(n) && n >= 1.0 && n <= 64.0) {
      kind = Kind::integer;
      integer = static_cast<int>(n);
    } else if (n == 0.5) {
      kind = Kind::square_root;
    }
  }
};

}  // namespace blendwright::detail
