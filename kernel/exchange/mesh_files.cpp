#include "kernel/exchange/mesh_files.hpp"

namespace blendwright {}
