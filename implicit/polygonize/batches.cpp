#include "implicit/polygonize/batches.hpp"

#include <algorithm>

#include "kernel/base/parallel_for.hpp"

namespace blendwright::detail {

void for_each_in_batches(std::size_t count, const Progress& progress, double from, double to,
                         std::string_view stage, const std::function<void(std::size_t)>& body) {
  const std::size_t batch = std::clamp<std::size_t>(count / 20, 128, 4096);
  for (std::size_t first = 0; first < count; first += batch) {
    progress.at(from + (to - from) * static_cast<double>(first) / static_cast<double>(count), stage);
    parallel_for(std::min(batch, count - first), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) body(first + n);
    });
  }
}

}  // namespace blendwright::detail
