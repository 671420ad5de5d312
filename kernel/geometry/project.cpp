#include "kernel/geometry/project.hpp"

namespace blendwright {}
