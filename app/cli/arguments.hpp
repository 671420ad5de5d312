#pragma once
// Values of flags that are more than a number or a word.
#include <cstddef>
#include <string>

#include "kernel/field/range.hpp"

namespace blendwright {

/// "x0,y0,z0,x1,y1,z1" with x0 < x1, y0 < y1, z0 < z1. Throws InputError: what it is and what it must be.
[[nodiscard]] Box box_argument(const std::string& text);
/// Bytes: a number, with K, M or G for 1024, 1024^2, 1024^3. Throws InputError.
[[nodiscard]] std::size_t memory_argument(const std::string& text);

}  // namespace blendwright
