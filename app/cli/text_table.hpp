#pragma once
// Columns of text, aligned.
#include <cstddef>
#include <string>
#include <vector>

namespace blendwright {

using TextRows = std::vector<std::vector<std::string>>;

/// Every row indented by two blanks, columns two blanks apart, no blanks at line ends.
[[nodiscard]] std::string aligned(const TextRows& rows);
/// The longest line.
[[nodiscard]] std::size_t widest_line(const std::string& text);
/// "1 blend", "2 blends".
[[nodiscard]] std::string counted(std::size_t n, const std::string& what);

}  // namespace blendwright
