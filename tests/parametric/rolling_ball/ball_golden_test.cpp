// Golden rolling balls: every case, at 1e-10.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "kernel/base/number_text.hpp"
#include "tests/parametric/rolling_ball/ball_scenes.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright {
namespace {

using namespace test;

constexpr double golden = 1e-10;

/// A case as pairs of primaries, and what a sample says of its place on the spine.
struct Scene {
  std::vector<BallPair> pairs;  ///< the same primaries, given in different ways
  Box box;
  std::string key;                                       ///< of the sample's place
  std::function<double(const SpinePoint&, double)> off;  ///< of a point's place from that of the sample
  std::function<bool(const Spine&)> meant = [](const Spine&) { return true; };
};

double polar(double x, double y, double of) { return std::remainder(std::atan2(y, x) - of, 2.0 * pi); }

/// (a u, b v) turned into a paraboloid; the coordinates' order and the origin are those of the case.
std::string square_sum(double a, double b) { return number_text(a) + "*u^2 + " + number_text(b) + "*v^2"; }
Surface upright(double a, double b, double half) {
  return formula({"u", "v", square_sum(a, b)}, {-half, half}, {-half, half});
}
ScalarField upright_field(double a, double b) { return quadric_field({a, b, 0, 0, 0, 0, 0, 0, -1, 0}); }

Scene sphere_plane(const RelationValues& p) {
  const double R = p.numbers.at("sphere_radius"), h = p.numbers.at("sphere_height"), r = p.numbers.at("r");
  const Surface sphere = sphere_surface(R, {0, 0, h});
  Scene s;
  s.pairs = {fillet(BallPrimary(sphere_field(R, {0, 0, h})), BallPrimary(floor_field()), r),
             fillet(outside_at(sphere, {3, 0, 3}), outside_at(plane(4.0), {0, 0, 1}), r)};
  s.box = cube(2.0);
  s.key = "angle";
  s.off = [](const SpinePoint& at, double angle) { return polar(at.centre[0], at.centre[1], angle); };
  return s;
}

Scene two_cylinders(const RelationValues& p) {
  const double a = p.numbers.at("radius_about_x"), b = p.numbers.at("radius_about_z"), r = p.numbers.at("r");
  Scene s;
  s.pairs = {fillet(BallPrimary(cylinder_field(a, 0)), BallPrimary(cylinder_field(b, 2)), r),
             fillet(BallPrimary(cylinder_field(a, 0)), outside_at(cylinder(b, -3.0, 3.0), {2, 0, 0}), r)};
  s.box = cube(2.5);
  s.key = "angle";
  s.off = [](const SpinePoint& at, double angle) { return polar(at.centre[0], at.centre[1], angle); };
  s.meant = [](const Spine& spine) { return spine.points()[0].centre[2] > 0.0; };
  return s;
}

Scene ellipsoid_plane(const RelationValues& p) {
  const auto& axes = p.lists.at("semi_axes");
  const Vec3 semi(axes[0], axes[1], axes[2]), centre(0, 0, p.numbers.at("height"));
  const double r = p.numbers.at("r");
  Scene s;
  s.pairs = {fillet(BallPrimary(ellipsoid_field(semi, centre)), BallPrimary(floor_field()), r),
             fillet(outside_at(ellipsoid_surface(semi, centre), {3, 0, 3}), BallPrimary(floor_field()), r)};
  s.box = cube(2.5);
  s.key = "azimuth_parameter";
  s.off = [semi](const SpinePoint& at, double parameter) {
    return polar(at.feet[0].point[0] / semi[0], at.feet[0].point[1] / semi[1], parameter);
  };
  return s;
}

Scene two_paraboloids(const RelationValues& p) {
  const double a1 = p.numbers.at("a1"), b1 = p.numbers.at("b1"), a2 = p.numbers.at("a2"),
               b2 = p.numbers.at("b2"), x0 = p.numbers.at("x0"), r = p.numbers.at("r");
  const Surface second =
      formula({number_text(x0) + " + " + square_sum(a2, b2), "u", "v"}, {-1.5, 1.5}, {-1.5, 1.5});
  // x <= x0 + a2 y^2 + b2 z^2
  const ScalarField second_field = quadric_field({0, a2, b2, 0, 0, 0, -1, 0, 0, x0});
  Scene s;
  s.pairs = {fillet(outside_at(upright(a1, b1, 1.5), {0, 0, 1}), outside_at(second, {1, 0, 0}), r),
             fillet(BallPrimary(upright_field(a1, b1)), outside_at(second, {1, 0, 0}), r),
             fillet(BallPrimary(upright_field(a1, b1)), BallPrimary(second_field), r)};
  s.box = cube(1.5);
  s.key = "v";
  s.off = [](const SpinePoint& at, double v) { return at.feet[0].point[1] - v; };
  return s;
}

Scene sphere_paraboloid(const RelationValues& p) {
  const auto& c = p.lists.at("sphere_centre");
  const double R = p.numbers.at("sphere_radius"), r = p.numbers.at("r"), a1 = p.numbers.at("a1"),
               b1 = p.numbers.at("b1");
  const Vec3 centre(c[0], c[1], c[2]);
  Scene s;
  s.pairs = {fillet(BallPrimary(sphere_field(R, centre)), outside_at(upright(a1, b1, 2.5), {0, 0, 1}), r),
             fillet(BallPrimary(sphere_field(R, centre)), BallPrimary(upright_field(a1, b1)), r),
             fillet(outside_at(sphere_surface(R, centre), {3, 3, 3}), BallPrimary(upright_field(a1, b1)), r)};
  s.box = cube(2.5);
  s.key = "azimuth";
  s.off = [centre](const SpinePoint& at, double azimuth) {
    return polar(at.feet[1].point[0] - centre[0], at.feet[1].point[1] - centre[1], azimuth);
  };
  return s;
}

/// Balls of the spine at the sample's place: by sign changes between traced points, then the secant rule.
std::vector<SpinePoint> balls_at(const Spine& spine, const std::function<double(const SpinePoint&)>& off) {
  std::vector<SpinePoint> found;
  const auto& points = spine.points();
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k + 1 == points.size() && !spine.closed()) continue;
    double a = points[k].s, b = k + 1 < points.size() ? points[k + 1].s : spine.length();
    double fa = off(spine.at(a)), fb = off(spine.at(b));
    if ((fa > 0.0) == (fb > 0.0) || std::abs(fa - fb) > 1.0) continue;
    // Bisection, so that nothing but the sign of `off` counts.
    for (int i = 0; i < 70; ++i) {
      const double m = 0.5 * (a + b), fm = off(spine.at(m));
      ((fm > 0.0) == (fa > 0.0) ? a : b) = m;
    }
    found.push_back(spine.at(0.5 * (a + b)));
  }
  return found;
}

