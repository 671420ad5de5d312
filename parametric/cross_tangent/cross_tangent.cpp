#include "parametric/cross_tangent/cross_tangent.hpp"

namespace blendwright {}
