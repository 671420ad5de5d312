#include "kernel/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

namespace blendwright {
namespace {

template <class... Format>
std::string text(double x, Format... format) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, format...).ptr;
  return {buffer.data(), end};
}

/// Insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] =
          std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string number_text(double x) { return text(x); }
std::string number_text(double x, int significant) {
  return text(x, std::chars_format::general, significant);
}
std::string scientific_text(double x, int digits) {
  return text(x, std::chars_format::scientific, digits - 1);
}

std::string place_text(double x, double resolution) {
  if (!std::isfinite(x) || !(resolution > 0.0) || !std::isfinite(resolution)) return number_text(x);
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(resolution))), 0, 15);
  // Longer than any reader follows: an exponent then says more.
  if (!(std::abs(x) < 1e15)) return number_text(x, 6);
  std::string digits = text(x, std::chars_format::fixed, decimals);
  if (digits.find('.') != std::string::npos) digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits == "-0" ? "0" : digits;
}

std::string hash_text(std::string_view bytes) {
  std::uint64_t h = 14695981039346656037ull;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  std::string hex(16, '0');
  for (std::size_t i = 16; i-- > 0; h >>= 4) hex[i] = "0123456789abcdef"[h & 15];
  return hex;
}

std::optional<std::string> nearest_word(std::string_view word, const std::string* first, std::size_t count) {
  if (word.size() > 64) return std::nullopt;  // no name is that long
  std::optional<std::string> best;
  std::size_t limit = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t d = edit_distance(word, first[i]);
    if (d < limit) {
      limit = d;
      best = first[i];
    }
  }
  return best;
}

}  // namespace blendwright
