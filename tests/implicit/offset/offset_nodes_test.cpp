// What scenes with offsets are refused for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "implicit/scene/scene.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using ::testing::HasSubstr;

struct Bad {
  const char* kind;
  Values values;
  const char* where;
  const char* says;
};

std::vector<Problem> problems_with(const std::string& kind, Values values, const std::string& of = "egg") {
  if (!values.contains("of") && !of.empty()) values["of"] = ref(of);
  return problems_of(
      scene_of({part("profile", "lp_profile", {{"a", 1.0}, {"b", 1.0}, {"n", 2.0}}), ball("distance", 1.0),
                part("egg", "ellipsoid_quadric", {{"a", 1.0}, {"b", 2.0}, {"c", 3.0}}),
                part("x", kind, std::move(values))}));
}

TEST(OffsetNodes, RefuseBadInput) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const std::vector<Bad> cases{
      {"iso_offset", {{"value", nan}}, "/nodes/x/value", ""},
      {"iso_offset", {}, "/nodes/x/value", ""},
      {"iso_offset", {{"value", std::string("0.1")}}, "/nodes/x/value", "-1e+30"},
      {"iso_offset", {{"value", 0.1}, {"distance", 0.1}}, "/nodes/x/distance", ""},
      {"normal_offset", {{"distance", nan}}, "/nodes/x/distance", ""},
      {"normal_offset", {{"distance", infinity}}, "/nodes/x/distance", ""},
      {"normal_offset", {}, "/nodes/x/distance", ""},
      {"ball_offset", {{"distance", nan}}, "/nodes/x/distance", ""},
      {"ball_offset", {{"distance", 1e31}}, "/nodes/x/distance", "1e+30"},
      {"ball_offset", {{"distance", 0.1}, {"tolerance", 0.0}}, "/nodes/x/tolerance", "1e-13"},
      {"ball_offset", {{"distance", 0.1}, {"tolerance", -1e-6}}, "/nodes/x/tolerance", "1e-13"},
      {"ball_offset", {{"distance", 0.1}, {"tolerance", 0.5}}, "/nodes/x/tolerance", "0.1"},
      {"ball_offset", {{"distance", 0.1}, {"of", ref("profile")}}, "/nodes/x/of", "profile"},
      {"ball_offset", {{"distance", 0.1}, {"of", ref("distance")}}, "/nodes/x/of", "LevelMismatch"},
      {"iso_offset", {{"value", 0.1}, {"of", ref("distance")}}, "/nodes/x/of", "convert"},
      {"normal_offset", {{"distance", 0.1}, {"of", ref("distance")}}, "/nodes/x/of", "distance"},
      {"ball_offset", {{"distance", 0.1}, {"of", ref("nobody")}}, "/nodes/x/of", "nobody"},
      {"ball_offset", {{"distance", 0.1}, {"of", ref("x")}}, "/nodes/x/of", "cycle"},
      {"shell", {{"inner", 0.0}, {"outer", 0.0}}, "/nodes/x/inner", "thickness"},
      {"shell", {{"inner", -0.1}, {"outer", 0.2}}, "/nodes/x/inner", ""},
      {"shell", {{"inner", 0.1}}, "/nodes/x/outer", ""},
      {"shell", {{"inner", 0.1}, {"outer", 0.1}, {"of", ref("distance")}}, "/nodes/x/of", "solid"},
      {"opening", {{"radius", -0.1}}, "/nodes/x/radius", ""},
      {"opening", {{"radius", 0.0}}, "/nodes/x/radius", ""},
      {"opening", {{"radius", nan}}, "/nodes/x/radius", ""},
      {"closing", {{"radius", -1.0}}, "/nodes/x/radius", ""},
      {"closing", {{"radius", 0.1}, {"of", ref("profile")}}, "/nodes/x/of", "profile"},
      {"closing", {{"radius", 0.1}, {"of", ref("distance")}}, "/nodes/x/of", "solid"},
  };
  for (const Bad& bad : cases) {
    SCOPED_TRACE(std::string(bad.kind) + " " + bad.where + " " + bad.says);
    const std::vector<Problem> found = problems_with(bad.kind, bad.values);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front().where, bad.where);
    EXPECT_THAT(found.front().message, HasSubstr(bad.says));
  }
  EXPECT_TRUE(problems_with("ball_offset", {{"distance", 0.1}, {"tolerance", 1e-9}}).empty());
}

TEST(OffsetNodes, AreNotStackedWithoutEnd) {
  const auto stack = [](int depth) {
    std::vector<NodeSpec> nodes{part("o0", "ellipsoid_quadric", {{"a", 1.0}, {"b", 2.0}, {"c", 3.0}})};
    for (int i = 1; i <= depth; ++i)
      nodes.push_back(part("o" + std::to_string(i), "iso_offset",
                           {{"of", ref("o" + std::to_string(i - 1))}, {"value", 0.01}}));
    return problems_of(scene_of(std::move(nodes)));
  };
  EXPECT_TRUE(stack(16).empty());
  const std::vector<Problem> found = stack(17);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found.front().message, HasSubstr("17"));
}

// A chain of offsets is as long as it is, in time too.
TEST(OffsetNodes, AreMadeOnceHoweverOftenTheyAreUsed) {
  std::vector<NodeSpec> nodes{part("o0", "ellipsoid_quadric", {{"a", 1.0}, {"b", 2.0}, {"c", 3.0}})};
  for (int i = 1; i <= 6; ++i)
    nodes.push_back(part("o" + std::to_string(i), "normal_offset",
                         {{"of", ref("o" + std::to_string(i - 1))}, {"distance", 0.01}}));
  const Scene scene = build_scene(scene_of(std::move(nodes)));
  EXPECT_EQ(scene.steps, 1u);
  EXPECT_NEAR(scene.field.value({1.06, 0, 0}), 0.0, 1e-12);
}

}  // namespace
}  // namespace blendwright::test
