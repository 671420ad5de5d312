#pragma once
// Private: scales of plots and colour bars.
#include <string>
#include <vector>

namespace blendwright {

struct Tick {
  double value;       ///< on the scale of Axis: log10 when logarithmic
  std::string label;  ///< "" between labelled ticks; "10^-8" and "2x10^-8" carry an exponent after '^'
};

/// What lo ... hi stands for: the quantity, or its log10.
struct Axis {
  double lo = 0.0, hi = 1.0;
  bool logarithmic = false;
  std::vector<Tick> ticks;
  /// Position of `value` on the axis, within [0, 1]; values beyond the ends (zero on a log axis) stay at the
  /// ends.
  [[nodiscard]] double position(double value) const;
};

/// Three digits: "0.25", "120", "10^-6", "2.5x10^-8".
[[nodiscard]] std::string quantity_text(double value);

struct ValueRange {
  double least = 0.0, most = 0.0;  ///< of the finite values; 0, 0 when there are none
  double least_positive = 0.0;     ///< 0 when there is none
};
[[nodiscard]] ValueRange range_of(const std::vector<double>& values);

/// `fitted`: ends at the range, not at the next tick.
[[nodiscard]] Axis linear_axis(const ValueRange& range, int ticks, bool fitted = false);
/// Whole decades, at most `decades` of them, none below 1e-16 (rounding of numbers of order 1).
[[nodiscard]] Axis log_axis(const ValueRange& range, int decades, int ticks);

}  // namespace blendwright
