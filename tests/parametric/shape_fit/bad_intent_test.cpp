// Intents that cannot be: each is refused with the place and what must be, all problems at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "kernel/base/error.hpp"
#include "tests/parametric/shape_fit/fit_scenes.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

std::vector<Problem> problems_of(const FitScene& scene, const ShapeFitOptions& options) {
  try {
    (void)fit(scene, options);
  } catch (const InputError& e) {
    return e.problems();
  }
  return {};
}

struct BadIntent {
  std::string where, words;
  std::function<void(FitScene&, ShapeFitOptions&)> spoil;
};

PassThrough through(const Vec3& p) {
  PassThrough o;
  o.points = {p};
  return o;
}
ScannedPoints scan(std::vector<Vec3> points, double robust_scale) {
  ScannedPoints o;
  o.points = std::move(points);
  o.robust_scale = robust_scale;
  return o;
}
RollingBall ball(std::vector<LawPoint> radius) {
  RollingBall o;
  o.radius = std::move(radius);
  return o;
}
Clearance clearance(double distance, double value) {
  Clearance o;
  o.distance = distance;
  o.obstacle = [value](const Vec3&) { return ObstacleSample{value, Vec3::UnitX()}; };
  return o;
}

std::vector<BadIntent> bad_intents() {
  using S = FitScene;
  using O = ShapeFitOptions;
  return {
      {"objectives", "are none", [](S&, O& o) { o.objectives.clear(); }},
      {"objectives", "no weight above 0",
       [](S&, O& o) {
         o.objectives = {ThinPlate{0.0}, NoFold{0.0}};
       }},
      {"objectives/0/weight", "must be >= 0", [](S&, O& o) { o.objectives = {ThinPlate{-1.0}}; }},
      {"objectives/0/weight", "nan", [](S&, O& o) { o.objectives = {ThinPlate{nan}}; }},
      {"objectives/0/radius", "must be > 0",
       [](S&, O& o) {
         o.objectives = {ball({{0.0, -2.0}})};
       }},
      {"objectives/0/radius", "is empty", [](S&, O& o) { o.objectives = {ball({})}; }},
      {"objectives/0/radius/1", "must come after",
       [](S&, O& o) {
         o.objectives = {ball({{0.5, 1.0}, {0.2, 1.0}})};
       }},
      {"objectives/0/across", "smaller number first",
       [](S&, O& o) {
         RollingBall b = ball({{0.0, 1.0}});
         b.across = {0.7, 0.3};
         o.objectives = {b};
       }},
      {"objectives/1/points/0", "check their unit",
       [](S&, O& o) {
         o.objectives.push_back(through({5000.0, 0.0, 0.0}));
       }},
      {"objectives/0/points", "at least one point", [](S&, O& o) { o.objectives = {PassThrough{}}; }},
      {"objectives/0/points/1", "not a finite number",
       [](S&, O& o) {
         o.objectives = {scan({{1, 0, 1}, {nan, 0, 0}}, 0.1)};
       }},
      {"objectives/0/points", "at least one point", [](S&, O& o) { o.objectives = {scan({}, 0.1)}; }},
      {"objectives/0/robust_scale", "must be > 0",
       [](S&, O& o) {
         o.objectives = {scan({{1, 0, 1}}, 0.0)};
       }},
      {"objectives/0/least_radius", "must be > 0", [](S&, O& o) { o.objectives = {LargestCurvature{}}; }},
      {"objectives/0/distance", "must be > 0", [](S&, O& o) { o.objectives = {clearance(0.0, 1.0)}; }},
      {"objectives/0/to", "nothing to keep clear of",
       [](S&, O& o) {
         Clearance c;
         c.distance = 1.0;
         o.objectives = {c};
       }},
      {"objectives/0/to", "no finite distance", [](S&, O& o) { o.objectives = {clearance(1.0, nan)}; }},
      {"objectives/0/margin", "[0, 1)",
       [](S&, O& o) {
         o.objectives = {NoFold{1.0, 1.0}};
       }},
      {"bounds/tension", "smaller one first",
       [](S&, O& o) {
         o.bounds.tension = {5.0, 1.0};
       }},
      {"bounds/tension", "must stay <= 70", [](S&, O& o) { o.bounds.tension.hi = 500.0; }},
      {"bounds/magnitude", "two finite numbers",
       [](S&, O& o) {
         o.bounds.magnitude = {0.5, infinite};
       }},
      {"bounds/tangent_angle", "(0, 60] deg", [](S&, O& o) { o.bounds.tangent_angle = degrees(80.0); }},
      {"bounds/least_speed", "(0, 1)", [](S&, O& o) { o.bounds.least_speed = 1.0; }},
      {"bounds/prior", "must be >= 0", [](S&, O& o) { o.bounds.prior = -1.0; }},
      {"unknowns", "nothing can change",
       [](S&, O& o) {
         o.unknowns.tension = false;
         o.unknowns.magnitudes = {0, 0};
       }},
      {"unknowns/magnitudes/1", "[0, 64]", [](S&, O& o) { o.unknowns.magnitudes[1] = -1; }},
      {"unknowns/correspondence", "[0, 64]", [](S&, O& o) { o.unknowns.correspondence = 1000; }},
      {"unknowns/tension_per_component", "sixth",
       [](S& s, O& o) {
         s.spec.sides[0].continuity = Continuity::G2;
         o.unknowns.tension_per_component = true;
       }},
      {"unknowns/coefficients", "sixth",
       [](S& s, O& o) {
         s.spec.sides[0].continuity = Continuity::G2;
         o.unknowns.coefficients = true;
       }},
      {"unknowns/coefficients", "excludes",
       [](S&, O& o) { o.unknowns.coefficients = o.unknowns.tension_per_component = true; }},
      {"unknowns/tangent_angle/0", "follows the chord",
       [](S& s, O& o) {
         s.spec.sides[0].continuity = Continuity::G0;
         o.unknowns.tangent_angle[0] = true;
       }},
      {"shape", "no resonance is",
       [](S& s, O& o) {
         s.spec.shape.ode.fill({1.0, 3.0, 1.0});
         o.unknowns.coefficients = true;
       }},
      {"shape", "without a single root",
       [](S& s, O&) {
         s.spec.shape.ode.fill({1.0, -5.0, 1.0});
       }},
      {"shape", "tension_per_component",
       [](S& s, O&) {
         s.spec.shape.ode[1] = {1.0, -4.0, 4.0};
       }},
      {"samples_u", "[2, 64]", [](S&, O& o) { o.samples_u = 1; }},
      {"samples_v", "[4, 1000000]", [](S&, O& o) { o.samples_v = 0; }},
      {"max_iterations", "[1, ", [](S&, O& o) { o.max_iterations = 0; }},
      {"starts", "[1, 1000]", [](S&, O& o) { o.starts = 0; }},
      {"threads", "[1, ", [](S&, O& o) { o.threads = -2; }},
  };
}

