#include "kernel/primitives/primary.hpp"

namespace blendwright {}
