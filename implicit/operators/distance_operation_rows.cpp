#include <algorithm>
#include <array>

#include "implicit/operators/distance_operation.hpp"
#include "implicit/operators/range_rules.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/scene/direction_scan.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using detail::Dilation;
using detail::Erosion;
using detail::RayScaling;
using Operand = std::shared_ptr<const Node>;

std::string text(const Vec3& p) {
  std::string list;
  for (int i = 0; i < 3; ++i) list.append(i == 0 ? "(" : ", ").append(number_text(p[i], 4));
  return list.append(")");
}

/// Distances that are ray-linear about one point; reports what is not.
bool check_operands(NodeInputs& in, std::initializer_list<std::string_view> keys) {
  bool good = true;
  const auto problem = [&](std::string_view key, std::string_view error, std::string message) {
    in.problem(key, error, std::move(message));
    good = false;
  };
  const std::string_view first_key = *keys.begin();
  const Operand first = in.node(first_key);
  for (const std::string_view key : keys) {
    const Operand node = in.node(key);
    if (!node->distance)
      problem(
          key, scene_error::level_mismatch,
          (node->level == Level::one ? std::string("is signed") : "is of " + std::string(name(node->level))) +
              ", must be a distance (one level, never negative)");
    else if (!node->ray_linear)
      problem(key, scene_error::not_ray_linear, "is not ray-linear, must be");
    else if (first->ray_linear && !same_origin(*first, *node))
      problem(key, scene_error::origin_mismatch,
              "has its origin at " + text(node->origin) + ", must have it at " + text(first->origin) +
                  ", where \"" + std::string(first_key) + "\" has it");
  }
  return good;
}

/// What all results have in common.
Node ray_linear_distance(const Node& of, bool positive) {
  Node node;
  node.distance = true;
  node.ray_linear = true;
  node.origin = of.origin;
  node.positive = positive;
  return node;
}

/// ((a - o)^n + (b - o)^n)^(1/n) + o for every side of two boxes around o: a radius R = (R_a^n + R_b^n)^(1/n)
/// in a direction has coordinates that are that norm of both radii's.
Box radii_joined(const Box& a, const Box& b, const Vec3& o, double n) {
  const auto norm = [n](double x, double y) {
    const double m = std::max(x, y);
    return m > 0.0 ? m * std::pow(std::pow(x / m, n) + std::pow(y / m, n), 1.0 / n) : 0.0;
  };
  Box box;
  for (int i = 0; i < 3; ++i) {
    box.lo[i] = o[i] - (1.0 + 1e-12) * norm(std::max(0.0, o[i] - a.lo[i]), std::max(0.0, o[i] - b.lo[i]));
    box.hi[i] = o[i] + (1.0 + 1e-12) * norm(std::max(0.0, a.hi[i] - o[i]), std::max(0.0, b.hi[i] - o[i]));
  }
  return box;
}

Node dilated(const Operand& of, const Operand& by, double n) {
  Node node = ray_linear_distance(*of, of->positive && by->positive);
  node.emit = [of, by, body = std::make_shared<const Dilation>(n)](TapeBuilder& tape, const Frame& frame) {
    return tape.add(body, Frame(), {of->emit(tape, frame), by->emit(tape, frame)});
  };
  node.region = [of, by, n](double value) -> std::optional<Box> {
    const std::optional<Box> a = of->region(value), b = by->region(value);
    if (!a || !b || !a->finite() || !b->finite()) return std::nullopt;
    return radii_joined(*a, *b, of->origin, n);
  };
  return node;
}

Node eroded(const Operand& of, const Operand& by, double n) {
  Node node = ray_linear_distance(*of, of->positive);
  node.emit = [of, by, body = std::make_shared<const Erosion>(Erosion{n})](TapeBuilder& tape,
                                                                           const Frame& frame) {
    return tape.add(body, Frame(), {of->emit(tape, frame), by->emit(tape, frame)});
  };
  node.region = [of](double value) { return of->region(value); };  // E >= d
  return node;
}

/// T/d <= 1 in a direction: the erosion cuts right through.
void check_erosion(NodeInputs& in, std::string_view key, const Node& of, const Node& by) {
  const detail::RatioScan scan = detail::scan_ratio(by, of);
  if (scan.min > 1.0) return;
  const std::string message = "is larger than what it erodes along " + text(scan.min_direction) +
                              ": its radius is " + number_text(1.0 / scan.min, 4) +
                              " times as large, must be smaller; the object is cut through there";
  if (in.strict())
    in.problem(key, scene_error::erosion_overreach, message);
  else
    in.warning(key, std::string(scene_error::erosion_overreach) + ": " + message);
}

Node make_dilation(NodeInputs& in) {
  if (!check_operands(in, {"of", "by"})) return {};
  return dilated(in.node("of"), in.node("by"), in.number("n"));
}

Node make_erosion(NodeInputs& in) {
  if (!check_operands(in, {"of", "by"})) return {};
  check_erosion(in, "by", *in.node("of"), *in.node("by"));
  return eroded(in.node("of"), in.node("by"), in.number("n"));
}

