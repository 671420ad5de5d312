#pragma once
// Numbers as text: shortest form that reads back to the same double, independent of locale.
#include <optional>
#include <string>
#include <string_view>

namespace blendwright {

[[nodiscard]] std::string number_text(double x);                      ///< shortest round trip
[[nodiscard]] std::string number_text(double x, int significant);     ///< rounded to `significant` digits
[[nodiscard]] std::string scientific_text(double x, int digits = 2);  ///< "3.1e-08"
/// Rounded to the decimal place that shows `resolution` (> 0), without exponent: "1000.12" for 0.02. A value
/// below half of that place is "0"; shortest form when the resolution is none.
[[nodiscard]] std::string place_text(double x, double resolution);
[[nodiscard]] std::string hash_text(std::string_view bytes);  ///< 64-bit FNV-1a, 16 hex digits
/// The candidate nearest to `word` (edit distance at most a third of its length), for "did you mean".
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word, const std::string* first,
                                                      std::size_t count);

}  // namespace blendwright
