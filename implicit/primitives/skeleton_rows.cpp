#include <array>

#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/primitive_tables.hpp"
#include "implicit/primitives/skeleton.hpp"

namespace blendwright::detail {
namespace {

constexpr NodeParam end_point(std::string_view name, std::string_view description) {
  return {.type = NodeParam::Type::point, .info = {.name = name, .description = description}};
}
constexpr NodeParam reach(std::string_view name, std::string_view description) {
  NodeParam p = length_param(name, description);
  p.info.min_allowed = true;
  return p;
}

constexpr std::array segment_params{end_point("p0", "start p0 of the segment"),
                                    end_point("p1", "end p1 of the segment; may be p0"),
                                    length_param("radius", "influential radius I, where d = 1")};
constexpr std::array capsule_params{reach("below", "length l0 of the axis below 0"),
                                    reach("above", "length l1 of the axis above 0"),
                                    length_param("radius", "radius R of the capsule d = 1")};

Node make_segment(NodeInputs& in) {
  const Vec3 p0 = read_point(in, "p0"), p1 = read_point(in, "p1");
  const double radius = read_length(in, "radius");
  const double length = (p1 - p0).norm();
  const Vec3 direction = length > 0.0 ? Vec3((p1 - p0).normalized()) : Vec3::Zero();
  Node node;
  node.distance = true;
  node.ray_linear = length == 0.0;  // a ball, about its centre
  node.positive = node.ray_linear;  // else 0 all along the segment
  if (node.ray_linear) node.origin = p0;
  node.emit = emit_body(SegmentSkeleton{p0, direction, length, 1.0 / radius});
  const Box ends{p0.cwiseMin(p1), p0.cwiseMax(p1)};
  node.region = [ends, radius](double value) -> std::optional<Box> {
    // The differences of coordinates in d are rounded; that is what the margin has beyond value * radius.
    const double margin = std::max(0.0, value) * radius * (1.0 + range_slack) +
                          range_slack * (ends.lo.cwiseAbs() + ends.hi.cwiseAbs()).sum();
    const Box box{ends.lo.array() - margin, ends.hi.array() + margin};
    if (!box.finite()) return std::nullopt;
    return box;
  };
  return node;
}

Node make_capsule(NodeInputs& in) {
  const double below = in.number("below"), above = in.number("above"), radius = read_length(in, "radius");
  Node node;
  node.distance = true;
  node.ray_linear = true;
  node.positive = true;
  node.emit = emit_body(CapsuleGauge{below / radius, above / radius, 1.0 / radius});
  const Box unit{{-radius, -radius, -(below + radius)}, {radius, radius, above + radius}};
  node.region = [unit](double value) { return scaled_box(unit, value); };
  return node;
}

constexpr std::array rows{
    NodeKind{"segment_skeleton", NodeFamily::distance, "d = r/I, r the distance from the segment p0 p1",
             "capsule around a segment", "Bloomenthal and Wyvill 1990", segment_params, make_segment},
    NodeKind{"capsule_gauge", NodeFamily::distance,
             "d = t: X lies on t K, K the capsule of radius R around the z axis from -l0 to l1",
             "capsule that is ray-linear about the origin", "derived", capsule_params, make_capsule}};

}  // namespace

std::span<const NodeKind> skeleton_kinds() { return rows; }

}  // namespace blendwright::detail
