// Spines against closed forms, components, and the laws that every spine obeys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/geometry/project.hpp"
#include "tests/parametric/rolling_ball/ball_scenes.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;

constexpr double touching = 1e-12;  ///< largest |E_i|, of the tracer's contract

/// What every traced spine has, and what is between its points.
void expect_spine(const Spine& spine) {
  const double cos4 = std::cos(degrees(4.0).value) - 1e-12;
  const auto& points = spine.points();
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_LE(points[k].residual, touching * std::max(1.0, spine.radius()));
    for (const BallFoot& foot : points[k].feet) EXPECT_GT(foot.room, 0.0);
    if (k > 0) {
      EXPECT_GE(points[k].tangent.dot(points[k - 1].tangent), cos4);
    }
    const double next = k + 1 < points.size() ? points[k + 1].s : spine.length();
    if (!(next > points[k].s)) continue;
    const SpinePoint between = spine.at(0.5 * (points[k].s + next));
    EXPECT_LE(between.residual, touching * std::max(1.0, spine.radius()));
    // s is the arc length at the points; between them to the interpolation's error.
    EXPECT_NEAR(between.speed, 1.0, 1e-4);
  }
}

TEST(Spine, OfASphereOverAPlaneIsACircle) {
  for_all(
      [](Rng& rng) {
        const double R = uniform(rng, 0.5, 2.0), r = uniform(rng, 0.1, 0.6);
        const double h = r + uniform(rng, -0.95, 0.95) * (R + r);
        const BallPair pair = fillet(BallPrimary(sphere_field(R, {0, 0, h})), BallPrimary(floor_field()), r);
        const SpineSet set = find_spines(pair, in_box(cube(4.0)));
        ASSERT_EQ(set.spines.size(), 1u);
        const Spine& spine = set.spines[0];
        EXPECT_TRUE(spine.closed());
        expect_spine(spine);
        const double radius = std::sqrt((R + r) * (R + r) - (h - r) * (h - r));
        // Quadrature of a speed that is 1 to 1e-4, five nodes a segment: rounding of some hundred terms.
        EXPECT_NEAR(spine.length(), 2.0 * pi * radius, 1e-9 * radius);
        for (const SpinePoint& p : spine.points()) {
          // A centre is as good as the residual over the sine of the angle between the normals.
          const double sine = p.feet[0].normal.cross(p.feet[1].normal).norm();
          EXPECT_NEAR(p.centre[2], r, 2.0 * touching);
          EXPECT_NEAR(p.centre.head<2>().norm(), radius, 4.0 * touching / sine);
          EXPECT_NEAR(p.curvature, 1.0 / radius, 1e-9 / radius / sine);
        }
      },
      5);
}

TEST(Spine, ExistsForASphereOverAPlaneIffTheBallReaches) {
  // |h - r| < R + r, from both sides by 2 %.
  for (const double factor : {-1.02, -0.98, 0.98, 1.02}) {
    const double R = 1.0, r = 0.3, h = r + factor * (R + r);
    const BallPair pair = fillet(BallPrimary(sphere_field(R, {0, 0, h})), BallPrimary(floor_field()), r);
    const SpineSet set = find_spines(pair, in_box(cube(3.0)));
    EXPECT_EQ(set.spines.size(), std::abs(factor) < 1.0 ? 1u : 0u) << factor;
    if (std::abs(factor) > 1.0) {
      ASSERT_FALSE(set.failures.empty());
      EXPECT_EQ(set.failures.back().cause, BallFailure::Cause::no_spine) << set.failures.back().message;
    }
  }
}

TEST(Spine, OfTwoCylindersHasTwoLoopsOfTheKnownLength) {
  const double a = 1.1, b = 0.6, r = 0.25;
  const BallPair pair = fillet(BallPrimary(cylinder_field(a, 0)), BallPrimary(cylinder_field(b, 2)), r);
  SpineSpec spec = in_box(cube(2.5));
  spec.chord_tolerance = 1e-4;
  const SpineSet set = find_spines(pair, spec);
  ASSERT_EQ(set.spines.size(), 2u);
  EXPECT_TRUE(set.failures.empty());
  for (const Spine& spine : set.spines) {
    EXPECT_TRUE(spine.closed());
    EXPECT_FALSE(spine.interference);
    expect_spine(spine);
    EXPECT_NEAR(spine.length(), 5.50459712914205, 1e-9);
    for (const SpinePoint& p : spine.points()) {
      const double t = std::atan2(p.centre[1], p.centre[0]), y = (b + r) * std::sin(t);
      const double z = std::sqrt((a + r) * (a + r) - y * y);
      const double sine = p.feet[0].normal.cross(p.feet[1].normal).norm();
      EXPECT_NEAR(std::abs(p.centre[2]), z, 4.0 * touching / sine);
      EXPECT_NEAR(p.centre.head<2>().norm(), b + r, 4.0 * touching);
    }
  }
  EXPECT_LT(set.spines[0].points()[0].centre[2] * set.spines[1].points()[0].centre[2], 0.0);
}

