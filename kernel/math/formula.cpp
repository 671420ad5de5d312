#include "kernel/math/formula.hpp"

namespace blendwright {}
