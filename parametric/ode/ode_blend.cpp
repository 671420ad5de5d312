#include "parametric/ode/ode_blend.hpp"

namespace blendwright {}
