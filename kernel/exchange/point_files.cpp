#include "kernel/exchange/point_files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "kernel/base/error.hpp"
#include "kernel/exchange/csv_text.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/mesh_formats.hpp"

namespace blendwright {
namespace {

class PointReader {
 public:
  void read_line(std::size_t number, std::string_view line) {
    line_ = number;
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
      if (!x) return broken("is " + quoted_field(fields[columns_[k]]) + " where a number must be");
      if (!std::isfinite(*x))
        return broken("is " + quoted_field(fields[columns_[k]]) + ", must be a finite number");
      p[static_cast<Eigen::Index>(k)] = *x;
    }
    points_.push_back(p);
  }

  void too_long(std::size_t line) { problems_.too_long(line, "points"); }

  std::vector<Vec3> finish() {
    problems_.finish();
    return std::move(points_);
  }

 private:
  void broken(std::string message) { problems_.add(line_, std::move(message)); }

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
      text += (i == 0 ? "" : ", ") + quoted_field(fields[i]);
    return text + (fields.size() > 8 ? ", ..." : "");
  }

  std::vector<Vec3> points_;
  LineProblems problems_;
  std::size_t line_ = 0, width_ = 3;
  std::array<std::size_t, 3> columns_{0, 1, 2};
  bool started_ = false;
};

}  // namespace

std::vector<Vec3> read_csv_points(std::istream& in) {
  PointReader reader;
  const std::size_t too_long =
      for_each_line(in, [&](std::size_t line, std::string_view text) { reader.read_line(line, text); });
  if (too_long > 0) reader.too_long(too_long);
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
