// Soft objects: a potential of a distance, with an adjustable range.
#include <array>
#include <cmath>

#include "implicit/operators/potential.hpp"
#include "implicit/operators/range_map.hpp"
#include "implicit/scene/direction_scan.hpp"
#include "implicit/scene/node.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using Type = NodeParam::Type;
enum class Potential : std::size_t { blanc, wyvill, gaussian, gaussian_windowed };

/// A function of the results of earlier steps: a body with its operation.
struct Function {
  const Op* op = nullptr;
  std::shared_ptr<const void> body;
  [[nodiscard]] double operator()(std::initializer_list<double> args) const {
    return scalar_value(*op, body.get(), Vec3::Zero(), {args.begin(), args.size()});
  }
  [[nodiscard]] StepIndex add(TapeBuilder& tape, std::initializer_list<StepIndex> args) const {
    return tape.add(*op, body, Frame(), {args.begin(), args.size()});
  }
};
template <class Body>
Function function_of(Body body) {
  return {&op_for<Body>(), std::make_shared<const Body>(std::move(body))};
}

Function potential_of(const NodeInputs& in) {
  switch (Potential{in.word("potential")}) {
    case Potential::wyvill:
      return function_of(detail::Wyvill{});
    case Potential::gaussian:
      return function_of(detail::Gaussian{});
    case Potential::gaussian_windowed:
      return function_of(detail::GaussianWindowed{});
    case Potential::blanc:
      break;
  }
  return function_of(detail::Blanc{in.number("softness")});
}

/// A number that `f`, which falls or stays, does not reach `value` at, at most 2^-40 too large; nullopt when
/// f does not fall below it before 1e6.
template <class F>
std::optional<double> end_of(F f, double value) {
  double lo = 0.0, hi = 1.0;
  while (!(f(hi) < value)) {
    lo = hi;
    hi *= 2.0;
    if (hi > 1e6) return std::nullopt;
  }
  while (hi - lo > 0x1p-40 * hi) {
    const double middle = 0.5 * (lo + hi);
    (f(middle) < value ? hi : lo) = middle;
  }
  return hi;
}

/// (1 - t) a + t b, corner by corner.
Box between(const Box& a, const Box& b, double t) {
  return {(1.0 - t) * a.lo + t * b.lo, (1.0 - t) * a.hi + t * b.hi};
}

Node half_level(const Node& distance) {
  Node node;
  node.level = Level::half;
  node.origin = distance.origin;
  return node;
}

// ---- One range for the whole object -------------------------------------------------------------------

Node plain(const std::shared_ptr<const Node>& distance, const Function& potential) {
  Node node = half_level(*distance);
  node.emit = [distance, potential](TapeBuilder& tape, const Frame& frame) {
    return potential.add(tape, {distance->emit(tape, frame)});
  };
  node.region = [distance, potential](double value) -> std::optional<Box> {
    const std::optional<double> end = end_of([&](double d) { return potential({d}); }, value);
    if (!(value > 0.0) || !end) return std::nullopt;
    return distance->region(*end);
  };
  return node;
}

Node ranged(const std::shared_ptr<const Node>& distance, const Function& potential, const Function& map) {
  Node node = half_level(*distance);
  node.emit = [distance, potential, map](TapeBuilder& tape, const Frame& frame) {
    return potential.add(tape, {map.add(tape, {distance->emit(tape, frame)})});
  };
  node.region = [distance, potential, map](double value) -> std::optional<Box> {
    const std::optional<double> end = end_of([&](double d) { return potential({map({d})}); }, value);
    if (!(value > 0.0) || !end) return std::nullopt;
    return distance->region(*end);
  };
  return node;
}

// ---- A range that varies with the direction -----------------------------------------------------------

/// The field is >= value where T <= t. Along a ray with object radius R_d and contour radius R_f the map is
/// 1/2 + (d - 1/2)/w, w = 2 R_f/R_d - 1, so that T = t at (1 - s) R_d/2 + s R_f, s = 2 t - 1: between the
/// boxes of d = 1/2 and f_c = 1. Where the floor of w acts, w < 2 w_floor, T = t at d < 1/2 + s w_floor.
std::optional<Box> contoured_region(const Node& distance, const Node& contour, double t, double w_floor) {
  const double s = std::max(0.0, 2.0 * t - 1.0);
  const std::optional<Box> object = distance.region(0.5), outline = contour.region(1.0);
  const std::optional<Box> floored = distance.region(0.5 + s * w_floor);
  if (!object || !outline || !floored || !object->finite() || !outline->finite()) return std::nullopt;
  return hull(between(*object, *outline, s), *floored);
}

