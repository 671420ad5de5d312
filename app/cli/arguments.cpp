#include "app/cli/arguments.hpp"

#include <charconv>
#include <cmath>
#include <vector>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr double most_memory = 1e18;  // bytes; far beyond any machine, and well within std::size_t

/// Finite numbers separated by commas; nothing when the text is anything else.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> x;
  const char *at = text.data(), *end = at + text.size();
  for (;;) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) return {};
    x.push_back(value);
    at = next;
    if (at == end) return x;
    if (*at != ',') return {};
    ++at;
  }
}

}  // namespace

Box box_argument(const std::string& text) {
  const std::vector<double> x = numbers_in(text);
  if (x.size() != 6) throw InputError("", "is " + text + ", must be six numbers x0,y0,z0,x1,y1,z1");
  const Box box{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  for (int k = 0; k < 3; ++k)
    if (!(box.lo[k] < box.hi[k]))
      throw InputError("", "goes from " + number_text(box.lo[k]) + " to " + number_text(box.hi[k]) + " in " +
                               std::string(1, "xyz"[k]) + ", must have a lower corner below the upper one");
  return box;
}

std::array<double, 2> shell_argument(const std::string& text) {
  const std::vector<double> x = numbers_in(text);
  if (x.size() != 2)
    throw InputError("", "is " + text + ", must be two lengths inner,outer: a wall inward and outward");
  for (const double length : x)
    if (length < 0.0) throw InputError("", "is " + text + ", must be two lengths >= 0");
  return {x[0], x[1]};
}

Vec3 direction_argument(const std::string& text) {
  const std::vector<double> x = numbers_in(text);
  if (x.size() != 3) throw InputError("", "is " + text + ", must be three numbers x,y,z");
  const double length = Vec3(x[0], x[1], x[2]).stableNorm();
  if (!(length > 0.0)) throw InputError("", "is " + text + ", must have a direction");
  return Vec3(x[0], x[1], x[2]) / length;
}

std::array<int, 2> size_argument(const std::string& text) {
  std::array<int, 2> size{};
  const char* end = text.data() + text.size();
  const auto [middle, first] = std::from_chars(text.data(), end, size[0]);
  const bool cross = first == std::errc() && middle != end && (*middle == 'x' || *middle == 'X');
  const auto [last, second] = std::from_chars(cross ? middle + 1 : end, end, size[1]);
  constexpr int least = 64, most = 4096;
  const auto wrong = [](int pixels) { return pixels < least || pixels > most; };
  if (!cross || second != std::errc() || last != end || wrong(size[0]) || wrong(size[1]))
    throw InputError("", "is " + text + ", must be width and height in pixels as in 1280x960, each from " +
                             std::to_string(least) + " to " + std::to_string(most));
  return size;
}

std::pair<int, double> plane_argument(const std::string& text) {
  const std::size_t axis = text.empty() ? std::string::npos : std::string("xyz").find(text[0]);
  const std::vector<double> at =
      text.size() > 2 && text[1] == '=' ? numbers_in(text.substr(2)) : std::vector<double>();
  if (axis == std::string::npos || at.size() != 1)
    throw InputError("", "is " + text + ", must be an axis and a place as in z=1.5");
  return {static_cast<int>(axis), at[0]};
}

Interval range_argument(const std::string& text) {
  const std::vector<double> x = numbers_in(text);
  if (x.size() != 2) throw InputError("", "is " + text + ", must be two numbers lo,hi");
  if (!(x[0] < x[1])) throw InputError("", "is " + text + ", must have the lower number first");
  return {x[0], x[1]};
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

std::optional<FairnessOptions> fairness_of(bool wanted, const std::string& pull) {
  if (!wanted) return std::nullopt;
  FairnessOptions options;
  if (!pull.empty()) options.pull = direction_argument(pull);
  return options;
}

std::string command_line(int argc, const char* const* argv) {
  std::string line = "blendwright";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789-_=+.,:/@%") == std::string::npos;
    line += ' ';
    if (plain) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) {
      if (c == '\'')
        line += "'\\''";
      else
        line += c;
    }
    line += '\'';
  }
  return line;
}

}  // namespace blendwright
