#include "app/pipeline/motion_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <optional>

#include "app/json/object_reader.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/csv_text.hpp"

namespace blendwright {
namespace {

constexpr double unit_length = 1e-6;  // how far a quaternion may be from length 1
constexpr std::size_t absent = static_cast<std::size_t>(-1);

const std::vector<std::string> known_columns{
    "step", "time", "body", "x", "y", "z", "qw", "qx", "qy", "qz", "axis_x", "axis_y", "axis_z", "angle_deg"};
enum ColumnIndex { step, time, body, x, y, z, qw, qx, qy, qz, axis_x, axis_y, axis_z, angle_deg, columns };

/// What a line lacks is told by an exception of this kind, so that reading a field stays one expression.
struct BrokenLine {
  std::string message;
};

class MotionReader {
 public:
  explicit MotionReader(const std::vector<std::string>& bodies) : bodies_(bodies) { at_.fill(absent); }

  void read_line(std::size_t line, std::string_view text) {
    const std::vector<std::string_view> fields = fields_of(text);
    if (!started_) {
      started_ = true;
      good_header_ = read_header(line, fields);
      return;
    }
    if (!good_header_) return;  // nothing can be said of lines without columns
    try {
      read_placement(fields);
    } catch (const BrokenLine& broken) {
      problems_.add(line, broken.message);
    }
  }

  void too_long(std::size_t line) { problems_.too_long(line, "motions"); }

  Motion finish() {
    if (!started_)
      throw InputError("", "is empty; its first line must name the columns, at least " + least());
    problems_.finish();
    if (motion_.steps.empty()) throw InputError("", "has no line besides the names of its columns");
    return std::move(motion_);
  }

 private:
  static std::string least() { return "\"step\", \"body\", \"x\", \"y\", \"z\""; }
  [[nodiscard]] bool has(ColumnIndex c) const { return at_[c] != absent; }
  [[nodiscard]] bool has_turn() const { return has(qw) || has(qx) || has(qy) || has(qz); }
  [[nodiscard]] bool has_axis() const { return has(axis_x) || has(axis_y) || has(axis_z) || has(angle_deg); }

  bool read_header(std::size_t line, const std::vector<std::string_view>& fields) {
    width_ = fields.size();
    bool good = true;
    const auto problem = [&](std::string message) {
      problems_.add(line, std::move(message));
      good = false;
    };
    if (std::all_of(fields.begin(), fields.end(), number_in)) {
      problem("has numbers, must name the columns, at least " + least());
      return false;
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::string name = name_in(fields[i]);
      const auto known = std::find(known_columns.begin(), known_columns.end(), name);
      if (known == known_columns.end()) {
        problem("names the column " + quoted_field(fields[i]) + ", which is not known" +
                suggestion(name, known_columns));
        continue;
      }
      std::size_t& at = at_[static_cast<std::size_t>(known - known_columns.begin())];
      if (at != absent) problem("names the column \"" + name + "\" twice");
      at = i;
    }
    if (!good) return false;
    const auto require = [&](std::initializer_list<ColumnIndex> wanted) {
      for (const ColumnIndex c : wanted)
        if (!has(c)) problem("names no column \"" + known_columns[c] + "\"");
    };
    if (has(step) && has(time)) problem("names both \"step\" and \"time\", must name one");
    if (!has(step) && !has(time)) problem("names no column \"step\" or \"time\"");
    require({body, x, y, z});
    if (has_turn() && has_axis()) problem("names a quaternion and an axis, must name one turn");
    if (has_turn()) require({qw, qx, qy, qz});
    if (has_axis()) require({axis_x, axis_y, axis_z, angle_deg});
    if (has(time)) motion_.at_name = known_columns[time];
    return good;
  }

  double number(const std::vector<std::string_view>& fields, ColumnIndex c) const {
    const std::string_view field = fields[at_[c]];
    const auto value = number_in(field);
    if (!value) throw BrokenLine{known_columns[c] + " is " + quoted_field(field) + ", must be a number"};
    if (!std::isfinite(*value))
      throw BrokenLine{known_columns[c] + " is " + quoted_field(field) + ", must be a finite number"};
    return *value;
  }