TEST(Spine, IsClosedByItsStartNotByAnOvershoot) {
  // The chords of a closed spine, with the last one back to the start, fall short of its length by the chord
  // error only: L kappa^2 h^2/24 with h <= 4 deg/kappa: 2.1e-4 of it. An overshoot makes them longer.
  const BallPair pair =
      fillet(BallPrimary(cylinder_field(1.1, 0)), BallPrimary(cylinder_field(0.6, 2)), 0.25);
  const SpineSet set = find_spines(pair, in_box(cube(2.5)));
  ASSERT_EQ(set.spines.size(), 2u);
  for (const Spine& spine : set.spines) {
    double chords = 0.0;
    const auto& p = spine.points();
    for (std::size_t k = 0; k < p.size(); ++k) chords += (p[(k + 1) % p.size()].centre - p[k].centre).norm();
    EXPECT_LT(chords, spine.length());
    EXPECT_GT(chords, (1.0 - 2.2e-4) * spine.length());
  }
}

TEST(Spine, ChordsKeepTheTolerance) {
  const BallPair pair =
      fillet(BallPrimary(ellipsoid_field({1.5, 0.9, 1}, {0, 0, 0.3})), BallPrimary(floor_field()), 0.2);
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    SpineSpec spec = in_box(cube(2.5));
    spec.chord_tolerance = tolerance;
    spec.seeds = SpineSpec::Seeds::edge;
    const SpineSet set = find_spines(pair, spec);
    ASSERT_EQ(set.spines.size(), 1u);
    const auto& p = set.spines[0].points();
    double worst = 0.0;
    for (std::size_t k = 1; k < p.size(); ++k) {
      const Vec3 d = (p[k].centre - p[k - 1].centre).normalized();
      const Vec3 off = set.spines[0].at(0.5 * (p[k].s + p[k - 1].s)).centre - p[k - 1].centre;
      worst = std::max(worst, (off - d * d.dot(off)).norm());
    }
    // The curvature at the start of a step stands for all of it; it changes by less than a third in 4 deg.
    EXPECT_LE(worst, 1.35 * tolerance);
  }
}

TEST(Spine, OfAnEllipsoidOverAPlaneHasTheKnownLength) {
  const BallPair pair =
      fillet(BallPrimary(ellipsoid_field({1.5, 0.9, 1}, {0, 0, 0.3})), BallPrimary(floor_field()), 0.2);
  const SpineSet set = find_spines(pair, in_box(cube(2.5)));
  ASSERT_EQ(set.spines.size(), 1u);
  const Spine& spine = set.spines[0];
  expect_spine(spine);
  EXPECT_NEAR(spine.length(), 8.88404, 5e-6);  // as many digits as are known
  for (const Vec3& c : {Vec3(1.6942197379574869, 0, 0.2), Vec3(0, 1.0961797688617855, 0.2)})
    EXPECT_LE((spine.at(spine.nearest(c)).centre - c).norm(), 1e-11);
}

TEST(Spine, OfABallWithinBothSolidsIsTheRoundsSpine) {
  // The ball inside the sphere and below the floor: radius sqrt((R - r)^2 - (h + r)^2) at z = -r.
  const double R = 1.2, h = 0.1, r = 0.25;
  const BallPair pair{{BallPrimary(sphere_field(R, {0, 0, h})), BallPrimary(floor_field())}, {-r, -r}};
  const SpineSet set = find_spines(pair, in_box(cube(2.0)));
  ASSERT_EQ(set.spines.size(), 1u);
  expect_spine(set.spines[0]);
  const double radius = std::sqrt((R - r) * (R - r) - (h + r) * (h + r));
  EXPECT_NEAR(set.spines[0].length(), 2.0 * pi * radius, 1e-9);
  for (const SpinePoint& p : set.spines[0].points()) EXPECT_NEAR(p.centre[2], -r, 2.0 * touching);
}

