#pragma once
// Small scenes of exact solids, and the program in their folder.
#include <limits>

#include "app/json/json_value.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/units.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {

inline std::string ball_node(double radius, double x = 0.0, double y = 0.0, double z = 0.0) {
  const std::string ball = R"({ "kind": "sphere", "radius": )" + number_text(radius) + " }";
  return R"({ "kind": "place", "move": [)" + number_text(x) + ", " + number_text(y) + ", " + number_text(z) +
         R"(], "of": )" + ball + " }";
}
inline std::string ball_scene(double radius, double x = 0.0, double y = 0.0, double z = 0.0,
                              const std::string& unit = "mm") {
  return R"({ "unit": ")" + unit + R"(", "solid": )" + ball_node(radius, x, y, z) + " }";
}

/// A folder with scenes, where the program runs.
class SceneFolder {
 public:
  void add(const std::string& file, const std::string& text) const { write(folder_ / file, text); }
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& before = "") const {
    return run_program(arguments, "cd " + quoted_path(folder_.path()) + "; " + before);
  }
  [[nodiscard]] fs::path operator/(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::vector<std::string> files() const { return folder_.files(); }

 private:
  Folder folder_;
};

inline double number_at(const JsonValue& object, std::string_view key) {
  return object.find(key)->number() ? *object.find(key)->number() : std::numeric_limits<double>::quiet_NaN();
}
inline std::string text_at(const JsonValue& object, std::string_view key) {
  return *object.find(key)->text();
}
inline Vec3 point_at(const JsonValue& object, std::string_view key) {
  const JsonValue::Array& x = *object.find(key)->items();
  return {*x[0].number(), *x[1].number(), *x[2].number()};
}

inline std::size_t widest(const std::string& text) {
  std::size_t best = 0, at = 0;
  for (std::size_t i = 0; i <= text.size(); ++i)
    if (i == text.size() || text[i] == '\n') {
      best = std::max(best, i - at);
      at = i + 1;
    }
  return best;
}

}  // namespace blendwright::test
