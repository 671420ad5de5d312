#include "kernel/exchange/csv_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace blendwright {
namespace {

constexpr std::size_t most_lines_named = 20, longest_line = std::size_t{1} << 20, longest_quote = 40;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_separator(char c) { return c == ',' || c == ';'; }

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  const bool separated = std::any_of(line.begin(), line.end(), is_separator);
  std::vector<std::string_view> fields;
  for (;;) {
    line = trimmed(line);
    std::size_t end = 0;
    while (end < line.size() && !(separated ? is_separator(line[end]) : is_blank(line[end]))) ++end;
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == line.size()) return fields;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> number_in(std::string_view field) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  double x = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), x);
  if (field.empty() || end != field.data() + field.size()) return std::nullopt;
  // A number beyond the range of doubles is not finite either.
  if (error != std::errc())
    return error == std::errc::result_out_of_range ? std::optional(HUGE_VAL) : std::nullopt;
  return x;
}

std::string name_in(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  std::string name(trimmed(field));
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

std::string quoted_field(std::string_view field) {
  std::string shown(1, '"');
  for (const char c : field.substr(0, longest_quote)) shown += c < ' ' || c == 0x7f ? '?' : c;
  if (field.size() > longest_quote) shown += "...";
  return shown += '"';
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted += '"';
}

std::size_t for_each_line(std::istream& in, const std::function<void(std::size_t, std::string_view)>& use) {
  std::size_t count = 0;
  const auto take = [&](std::string_view line) {
    ++count;
    if (count == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
    line = trimmed(line);
    if (!line.empty() && line.front() != '#') use(count, line);
  };
  std::string rest;
  std::array<char, 65536> block;
  while (in.read(block.data(), block.size()), in.gcount() > 0) {
    rest.append(block.data(), static_cast<std::size_t>(in.gcount()));
    std::size_t start = 0;
    for (std::size_t end; (end = rest.find('\n', start)) != std::string::npos; start = end + 1)
      take(std::string_view(rest).substr(start, end - start));
    rest.erase(0, start);
    if (rest.size() > longest_line) return count + 1;
  }
  if (!rest.empty()) take(rest);
  return 0;
}

void LineProblems::add(std::size_t line, std::string message) {
  ++count_;
  if (problems_.size() < most_lines_named)
    problems_.push_back({"line " + std::to_string(line), std::move(message)});
}

void LineProblems::too_long(std::size_t line, const std::string& what_file) {
  add(line,
      "is longer than " + std::to_string(longest_line >> 20) + " MB; is this a file of " + what_file + "?");
}

void LineProblems::finish() {
  if (count_ > problems_.size())
    problems_.push_back({"", std::to_string(count_ - problems_.size()) + " more broken lines"});
  if (!problems_.empty()) throw InputError(std::move(problems_));
}

}  // namespace blendwright
