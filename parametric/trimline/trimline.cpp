#include "parametric/trimline/trimline.hpp"

namespace blendwright {}
