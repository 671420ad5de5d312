#pragma once
// The level conventions: which values of a field belong to its solid. One function, inside(), sees all of
// them alike, so that whatever works on solids is written once.
#include <string_view>

namespace blendwright {

/// zero: g <= 0, complement -g. one (constructive geometry, distances): x <= 1, x >= 0, complement 1/x.
/// half (soft objects): f >= 1/2, 0 <= f <= 1, complement 1 - f. function (F-rep): f >= 0, complement -f.
enum class Level { zero, one, half, function };

[[nodiscard]] std::string_view name(Level level);

/// The value on the surface.
[[nodiscard]] constexpr double surface_value(Level level) {
  return level == Level::one ? 1.0 : level == Level::half ? 0.5 : 0.0;
}
/// +1 when larger values are inside, else -1.
[[nodiscard]] constexpr double sense(Level level) {
  return level == Level::half || level == Level::function ? 1.0 : -1.0;
}
/// phi = sense * (value - surface value): the solid is phi >= 0; its gradient points inward.
[[nodiscard]] constexpr double inside(Level level, double value) {
  return sense(level) * (value - surface_value(level));
}

}  // namespace blendwright
