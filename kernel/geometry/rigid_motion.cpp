#include "kernel/geometry/rigid_motion.hpp"

namespace blendwright {}