double error_of(const SpinePoint& ball, const RelationSample& sample) {
  const auto vector = [&](const char* key) {
    const auto& x = sample.lists.at(key);
    return Vec3(x[0], x[1], x[2]);
  };
  return std::max({(ball.centre - vector("centre")).norm(), (ball.feet[0].point - vector("trim_1")).norm(),
                   (ball.feet[1].point - vector("trim_2")).norm()});
}

double parameter_error(const SpinePoint& ball, const RelationSample& sample) {
  double worst = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto known = sample.lists.find(i == 0 ? "parameters_1" : "parameters_2");
    if (known == sample.lists.end()) continue;
    worst = std::max({worst, std::abs(ball.feet[i].at.u - known->second[0]),
                      std::abs(ball.feet[i].at.v - known->second[1])});
  }
  return worst;
}

int expect_case(const RelationCase& c, const Scene& scene) {
  int compared = 0;
  for (const BallPair& pair : scene.pairs) {
    // All of these primaries meet, and their spines run along the edges.
    SpineSpec spec = in_box(scene.box);
    spec.seeds = SpineSpec::Seeds::edge;
    const SpineSet set = find_spines(pair, spec);
    EXPECT_FALSE(set.spines.empty());
    for (const RelationSample& sample : c.samples) {
      const double place = sample.numbers.at(scene.key);
      double error = 1.0, of_parameters = 0.0;
      for (const Spine& spine : set.spines) {
        if (!scene.meant(spine)) continue;
        for (const SpinePoint& ball :
             balls_at(spine, [&](const SpinePoint& p) { return scene.off(p, place); })) {
          if (error_of(ball, sample) >= error) continue;
          error = error_of(ball, sample);
          of_parameters = pair.primaries[0].surface() ? parameter_error(ball, sample) : 0.0;
        }
      }
      EXPECT_LE(error, golden) << c.id << " at " << place;
      EXPECT_LE(of_parameters, golden) << c.id << " at " << place;
      ++compared;
    }
  }
  return compared;
}

using Maker = Scene (*)(const RelationValues&);
const std::map<std::string, Maker> makers{{"rolling_ball_sphere_plane", sphere_plane},
                                          {"rolling_ball_two_cylinders", two_cylinders},
                                          {"rolling_ball_ellipsoid_plane", ellipsoid_plane},
                                          {"rolling_ball_two_paraboloids", two_paraboloids},
                                          {"rolling_ball_sphere_paraboloid", sphere_paraboloid}};

TEST(RollingBallGolden, EveryCaseIsMetInEveryRepresentation) {
  std::map<std::string, int> compared;
  for (const RelationCase& c : read_relation_golden(golden_folder())) {
    if (c.function.rfind("rolling_ball", 0) != 0) continue;
    SCOPED_TRACE(c.id);
    ASSERT_TRUE(makers.count(c.function)) << c.function;
    compared[c.function] += expect_case(c, makers.at(c.function)(c.parameters));
  }
  for (const auto& [function, maker] : makers) EXPECT_GT(compared[function], 0) << function;
}

TEST(RollingBallGolden, NoticesAWrongRadius) {
  for (const RelationCase& c : read_relation_golden(golden_folder())) {
    if (c.function != "rolling_ball_sphere_plane") continue;
    RelationValues wrong = c.parameters;
    wrong.numbers["r"] += 1e-8;
    const Scene scene = sphere_plane(wrong);
    const SpineSet set = find_spines(scene.pairs[0], in_box(scene.box));
    const RelationSample& sample = c.samples[0];
    const auto balls = balls_at(
        set.spines[0], [&](const SpinePoint& p) { return scene.off(p, sample.numbers.at(scene.key)); });
    ASSERT_EQ(balls.size(), 1u);
    EXPECT_GT(error_of(balls[0], sample), golden);
    return;
  }
  FAIL() << "no such case";
}

}  // namespace
}  // namespace blendwright
