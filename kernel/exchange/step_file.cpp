#include "kernel/exchange/step_file.hpp"

namespace blendwright {}