Node contoured(const std::shared_ptr<const Node>& distance, const std::shared_ptr<const Node>& contour,
               const Function& potential, const Function& map, double w_floor) {
  Node node = half_level(*distance);
  node.emit = [distance, contour, potential, map](TapeBuilder& tape, const Frame& frame) {
    const StepIndex d = distance->emit(tape, frame), f = contour->emit(tape, frame);
    return potential.add(tape, {map.add(tape, {d, f})});
  };
  node.region = [distance, contour, potential, w_floor](double value) -> std::optional<Box> {
    if (!(value > 0.0) || !(potential({1.0}) < value)) return std::nullopt;
    const std::optional<double> end = end_of([&](double t) { return potential({t}); }, value);
    return end ? contoured_region(*distance, *contour, *end, w_floor) : std::nullopt;
  };
  return node;
}

// ---- The row ------------------------------------------------------------------------------------------

std::string point_text(const Vec3& p) {
  return '[' + number_text(p.x()) + ", " + number_text(p.y()) + ", " + number_text(p.z()) + ']';
}

/// A direction for reading: three digits, and no traces of zeros.
std::string direction_text(const Vec3& u) {
  Vec3 rounded;
  for (int i = 0; i < 3; ++i) rounded[i] = std::round(1e3 * u[i]) / 1e3 + 0.0;
  return point_text(rounded);
}

/// The key of a contour, below the node.
constexpr std::string_view contour_key = "w1/contour";

/// Reports what a range cannot vary with: both must be ray-linear about one point, the contour closed.
bool check_contour(NodeInputs& in, const Node& distance, const Node& contour) {
  bool good = true;
  const auto problem = [&](std::string_view key, std::string_view error, std::string message) {
    in.problem(key, error, std::move(message));
    good = false;
  };
  if (!distance.ray_linear)
    problem(
        "distance", scene_error::not_ray_linear,
        "is not ray-linear, must be for a w1 that varies: its radius must be a function of the direction");
  if (!contour.distance)
    problem(contour_key, scene_error::level_mismatch, "is not a distance, must be one");
  else if (!contour.ray_linear)
    problem(contour_key, scene_error::not_ray_linear,
            "is not ray-linear, must be: its radius must be a function of the direction");
  else if (!contour.positive)
    problem(contour_key, scene_error::unbounded_contour,
            "is 0 along some direction, must be > 0 off its origin, so that w1 is finite");
  else if (distance.ray_linear && !same_origin(distance, contour))
    problem(contour_key, scene_error::origin_mismatch,
            "has its origin at " + point_text(contour.origin) + ", must have it at " +
                point_text(distance.origin) + " like the distance; place both alike, or the soft object");
  return good;
}

/// The least w1 = 2 d/f_c - 1 of all directions against the floor; the least w that is left.
double check_width(NodeInputs& in, const Node& distance, const Node& contour, double floor) {
  const detail::RatioScan scan = detail::scan_ratio(distance, contour);
  const double least = 2.0 * scan.min - 1.0;
  const std::string is =
      "gives w1 = " + number_text(least, 4) + " along " + direction_text(scan.min_direction);
  if (!(least > 0.0)) {
    const std::string inside =
        is + ", where the contour f_c = 1 is not outside the object d = 1/2; w1 must be > 0";
    if (in.strict())
      in.problem(contour_key, scene_error::contour_inside_object, inside);
    else
      in.warning(contour_key, std::string(scene_error::contour_inside_object) + ": " + inside +
                                  "; w_floor = " + number_text(floor, 4) + " acts there");
  } else if (least < 2.0 * floor) {
    in.warning(contour_key, is + ", below 2 w_floor = " + number_text(2.0 * floor, 4) +
                                ": the object reaches a little beyond the contour there");
  }
  if (least <= 0.0) return floor;
  return least < 2.0 * floor ? floor + least * least / (4.0 * floor) : least;
}

void check_inner(NodeInputs& in, double w2, double w1, std::string_view meaning) {
  if (w2 > 2.0 * w1)
    in.problem("w2", scene_error::invalid_parameter,
               "is " + number_text(w2) + ", must be at most " + std::string(meaning) + " = " +
                   number_text(2.0 * w1, 6) + "; else the object gets a hole inside");
}

