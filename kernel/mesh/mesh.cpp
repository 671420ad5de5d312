#include "kernel/mesh/mesh.hpp"

namespace blendwright {}
