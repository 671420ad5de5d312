#include "implicit/polygonize/memory_need.hpp"

#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {

namespace {

/// "1.5 GiB", "100 MiB": two or three digits that can be read.
std::string size_text(double bytes) {
  constexpr double mebibyte = 1024.0 * 1024.0, gibibyte = 1024.0 * mebibyte;
  if (bytes < 0.95 * gibibyte) return number_text(std::ceil(bytes / mebibyte)) + " MiB";
  return number_text(std::ceil(10.0 * bytes / gibibyte) / 10.0) + " GiB";
}

}  // namespace

void require_memory(double bytes, std::size_t max_memory, double cell) {
  const auto limit = static_cast<double>(max_memory);
  if (bytes <= limit) return;
  throw InputError("max_memory", "is " + size_text(limit) + ", but cells of " + number_text(cell, 6) +
                                     " need about " + size_text(bytes) + ": a cell of about " +
                                     number_text(1.1 * cell * std::sqrt(bytes / limit), 2) + " would fit");
}

}  // namespace blendwright::detail
