#include <array>

#include "implicit/primitives/lp_metric.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/primitive_tables.hpp"
#include "implicit/primitives/superquadric.hpp"

namespace blendwright::detail {
namespace {

constexpr NodeParam axis_a = length_param("a", "half-axis a along x, of d = 1");
constexpr NodeParam axis_b = length_param("b", "half-axis b along y, of d = 1");
constexpr NodeParam axis_c = length_param("c", "half-axis c along z, of d = 1");

constexpr std::array lp_params{axis_a, axis_b, axis_c, exponent_param("n", "exponent n; convex for n >= 1")};
constexpr std::array superquadric_params{
    axis_a, axis_b, axis_c, exponent_param("n1", "exponent n1 of the sections z = const; convex for n1 >= 1"),
    exponent_param("n2", "exponent n2 of the outline along z; convex for n2 >= 1")};

constexpr NodeParam both_axes(std::string_view name, std::string_view description) {
  return {.type = NodeParam::Type::numbers,
          .info = {.name = name, .description = description, .min = 0.0, .max = largest_length},
          .count = 2};
}
constexpr std::array asymmetric_params{both_axes("x", "[a+, a-], half-axes of d = 1 towards +x and -x"),
                                       both_axes("y", "[b+, b-], half-axes of d = 1 towards +y and -y"),
                                       both_axes("z", "[c+, c-], half-axes of d = 1 towards +z and -z"),
                                       exponent_param("n", "exponent n; convex for n >= 1")};

/// A ray-linear, bounded distance whose d = 1 just fits into `unit`.
template <class Body>
Node gauge(Body body, const Box& unit) {
  Node node;
  node.distance = true;
  node.ray_linear = true;
  node.positive = true;
  node.emit = emit_body(std::move(body));
  node.region = [unit](double value) { return scaled_box(unit, value); };
  return node;
}

Vec3 read_axes(NodeInputs& in) {
  const double a = read_length(in, "a"), b = read_length(in, "b"), c = read_length(in, "c");
  return {a, b, c};
}

Node make_lp_metric(NodeInputs& in) {
  const Vec3 axes = read_axes(in);
  const double n = in.number("n");
  return gauge(LpMetric{axes.cwiseInverse(), Power(n), Power(1.0 / n)}, {-axes, axes});
}

Node make_superquadric(NodeInputs& in) {
  const Vec3 axes = read_axes(in);
  const double n1 = in.number("n1"), n2 = in.number("n2");
  return gauge(Superquadric{axes.cwiseInverse(), Power(n1), Power(1.0 / n1), Power(n2), Power(1.0 / n2)},
               {-axes, axes});
}

Node make_asymmetric(NodeInputs& in) {
  constexpr std::array<std::string_view, 3> keys{"x", "y", "z"};
  Vec3 plus, minus;
  for (int i = 0; i < 3; ++i) {
    const std::string_view key = keys[static_cast<std::size_t>(i)];
    plus[i] = checked_length(in, key, in.numbers(key)[0], 0);
    minus[i] = checked_length(in, key, in.numbers(key)[1], 1);
  }
  const double n = in.number("n");
  return gauge(AsymmetricSuperellipsoid{plus.cwiseInverse(), minus.cwiseInverse(), Power(n), Power(1.0 / n)},
               {-minus, plus});
}

constexpr std::array rows{
    NodeKind{"lp_metric", NodeFamily::distance, "d = (|x/a|^n + |y/b|^n + |z/c|^n)^(1/n)",
             "super-ellipsoid, from octahedron to box", "Blanc and Schlick 1995", lp_params, make_lp_metric},
    NodeKind{"superquadric", NodeFamily::distance, "d = ((|x/a|^n1 + |y/b|^n1)^(n2/n1) + |z/c|^n2)^(1/n2)",
             "bar or cushion along z with its own section", "Barr 1981", superquadric_params,
             make_superquadric},
    NodeKind{"asymmetric_superellipsoid", NodeFamily::distance,
             "d = (u^n + v^n + w^n)^(1/n), u = x/a+ for x >= 0, -x/a- else, and so on",
             "super-ellipsoid with its own half-axis on either side", "after Blanc and Schlick 1995",
             asymmetric_params, make_asymmetric}};

}  // namespace

std::span<const NodeKind> superellipsoid_kinds() { return rows; }

}  // namespace blendwright::detail
