#pragma once
// What the rows of primitives share: parameters that are alike, and how their values are read.
#include <cmath>

#include "implicit/number/power.hpp"
#include "implicit/scene/node.hpp"

namespace blendwright::detail {

/// Lengths lie in [1e-30, 1e30]: their inverses, squares and ratios are numbers, and so are the derivatives
/// made of these.
inline constexpr double smallest_length = 1e-30, largest_length = 1e30;
/// Exponents of p-norms: below 0.05 the factor k^(1/n) costs digits and derivatives overflow; above 1e6
/// (u/m)^n does not tell the largest terms apart.
inline constexpr double smallest_exponent = 0.05, largest_exponent = 1e6;

[[nodiscard]] constexpr NodeParam length_param(std::string_view name, std::string_view description) {
  return {.type = NodeParam::Type::number,
          .info = {.name = name, .description = description, .min = 0.0, .max = largest_length}};
}
[[nodiscard]] constexpr NodeParam exponent_param(std::string_view name, std::string_view description,
                                                 double least = smallest_exponent) {
  return {.type = NodeParam::Type::number,
          .info = {.name = name,
                   .description = description,
                   .min = least,
                   .max = largest_exponent,
                   .min_allowed = true}};
}

/// The length `value` of a key, checked; 1 after a problem. index: the element of a list, -1 for the whole.
[[nodiscard]] double checked_length(NodeInputs& in, std::string_view key, double value, int index = -1);
[[nodiscard]] inline double read_length(NodeInputs& in, std::string_view key) {
  return checked_length(in, key, in.number(key));
}
/// A direction of a key: as it is when its length is 1 within 1e-9, else normalised; a problem when it is
/// zero. index: the element of a list, -1 for the whole.
struct Direction {
  Vec3 unit = Vec3::UnitX();
  double length = 1.0;  ///< as it was given
  [[nodiscard]] bool was_unit() const { return std::abs(length - 1.0) <= 1e-9; }
};
[[nodiscard]] Direction checked_direction(NodeInputs& in, std::string_view key, const Vec3& value,
                                          int index = -1);
/// The direction of a key, with a warning when it had to be normalised.
[[nodiscard]] Vec3 read_direction(NodeInputs& in, std::string_view key);
/// A point of a key, with coordinates up to 1e30 in magnitude.
[[nodiscard]] Vec3 read_point(NodeInputs& in, std::string_view key);

/// A box around {d <= value} of a ray-linear d whose level set d = 1 has the box `unit`; empty sets get the
/// box of value 0. Widened by what rounding can add.
[[nodiscard]] std::optional<Box> scaled_box(const Box& unit, double value);

/// What emit of a primitive does: one step with this body.
template <class Body>
[[nodiscard]] std::function<StepIndex(TapeBuilder&, const Frame&)> emit_body(Body body) {
  return [shared = std::make_shared<const Body>(std::move(body))](TapeBuilder& tape, const Frame& frame) {
    return tape.add<Body>(shared, frame, {});
  };
}

}  // namespace blendwright::detail
