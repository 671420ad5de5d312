#include <array>

#include "implicit/primitives/plane.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/primitive_tables.hpp"

namespace blendwright::detail {
namespace {

constexpr std::array plane_params{
    NodeParam{.type = NodeParam::Type::point, .info = {.name = "normal", .description = "unit normal n"}},
    length_param("a", "distance a from the plane X.n = 0 at which the value is 1")};

template <class Body>
Node make_plane(NodeInputs& in, bool distance) {
  const Vec3 normal = read_direction(in, "normal");
  Node node;
  node.distance = distance;
  node.ray_linear = distance;  // a signed function is homogeneous, but no ray-linear function into [0, inf)
  node.emit = emit_body(Body{normal / read_length(in, "a")});
  return node;
}

constexpr std::array rows{
    NodeKind{"plane", NodeFamily::distance, "f = (X.n)/a",
             "signed distance from a plane (not for potentials)", "Ricci 1973", plane_params,
             [](NodeInputs& in) { return make_plane<Plane>(in, false); }},
    NodeKind{"half_space", NodeFamily::distance, "d = max(0, X.n)/a", "distance from a half of space",
             "Ricci 1973", plane_params, [](NodeInputs& in) { return make_plane<HalfSpace>(in, true); }},
    NodeKind{"slab", NodeFamily::distance, "d = |X.n|/a", "layer around a plane", "Ricci 1973", plane_params,
             [](NodeInputs& in) { return make_plane<Slab>(in, true); }}};

}  // namespace

std::span<const NodeKind> plane_kinds() { return rows; }

}  // namespace blendwright::detail
