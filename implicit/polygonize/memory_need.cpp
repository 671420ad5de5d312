#include "implicit/polygonize/memory_need.hpp"

#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {

void require_memory(double bytes, std::size_t max_memory, double cell) {
  const auto limit = static_cast<double>(max_memory);
  if (bytes <= limit) return;
  const double mebibyte = 1024.0 * 1024.0;
  throw InputError("max_memory", "is " + number_text(limit / mebibyte, 3) + " MiB, but cells of " +
                                     number_text(cell, 6) + " need about " +
                                     number_text(std::ceil(bytes / mebibyte), 3) + " MiB: a cell of about " +
                                     number_text(1.1 * cell * std::sqrt(bytes / limit), 2) + " would fit");
}

}  // namespace blendwright::detail
