#include "parametric/fit/blend_fit.hpp"

namespace blendwright {}