TEST(BadIntent, IsRefusedWithItsPlaceAndWhatMustBe) {
  for (const BadIntent& bad : bad_intents()) {
    SCOPED_TRACE(bad.where + ": " + bad.words);
    FitScene scene = coaxial_cylinders();
    ShapeFitOptions options;
    options.objectives = {ThinPlate{}};
    bad.spoil(scene, options);
    const std::vector<Problem> problems = problems_of(scene, options);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].where, bad.where);
    EXPECT_THAT(problems[0].message, HasSubstr(bad.words));
  }
  EXPECT_GE(bad_intents().size(), 20u);
}

TEST(BadIntent, HasAllItsProblemsToldAtOnce) {
  const FitScene scene = coaxial_cylinders();
  ShapeFitOptions options;
  options.objectives = {ball({{0.0, -1.0}}), scan({{nan, 0, 0}}, -1.0), LargestCurvature{}};
  options.bounds.tension = {3.0, 2.0};
  options.samples_v = 0;
  std::vector<std::string> places;
  for (const Problem& p : problems_of(scene, options)) places.push_back(p.where);
  EXPECT_THAT(places,
              ::testing::ElementsAre("bounds/tension", "objectives/0/radius", "objectives/1/points/0",
                                     "objectives/1/robust_scale", "objectives/2/least_radius", "samples_v"));
}

TEST(BadIntent, ThatIsGoodIsNot) {
  ShapeFitOptions options;
  options.objectives = {ThinPlate{}};
  options.max_iterations = 2;
  EXPECT_TRUE(problems_of(coaxial_cylinders(), options).empty());
}

/// A limit that the trimline itself breaks has a best answer all the same, with what stands against it.
TEST(BadIntent, ThatATrimlineContradictsGivesTheBestAndSaysWhatStandsAgainstIt) {
  const FitScene scene = coaxial_cylinders();
  Clearance clear;
  clear.distance = 0.5;
  const Vec3 on_line = scene.line0.jet(scene.line0.domain().v.lo).C();
  clear.obstacle = [on_line](const Vec3& p) {
    const Vec3 d = p - on_line;
    return ObstacleSample{d.norm() - 0.1, d.norm() > 0.0 ? Vec3(d.normalized()) : Vec3(Vec3::UnitX())};
  };
  ShapeFitOptions options;
  options.objectives = {clear};
  options.samples_v = 16;
  options.max_iterations = 10;
  const ShapeFitResult result = fit(scene, options);
  EXPECT_FALSE(result.objectives[0].fulfilled);
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("the trimline itself, which cannot move")));
}

}  // namespace
}  // namespace blendwright
