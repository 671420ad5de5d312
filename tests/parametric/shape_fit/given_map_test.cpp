// Correspondences that are given as a map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/base/error.hpp"
#include "parametric/trimline/given_map.hpp"
#include "tests/parametric/shape_fit/fit_scenes.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

CorrespondenceSpec mapped(std::vector<LawPoint> points) {
  CorrespondenceSpec spec;
  spec.rule = CorrespondenceRule::mapped;
  spec.map = std::move(points);
  return spec;
}

TEST(GivenMap, JoinsTheFractionsThatItNames) {
  for (const FitScene& scene : {free_surfaces(), open_panel()}) {
    const bool closed = scene.line0.domain().closed;
    CorrespondenceSpec even;
    even.reverse = false;
    if (closed) even.seam_offset = 0.1;
    CorrespondenceSpec spec = mapped(closed ? std::vector<LawPoint>{{0.1, 0.13}, {0.6, 0.55}}
                                            : std::vector<LawPoint>{{0.3, 0.34}, {0.7, 0.66}});
    spec.reverse = even.reverse;
    spec.seam_offset = even.seam_offset;
    const Correspondence plain = correspond(scene.line0, scene.line1, even);
    const Correspondence with = correspond(scene.line0, scene.line1, spec);
    for (const LawPoint& p : spec.map)
      EXPECT_LE((with.line1.jet(p.t).C() - plain.line1.jet(p.value).C()).norm(), 1e-12);
    for (const double t : {0.0, 0.45, 0.8})
      EXPECT_LE((with.line0.jet(t).C() - plain.line0.jet(t).C()).norm(), 1e-13);
    // Derivatives along the new parameter are those of the points.
    const auto point = [&](double t) { return with.line1.jet(t).C(); };
    EXPECT_LE((difference(point, 0.45, 1e-3) - with.line1.jet(0.45).C1()).norm(), 1e-7);
  }
}

TEST(GivenMap, OfOnePointShiftsAClosedLine) {
  const FitScene scene = free_surfaces();
  CorrespondenceSpec spec = mapped({{0.0, 0.25}});
  spec.seam_offset = 0.0;
  spec.reverse = false;
  CorrespondenceSpec offset;
  offset.seam_offset = 0.25;
  offset.reverse = false;
  const Correspondence a = correspond(scene.line0, scene.line1, spec),
                       b = correspond(scene.line0, scene.line1, offset);
  EXPECT_NEAR(a.seam_offset, 0.25, 1e-15);
  for (const double t : {0.0, 0.3, 0.9}) EXPECT_LE((a.line1.jet(t).C() - b.line1.jet(t).C()).norm(), 1e-12);
}

TEST(GivenMap, ThatDoesNotIncreaseIsRefused) {
  struct Case {
    std::vector<LawPoint> map;
    bool closed;
    std::string where, words;
  };
  for (const Case& c :
       std::vector<Case>{{{}, true, "map", "is empty"},
                         {{{0.5, 0.4}, {0.2, 0.6}}, true, "map/1", "must come after"},
                         {{{1.5, 0.4}}, true, "map/0", "must lie in [0, 1]"},
                         {{{0.0, 0.0}, {1.0, 1.0}}, true, "map/1", "leave it out"},
                         {{{0.2, 0.6}, {0.5, 0.4}}, true, "map/1", "above that of the point before"},
                         {{{0.0, 0.0}, {0.5, 1.2}}, true, "map/1", "a turn on"},
                         {{{0.0, 0.2}}, false, "map/0", "ends belong together"},
                         {{{0.5, 1.2}}, false, "map/0", "must lie in (0, 1)"},
                         {{{0.3, 0.1}, {0.31, 0.9}}, false, "map", "runs back"},
                         {{{0.5, std::nan("")}}, false, "map/0", "no finite fraction"}}) {
    SCOPED_TRACE(c.words);
    const std::vector<Problem> problems = check_map(c.map, c.closed);
    ASSERT_FALSE(problems.empty());
    EXPECT_EQ(problems[0].where, c.where);
    EXPECT_THAT(problems[0].message, HasSubstr(c.words));
  }
  EXPECT_TRUE(check_map({{0.0, 0.1}, {0.5, 0.55}}, true).empty());
  EXPECT_TRUE(check_map({{0.0, 0.0}, {0.5, 0.55}, {1.0, 1.0}}, false).empty());
}

TEST(GivenMap, BelongsToItsRule) {
  const FitScene scene = free_surfaces();
  CorrespondenceSpec spec = mapped({{0.0, 0.1}});
  spec.rule = CorrespondenceRule::arc_length;
  EXPECT_THAT(message_of([&] { (void)correspond(scene.line0, scene.line1, spec); }),
              HasSubstr("rule is not mapped"));
  EXPECT_THAT(message_of([&] { (void)correspond(scene.line0, scene.line1, mapped({})); }),
              HasSubstr("is empty"));
}

}  // namespace
}  // namespace blendwright