Node make_erosion_after_dilation(NodeInputs& in) {
  if (!check_operands(in, {"of", "dilate_by", "erode_by"})) return {};
  const auto larger =
      std::make_shared<const Node>(dilated(in.node("of"), in.node("dilate_by"), in.number("n_dilation")));
  check_erosion(in, "erode_by", *larger, *in.node("erode_by"));
  return eroded(larger, in.node("erode_by"), in.number("n_erosion"));
}

Node make_ray_scaling(NodeInputs& in) {
  if (!check_operands(in, {"of", "by"})) return {};
  const Operand of = in.node("of"), by = in.node("by");
  const double n = in.number("n");
  if (n == 0.0) return *of;
  const Range radius = by->positive ? detail::radius_bounds(*by) : Range::everything();
  if (!std::isfinite(radius.hi) || !(radius.lo > 0.0)) {
    in.problem("by", scene_error::invalid_parameter,
               "is 0 or infinite along a direction, must have a finite radius in every direction");
    return {};
  }
  // (r/T)^n = R_T^n
  const double a = std::pow(radius.lo, n), b = std::pow(radius.hi, n);
  const Range factor = Range{std::min(a, b), std::max(a, b)}.widened(1e-12);
  if (!(factor.lo >= 1e-60 && factor.hi <= 1e60)) {
    in.problem("n", scene_error::invalid_parameter,
               "is " + number_text(n) + ", which scales by " + scientific_text(factor.lo) + " to " +
                   scientific_text(factor.hi) + ", must stay within 1e-60 and 1e60");
    return {};
  }
  Node node = ray_linear_distance(*of, of->positive);
  const auto body = std::make_shared<const RayScaling>(n, factor);
  node.emit = [of, by, body](TapeBuilder& tape, const Frame& frame) {
    const StepIndex args[] = {of->emit(tape, frame), by->emit(tape, frame)};
    const Frame about(Eigen::Matrix3d::Identity(), -of->origin);
    return tape.add(op_for<RayScaling>(), body, of->origin.isZero(0.0) ? frame : about.after(frame), args);
  };
  node.region = [of, least = factor.lo](double value) { return of->region(value / least); };
  return node;
}

// ---- Rows ------------------------------------------------------------------------------------------------

constexpr NodeParam distance_param(std::string_view name, std::string_view description) {
  return {.type = NodeParam::Type::node, .info = {.name = name, .description = description}};
}
constexpr std::array dilation_params{distance_param("of", "d: a ray-linear distance"),
                                     distance_param("by", "T: a ray-linear distance about the same point"),
                                     detail::exponent_param("n", "exponent n; n = 1 adds the radii")};
constexpr std::array erosion_params{distance_param("of", "d: a ray-linear distance"),
                                    distance_param("by", "T > d: a ray-linear distance about the same point"),
                                    detail::exponent_param("n", "exponent n; n = 1 subtracts the radii")};
constexpr std::array both_params{
    distance_param("of", "d: a ray-linear distance"),
    distance_param("dilate_by", "T_D: a ray-linear distance about the same point"),
    distance_param("erode_by", "T_E: a ray-linear distance about the same point, smaller than the dilated d"),
    detail::exponent_param("n_dilation", "exponent n of the dilation"),
    detail::exponent_param("n_erosion", "exponent m of the erosion")};
constexpr std::array ray_scaling_params{
    distance_param("of", "d: a ray-linear distance"),
    distance_param("by", "T: a ray-linear distance about the same point, > 0 but there"),
    NodeParam{.type = NodeParam::Type::number,
              .info = {.name = "n",
                       .description =
                           "exponent n; n > 0 erodes where T is larger than the unit ball, n < 0 dilates",
                       .min = -64.0,
                       .max = 64.0,
                       .min_allowed = true}}};
constexpr NodeFamily family = NodeFamily::distance_operation;

constexpr std::array rows{
    NodeKind{"dilation", family, "x = (d^-n + T^-n)^(-1/n): R = (R_d^n + R_T^n)^(1/n)",
             "a distance enlarged by the radii of another", "Hsu, Distance Function Operations",
             dilation_params, make_dilation},
    NodeKind{"erosion", family, "x = (d^-n - T^-n)^(-1/n): R = (R_d^n - R_T^n)^(1/n)",
             "a distance reduced by the radii of another", "Hsu, Distance Function Operations",
             erosion_params, make_erosion},
    NodeKind{"erosion_after_dilation", family, "R = ((R_d^n + R_D^n)^(m/n) - R_E^m)^(1/m)",
             "a distance enlarged by one and reduced by another", "Hsu, Distance Function Operations",
             both_params, make_erosion_after_dilation},
    NodeKind{"ray_scaling", family, "x = d (r/T)^n, r = |X|: R = R_d / R_T^n", "a distance scaled ray by ray",
             "Hsu 2016", ray_scaling_params, make_ray_scaling},
};

}  // namespace

std::span<const NodeKind> distance_operation_kinds() { return rows; }

}  // namespace blendwright
