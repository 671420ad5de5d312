#include <array>

#include "implicit/primitives/generalized_distance.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/primitive_tables.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

constexpr std::array generalized_params{
    NodeParam{.type = NodeParam::Type::points,
              .info = {.name = "normals", .description = "unit normals n_i of the facets"}},
    exponent_param("n", "exponent n; the larger, the sharper the edges", 1.0)};

/// The normals, with one warning when any had to be normalised.
std::vector<Vec3> read_normals(NodeInputs& in) {
  std::vector<Vec3> normals;
  std::string first;
  int changed = 0;
  for (const std::vector<double>& row : in.rows("normals")) {
    const int index = static_cast<int>(normals.size());
    const Direction d = checked_direction(in, "normals", {row[0], row[1], row[2]}, index);
    normals.push_back(d.unit.normalized());
    if (d.was_unit()) continue;
    if (changed++ == 0) first = "number " + number_text(index) + " has length " + number_text(d.length, 6);
  }
  if (changed > 0)
    in.warning("normals", "are not all of length 1 (" + first + "); " + number_text(changed) + " of " +
                              number_text(static_cast<double>(normals.size())) + " normalised");
  return normals;
}

Node make_generalized(NodeInputs& in) {
  GeneralizedDistance body{read_normals(in), {}, {}};
  const double n = in.number("n");
  body.n = Power(n);
  body.inverse_n = Power(1.0 / n);
  Node node;
  node.distance = true;
  node.ray_linear = true;
  node.positive = span_space(body.normals);
  if (node.positive) {
    const Vec3 half = half_size(body);
    node.region = [unit = Box{-half, half}](double value) { return scaled_box(unit, value); };
  }
  node.emit = emit_body(std::move(body));
  return node;
}

constexpr std::array rows{
    NodeKind{"generalized_distance", NodeFamily::distance, "d = (sum |X.n_i|^n)^(1/n), i = 1 ... k",
             "rounded polyhedron with two facets per normal; unbounded when the normals "
             "do not span space",
             "Akleman and Chen 1999", generalized_params, make_generalized}};

}  // namespace

std::span<const NodeKind> generalized_kinds() { return rows; }

}  // namespace blendwright::detail
