#include "kernel/brep/shape.hpp"

namespace blendwright {}
