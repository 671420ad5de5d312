#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "kernel/base/parallel_for.hpp"
#include "tests/verify/shapes.hpp"
#include "verify/surface/surface_checks.hpp"
#include "verify/surface/triangle_crossing.hpp"

namespace blendwright {
namespace {

using namespace test;
using detail::Crossing;
using detail::crossing;
using detail::Triangle;

const Triangle base{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
constexpr double tolerance = 1e-12;

TEST(TriangleCrossing, FindsAPiercingEdgeAndItsDepth) {
  const Triangle t{Vec3(0.2, 0.2, -0.3), Vec3(0.2, 0.2, 0.5), Vec3(0.3, 0.2, 0.5)};
  const auto c = crossing(base, t, tolerance);
  ASSERT_TRUE(c);
  EXPECT_NEAR((c->point - Vec3(0.2, 0.2, 0)).norm(), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(c->depth, 0.3);
  EXPECT_EQ(c->triangle, 1);
  EXPECT_EQ(c->edge, 0);
  EXPECT_DOUBLE_EQ(c->along, 0.375);
}

TEST(TriangleCrossing, TouchingIsNotCrossing) {
  const auto apart = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return !crossing(base, {a, b, c}, tolerance) && !crossing({a, b, c}, base, tolerance);
  };
  EXPECT_TRUE(apart({0.2, 0.2, 0}, {0.2, 0.2, 1}, {0.3, 0.2, 1}));  // a corner inside
  EXPECT_TRUE(apart({0, 0, 0}, {1, 0, 0}, {0.3, -1, 1}));           // a shared edge
  EXPECT_TRUE(apart({0, 0, 0}, {-1, 0, 0}, {-1, -1, 1}));           // a shared corner
  EXPECT_TRUE(apart({0.1, 0.1, 0}, {0.3, 0.2, 0}, {0.1, 0.1, 1}));  // an edge in the plane
  EXPECT_TRUE(apart({1, 0, 0}, {0, 1, 0}, {1, 1, 0}));              // beside it in one plane, sharing an edge
  EXPECT_TRUE(apart({0, 0, 1e-13}, {1, 0, 1e-13}, {0, -1, 1e-13}));  // the same, but for rounding
  EXPECT_TRUE(apart({2, 2, -1}, {2, 2, 1}, {3, 2, 0}));  // through the plane, outside the triangle
  EXPECT_TRUE(apart({0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.2, 0.2, 0.5}));  // no area
}

TEST(TriangleCrossing, OverlapInOnePlaneCounts) {
  const auto shifted = [](double x, double y) {
    return Triangle{base[0] + Vec3(x, y, 0), base[1] + Vec3(x, y, 0), base[2] + Vec3(x, y, 0)};
  };
  EXPECT_TRUE(crossing(base, shifted(0.2, 0.1), tolerance));
  EXPECT_FALSE(crossing(base, shifted(1.0, 0.0), tolerance));
  const Triangle small{Vec3(0.2, 0.2, 0), Vec3(0.3, 0.2, 0), Vec3(0.2, 0.3, 0)};
  EXPECT_TRUE(crossing(base, small, tolerance));
  EXPECT_TRUE(crossing(small, base, tolerance));
}

TEST(TriangleCrossing, AgreesWithItsConstructionInEveryPosition) {
  for_all(
      [](Rng& rng) {
        const auto random = [&] {
          return Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
        };
        const Triangle a{random(), random(), random()};
        const Vec3 normal = (a[1] - a[0]).cross(a[2] - a[0]);
        if (normal.norm() < 0.05) return;  // thin triangles have ill-conditioned planes
        // A point inside, at least a tenth of each height from the edges, pierced by an edge of a random
        // direction.
        const double s = uniform(rng, 0.1, 0.8), t = uniform(rng, 0.1, 0.9 - s);
        const Vec3 inside = a[0] + s * (a[1] - a[0]) + t * (a[2] - a[0]);
        const Vec3 direction = normal.normalized() + 0.3 * random();
        const double before = uniform(rng, 0.01, 1.0), after = uniform(rng, 0.01, 1.0);
        const Triangle through{inside - before * direction, inside + after * direction,
                               inside + 9.0 * direction + random()};
        const auto c = crossing(a, through, tolerance);
        ASSERT_TRUE(c);
        const auto d = crossing(through, a, tolerance);
        ASSERT_TRUE(d);
        EXPECT_DOUBLE_EQ(c->depth, d->depth);
        // Lifted until its lowest corner is above the plane.
        Triangle above = through;
        const double lift = (before + 10.0) * 2.0;
        for (Vec3& p : above) p += lift * normal.normalized();
        EXPECT_FALSE(crossing(a, above, tolerance));
      },
      500);
}

TEST(SelfIntersection, SoundSurfacesHaveNone) {
  EXPECT_EQ(check_self_intersection(flare(0.5)).pairs, 0u);
  EXPECT_EQ(check_self_intersection(continued_cylinder()).pairs, 0u);
  EXPECT_EQ(check_self_intersection(plane_patch()).pairs, 0u);
  const Surface torus =
      surface({{0.0, 2.0 * pi}, {0.0, 2.0 * pi}, true, true}, [](const auto& u, const auto& v) {
        using T = std::remove_cvref_t<decltype(u)>;
        const T r = 2.0 + 0.5 * cos(u);
        return std::array<T, 3>{r * cos(v), r * sin(v), 0.5 * sin(u)};
      });
  EXPECT_EQ(check_self_intersection(torus).pairs, 0u);
  // A tube that closes without saying so: the borders touch.
  const Surface unmarked =
      surface({{0.0, 1.0}, {0.0, 2.0 * pi}, false, false}, [](const auto& u, const auto& v) {
        using T = std::remove_cvref_t<decltype(u)>;
        return std::array<T, 3>{cos(v), sin(v), u};
      });
  EXPECT_EQ(check_self_intersection(unmarked).pairs, 0u);
  // A narrow waist, thirty times thinner than the ends.
  const Surface waist = revolution(
      turn, [](const auto& u) { return 0.03 + 4.0 * (u - 0.5) * (u - 0.5); },
      [](const auto& u) { return u; });
  EXPECT_EQ(check_self_intersection(waist).pairs, 0u);
}

TEST(SelfIntersection, FigureEightBandIsFoundWhereItCrosses) {
  // Crosses itself along x = y = 0, at v = 0 and v = pi, which are lines of every even uniform grid.
  const Surface eight = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{sin(v), sin(2.0 * v), u};
  });
  for (const int nv : {64, 127, 128}) {
    const SelfIntersectionReport r = check_self_intersection(eight, 32, nv);
    EXPECT_GE(r.pairs, 32u);
    const double cell = 2.0 * pi / nv * 1.25;
    const double a = std::abs(std::remainder(r.where.at.v, pi)), b = std::abs(std::remainder(r.other.v, pi));
    EXPECT_LE(a, cell);
    EXPECT_LE(b, cell);
    EXPECT_NEAR(std::abs(std::remainder(r.where.at.v - r.other.v, 2.0 * pi)), pi, 2.0 * cell);
    EXPECT_LE(r.where.point.head<2>().norm(), 0.01);
    EXPECT_GT(r.where.value, 0.0);
  }
}

TEST(SelfIntersection, TwistedBandIsFound) {
  // Between a circle and the same circle run backwards: every ruling passes through the plane x z, so the
  // sheets of +v and -v pass through each other along the segment at u = 1/2.
  const Surface band = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{cos(v), (1.0 - 2.0 * u) * sin(v) + 0.05 * sin(2.0 * v), u};
  });
  const SelfIntersectionReport r = check_self_intersection(band);
  EXPECT_GE(r.pairs, 16u);
}