TEST(Spine, OfOppositeSignsTouchesOneFromWithin) {
  // Above the floor and inside the sphere: radius sqrt((R - r)^2 - (h - r)^2) at z = r.
  const double R = 1.2, h = 0.1, r = 0.25;
  const BallPair pair{{BallPrimary(sphere_field(R, {0, 0, h})), BallPrimary(floor_field())}, {-r, r}};
  const SpineSet set = find_spines(pair, in_box(cube(2.0)));
  ASSERT_EQ(set.spines.size(), 1u);
  const double radius = std::sqrt((R - r) * (R - r) - (h - r) * (h - r));
  EXPECT_NEAR(set.spines[0].length(), 2.0 * pi * radius, 1e-9);
  for (const SpinePoint& p : set.spines[0].points()) {
    const Vec3 d1 = (p.feet[0].point - p.centre) / r, d2 = (p.feet[1].point - p.centre) / r;
    EXPECT_NEAR(p.arc.value, std::acos(d1.dot(d2)), 1e-9);
  }
}

TEST(Spine, DoesNotDependOnHowPrimariesAreGiven) {
  const Vec3 centre(0.1, -0.2, 0.4), place(1.5, 0, 0.3);
  const double R = 0.9, r = 0.2;
  const Surface sphere = sphere_surface(R, centre), floor = plane(3.0);
  const std::vector<BallPair> pairs{
      fillet(BallPrimary(sphere_field(R, centre)), BallPrimary(floor_field()), r),
      fillet(outside_at(sphere, place), BallPrimary(floor_field()), r),
      fillet(BallPrimary(sphere_field(R, centre)), outside_at(floor, place), r),
      fillet(outside_at(sphere, place), outside_at(floor, place), r)};
  const double radius = std::sqrt((R + r) * (R + r) - (centre[2] - r) * (centre[2] - r));
  for (const BallPair& pair : pairs) {
    const SpineSet set = find_spines(pair, in_box(cube(2.5)));
    ASSERT_EQ(set.spines.size(), 1u);
    EXPECT_TRUE(set.spines[0].closed());
    EXPECT_NEAR(set.spines[0].length(), 2.0 * pi * radius, 1e-9);
    expect_spine(set.spines[0]);
    const Spine near = spine_near(pair, place, in_box(cube(2.5)));
    EXPECT_NEAR(near.length(), 2.0 * pi * radius, 1e-9);
  }
}

TEST(Spine, MovesAndScalesWithItsPrimaries) {
  const double k = 25.4;
  const Vec3 by(3, -2, 1);
  const auto length = [&](double scale, const Vec3& move) {
    const BallPair pair =
        fillet(BallPrimary(ellipsoid_field(scale * Vec3(1.5, 0.9, 1), Vec3(scale * Vec3(0, 0, 0.3) + move))),
               BallPrimary(floor_field(move[2])), 0.2 * scale);
    const SpineSet set = find_spines(pair, in_box(cube(2.5 * scale, move)));
    return set.spines.size() == 1 ? set.spines[0].length() : 0.0;
  };
  const double plain = length(1.0, Vec3::Zero());
  EXPECT_NEAR(length(k, k * by), k * plain, 1e-9 * k);
}

/// Distance of a point to an ellipsoid without the field, its derivatives or the feet: by search on the
/// surface.
double distance(const Surface& surface, const Vec3& c) { return closest_point(surface, c).distance; }

TEST(Spine, BallTouchesBothEllipsoidsAndMeetsNeither) {
  int found = 0;
  for_all(
      [&](Rng& rng) {
        const auto vector = [&](double lo, double hi) {
          return Vec3(uniform(rng, lo, hi), uniform(rng, lo, hi), uniform(rng, lo, hi));
        };
        const Vec3 s1 = vector(0.7, 1.4), s2 = vector(0.7, 1.4), c2 = vector(0.3, 0.8);
        const double r = uniform(rng, 0.15, 0.5);
        const BallPair pair =
            fillet(BallPrimary(ellipsoid_field(s1, {0, 0, 0})), BallPrimary(ellipsoid_field(s2, c2)), r);
        const SpineSet set = find_spines(pair, in_box(cube(3.5)));
        const Surface e1 = ellipsoid_surface(s1, {0, 0, 0}), e2 = ellipsoid_surface(s2, c2);
        for (const Spine& spine : set.spines) {
          ++found;
          for (int k = 0; k < 16; ++k) {
            const SpinePoint p = spine.at(uniform(rng, 0.0, spine.length()));
            // A search that ends within 1e-9 of its size from the foot has the distance to its square.
            const double interfering = spine.interference ? spine.interference->depth : 0.0;
            EXPECT_NEAR(distance(e1, p.centre), r, 1e-11 + interfering);
            EXPECT_NEAR(distance(e2, p.centre), r, 1e-11 + interfering);
          }
        }
      },
      5);
  EXPECT_GE(found, 5);
}