  /// Its number, or its name.
  [[nodiscard]] std::size_t body_in(std::string_view field) const {
    if (const auto n = number_in(field)) {
      if (*n >= 1.0 && *n <= static_cast<double>(bodies_.size()) && *n == std::floor(*n))
        return static_cast<std::size_t>(*n) - 1;
      throw BrokenLine{"body is " + quoted_field(field) + ", must be a number from 1 to " +
                       std::to_string(bodies_.size()) + " or a name"};
    }
    std::string_view name = field;
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    const auto found = std::find(bodies_.begin(), bodies_.end(), name);
    if (found != bodies_.end()) return static_cast<std::size_t>(found - bodies_.begin());
    throw BrokenLine{"body is " + quoted_field(field) + ", must be " +
                     (bodies_.size() <= 6
                          ? listed(bodies_) + " or a number"
                          : "the name of a scene or a number from 1 to " + std::to_string(bodies_.size())) +
                     suggestion(name, bodies_)};
  }

  [[nodiscard]] Eigen::Matrix3d turn_in(const std::vector<std::string_view>& fields) const {
    if (has_turn()) {
      const Eigen::Quaterniond q(number(fields, qw), number(fields, qx), number(fields, qy),
                                 number(fields, qz));
      const double length = q.coeffs().stableNorm();
      if (!(std::abs(length - 1.0) <= unit_length))
        throw BrokenLine{"the quaternion has the length " + number_text(length, 9) +
                         ", must be 1 within 1e-06"};
      return q.normalized().toRotationMatrix();
    }
    if (!has_axis()) return Eigen::Matrix3d::Identity();
    const Vec3 axis(number(fields, axis_x), number(fields, axis_y), number(fields, axis_z));
    const double angle = number(fields, angle_deg);
    if (angle == 0.0) return Eigen::Matrix3d::Identity();
    const double largest = axis.cwiseAbs().maxCoeff();
    if (!(largest > 0.0)) throw BrokenLine{"the axis is 0, must be a direction"};
    return Eigen::AngleAxisd(degrees(std::remainder(angle, 360.0)).value, (axis / largest).normalized())
        .toRotationMatrix();
  }

  void read_placement(const std::vector<std::string_view>& fields) {
    if (fields.size() != width_)
      throw BrokenLine{"has " + std::to_string(fields.size()) + (fields.size() == 1 ? " value" : " values") +
                       ", must have " + std::to_string(width_)};
    const double at = number(fields, has(step) ? step : time);
    const std::size_t which = body_in(fields[at_[body]]);
    const RigidMotion motion{turn_in(fields), Vec3(number(fields, x), number(fields, y), number(fields, z))};
    std::vector<MotionStep>& steps = motion_.steps;
    if (!steps.empty() && at < steps.back().at)
      throw BrokenLine{motion_.at_name + " is " + number_text(at) + " after " + number_text(steps.back().at) +
                       ", must ascend"};
    if (steps.empty() || at > steps.back().at) {
      steps.push_back({at, {}});
      seen_.assign(bodies_.size(), false);
    }
    if (seen_[which])
      throw BrokenLine{"places the body \"" + bodies_[which] + "\" a second time at " + motion_.at_name +
                       " " + number_text(at)};
    seen_[which] = true;
    steps.back().placed.emplace_back(which, motion);
  }

  const std::vector<std::string>& bodies_;
  std::array<std::size_t, columns> at_{};
  std::size_t width_ = 0;
  bool started_ = false, good_header_ = false;
  std::vector<bool> seen_;  ///< bodies with a line of this step
  Motion motion_;
  LineProblems problems_;
};

}  // namespace

Motion read_motion(std::istream& in, const std::vector<std::string>& bodies) {
  MotionReader reader(bodies);
  const std::size_t too_long =
      for_each_line(in, [&](std::size_t line, std::string_view text) { reader.read_line(line, text); });
  if (too_long > 0) reader.too_long(too_long);
  return reader.finish();
}

Motion read_motion_file(const std::filesystem::path& file, const std::vector<std::string>& bodies) {
  if (file == "-") return read_motion(std::cin, bodies);
  const auto fail = [&](const std::string& why) -> IoError {
    return IoError(file.string() + ": cannot be read (" + why + ")");
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw fail("it is a folder");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw fail(std::strerror(errno));
  Motion motion = read_motion(in, bodies);
  if (in.bad()) throw fail(std::strerror(errno));
  return motion;
}

}  // namespace blendwright
