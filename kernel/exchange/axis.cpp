#include "kernel/exchange/axis.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr double log_floor = 1e-16;

/// The step 1, 2 or 5 times a power of ten that makes at most `ticks` intervals of `length`.
double nice_step(double length, int ticks) {
  const double rough = length / ticks, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

/// Sizes that are read better without an exponent.
bool plain(double size) { return size >= 1e-3 && size < 1e5; }

std::string with_exponent(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  const std::string mantissa = number_text(value / std::pow(10.0, exponent), 3);
  return (mantissa == "1" ? "" : mantissa + "x") + "10^" + std::to_string(exponent);
}

/// All ticks of an axis with as many decimals as its step.
std::string tick_text(double value, double step) {
  if (std::abs(value) < 1e-9 * step) return "0";
  if (!plain(std::max(std::abs(value), step))) return with_exponent(value);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::array<char, 40> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr;
  return {text.data(), end};
}

}  // namespace

std::string quantity_text(double value) {
  return value == 0.0 || plain(std::abs(value)) ? number_text(value, 3) : with_exponent(value);
}

double Axis::position(double value) const {
  const double x = logarithmic ? (value > 0.0 ? std::log10(value) : lo) : value;
  return std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
}

ValueRange range_of(const std::vector<double>& values) {
  ValueRange range;
  bool first = true;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    range.least = first ? v : std::min(range.least, v);
    range.most = first ? v : std::max(range.most, v);
    if (v > 0.0 && (range.least_positive == 0.0 || v < range.least_positive)) range.least_positive = v;
    first = false;
  }
  return range;
}

Axis linear_axis(const ValueRange& range, int ticks, bool fitted) {
  double lo = range.least, hi = range.most;
  const double size = std::max(std::abs(lo), std::abs(hi));
  if (hi - lo <= 1e-9 * size || size == 0.0) {  // a constant: a scale around it
    const double half = size > 0.0 ? 0.5 * size : 0.5;
    lo -= half;
    hi += half;
  }
  const double step = nice_step(hi - lo, ticks);
  Axis axis{fitted ? lo : step * std::floor(lo / step + 1e-9),
            fitted ? hi : step * std::ceil(hi / step - 1e-9),
            false,
            {}};
  const auto first = static_cast<long>(std::ceil(axis.lo / step - 1e-9));
  for (long i = first; step * static_cast<double>(i) <= axis.hi + 1e-9 * step; ++i)
    axis.ticks.push_back({step * static_cast<double>(i), tick_text(step * static_cast<double>(i), step)});
  return axis;
}

Axis log_axis(const ValueRange& range, int decades, int ticks) {
  const double most = std::max(range.most, 10.0 * log_floor);
  const double least = std::clamp(range.least_positive, log_floor, most);
  const double hi = std::ceil(std::log10(most) - 1e-9);
  const double lo = std::max(std::min(std::floor(std::log10(least) + 1e-9), hi - 1.0), hi - decades);
  Axis axis{lo, hi, true, {}};
  const int stride = std::max(1, static_cast<int>(std::ceil((hi - lo) / ticks)));
  for (int e = static_cast<int>(hi); e >= static_cast<int>(lo); --e) {
    const bool labelled = (static_cast<int>(hi) - e) % stride == 0;
    axis.ticks.push_back({static_cast<double>(e), labelled ? "10^" + std::to_string(e) : ""});
  }
  return axis;
}

}  // namespace blendwright
