// The rows of offsets.
#include <array>
#include <cmath>

#include "implicit/offset/offset_nodes.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace detail {
namespace {

using Type = NodeParam::Type;

/// The node that is offset: null after a problem. Values of distances have no fixed scale and no sign: they
/// are level one by convention only.
NodePtr read_of(NodeInputs& in) {
  NodePtr of = in.node("of");
  if (!of->distance) return of;
  in.problem("of", scene_error::level_mismatch,
             "is a distance (of level one, never negative), must be a solid; convert it");
  return nullptr;
}

void warn_if_empty(NodeInputs& in, const Node& node, std::string_view key, double amount, const char* what) {
  if (provably_empty(node))
    in.warning(key,
               "is " + number_text(amount) + ": the " + what + " leaves nothing of the solid; it is empty");
}
void warn_if_zero(NodeInputs& in, std::string_view key, double amount) {
  if (amount == 0.0) in.warning(key, "is 0: nothing changes");
}

Node make_iso_offset(NodeInputs& in) {
  const NodePtr of = read_of(in);
  if (!of) return {};
  const double value = in.number("value");
  warn_if_zero(in, "value", value);
  Node node = iso_offset(of, value);
  if (value < 0.0) warn_if_empty(in, node, "value", value, "iso-offset by it");
  return node;
}

/// A probe from the point where the solid touches a side of its box goes straight to the other side.
void warn_of_overshoot(NodeInputs& in, const Node& of, double distance) {
  const std::optional<Box> box = of.region(surface_value(of.level));
  if (!box || !box->finite()) return;
  const double width = box->size().minCoeff();
  if (distance > width)
    in.warning("distance",
               "is " + number_text(distance) + ", more than the solid is wide (" + number_text(width, 4) +
                   "): probes leave it on its far side, which makes cavities; ball_offset has none");
}

Node make_normal_offset(NodeInputs& in) {
  const NodePtr of = read_of(in);
  if (!of) return {};
  const double distance = in.number("distance");
  warn_if_zero(in, "distance", distance);
  warn_of_overshoot(in, *of, distance);
  Node node = normal_offset(of, distance);
  if (distance < 0.0) warn_if_empty(in, node, "distance", distance, "offset by it");
  return node;
}

Node make_ball_offset(NodeInputs& in) {
  const NodePtr of = read_of(in);
  if (!of) return {};
  const double distance = in.number("distance");
  warn_if_zero(in, "distance", distance);
  Node node = ball_offset(of, distance, in.number("tolerance"));
  if (distance < 0.0) warn_if_empty(in, node, "distance", distance, "offset by it");
  return node;
}

Node make_shell(NodeInputs& in) {
  const NodePtr of = read_of(in);
  if (!of) return {};
  const double inner = in.number("inner"), outer = in.number("outer"), tolerance = in.number("tolerance");
  if (inner + outer == 0.0) {
    in.problem("inner", scene_error::invalid_parameter,
               "is 0, must be > 0 when outer is 0: the wall has no thickness");
    return {};
  }
  const auto hole = std::make_shared<const Node>(ball_offset(of, -inner, tolerance));
  if (inner > 0.0 && provably_empty(*hole))
    in.warning("inner", "is " + number_text(inner) +
                            ": the inner offset by it leaves nothing of the solid; the shell has no hollow");
  return shell(std::make_shared<const Node>(ball_offset(of, outer, tolerance)), hole);
}

Node make_opening(NodeInputs& in) {
  const NodePtr of = read_of(in);
  if (!of) return {};
  const double radius = read_length(in, "radius");
  Node node = opening(of, radius, in.number("tolerance"));
  const Node first = ball_offset(of, -radius, in.number("tolerance"));
  warn_if_empty(in, first, "radius", radius, "opening by it");
  return node;
}

Node make_closing(NodeInputs& in) {
  const NodePtr of = read_of(in);
  if (!of) return {};
  return closing(of, read_length(in, "radius"), in.number("tolerance"));
}

constexpr NodeParam of_param{
    .type = Type::node,
    .info = {.name = "of", .description = "f: the solid, a node of any level but no distance"}};
constexpr NodeParam amount_param(std::string_view name, std::string_view description) {
  return {.type = Type::number,
          .info = {.name = name, .description = description, .min = -1e30, .max = 1e30, .min_allowed = true}};
}
constexpr NodeParam thickness_param(std::string_view name, std::string_view description) {
  return {.type = Type::number,
          .info = {.name = name, .description = description, .min = 0.0, .max = 1e30, .min_allowed = true}};
}
constexpr NodeParam tolerance_param{
    .type = Type::number,
    .info = {.name = "tolerance",
             .description =
                 "largest error of a value that is searched for, relative to the range of f over the ball",
             .min = 1e-13,
             .max = 0.1,
             .min_allowed = true,
             .fallback = 1e-6}};

constexpr std::array iso_params{of_param, amount_param("value", "C: added to phi; > 0 grows the solid")};
constexpr std::array normal_params{of_param, amount_param("distance", "D: > 0 grows the solid")};
constexpr std::array ball_params{of_param, amount_param("distance", "D: > 0 grows the solid"),
                                 tolerance_param};
constexpr std::array shell_params{of_param, thickness_param("inner", "how far the wall reaches inward"),
                                  thickness_param("outer", "how far the wall reaches outward"),
                                  tolerance_param};
constexpr std::array rounding_params{of_param, length_param("radius", "r: radius of the ball"),
                                     tolerance_param};

constexpr NodeFamily offset = NodeFamily::offset;
constexpr std::string_view vyatkin = "Vyatkin 2007-2014", rossignac = "Rossignac and Requicha 1984, 1986";

constexpr std::array rows{
    NodeKind{"iso_offset", offset, "phi(X) + C", "the solid of another level of its field: C is no length",
             vyatkin, iso_params, make_iso_offset},
    NodeKind{
        "normal_offset", offset, "phi(X + D N), N = grad phi/|grad phi| at X",
        "offset along the normal: exact for distances, off by O(D^2) else; cavities where D is more than "
        "the local thickness",
        vyatkin, normal_params, make_normal_offset},
    NodeKind{"ball_offset", offset, "max (D < 0: min) of phi(Y), |Y - X| <= |D|",
             "offset of constant radius, exact or searched to a tolerance", rossignac, ball_params,
             make_ball_offset},
    NodeKind{"shell", offset, "min(phi offset by outer, -(phi offset by -inner))",
             "a wall of constant thickness along the surface", rossignac, shell_params, make_shell},
    NodeKind{"opening", offset, "the ball offset by r of that by -r",
             "rounds convex edges: what a ball of the radius r reaches from inside", rossignac,
             rounding_params, make_opening},
    NodeKind{"closing", offset, "the ball offset by -r of that by r",
             "fillets concave edges: what no ball of the radius r reaches from outside", rossignac,
             rounding_params, make_closing},
};

}  // namespace
}  // namespace detail

std::span<const NodeKind> offset_kinds() { return detail::rows; }

}  // namespace blendwright
