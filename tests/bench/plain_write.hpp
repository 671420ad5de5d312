#pragma once
// The memory speed that grid evaluation is measured against.
#include <cstddef>

namespace blendwright::bench {

/// Writes a number to every element, past the caches, with the widest vectors of this machine.
void plain_write(double* out, std::size_t count);

}  // namespace blendwright::bench