TEST(SpineSeeds, OfTheEdgeMissAComponentThatBoxesFind) {
  // One ball cuts the floor, one hangs above it, with less room than the rolling ball needs: two loops, one
  // edge.
  const double r = 0.3;
  std::vector<NodeSpec> nodes{quadric("low", ellipsoid_coefficients({0.7, 0.7, 0.7}, {-1.2, 0, 0.2})),
                              quadric("high", ellipsoid_coefficients({0.7, 0.7, 0.7}, {1.2, 0, 1.0})),
                              part("both", "max", {{"of", refs({"low", "high"})}})};
  const BallPair pair = fillet(BallPrimary(field_of(nodes)), BallPrimary(floor_field()), r);
  SpineSpec spec = in_box({{-3, -2, -1}, {3, 2, 2}});
  spec.seeds = SpineSpec::Seeds::edge;
  EXPECT_EQ(find_spines(pair, spec).spines.size(), 1u);
  for (const auto seeds : {SpineSpec::Seeds::box, SpineSpec::Seeds::both}) {
    spec.seeds = seeds;
    const SpineSet set = find_spines(pair, spec);
    ASSERT_EQ(set.spines.size(), 2u);
    for (const Spine& spine : set.spines) {
      const double h = spine.points()[0].centre[0] < 0.0 ? 0.2 : 1.0;
      EXPECT_NEAR(spine.length(), 2.0 * pi * std::sqrt((0.7 + r) * (0.7 + r) - (h - r) * (h - r)), 1e-9);
    }
  }
}

TEST(SpineEnds, AreOnTheBoxAndOnTheDomainsBorder) {
  // Two floors at a right angle: the spine is the line y = z = r.
  const double r = 0.2;
  const ScalarField wall = quadric_field({0, 0, 0, 0, 0, 0, 0, -1, 0, 0});  // y <= 0
  const SpineSet in_fields =
      find_spines(fillet(BallPrimary(floor_field()), BallPrimary(wall), r), in_box(cube(1.0)));
  ASSERT_EQ(in_fields.spines.size(), 1u);
  EXPECT_NEAR(in_fields.spines[0].length(), 2.0, 1e-9);
  for (const SpineEnd& end : in_fields.spines[0].ends()) EXPECT_EQ(end.kind, SpineEnd::Kind::box);
  // The floor as a square of half side 0.7 about the origin, turned by 0: it ends before the box does.
  const BallPrimary floor = outside_at(plane(0.7), {0, 0.2, 0.2});
  const SpineSet on_surface = find_spines(fillet(floor, BallPrimary(wall), r), in_box(cube(1.0)));
  ASSERT_EQ(on_surface.spines.size(), 1u);
  EXPECT_NEAR(on_surface.spines[0].length(), 1.4, 1e-9);
  for (const SpineEnd& end : on_surface.spines[0].ends()) EXPECT_EQ(end.kind, SpineEnd::Kind::domain);
  EXPECT_FALSE(on_surface.spines[0].closed());
}

TEST(SpineSpec, IsCheckedAsAWhole) {
  BallPair pair = fillet(BallPrimary(sphere_field(1, {0, 0, 0})), BallPrimary(floor_field()), 0.3);
  pair.radius[1] = 0.2;
  SpineSpec spec = in_box({{1, 1, 1}, {0, 0, 0}});
  spec.chord_tolerance = -1.0;
  try {
    static_cast<void>(find_spines(pair, spec));
    FAIL();
  } catch (const InputError& e) {
    std::vector<std::string> where;
    for (const Problem& p : e.problems()) where.push_back(p.where);
    EXPECT_THAT(where, ::testing::ElementsAre("radius", "box", "chord_tolerance"));
  }
}

}  // namespace
}  // namespace blendwright
