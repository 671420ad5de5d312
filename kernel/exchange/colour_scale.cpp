#include "kernel/exchange/colour_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

constexpr int bar_decades = 5, bar_ticks = 9;  // errors cross zero, which would take any number of decades
constexpr double many_decades = 100.0;         // ratio from which by_decades is logarithmic
constexpr std::size_t steps = 256;             // colours of a map

constexpr Colour rgb(std::uint32_t hex) {
  return {((hex >> 16) & 255u) / 255.0, ((hex >> 8) & 255u) / 255.0, (hex & 255u) / 255.0};
}

/// Equidistant values of viridis (CC0).
constexpr std::array<std::uint32_t, 16> viridis_nodes{
    0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e,
    0x1f988b, 0x22a884, 0x35b779, 0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725};

/// Moreland's polar form of CIELAB: L = M cos s, a = M sin s cos h, b = M sin s sin h.
struct Msh {
  double M, s, h;
};
constexpr Msh cool{80.0, 1.08, -1.1}, warm{80.0, 1.08, 0.5};
constexpr double middle_M = 88.0;

/// The hue with which a saturated end reaches the unsaturated middle by equal steps of CIELAB.
double spun_hue(const Msh& end) {
  const double spin = end.s * std::sqrt(middle_M * middle_M - end.M * end.M) / (end.M * std::sin(end.s));
  return end.h > -std::numbers::pi / 3.0 ? end.h + spin : end.h - spin;
}

double gamma_of(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

/// CIELAB under D65 to sRGB (IEC 61966-2-1).
Colour colour_of(const Msh& c) {
  const double L = c.M * std::cos(c.s), a = c.M * std::sin(c.s) * std::cos(c.h),
               b = c.M * std::sin(c.s) * std::sin(c.h);
  const auto inverse = [](double f) {
    return f > 6.0 / 29.0 ? f * f * f : 3.0 * (6.0 / 29.0) * (6.0 / 29.0) * (f - 4.0 / 29.0);
  };
  const double fy = (L + 16.0) / 116.0;
  const double X = 0.95047 * inverse(fy + a / 500.0), Y = inverse(fy), Z = 1.08883 * inverse(fy - b / 200.0);
  return {gamma_of(3.2404542 * X - 1.5371385 * Y - 0.4985314 * Z),
          gamma_of(-0.9692660 * X + 1.8760108 * Y + 0.0415560 * Z),
          gamma_of(0.0556434 * X - 0.2040259 * Y + 1.0572252 * Z)};
}

using Table = std::array<Colour, steps>;
const Table& table_of(ColourMap map) {
  const auto filled = [](ColourMap m) {
    Table table;
    for (std::size_t i = 0; i < steps; ++i) {
      const double t = static_cast<double>(i) / (steps - 1);
      table[i] = m == ColourMap::sequential ? viridis(t) : cool_warm(t);
    }
    return table;
  };
  static const Table sequential = filled(ColourMap::sequential), diverging = filled(ColourMap::diverging);
  return map == ColourMap::sequential ? sequential : diverging;
}

std::uint8_t byte_of(double x) { return static_cast<std::uint8_t>(std::lround(255.0 * x)); }

Axis symmetric_axis(const ValueRange& range) {
  const double most = std::max(std::abs(range.least), std::abs(range.most));
  return linear_axis({-most, most, most}, bar_ticks - 2);
}

}  // namespace

Colour viridis(double t) {
  const double x = std::clamp(t, 0.0, 1.0) * (viridis_nodes.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), viridis_nodes.size() - 2);
  const double w = x - static_cast<double>(i);
  const Colour a = rgb(viridis_nodes[i]), b = rgb(viridis_nodes[i + 1]);
  return {a.r + w * (b.r - a.r), a.g + w * (b.g - a.g), a.b + w * (b.b - a.b)};
}

Colour cool_warm(double t) {
  const double x = 2.0 * std::clamp(t, 0.0, 1.0) - 1.0, w = std::abs(x);
  const Msh& end = x < 0.0 ? cool : warm;
  const double h = spun_hue(end);
  return colour_of({middle_M + w * (end.M - middle_M), w * end.s, h + w * (end.h - h)});
}

Colour colour_at(ColourMap map, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * (steps - 1);
  return table_of(map)[static_cast<std::size_t>(std::lround(x))];
}

ColourScale::ColourScale(ColourMap map, Axis axis) : map_(map), axis_(std::move(axis)) {}

ColourScale ColourScale::over(const std::vector<double>& values, ScaleRule rule) {
  const ValueRange range = range_of(values);
  if (rule == ScaleRule::diverging) return {ColourMap::diverging, symmetric_axis(range)};
  const bool decades =
      range.least >= 0.0 && range.least_positive > 0.0 && range.most > many_decades * range.least_positive;
  if (rule == ScaleRule::linear || (rule == ScaleRule::by_decades && !decades))
    return {ColourMap::sequential, linear_axis(range, bar_ticks - 2)};
  Axis axis = log_axis(range, bar_decades, bar_ticks);
  if (range.least <= 0.0 || std::log10(range.least) < axis.lo) axis.ticks.back().label.insert(0, "< ");
  return {ColourMap::sequential, std::move(axis)};
}

Colour ColourScale::colour(double value) const {
  return std::isnan(value) ? no_value_colour : colour_at(map_, axis_.position(value));
}

std::array<std::uint8_t, 3> ColourScale::bytes(double value) const {
  const Colour c = colour(value);
  return {byte_of(c.r), byte_of(c.g), byte_of(c.b)};
}

void ColourScale::colour(std::span<const float> values, std::span<std::uint8_t> rgb) const {
  if (rgb.size() != 3 * values.size())
    throw InputError("rgb", "has " + std::to_string(rgb.size()) + " elements, must have three for each of " +
                                std::to_string(values.size()) + " values");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto c = bytes(static_cast<double>(values[i]));
    std::copy(c.begin(), c.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
}

}  // namespace blendwright
