#include "implicit/scene/scene.hpp"

#include <stdexcept>

namespace blendwright {

Scene build_scene(const SceneSpec&) { throw std::logic_error("scene"); }
std::shared_ptr<const Tape> build_tape(const SceneSpec&) { throw std::logic_error("scene"); }

}  // namespace blendwright
