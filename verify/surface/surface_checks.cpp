#include "verify/surface/surface_checks.hpp"

namespace blendwright {}
