#include "kernel/math/dense_solve.hpp"

namespace blendwright {}
