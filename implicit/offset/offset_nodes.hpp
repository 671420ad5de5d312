#pragma once
// Offsets of nodes: which route leads to the offset of what (all lengths in the node's own coordinates). For
// any level with phi = sense (n - surface value): the solid phi >= 0 grows by D > 0.
#include <memory>

#include "implicit/scene/node.hpp"

namespace blendwright::detail {

using NodePtr = std::shared_ptr<const Node>;

/// phi + value.
[[nodiscard]] Node iso_offset(const NodePtr& of, double value);
/// phi(X + distance grad phi/|grad phi|), see normal_offset.hpp.
[[nodiscard]] Node normal_offset(const NodePtr& of, double distance);

/// The largest (smallest for D < 0) phi within |D|. In order of preference:
///   exact distances d: d + D, exact as a solid; the value is a distance only where no nearest point is lost
///   quadrics: quadric_ball.hpp, also placed ones; planes f + D |g|
///   placements that keep shapes: the placed offset
///   min and max: where the extreme of several nodes goes with that of the ball, the extreme of the offsets;
///     complements: the complement of the opposite offset
///   all else: ball_search.hpp
[[nodiscard]] Node ball_offset(const NodePtr& of, double distance, double tolerance);

/// The offset by -r and then by r (by r and then by -r): what balls of the radius r in (outside of) the solid
/// reach (do not reach). Where the first solid has an exact distance in closed form (spheres, tori, boxes,
/// ellipsoids up to their curvature, intersections of half-spaces; unions of them for closings) the second
/// offset is one of that distance, and the result an exact distance. Else two ball offsets: a formula that
/// only has the right sign is never offset as if it were a distance.
[[nodiscard]] Node opening(const NodePtr& of, double radius, double tolerance);
[[nodiscard]] Node closing(const NodePtr& of, double radius, double tolerance);

/// The solid `outer` without the inside of the solid `inner`; both of one level.
[[nodiscard]] Node shell(const NodePtr& outer, const NodePtr& inner);

/// Whether ranges prove that the solid of the node is empty; false: it is not, or this is not known.
[[nodiscard]] bool provably_empty(const Node& node);

/// The tape of a node by itself.
[[nodiscard]] std::shared_ptr<const Tape> tape_of(const Node& node);

}  // namespace blendwright::detail
