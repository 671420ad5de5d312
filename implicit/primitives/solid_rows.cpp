// The rows of exact signed distances.
#include <array>

#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/primitive_tables.hpp"
#include "implicit/primitives/solid_distance.hpp"
#include "implicit/scene/level_map.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

using Type = NodeParam::Type;

/// The box around { f >= value } of a distance to a body that lies in [-half, half]: smaller by value inside,
/// larger outside; a point when nothing is left. Rounding is far below the part added here.
std::function<std::optional<Box>(double)> distance_region(const Vec3& half) {
  return [half](double value) -> std::optional<Box> {
    const double size = half.maxCoeff() + std::abs(value);
    const Vec3 left = (half.array() - value + range_slack * size).matrix().cwiseMax(Vec3::Zero());
    if (!left.allFinite()) return std::nullopt;
    return Box{-left, left};
  };
}

template <class Body>
Node distance_node(Body body, const Vec3& half) {
  Node node;
  node.level = Level::function;
  node.exact_distance = true;
  node.emit = emit_body(std::move(body));
  node.region = distance_region(half);
  return node;
}

using Parallel = std::shared_ptr<const Node>;

/// f + length of the exact distance f of a convex solid: the exact distance again when the solid grows, as
/// its nearest points keep their normals, and when it shrinks and could grow back to what it was.
Parallel shifted(const Node& of, double length) {
  Node node = of;
  node.emit = [emit = of.emit, map = std::make_shared<const LevelMap>(LevelMap{1.0, length})](
                  TapeBuilder& tape, const Frame& frame) {
    return tape.add<LevelMap>(map, Frame(), {emit(tape, frame)});
  };
  node.region = [region = of.region, length](double value) { return region(value - length); };
  if (of.parallel) node.parallel = [p = of.parallel, length](double more) { return p(length + more); };
  return std::make_shared<const Node>(std::move(node));
}

Node sphere_node(double radius) {
  Node node = distance_node(SphereDistance{radius}, Vec3::Constant(radius));
  node.parallel = [radius](double length) {
    return radius + length > 0.0 ? std::make_shared<const Node>(sphere_node(radius + length)) : nullptr;
  };
  return node;
}

Node torus_node(double ring, double tube) {
  Node node = distance_node(TorusDistance{ring, tube}, {ring + tube, ring + tube, tube});
  node.parallel = [ring, tube](double length) {
    const double r = tube + length;
    return r > 0.0 && r < ring ? std::make_shared<const Node>(torus_node(ring, r)) : nullptr;
  };
  return node;
}

Node box_node(const Vec3& half) {
  Node node = distance_node(BoxDistance{half}, half);
  node.parallel = [half](double length) -> Parallel {
    if (length >= 0.0) return shifted(box_node(half), length);
    const Vec3 left = half.array() + length;
    return left.minCoeff() > 0.0 ? std::make_shared<const Node>(box_node(left)) : nullptr;
  };
  return node;
}

/// Shrunk by no more than its least radius of curvature, s_min^2/s_max, it grows back.
Node ellipsoid_node(const Vec3& s) {
  Node node = distance_node(EllipsoidDistance(s), s);
  node.parallel = [s](double length) {
    const double least = s.minCoeff() * (s.minCoeff() / s.maxCoeff());
    return length >= -least ? shifted(ellipsoid_node(s), length) : nullptr;
  };
  return node;
}

Node make_sphere(NodeInputs& in) { return sphere_node(read_length(in, "radius")); }

Node make_ellipsoid(NodeInputs& in) {
  return ellipsoid_node({read_length(in, "a"), read_length(in, "b"), read_length(in, "c")});
}

Node make_torus(NodeInputs& in) {
  const double ring = read_length(in, "ring"), tube = read_length(in, "tube");
  if (!(tube < ring)) {
    in.problem("tube", scene_error::invalid_parameter,
               "is " + number_text(tube) + ", must be < ring = " + number_text(ring) +
                   ": the surface would meet itself");
    return {};
  }
  return torus_node(ring, tube);
}

Node make_box(NodeInputs& in) {
  const std::vector<double>& half = in.numbers("half");
  Vec3 h;
  for (int i = 0; i < 3; ++i) h[i] = checked_length(in, "half", half[static_cast<std::size_t>(i)], i);
  return box_node(h);
}

constexpr std::array sphere_params{length_param("radius", "radius R")};
constexpr std::array ellipsoid_params{length_param("a", "semi-axis along x"),
                                      length_param("b", "semi-axis along y"),
                                      length_param("c", "semi-axis along z")};
constexpr std::array torus_params{length_param("ring", "radius R of the circle in the tube, around z"),
                                  length_param("tube", "radius r of the tube, < ring")};
constexpr std::array box_params{NodeParam{
    .type = Type::numbers, .info = {.name = "half", .description = "half sizes [hx, hy, hz]"}, .count = 3}};

constexpr std::array rows{
    NodeKind{"sphere", NodeFamily::solid, "f = R - |X|", "exact signed distance of a sphere",
             "Vyatkin 2007-2014", sphere_params, make_sphere},
    NodeKind{"ellipsoid", NodeFamily::solid, "f = -t |W|, W_i = x_i/(t + s_i^2), sum (s_i W_i)^2 = 1",
             "exact signed distance of an ellipsoid", "Eberly 2013", ellipsoid_params, make_ellipsoid},
    NodeKind{"torus", NodeFamily::solid, "f = r - |(sqrt(x^2 + y^2) - R, z)|",
             "exact signed distance of a torus around z", "Vyatkin 2007-2014", torus_params, make_torus},
    NodeKind{"box", NodeFamily::solid, "f = -|max(a, 0)| - min(max(a_i), 0), a_i = |x_i| - h_i",
             "exact signed distance of a box", "Rossignac and Requicha 1984", box_params, make_box}};

}  // namespace

std::span<const NodeKind> solid_distance_kinds() { return rows; }

}  // namespace blendwright::detail
