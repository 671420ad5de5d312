#include "kernel/geometry/spline_interpolation.hpp"

namespace blendwright {}
