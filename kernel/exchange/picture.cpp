#include "kernel/exchange/picture.hpp"

namespace blendwright {}
