#pragma once
// From a scene's description to its field.
#include <string>
#include <vector>

#include "implicit/scene/node.hpp"
#include "implicit/scene/node_spec.hpp"

namespace blendwright {

struct Scene {
  ScalarField field;
  LengthUnit unit = LengthUnit::millimetre;
  bool ray_linear = false;     ///< f(origin + a X) = a f(origin + X), a >= 0
  Vec3 origin = Vec3::Zero();  ///< of ray-linearity
  std::size_t nodes = 0, steps = 0;  ///< of the description, of the tape
  std::vector<Problem> warnings;
};

/// Checks the whole description and builds the field of `solid`; nodes that it does not use are checked too.
/// Throws InputError with every problem, in the order of the nodes: unknown kinds and keys (with the nearest
/// name), values of the wrong type or out of bounds, names that are missing or appear twice, cycles, mixed
/// level conventions, and the named errors of scene_error.
[[nodiscard]] Scene build_scene(const SceneSpec& spec);

/// The field of one node by itself (for tests and tools); distances have level one. Throws like build_scene.
[[nodiscard]] std::shared_ptr<const Tape> build_tape(const SceneSpec& spec);

}  // namespace blendwright
