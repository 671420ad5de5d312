#pragma once
// Private to files of lines of numbers: what a line, a field and a number are, and how broken lines are told.
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/base/error.hpp"

namespace blendwright {

/// Without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// Between commas or semicolons where there are any, else between blanks; all trimmed.
[[nodiscard]] std::vector<std::string_view> fields_of(std::string_view line);
/// The whole field as a number; infinite when it is beyond doubles.
[[nodiscard]] std::optional<double> number_in(std::string_view field);
/// The name in a header: without quotes, in lower case.
[[nodiscard]] std::string name_in(std::string_view field);
/// In quotes, for messages: cut when long, control characters as "?".
[[nodiscard]] std::string quoted_field(std::string_view field);
/// A text as a field of a line to be written: in quotes where it has commas, quotes or line ends.
[[nodiscard]] std::string csv_field(const std::string& text);

/// Calls `use` with the number (from 1) of every line and what it says, trimmed, but not for empty lines and
/// those that start with #. Returns 0, or the number of a line that is longer than a megabyte: nothing was
/// read from there on.
[[nodiscard]] std::size_t for_each_line(std::istream& in,
                                        const std::function<void(std::size_t, std::string_view)>& use);

/// What is wrong with lines: the first 20 are named ("line 7"), the others counted.
class LineProblems {
 public:
  void add(std::size_t line, std::string message);
  /// Of the first line that is too long to be one of numbers.
  void too_long(std::size_t line, const std::string& what_file);
  [[nodiscard]] bool empty() const { return count_ == 0; }
  /// Throws InputError when there are any.
  void finish();

 private:
  std::vector<Problem> problems_;
  std::size_t count_ = 0;
};

}  // namespace blendwright
