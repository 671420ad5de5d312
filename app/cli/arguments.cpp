#include "app/cli/arguments.hpp"

#include <charconv>
#include <cmath>
#include <vector>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr double most_memory = 1e18;  // bytes; far beyond any machine, and well within std::size_t

}  // namespace

Box box_argument(const std::string& text) {
  std::vector<double> x;
  const char *at = text.data(), *end = at + text.size();
  for (;;) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) break;
    x.push_back(value);
    at = next;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (x.size() != 6 || at != end)
    throw InputError("", "is " + text + ", must be six numbers x0,y0,z0,x1,y1,z1");
  const Box box{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  for (int k = 0; k < 3; ++k)
    if (!(box.lo[k] < box.hi[k]))
      throw InputError("", "goes from " + number_text(box.lo[k]) + " to " + number_text(box.hi[k]) + " in " +
                               std::string(1, "xyz"[k]) + ", must have a lower corner below the upper one");
  return box;
}

std::size_t memory_argument(const std::string& text) {
  double value = 0.0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string unit(next, text.data() + text.size());
  double factor = 0.0;
  if (unit.empty() || unit == "B") factor = 1.0;
  if (unit == "K" || unit == "KiB") factor = 0x1p10;
  if (unit == "M" || unit == "MiB") factor = 0x1p20;
  if (unit == "G" || unit == "GiB") factor = 0x1p30;
  const double bytes = value * factor;
  if (error != std::errc() || !(bytes >= 1.0 && bytes <= most_memory))
    throw InputError("", "is " + text + ", must be a size such as 500M or 4G");
  return static_cast<std::size_t>(bytes);
}

}  // namespace blendwright
