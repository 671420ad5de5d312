#include "kernel/primitives/primary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/geometry/bspline.hpp"
#include "kernel/primitives/quadrics.hpp"
#include "kernel/primitives/swept.hpp"
#include "tests/kernel/primary_samples.hpp"
#include "tests/support/for_all.hpp"
#include "tests/support/jet_matchers.hpp"

namespace blendwright {
namespace {

using test::bspline_sample;
using test::for_all;
using test::HasConsistentJetAt;
using test::HasConsistentPartialsAt;
using test::pi;
using test::random_inside;
using test::Rng;
using test::Sample;
using test::samples_of;
using test::spec_of;
using test::uniform;

/// Calls f(sample, surface) for the samples of every row.
template <class F>
void for_every_row(F f) {
  ASSERT_FALSE(primaries_table().empty());
  for (const PrimaryInfo& row : primaries_table()) {
    SCOPED_TRACE(std::string(row.kind));
    const std::vector<Sample> samples = samples_of(row.kind);
    ASSERT_FALSE(samples.empty()) << "a row without a sample";
    for (const Sample& s : samples) {
      ASSERT_EQ(check(s.spec), std::vector<Problem>{});
      f(s, make_primary(s.spec));
    }
  }
}

TEST(Primary, FulfilsTheEquationOfItsKind) {
  int equations = 0;
  for_every_row([&](const Sample& s, const Surface& surface) {
    if (!s.equation) return;
    ++equations;
    for_all([&](Rng& rng) {
      // A few roundings of terms of size 1 to 30 (the irregular cone's acos loses the most).
      ASSERT_NEAR(s.equation(surface.point(random_inside(rng, surface.domain()))), 0.0, 2e-13);
    });
  });
  EXPECT_EQ(equations, 15);  // all but the splines
}

/// The breaks of a surface made of splines, in u and v.
std::array<std::vector<double>, 2> breaks_of(const Surface& surface) {
  if (const auto* s = surface.target<BSplineSurface>()) return {s->basis_u().breaks(), s->basis_v().breaks()};
  if (const auto* s = surface.target<RevolvedSpline>())
    return {s->shape().profile.curve.basis().breaks(), std::vector<double>{}};
  if (const auto* s = surface.target<ExtrudedSpline>())
    return {std::vector<double>{}, s->shape().profile.curve.basis().breaks()};
  return {};
}

/// Differences reach over 2 steps to each side and need one polynomial there.
bool is_smooth_near(const Surface& surface, UV p) {
  const SurfaceDomain d = surface.domain();
  const auto breaks = breaks_of(surface);
  const auto clear = [](const std::vector<double>& ts, double x, double range) {
    return std::none_of(ts.begin(), ts.end(),
                        [&](double t) { return std::abs(t - x) <= 2.0 * test::step_share * range; });
  };
  return clear(breaks[0], p.u, d.u.length()) && clear(breaks[1], p.v, d.v.length());
}

TEST(Primary, DerivativesOfEveryRowAgreeWithDifferences) {
  for_every_row([](const Sample&, const Surface& surface) {
    int points = 0;
    for_all(
        [&](Rng& rng) {
          const UV p = random_inside(rng, surface.domain());
          if (!is_smooth_near(surface, p)) return;
          ++points;
          ASSERT_THAT(surface, HasConsistentJetAt(p));
          ASSERT_THAT(surface, HasConsistentPartialsAt(p));
        },
        50);
    EXPECT_GE(points, 20);
  });
}

/// A cylinder whose Sv is wrong by one part in a thousand.
struct BentCylinder {
  Surface surface;
  [[nodiscard]] SurfaceJet jet(UV p) const {
    SurfaceJet j = surface.jet(p);
    j.Sv *= 1.001;
    return j;
  }
  [[nodiscard]] SurfacePartials partials(UV p) const {
    SurfacePartials P = surface.partials(p);
    P(0, 4) *= 1.001;
    return P;
  }
  [[nodiscard]] SurfaceDomain domain() const { return surface.domain(); }
};

TEST(JetMatchers, NoticeADerivativeThatIsWrong) {
  const Surface bent = BentCylinder{make_primary(spec_of("cylinder", {{"radius", 1}}, Interval{0, 1}))};
  EXPECT_GT(test::jet_error(bent, {0.5, 0.5}), 10.0 * test::difference_error);
  EXPECT_GT(test::partials_error(bent, {0.5, 0.5}), 10.0 * test::difference_error);
}

TEST(Primary, MovesRigidlyWithItsPlacement) {
  const RigidMotion motion = RigidMotion::from_axis(Vec3(1, -2, 3), Vec3(1, 1, 1), Vec3(0, 1, 0));
  for_every_row([&](const Sample& s, const Surface& surface) {
    PrimarySpec spec = s.spec;
    spec.placement = motion;
    const Surface moved = make_primary(spec);
    for_all(
        [&](Rng& rng) {
          const UV p = random_inside(rng, surface.domain());
          const SurfaceJet a = surface.jet(p), b = moved.jet(p);
          ASSERT_LE((motion(a.S) - b.S).norm(), 1e-14 * (10 + a.S.norm()));
          ASSERT_LE((motion.R * a.Sv - b.Sv).norm(), 1e-14 * (1 + a.Sv.norm()));
          ASSERT_LE((motion.R * a.Suv - b.Suv).norm(), 1e-14 * (1 + a.Suv.norm()));
        },
        10);
  });
}

TEST(Primary, ClosesWhereItTurnsFully) {
  for_every_row([](const Sample&, const Surface& surface) {
    const SurfaceDomain d = surface.domain();
    for_all(
        [&](Rng& rng) {
          const UV p = random_inside(rng, d);
          const auto same = [](const SurfaceJet& a, const SurfaceJet& b) {
            // Rounding of the parameter 2 pi + v, times derivatives up to 20 per radian.
            ASSERT_LE((a.S - b.S).norm(), 1e-13);
            ASSERT_LE((a.Su - b.Su).norm() + (a.Sv - b.Sv).norm(), 1e-12);
            ASSERT_LE((a.Suu - b.Suu).norm() + (a.Suv - b.Suv).norm() + (a.Svv - b.Svv).norm(), 1e-10);
          };
          if (d.u_closed) same(surface.jet({d.u.lo, p.v}), surface.jet({d.u.hi, p.v}));
          if (d.v_closed) same(surface.jet({p.u, d.v.lo}), surface.jet({p.u, d.v.hi}));
        },
        10);
  });
  const auto domain = [](const PrimarySpec& s) { return make_primary(s).domain(); };
  EXPECT_TRUE(domain(spec_of("cylinder", {{"radius", 1}}, Interval{0, 1})).v_closed);
  EXPECT_TRUE(domain(spec_of("cylinder", {{"radius", 1}}, Interval{0, 1}, Interval{-pi, pi})).v_closed);
  EXPECT_FALSE(domain(spec_of("cylinder", {{"radius", 1}}, Interval{0, 1}, Interval{0, 6.28})).v_closed);
  EXPECT_TRUE(domain(spec_of("torus", {{"major_radius", 2}, {"minor_radius", 1}})).u_closed);
  EXPECT_FALSE(domain(spec_of("sphere", {{"radius", 1}})).u_closed);
  EXPECT_FALSE(domain(spec_of("irregular_cone", {{"radius", 1}, {"height", 1}}, Interval{0, 1})).v_closed);
  EXPECT_TRUE(domain(samples_of("revolution").at(2).spec).u_closed);
}

TEST(Primary, HasKnownPoints) {
  const auto at = [](const PrimarySpec& s, double u, double v) { return make_primary(s).point({u, v}); };
  const auto near = [](const Vec3& a, const Vec3& b) { return (a - b).norm() <= 1e-15 * (1 + b.norm()); };
  EXPECT_TRUE(near(at(spec_of("plane", {}, Interval{0, 9}, Interval{0, 9}), 1, 2), Vec3(1, 2, 0)));
  EXPECT_TRUE(near(at(spec_of("cylinder", {{"radius", 3}}, Interval{0, 9}), 5, pi / 2), Vec3(0, 3, 5)));
  EXPECT_TRUE(near(at(spec_of("cone", {{"radius", 1}, {"half_angle_deg", 30}}, Interval{0, 9}), 2, 0),
                   Vec3(2, 0, std::sqrt(3.0))));
  EXPECT_TRUE(near(at(spec_of("sphere", {{"radius", 2}}), pi / 2, 0), Vec3(0, 0, 2)));
  EXPECT_TRUE(
      near(at(spec_of("torus", {{"major_radius", 3}, {"minor_radius", 1}}), pi / 2, pi), Vec3(-3, 0, 1)));
  EXPECT_TRUE(near(at(spec_of("irregular_cone", {{"radius", 2}, {"height", 3}}, Interval{0, 9}), 1, pi / 2),
                   Vec3(0, pi, 3)));
  PrimarySpec wave = samples_of("extrusion").at(0).spec;
  EXPECT_TRUE(near(at(wave, 1, 0), Vec3(0, 0, 1)));  // the direction is made a unit vector
}

TEST(Primary, CanBeRecognisedWithItsNumbers) {
  const Surface s = make_primary(spec_of("cone", {{"radius", 1.5}, {"half_angle_deg", 45}}, Interval{0, 1}));
  const Cone* cone = s.target<Cone>();
  ASSERT_NE(cone, nullptr);
  EXPECT_EQ(cone->shape().radius, 1.5);
  EXPECT_DOUBLE_EQ(cone->shape().half_angle.value, pi / 4);
  EXPECT_EQ(s.target<Cylinder>(), nullptr);
  EXPECT_NE(make_primary(bspline_sample()).target<BSplineSurface>(), nullptr);
}

TEST(PrimariesTable, RowsAreNamedOnceAndFound) {
  for (const PrimaryInfo& row : primaries_table()) EXPECT_EQ(find_primary(row.kind), &row);
  EXPECT_EQ(find_primary("teapot"), nullptr);
}

}  // namespace
}  // namespace blendwright
