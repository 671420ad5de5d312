#include "kernel/brep/step_part.hpp"

namespace blendwright {}
