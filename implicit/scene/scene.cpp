#include "implicit/scene/scene.hpp"

#include "implicit/scene/scene_builder.hpp"

namespace blendwright {

Scene build_scene(const SceneSpec& spec) {
  detail::SceneBuilder builder(spec);
  std::vector<std::string> members = builder.mark_members();
  std::shared_ptr<const Tape> tape = builder.tape();
  const std::size_t steps = tape->size();
  const Node& solid = builder.solid();
  return {ScalarField(std::move(tape), solid.level, builder.bounds(), std::move(members)),
          spec.unit,
          solid.ray_linear,
          solid.origin,
          spec.nodes.size(),
          steps,
          builder.warnings()};
}

std::shared_ptr<const Tape> build_tape(const SceneSpec& spec) { return detail::SceneBuilder(spec).tape(); }

}  // namespace blendwright
