#pragma once
// From values to colours, without VTK: perceptually uniform maps and the scale of their bar.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/brep/shape.hpp"
#include "kernel/exchange/axis.hpp"

namespace blendwright {

/// Viridis (S. van der Walt and N. Smith, 2015), readable in grey and by colour-blind people; t in [0, 1].
[[nodiscard]] Colour viridis(double t);
/// Blue, light grey in the middle, red: K. Moreland, Diverging Color Maps for Scientific Visualization, 2009,
/// with his end points; t in [0, 1], 0.5 is the middle.
[[nodiscard]] Colour cool_warm(double t);

enum class ColourMap {
  sequential,  ///< viridis
  diverging    ///< cool_warm, 0 in the middle
};

/// How a scale is chosen from the values that it must hold.
enum class ScaleRule {
  linear,
  logarithmic,  ///< at most five decades; what lies below, and zero, has the lowest colour
  by_decades,   ///< logarithmic when the values are >= 0 and span more than two decades
  diverging     ///< linear and symmetric about 0
};

/// Colours of values and the axis of the bar that explains them. Looking up a colour costs some nanoseconds.
class ColourScale {
 public:
  ColourScale(ColourMap map, Axis axis);
  /// Over the finite values; with none of them 0 ... 1.
  [[nodiscard]] static ColourScale over(const std::vector<double>& values, ScaleRule rule);

  [[nodiscard]] ColourMap map() const { return map_; }
  [[nodiscard]] const Axis& axis() const { return axis_; }
  /// Grey for NaN; the end's colour beyond the ends and for infinities.
  [[nodiscard]] Colour colour(double value) const;
  [[nodiscard]] std::array<std::uint8_t, 3> bytes(double value) const;
  /// rgb[3 i ...] of values[i]; `rgb` has three times as many elements, else InputError.
  void colour(std::span<const float> values, std::span<std::uint8_t> rgb) const;

 private:
  ColourMap map_;
  Axis axis_;
};

/// Colour of a map at t in [0, 1].
[[nodiscard]] Colour colour_at(ColourMap map, double t);
/// For NaN.
inline constexpr Colour no_value_colour{0.6, 0.6, 0.6};

}  // namespace blendwright
