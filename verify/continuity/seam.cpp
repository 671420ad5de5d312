#include "verify/continuity/seam.hpp"

namespace blendwright {}