void warn_unused(NodeInputs& in, Potential potential, bool varies) {
  if (in.has("softness") && potential != Potential::blanc)
    in.warning("softness", "has no effect: only the potential blanc has one");
  for (const std::string_view key : {"w_floor", "inner"})
    if (in.has(key) && !varies) in.warning(key, "has no effect without a contour as w1");
  if (potential == Potential::gaussian)
    in.warning("potential",
               "is gaussian, which never ends: P(1) = 1/16, so that objects act on each other at "
               "any distance and bounds are rough; gaussian_windowed ends at d = 1");
}

Node make_soft_object(NodeInputs& in) {
  const std::shared_ptr<const Node> distance = in.node("distance"), contour = in.contour("w1");
  if (distance->level != Level::one) {
    in.problem("distance", scene_error::level_mismatch,
               "is of " + std::string(name(distance->level)) + ", must be a distance (level one)");
    return {};
  }
  if (!distance->distance) {
    in.problem("distance", scene_error::level_mismatch,
               "takes negative values, must be a distance; use half_space or slab for a plane");
    return {};
  }
  const Potential kind{in.word("potential")};
  const Function potential = potential_of(in);
  const double w2 = in.number("w2");
  warn_unused(in, kind, contour != nullptr);
  if (!contour) {
    const double w1 = in.number("w1");
    check_inner(in, w2, w1, "2 w1");
    if (w1 == 1.0 && w2 == 1.0) return plain(distance, potential);
    return ranged(distance, potential, function_of(detail::RangeMap{w1, w2}));
  }
  const double floor = in.number("w_floor");
  const bool coupled = in.word("inner") == 1;
  if (!check_contour(in, *distance, *contour)) return {};
  const double least = check_width(in, *distance, *contour, floor);
  if (coupled) check_inner(in, w2, least, "2 w1 of every direction");
  return contoured(distance, contour, potential, function_of(detail::VirMap{w2, floor, coupled}), floor);
}

constexpr std::string_view potentials[] = {"blanc", "wyvill", "gaussian", "gaussian_windowed"};
constexpr std::string_view inner_modes[] = {"decoupled", "coupled"};

constexpr NodeParam soft_object_params[] = {
    {.type = Type::node, .info = {.name = "distance", .description = "d: what the object is around"}},
    {.type = Type::word,
     .info = {.name = "potential",
              .description =
                  "P: blanc (with softness s), wyvill, gaussian_windowed, or gaussian, which has no end"},
     .required = false,
     .words = potentials},
    {.type = Type::number,
     .info = {.name = "softness",
              .description = "s of blanc: larger is steeper at the surface and flatter elsewhere",
              .min = 0.0,
              .max = 1e6,
              .min_allowed = true,
              .fallback = 0.0}},
    {.type = Type::number_or_contour,
     .info = {.name = "w1",
              .description = "outer radius of influence: the field ends at d = (1 + w1)/2, or at the contour "
                             "f_c = 1, w1 = 2 d/f_c - 1",
              .min = 1e-9,
              .max = 1e9,
              .min_allowed = true,
              .fallback = 1.0}},
    {.type = Type::number,
     .info = {.name = "w2",
              .description = "inner radius: the field is 1 for d <= (1 - w2)/2; w2 <= 2 w1",
              .min = 1e-9,
              .max = 1.0,
              .min_allowed = true,
              .fallback = 1.0}},
    {.type = Type::number,
     .info = {.name = "w_floor",
              .description = "w_0: w1 of a contour does not fall below it",
              .min = 1e-9,
              .max = 1.0,
              .min_allowed = true,
              .fallback = 0.02}},
    {.type = Type::word,
     .info = {.name = "inner",
              .description =
                  "inside, with a contour: decoupled (w2 alone) or coupled (smooth across d = 1/2; "
                  "w2 <= 2 w1 of every direction)"},
     .required = false,
     .words = inner_modes},
};

constexpr std::array kinds = {
    NodeKind{"soft_object", NodeFamily::field, "f = P(T(d))", "a field of level 1/2 that fades away from d",
             "Blanc and Schlick 1995, Hsu and Lee 2003", soft_object_params, make_soft_object},
};

}  // namespace

std::span<const NodeKind> field_kinds() { return kinds; }

}  // namespace blendwright
