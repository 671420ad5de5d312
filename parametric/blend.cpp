#include "parametric/blend.hpp"

namespace blendwright {}
