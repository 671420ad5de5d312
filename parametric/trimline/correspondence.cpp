#include "parametric/trimline/correspondence.hpp"

namespace blendwright {}
