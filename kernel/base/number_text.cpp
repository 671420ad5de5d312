#include "kernel/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
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

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replace});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string number_text(double x) { return text(x); }
std::string number_text(double x, int significant) {
  return text(x, std::chars_format::general, significant);
}
std::string scientific_text(double x, int digits) {
  return text(x, std::chars_format::scientific, digits - 1);
}

std::string hash_text(std::string_view bytes) {
  std::uint64_t h = 14695981039346656037ull;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  std::string hex(16, '0');
  for (std::size_t i = 16; i-- > 0; h >>= 4) hex[i] = "0123456789abcdef"[h & 15];
  return hex;
}

std::optional<std::string> nearest_word(std::string_view word, const std::string* first, std::size_t count) {
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
