#include "parametric/ode/cardinal_basis.hpp"

namespace blendwright {}
