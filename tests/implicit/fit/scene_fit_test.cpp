// Known scenes are found again from points of their surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "implicit/fit/scene_fit.hpp"
#include "kernel/base/error.hpp"
#include "tests/implicit/fit/scan.hpp"

namespace blendwright {
namespace {

using test::node;
using test::number_of;
using test::Rng;
using test::uniform;
using testing::Contains;
using testing::HasSubstr;

struct Superquadric {
  std::array<double, 5> form{};  ///< a, b, c, n1, n2
  Vec3 move, axis;
  double turn_deg = 0.0;
  [[nodiscard]] SceneSpec scene() const { return test::placed_superquadric(form, move, axis, turn_deg); }
};

/// Half-axes that differ by at least a fifth and exponents by a quarter, so that each has its name: with n1 =
/// n2 any of the axes may be called z. From a lemon to a cushion.
Superquadric random_superquadric(Rng& rng) {
  const double b = uniform(rng, 2.0, 4.0), n1 = uniform(rng, 1.6, 4.0);
  double n2 = n1;
  while (std::abs(std::log(n2 / n1)) < 0.25) n2 = uniform(rng, 1.6, 4.0);
  return {{b * uniform(rng, 1.2, 1.8), b, uniform(rng, 6.0, 9.0), n1, n2},
          {uniform(rng, -20, 20), uniform(rng, -20, 20), uniform(rng, -20, 20)},
          {uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, 0.1, 1)},
          uniform(rng, -180, 180)};
}

/// What the fit starts from: nothing but the kind.
SceneSpec unit_superquadric() {
  return test::placed_superquadric({1, 1, 1, 2, 2}, Vec3::Zero(), Vec3::UnitZ(), 0.0);
}

/// Largest relative error of the five numbers and of the place, a and b in either order.
double error_of(const SceneFitResult& result, const Superquadric& truth) {
  const auto found = [&](const char* key) { return number_of(result.spec, "form", key); };
  const double a = std::max(found("a"), found("b")), b = std::min(found("a"), found("b"));
  const std::array<double, 5> values{a, b, found("c"), found("n1"), found("n2")};
  double worst = 0.0;
  for (std::size_t i = 0; i < 5; ++i) worst = std::max(worst, std::abs(values[i] / truth.form[i] - 1.0));
  for (const NodeSpec& n : result.spec.nodes)
    if (n.name == "body") {
      const auto& m = std::get<std::vector<double>>(n.values.at("move"));
      worst = std::max(worst, (Vec3(m[0], m[1], m[2]) - truth.move).norm() / truth.form[1]);
    }
  return worst;
}

/// How many of `seeds` come back within `tolerance`; prints the worst errors.
int recovered(int seeds, double tolerance, bool half, double noise, const char* what) {
  int good = 0;
  double worst = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    const Superquadric truth = random_superquadric(rng);
    test::ScanOptions options{.points = half ? 10000u : 2000u, .noise = noise * truth.form[1]};
    if (half) options.seen_from = test::normal3(rng).normalized();
    const std::vector<Vec3> points = test::scan(truth.scene(), truth.move, 30.0, options, rng);
    const SceneFitResult result = fit_scene(unit_superquadric(), points, {.start_from_points = true});
    const double error = error_of(result, truth);
    worst = std::max(worst, error);
    if (error <= tolerance)
      ++good;
    else
      std::printf("  seed %d: error %.3g, rms %.3g\n", seed, error, result.rms);
  }
  std::printf("%s: %d of %d within %g %%, worst %.2g %%\n", what, good, seeds, 100 * tolerance, 100 * worst);
  return good;
}

TEST(SceneFit, SuperquadricsComeBackFromNoisyPoints) {
  const int seeds = test::bounded(2) > 2 ? 20 : 4;
  EXPECT_GE(20 * recovered(seeds, 0.02, false, 0.01, "whole scans, 1 % noise"), 19 * seeds);
}

TEST(SceneFit, SuperquadricsComeBackFromHalfScans) {
  const int seeds = test::bounded(2) > 2 ? 20 : 2;
  EXPECT_GE(20 * recovered(seeds, 0.05, true, 0.01, "half scans, 1 % noise"), 19 * seeds);
}

TEST(SceneFit, ExactPointsGiveExactNumbers) {
  Rng rng(7);
  const Superquadric truth = random_superquadric(rng);
  const std::vector<Vec3> points = test::scan(truth.scene(), truth.move, 30.0, {.points = 500}, rng);
  const SceneFitResult result = fit_scene(unit_superquadric(), points, {.start_from_points = true});
  EXPECT_LE(error_of(result, truth), 1e-8);
  EXPECT_LE(result.rms, 1e-9);
  EXPECT_TRUE(result.converged);
  EXPECT_TRUE(result.not_unique.empty());
  EXPECT_GE(result.inliers, 450u);  // three deviations of rounding leave out a few
  for (const FittedNumber& n : result.numbers) EXPECT_TRUE(n.determined) << n.name;
  // Its own evaluation agrees: every point is on the surface of the scene that was found.
  const Scene scene = build_scene(result.spec);
  for (const Vec3& p : points) EXPECT_NEAR(scene.field.value(p), 1.0, 1e-8);
}

