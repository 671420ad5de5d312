#include "implicit/primitives/primitive_inputs.hpp"

#include "kernel/base/number_text.hpp"

namespace blendwright::detail {

double checked_length(NodeInputs& in, std::string_view key, double value, int index) {
  if (value >= smallest_length && value <= largest_length) return value;
  const std::string required = !(value > 0.0)            ? "must be > 0"
                               : value < smallest_length ? "must be >= " + number_text(smallest_length)
                                                         : "must be <= " + number_text(largest_length);
  in.problem(key, scene_error::invalid_parameter, "is " + number_text(value) + ", " + required, index);
  return 1.0;
}

Direction checked_direction(NodeInputs& in, std::string_view key, const Vec3& value, int index) {
  const double largest = value.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) {
    in.problem(key, scene_error::invalid_parameter, "is the zero vector, must have a direction", index);
    return {};
  }
  const Vec3 rough = value / largest;  // its squares neither overflow nor underflow
  Direction d{value, largest * rough.norm()};
  if (!d.was_unit()) d.unit = rough.normalized();
  return d;
}

Vec3 read_direction(NodeInputs& in, std::string_view key) {
  const Direction d = checked_direction(in, key, in.point(key));
  if (!d.was_unit()) in.warning(key, "has length " + number_text(d.length, 6) + " and was normalised to 1");
  return d.unit;
}

Vec3 read_point(NodeInputs& in, std::string_view key) {
  Vec3 p = in.point(key);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(p[i]) <= largest_length) continue;
    in.problem(
        key, scene_error::invalid_parameter,
        "is " + number_text(p[i]) + ", must be at most " + number_text(largest_length) + " in magnitude", i);
    p[i] = 0.0;
  }
  return p;
}

std::optional<Box> scaled_box(const Box& unit, double value) {
  const double v = std::max(0.0, value);
  const Box box{v * (1.0 + range_slack) * unit.lo, v * (1.0 + range_slack) * unit.hi};
  if (!box.finite()) return std::nullopt;
  return box;
}

}  // namespace blendwright::detail