TEST(SelfIntersection, OverlapInAPlaneIsFound) {
  // A flat spiral strip that covers itself after a full turn.
  const Surface strip = surface({{0.0, 1.0}, {0.0, 7.0}, false, false}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{(1.0 + u) * cos(v), (1.0 + u) * sin(v), T(0.0)};
  });
  const SelfIntersectionReport r = check_self_intersection(strip);
  EXPECT_GT(r.pairs, 0u);
  EXPECT_NEAR(std::abs(r.where.at.v - r.other.v), 2.0 * pi, 2.0 * 7.0 / 128 * 1.25);
}

TEST(SelfIntersection, RigidMotionChangesNoVerdict) {
  const Surface eight = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{sin(v), sin(2.0 * v), u};
  });
  for_all(
      [&](Rng& rng) {
        const RigidMotion motion = random_motion(rng);
        EXPECT_GT(check_self_intersection(placed(eight, motion), 16, 64).pairs, 0u);
        EXPECT_EQ(check_self_intersection(placed(flare(0.5), motion), 16, 64).pairs, 0u);
        EXPECT_EQ(check_self_intersection(placed(plane_patch(), motion), 16, 64).pairs, 0u);
      },
      20);
}

TEST(SelfIntersection, NotANumberStays) {
  const Surface broken = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{cos(v), sin(v), u + 0.0 * sqrt(4.0 - v)};
  });
  EXPECT_TRUE(std::isnan(check_self_intersection(broken).where.value));
}

TEST(SelfIntersection, DoesNotDependOnTheNumberOfThreads) {
  const Surface band = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{cos(v), (1.0 - 2.0 * u) * sin(v) + 0.05 * sin(2.0 * v), u};
  });
  const SelfIntersectionReport many = check_self_intersection(band);
  const ThreadLimit one(1);
  const SelfIntersectionReport single = check_self_intersection(band);
  EXPECT_EQ(many.pairs, single.pairs);
  EXPECT_EQ(many.where.value, single.where.value);
  EXPECT_EQ(many.where.at, single.where.at);
}

}  // namespace
}  // namespace blendwright
