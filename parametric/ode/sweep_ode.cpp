#include "parametric/ode/sweep_ode.hpp"

namespace blendwright {}
