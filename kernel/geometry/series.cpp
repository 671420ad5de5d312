#include "kernel/geometry/series.hpp"

namespace blendwright {}
