#include "kernel/geometry/bspline.hpp"

namespace blendwright {}
