#pragma once
// Private: the state of the viewer as a line of JSON.
#include <string>

#include "app/view/window/controller.hpp"
#include "app/view/window/window.hpp"

namespace blendwright {

[[nodiscard]] std::string view_state_line(const Controller& controller, const std::string& after,
                                          const WindowTimes* times);

}  // namespace blendwright
