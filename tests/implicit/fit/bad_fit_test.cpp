// What cannot be fitted, and what is said then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "implicit/fit/scene_fit.hpp"
#include "kernel/base/error.hpp"
#include "tests/implicit/fit/scan.hpp"

namespace blendwright {
namespace {

using test::node;
using testing::HasSubstr;

struct BadFit {
  const char* name;
  SceneSpec scene;
  std::vector<Vec3> points;
  SceneFitOptions options;
  const char* where;
  const char* words;
};

SceneSpec good() { return test::placed_superquadric({1, 1, 1, 2, 2}, Vec3::Zero(), Vec3::UnitZ(), 0.0); }

std::vector<Vec3> some(std::size_t n) {
  test::Rng rng(1);
  return test::scan(good(), Vec3::Zero(), 3.0, {.points = n}, rng);
}

std::vector<BadFit> bad_fits() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec3> with_nan = some(100), one_place(100, Vec3(1, 2, 3));
  with_nan[41].y() = nan;
  SceneSpec torus;
  torus.nodes = {node("ring", "torus", {{"ring", 5.0}, {"tube", 1.0}})};
  torus.solid = "ring";
  SceneSpec missing = good();
  missing.solid = "bodi";
  SceneSpec two = good();
  two.nodes.push_back(node("soft", "soft_object", {{"distance", NodeRef{"body"}}}));
  two.nodes.push_back(node("more", "soft_object", {{"distance", NodeRef{"form"}}}));
  two.nodes.push_back(node("both", "soft_blend", {{"of", std::vector<NodeRef>{{"soft"}, {"more"}}}}));
  two.solid = "both";
  return {
      {"no points", good(), {}, {}, "points", "there are 0, must be at least 11"},
      {"fewer than unknowns", good(), some(10), {}, "points", "there are 10, must be at least 11"},
      {"not a number", good(), with_nan, {}, "points", "the first is point 42"},
      {"one place", good(), one_place, {}, "points", "all at one place"},
      {"another kind", torus, some(100), {}, "/nodes/ring", "is of kind torus, must be lp_metric"},
      {"a scene that is wrong", missing, some(100), {}, "/solid", "bodi"},
      {"unknown that is not there",
       good(),
       some(100),
       {.unknowns = {{"form", "n3", {1, 2}}}},
       "unknowns/0",
       "did you mean \"form/n1\""},
      {"crossed bounds",
       good(),
       some(100),
       {.unknowns = {{"form", "a", {2, 1}}}},
       "unknowns/0",
       "must have a lower bound below its upper one"},
      {"bounds that are not numbers",
       good(),
       some(100),
       {.unknowns = {{"form", "a", {nan, 1}}}},
       "unknowns/0",
       "must have a lower bound below its upper one"},
      {"bounds beyond what is possible",
       good(),
       some(100),
       {.unknowns = {{"form", "n1", {100, 200}}}},
       "unknowns/0",
       "which its bounds leave out"},
      {"robust scale zero", good(), some(100), {.robust_scale = 0.0}, "robust_scale", "must be > 0"},
      {"robust scale not a number", good(), some(100), {.robust_scale = nan}, "robust_scale", "must be > 0"},
      {"no iterations", good(), some(100), {.max_iterations = 0}, "max_iterations", "must be at least 1"},
      {"no single form to lay out",
       two,
       some(100),
       {.start_from_points = true},
       "start_from_points",
       "needs one form"},
  };
}

TEST(BadFit, SaysWhereWhatAndWhatItMustBe) {
  for (const BadFit& bad : bad_fits()) {
    SCOPED_TRACE(bad.name);
    try {
      static_cast<void>(fit_scene(bad.scene, bad.points, bad.options));
      ADD_FAILURE() << "was fitted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.problems().size(), 1u);
      EXPECT_EQ(e.problems()[0].where, bad.where);
      EXPECT_THAT(e.problems()[0].message, HasSubstr(bad.words));
    }
  }
  EXPECT_NO_THROW(static_cast<void>(fit_scene(good(), some(100))));  // negative control
}

TEST(BadFit, SaysAllProblemsAtOnce) {
  try {
    static_cast<void>(fit_scene(
        good(), {}, {.unknowns = {{"form", "n3", {1, 2}}, {"form", "a", {2, 1}}}, .robust_scale = -1.0}));
    ADD_FAILURE() << "was fitted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().size(), 4u);
  }
}

}  // namespace
}  // namespace blendwright
