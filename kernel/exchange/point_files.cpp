#include "kernel/exchange/point_files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "kernel/base/error.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/mesh_formats.hpp"

namespace blendwright {
namespace {

constexpr std::size_t most_lines_named = 20, longest_line = std::size_t{1} << 20, longest_quote = 40;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_separator(char c) { return c == ',' || c == ';'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Between commas or semicolons where there are any, else between blanks.
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

std::string quoted(std::string_view text) {
  std::string shown(1, '"');
  for (const char c : text.substr(0, longest_quote)) shown += c < ' ' || c == 0x7f ? '?' : c;
  if (text.size() > longest_quote) shown += "...";
  return shown += '"';
}

/// The name in a header: without quotes, in lower case.
std::string name_in(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  std::string name(trimmed(field));
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

class PointReader {
 public:
  void read_line(std::string_view line) {
    ++line_;
    if (line_ == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
    line = trimmed(line);
    if (line.empty() || line.front() == '#') return;
    const std::vector<std::string_view> fields = fields_of(line);
    const bool first = !started_;
    started_ = true;
    if (first && std::none_of(fields.begin(), fields.end(), number_in)) return read_header(fields);
    if (fields.size() != width_)
      return broken("has " + std::to_string(fields.size()) + (fields.size() == 1 ? " value" : " values") +
                    ", must have " + std::to_string(width_));
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = number_in(fields[columns_[k]]);
      if (!x) return broken("is " + quoted(fields[columns_[k]]) + " where a number must be");
      if (!std::isfinite(*x))
        return broken("is " + quoted(fields[columns_[k]]) + ", must be a finite number");
      p[static_cast<Eigen::Index>(k)] = *x;
    }
    points_.push_back(p);
  }

  void too_long() {
    ++line_;
    broken("is longer than " + std::to_string(longest_line >> 20) + " MB; is this a file of points?");
  }

  std::vector<Vec3> finish() {
    if (broken_ > problems_.size())
      problems_.push_back({"", std::to_string(broken_ - problems_.size()) + " more broken lines"});
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return std::move(points_);
  }

 private:
  void broken(std::string message) {
    ++broken_;
    if (problems_.size() < most_lines_named)
      problems_.push_back({"line " + std::to_string(line_), std::move(message)});
  }

  void read_header(const std::vector<std::string_view>& fields) {
    constexpr std::array names{"x", "y", "z"};
    width_ = fields.size();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = std::find_if(fields.begin(), fields.end(),
                                   [&](std::string_view field) { return name_in(field) == names[k]; });
      if (at == fields.end()) throw InputError("line " + std::to_string(line_), missing(names[k], fields));
      columns_[k] = static_cast<std::size_t>(at - fields.begin());
    }
  }

  static std::string missing(const char* name, const std::vector<std::string_view>& fields) {
    std::string text = std::string("names no column \"") + name + "\"; it has ";
    for (std::size_t i = 0; i < std::min<std::size_t>(fields.size(), 8); ++i)
      text += (i == 0 ? "" : ", ") + quoted(fields[i]);
    return text + (fields.size() > 8 ? ", ..." : "");
  }

  std::vector<Vec3> points_;
  std::vector<Problem> problems_;
  std::size_t line_ = 0, broken_ = 0, width_ = 3;
  std::array<std::size_t, 3> columns_{0, 1, 2};
  bool started_ = false;
};

}  // namespace

std::vector<Vec3> read_csv_points(std::istream& in) {
  PointReader reader;
  std::string rest;
  std::array<char, 65536> block;
  while (in.read(block.data(), block.size()), in.gcount() > 0) {
    rest.append(block.data(), static_cast<std::size_t>(in.gcount()));
    std::size_t start = 0;
    for (std::size_t end; (end = rest.find('\n', start)) != std::string::npos; start = end + 1)
      reader.read_line(std::string_view(rest).substr(start, end - start));
    rest.erase(0, start);
    if (rest.size() > longest_line) {
      reader.too_long();
      return reader.finish();
    }
  }
  if (!rest.empty()) reader.read_line(rest);
  return reader.finish();
}

std::vector<Vec3> read_points(const std::filesystem::path& file) {
  if (lower_case_extension(file) == ".vtp") return read_vtp_points(file);
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail_reading(file, "it is a folder");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail_reading(file, std::strerror(errno));
  std::vector<Vec3> points = read_csv_points(in);
  if (in.bad()) fail_reading(file, std::strerror(errno));
  return points;
}

}  // namespace blendwright
