#include "app/pipeline/write_outputs.hpp"

namespace blendwright {}
