#pragma once
// Random boxes and points in them, and what a model's bounds say about the values there.
#include <string>
#include <vector>

#include "kernel/field/scalar_field.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

/// Boxes of every size, from points to 10^6 and more, some flat, next to the origin, on coordinate planes and
/// far away; `where`: what is near (solids lie there).
[[nodiscard]] Box random_box(Rng& rng, const Box& where);
/// Its corners, its centre, and random points of its inside, faces and edges.
[[nodiscard]] std::vector<Vec3> points_in(Rng& rng, const Box& box, int random);

/// Pairs of a box and a point that were looked at, and those that contradict a bound.
struct BoundCount {
  std::size_t pairs = 0, boxes = 0;
  std::size_t range = 0, linear = 0, linear_range = 0, wider = 0, within = 0;
  std::size_t first_order = 0;  ///< boxes with a linear bound that leaves less than a range
  std::vector<std::string> examples;
  [[nodiscard]] std::size_t violations() const { return range + linear + linear_range + wider + within; }
};
/// Checks on one box that every value lies in range(), in linear() and in its range(); that linear() leaves
/// no more than range(); that within() has the same range and its model the same values.
void check_bounds(const ScalarField::Model& model, const Box& box, const std::vector<Vec3>& points,
                  const std::string& what, BoundCount& count);

}  // namespace blendwright::test
