#include "kernel/math/quadrature.hpp"

namespace blendwright {}
