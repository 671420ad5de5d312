#pragma once
// One primitive by itself: the node that its row makes, and its tape.
#include <memory>
#include <string>
#include <vector>

#include "implicit/scene/node.hpp"
#include "implicit/scene/node_spec.hpp"
#include "kernel/base/error.hpp"

namespace blendwright::test {

struct MadePrimitive {
  Node node;
  std::vector<Problem> problems, warnings;  ///< `where` is relative to the node
  std::shared_ptr<const Tape> tape;         ///< null after problems, and for profiles
};

/// Makes the node scene.solid, and what it refers to.
[[nodiscard]] MadePrimitive make_primitive(const SceneSpec& scene);

/// A primitive to test: every row of distance_kinds() has at least one.
struct PrimitiveSample {
  std::string id;
  SceneSpec scene;
  Box where;  ///< around d = 1, or a good part of it
};
[[nodiscard]] const std::vector<PrimitiveSample>& primitive_samples();
/// The sample's own node.
[[nodiscard]] const NodeSpec& solid_of(const SceneSpec& scene);

/// Values of a tape at points, by its vector kernels.
[[nodiscard]] std::vector<double> values_at(const Tape& tape, const std::vector<Vec3>& points);
[[nodiscard]] double value_at(const Tape& tape, const Vec3& point);
[[nodiscard]] Vec3 gradient_at(const Tape& tape, const Vec3& point);

}  // namespace blendwright::test
