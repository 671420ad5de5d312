#include <algorithm>
#include <array>
#include <type_traits>

#include "implicit/primitives/plane.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/primitive_tables.hpp"

namespace blendwright::detail {
namespace {

constexpr std::array plane_params{
    NodeParam{.type = NodeParam::Type::point, .info = {.name = "normal", .description = "unit normal n"}},
    length_param("a", "distance a from the plane X.n = 0 at which the value is 1")};

/// Where X.n <= reach, and >= -reach on both sides: a box without end when n is an axis. Several of them
/// have a bounded box in common.
std::optional<Box> layer(const Vec3& normal, double reach, bool both_sides) {
  int axis = 0;
  if (normal.cwiseAbs().maxCoeff(&axis) < normal.cwiseAbs().sum()) return std::nullopt;
  const Range all = Range::everything(), inner = Range{reach, reach}.widened(range_slack);
  Box box{Vec3::Constant(all.lo), Vec3::Constant(all.hi)};
  if (both_sides || normal[axis] > 0.0) box.hi[axis] = inner.hi;
  if (both_sides || normal[axis] < 0.0) box.lo[axis] = -inner.hi;
  return box;
}

template <class Body>
Node make_plane(NodeInputs& in, bool distance) {
  const Vec3 normal = read_direction(in, "normal");
  const double a = read_length(in, "a");
  Node node;
  node.distance = distance;
  node.region = [normal, a, distance](double value) {
    return layer(normal, a * (distance ? std::max(0.0, value) : value), std::is_same_v<Body, Slab>);
  };
  node.ray_linear = distance;  // a signed function is homogeneous, but no ray-linear function into [0, inf)
  node.emit = emit_body(Body{normal / a});
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
