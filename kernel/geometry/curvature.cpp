#include "kernel/geometry/curvature.hpp"

namespace blendwright {}
