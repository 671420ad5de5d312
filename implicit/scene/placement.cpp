// Nodes that put another one somewhere else.
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "implicit/scene/node.hpp"

namespace blendwright {
namespace {

using Type = NodeParam::Type;

/// Whether the map turns or mirrors and no more, but for what rounding does to a turn.
bool keeps_lengths(const Eigen::Matrix3d& m) {
  return (m * m.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-14;
}

/// The box, ends of which may be infinite, where the frame's local coordinates come from it; nullopt: not
/// known, for a box without end that is turned.
std::optional<Box> seen_box(const Box& box, const Frame& frame) {
  if (box.finite()) return frame.scene(box);
  if (!frame.matrix.isDiagonal(0.0)) return std::nullopt;
  Box seen;
  constexpr double relative = 8.0 * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 3; ++i) {
    const double factor = frame.matrix(i, i), offset = frame.offset[i];
    const double a = (box.lo[i] - offset) / factor, b = (box.hi[i] - offset) / factor;
    const double room = relative * std::abs(offset / factor);
    const Range ends = Range{std::min(a, b), std::max(a, b)}.widened(relative);
    seen.lo[i] = ends.lo - room;
    seen.hi[i] = ends.hi + room;
  }
  return seen;
}

/// The node `of` in the coordinates that `frame` turns into its own. Values do not change; a ray-linear
/// function stays one, about the point that its origin comes from.
Node placed(const std::shared_ptr<const Node>& of, const Frame& frame) {
  Node node;
  node.level = of->level;
  node.distance = of->distance;
  node.ray_linear = of->ray_linear;
  node.positive = of->positive;
  node.any_value = of->any_value;
  node.weight = of->weight;
  node.exact_distance = of->exact_distance && keeps_lengths(frame.matrix);
  if (of->quadric)
    node.quadric = std::make_shared<const NodeQuadric>(
        NodeQuadric{of->quadric->coefficients, of->quadric->frame.after(frame)});
  node.origin = frame.matrix.inverse().transpose() * (of->origin - frame.offset);
  node.emit = [of, frame](TapeBuilder& tape, const Frame& outer) {
    return of->emit(tape, frame.after(outer));
  };
  node.region = [of, frame](double value) -> std::optional<Box> {
    const std::optional<Box> box = of->region(value);
    return box ? seen_box(*box, frame) : std::nullopt;
  };
  node.under = of;
  node.detail = std::make_shared<const Frame>(frame);
  return node;
}

Node make_affine(NodeInputs& in) {
  const std::vector<std::vector<double>>& rows = in.rows("matrix");
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return placed(in.node("of"), Frame(matrix, Vec3(rows[3][0], rows[3][1], rows[3][2])));
}

/// X = move + scale R Y, hence as row vectors Y = X R / scale - move R / scale.
Node make_place(NodeInputs& in) {
  const Vec3 move = in.has("move") ? in.point("move") : Vec3::Zero();
  const Vec3 axis = in.has("axis") ? in.point("axis") : Vec3::UnitZ();
  const double size = axis.stableNorm();
  if (!(size > 0.0)) {
    in.problem("axis", scene_error::invalid_parameter, "has length 0, must have a direction");
    return {};
  }
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (const double angle = in.number("turn_deg"); angle != 0.0)
    turn = Eigen::AngleAxisd(degrees(angle).value, axis / size).toRotationMatrix();
  else if (in.has("axis"))
    in.warning("axis", "has no effect without turn_deg");
  const Eigen::Matrix3d matrix = turn / in.number("scale");
  const Vec3 offset = -(matrix.transpose() * move);
  if (offset.allFinite()) return placed(in.node("of"), Frame(matrix, offset));
  in.problem("move", scene_error::invalid_parameter, "is too far away for its scale, must be nearer");
  return {};
}

constexpr double any_number = -std::numeric_limits<double>::max();

constexpr NodeParam affine_params[] = {
    {.type = Type::node, .info = {.name = "of", .description = "the node that is placed"}},
    {.type = Type::rows,
     .info = {.name = "matrix",
              .description = "A: the node is seen at Y = [x y z 1] A; last row: translation"},
     .count = 4},
};
constexpr NodeParam place_params[] = {
    {.type = Type::node, .info = {.name = "of", .description = "the node that is placed"}},
    {.type = Type::point,
     .info = {.name = "move", .description = "m: where its origin goes; [0, 0, 0] if not given"},
     .required = false},
    {.type = Type::point,
     .info = {.name = "axis", .description = "u: axis of the turn; [0, 0, 1] if not given"},
     .required = false},
    {.type = Type::number,
     .info = {.name = "turn_deg",
              .description = "t: angle of the turn about the axis, right-handed",
              .min = any_number,
              .min_allowed = true,
              .fallback = 0.0}},
    {.type = Type::number,
     .info = {.name = "scale",
              .description = "s: how many times larger",
              .min = 1e-30,
              .max = 1e30,
              .min_allowed = true,
              .fallback = 1.0}},
};

constexpr std::array kinds = {
    NodeKind{"affine", NodeFamily::placement, "f(Y), Y = [x y z 1] A", "a node seen through an affine map",
             "Wyvill, Guy and Galin 1998", affine_params, make_affine},
    NodeKind{"place", NodeFamily::placement, "f(Y), X = m + s R(u, t) Y", "a node scaled, turned and moved",
             "Wyvill, Guy and Galin 1998", place_params, make_place},
};

}  // namespace

std::span<const NodeKind> placement_kinds() { return kinds; }

}  // namespace blendwright