TEST(SceneFit, OutliersDoNotPullWithARobustScale) {
  Rng rng(11);
  const Superquadric truth = random_superquadric(rng);
  std::vector<Vec3> points =
      test::scan(truth.scene(), truth.move, 30.0, {.points = 1000, .noise = 0.01}, rng);
  for (std::size_t i = 0; i < points.size(); i += 5)  // every fifth point is somewhere else
    points[i] = truth.move + 12.0 * Vec3(uniform(rng, 0, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
  const SceneFitResult plain = fit_scene(unit_superquadric(), points, {.start_from_points = true});
  const SceneFitResult robust =
      fit_scene(unit_superquadric(), points, {.robust_scale = 0.03, .start_from_points = true});
  EXPECT_LE(error_of(robust, truth), 0.02);
  EXPECT_GT(error_of(plain, truth), 0.05);  // negative control: plain squares are pulled
  EXPECT_LT(robust.inliers, 850u);
  EXPECT_GT(robust.inliers, 750u);
}

TEST(SceneFit, AsymmetricFormsComeBack) {
  SceneSpec truth;
  truth.nodes = {node("form", "asymmetric_superellipsoid",
                      {{"x", std::vector<double>{4.0, 2.5}},
                       {"y", std::vector<double>{2.0, 3.0}},
                       {"z", std::vector<double>{6.0, 5.0}},
                       {"n", 2.6}}),
                 node("body", "place",
                      {{"of", NodeRef{"form"}},
                       {"move", std::vector<double>{1.0, -2.0, 3.0}},
                       {"axis", std::vector<double>{1.0, 2.0, 3.0}},
                       {"turn_deg", 40.0}})};
  truth.solid = "body";
  SceneSpec start = truth;  // a first guess by eye
  start.nodes[0].values = {{"x", std::vector<double>{3.0, 3.0}},
                           {"y", std::vector<double>{3.0, 3.0}},
                           {"z", std::vector<double>{5.0, 5.0}},
                           {"n", 2.0}};
  start.nodes[1].values["move"] = std::vector<double>{1.5, -2.5, 3.5};
  start.nodes[1].values["turn_deg"] = 35.0;
  Rng rng(3);
  const auto points = test::scan(truth, {1.0, -2.0, 3.0}, 30.0, {.points = 3000, .noise = 0.005}, rng);
  const SceneFitResult result = fit_scene(start, points);
  const Scene found = build_scene(result.spec);
  // The surface is the same to the noise of the mean: 0.005 / sqrt(3000 / 13) times a few.
  for (const Vec3& p : test::scan(truth, {1.0, -2.0, 3.0}, 30.0, {.points = 500}, rng))
    EXPECT_NEAR(found.field.value(p), 1.0, 2e-3);
  EXPECT_NEAR(number_of(result.spec, "form", "n"), 2.6, 0.03);
  EXPECT_LE(result.rms, 0.006);
}

TEST(SceneFit, ThePowerOfARayScalingComesBack) {
  SceneSpec truth;
  truth.nodes = {
      node("ball", "lp_metric", {{"a", 3.0}, {"b", 3.0}, {"c", 3.0}, {"n", 2.0}}),
      node("cube", "lp_metric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}, {"n", 8.0}}),
      node("scaled", "ray_scaling", {{"of", NodeRef{"ball"}}, {"by", NodeRef{"cube"}}, {"n", -1.7}})};
  truth.solid = "scaled";
  SceneSpec start = truth;
  start.nodes[0].values["a"] = start.nodes[0].values["b"] = start.nodes[0].values["c"] = 2.0;
  start.nodes[2].values["n"] = 0.5;
  Rng rng(5);
  const auto points = test::scan(truth, Vec3::Zero(), 30.0, {.points = 2000, .noise = 0.03}, rng);
  const SceneFitResult result = fit_scene(start, points,
                                          {.unknowns = {{"scaled", "n", {-5.0, 5.0}},
                                                        {"ball", "a", {0.5, 10}},
                                                        {"ball", "b", {0.5, 10}},
                                                        {"ball", "c", {0.5, 10}}}});
  EXPECT_NEAR(number_of(result.spec, "scaled", "n"), -1.7, 0.02 * 1.7);
  for (const char* key : {"a", "b", "c"}) EXPECT_NEAR(number_of(result.spec, "ball", key), 3.0, 0.06);
  EXPECT_EQ(result.numbers.size(), 4u);
}

/// Two balls whose fields flow together.
SceneSpec two_balls(double w1, double distance) {
  SceneSpec spec;
  std::vector<NodeRef> members;
  for (const std::string tag : {"left", "right"}) {
    spec.nodes.push_back(node(tag + " ball", "lp_metric", {{"a", 4.0}, {"b", 4.0}, {"c", 4.0}, {"n", 2.0}}));
    spec.nodes.push_back(node(tag + " place", "place",
                              {{"of", NodeRef{tag + " ball"}},
                               {"move", std::vector<double>{tag == "left" ? 0.0 : distance, 0.0, 0.0}}}));
    spec.nodes.push_back(
        node(tag, "soft_object", {{"distance", NodeRef{tag + " place"}}, {"w1", w1}, {"w2", 0.5}}));
    members.push_back({tag});
  }
  spec.nodes.push_back(node("both", "soft_blend", {{"of", members}}));
  spec.solid = "both";
  return spec;
}

TEST(SceneFit, InfluenceRadiiComeBackFromTheBlend) {
  const SceneSpec truth = two_balls(0.8, 3.5);
  SceneSpec start = two_balls(0.5, 3.2);
  Rng rng(9);
  std::vector<Vec3> points = test::scan(truth, {0.5, 0.0, 0.0}, 30.0, {.points = 3000, .noise = 0.005}, rng);
  const std::vector<Vec3> right =
      test::scan(truth, {3.0, 0.0, 0.0}, 30.0, {.points = 3000, .noise = 0.005}, rng);
  points.insert(points.end(), right.begin(), right.end());
  const SceneFitResult result = fit_scene(
      start, points,
      {.unknowns = {
           {"left", "w1", {0.3, 3.0}}, {"right", "w1", {0.3, 3.0}}, {"right place", "move", {-10, 10}}}});
  EXPECT_NEAR(number_of(result.spec, "left", "w1"), 0.8, 0.016);
  EXPECT_NEAR(number_of(result.spec, "right", "w1"), 0.8, 0.016);
  EXPECT_LE(result.rms, 0.0065);
  EXPECT_GT(result.rms_before, 0.02);

  // Balls that do not reach each other show nothing of their influence.
  const SceneSpec apart = two_balls(0.8, 9.0);
  std::vector<Vec3> far = test::scan(apart, Vec3::Zero(), 30.0, {.points = 1000, .noise = 0.005}, rng);
  const SceneFitResult blind = fit_scene(apart, far, {.unknowns = {{"left", "w1", {0.3, 3.0}}}});
  EXPECT_THAT(blind.not_unique, Contains(HasSubstr("left/w1 is not determined")));
}

TEST(SceneFit, SaysWhatABallCannotTell) {
  Rng rng(13);
  const SceneSpec ball = test::placed_superquadric({3, 3, 3, 2, 2}, {1, 2, 3}, Vec3::UnitZ(), 0.0);
  const auto points = test::scan(ball, {1, 2, 3}, 30.0, {.points = 1000, .noise = 0.01}, rng);
  const SceneFitResult result = fit_scene(ball, points);
  EXPECT_THAT(result.not_unique, Contains(HasSubstr("body/turn is not determined")));
  EXPECT_NEAR(number_of(result.spec, "form", "c"), 3.0, 0.02);
}

TEST(SceneFit, SaysThatEqualExponentsLetAxesChangeTheirNames) {
  Rng rng(23);
  const SceneSpec ellipsoid = test::placed_superquadric({4, 3, 6, 2.5, 2.5}, {1, 2, 3}, Vec3::UnitZ(), 20.0);
  const auto points = test::scan(ellipsoid, {1, 2, 3}, 30.0, {.points = 1000, .noise = 0.02}, rng);
  const SceneFitResult result = fit_scene(unit_superquadric(), points, {.start_from_points = true});
  EXPECT_THAT(result.not_unique, Contains(HasSubstr("may change their names")));
  EXPECT_LE(result.rms, 0.022);
}

TEST(SceneFit, IsTheSameTwiceAndStopsWhenAsked) {
  Rng rng(17);
  const Superquadric truth = random_superquadric(rng);
  const auto points = test::scan(truth.scene(), truth.move, 30.0, {.points = 500, .noise = 0.01}, rng);
  const SceneFitOptions options{.start_from_points = true};
  EXPECT_EQ(fit_scene(unit_superquadric(), points, options).spec,
            fit_scene(unit_superquadric(), points, options).spec);
  std::stop_source stop;
  double last = -1.0;
  Progress progress{.report =
                        [&](double fraction, std::string_view) {
                          EXPECT_GE(fraction, last);
                          last = fraction;
                          if (fraction > 0.1) stop.request_stop();
                        },
                    .stop = stop.get_token()};
  EXPECT_THROW(static_cast<void>(fit_scene(unit_superquadric(), points, options, progress)), Cancelled);
}

TEST(SceneFit, KeepsBoundsAndSaysWhichHold) {
  Rng rng(19);
  const SceneSpec truth = test::placed_superquadric({4, 3, 6, 2, 2}, Vec3::Zero(), Vec3::UnitZ(), 0.0);
  const auto points = test::scan(truth, Vec3::Zero(), 30.0, {.points = 500, .noise = 0.01}, rng);
  const SceneFitResult result =
      fit_scene(truth, points, {.unknowns = {{"form", "a", {1.0, 3.5}}, {"form", "c", {1.0, 20.0}}}});
  EXPECT_DOUBLE_EQ(number_of(result.spec, "form", "a"), 3.5);
  EXPECT_EQ(number_of(result.spec, "form", "b"), 3.0);  // not asked for: untouched
  EXPECT_THAT(result.warnings, Contains(HasSubstr("form/a is at its bound")));
}

}  // namespace
}  // namespace blendwright
