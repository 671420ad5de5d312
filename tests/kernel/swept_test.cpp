#include "kernel/primitives/swept.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernel/geometry/bspline.hpp"
#include "tests/kernel/primary_samples.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::pi;
using test::random_inside;
using test::Rng;
using test::spec_of;
using test::typed;

TEST(FormulaPrimary, EqualsTheBuiltInOfTheSameFormula) {
  struct Pair {
    PrimarySpec built_in, formula;
  };
  const Interval turn{0, 2 * pi}, u{0.2, 1.3};
  std::vector<Pair> pairs{{spec_of("torus", {{"major_radius", 3}, {"minor_radius", 1}}),
                           typed({"(3+cos(u))*cos(v)", "(3+cos(u))*sin(v)", "sin(u)"}, turn, turn)},
                          {spec_of("elliptic_paraboloid", {{"a", 1}, {"b", 2}, {"c", 3}}, u),
                           typed({"u*cos(v)", "2*u*sin(v)", "3*u^2"}, u, turn)},
                          {spec_of("hyperboloid_one_sheet", {{"a", 1}, {"b", 2}, {"c", 3}}, u),
                           typed({"cosh(u)*cos(v)", "2*cosh(u)*sin(v)", "3*sinh(u)"}, u, turn)},
                          {spec_of("irregular_cone", {{"radius", 2}, {"height", 3}}, u),
                           typed({"2*u*cos(v)", "2*u*v*sin(v)", "3*u"}, u, turn)}};
  pairs[0].formula.closed = {true, true};
  for (const Pair& pair : pairs) {
    SCOPED_TRACE(pair.built_in.kind);
    const Surface a = make_primary(pair.built_in), b = make_primary(pair.formula);
    EXPECT_EQ(b.domain().u_closed && b.domain().v_closed, pair.formula.closed[0]);
    for_all(
        [&](Rng& rng) {
          const UV p = random_inside(rng, a.domain());
          const SurfacePartials P = a.partials(p), Q = b.partials(p);
          for (std::size_t k = 0; k < P.d.size(); ++k)
            ASSERT_LE((P.d[k] - Q.d[k]).norm(), 1e-14 * (1 + P.d[k].norm()) * 4)
                << k;  // 4 roundings per operation chain
        },
        50);
  }
}

TEST(FormulaPrimary, AcceptsAnyParameterOfAClosedDirection) {
  // The square of 4 u (1 - u) starts and ends with value 0 and slope 0, but is not periodic.
  PrimarySpec spec = typed({"v", "(4*u*(1-u))^2", "v"}, {0, 1}, {0, 1});
  spec.closed = {true, false};
  ASSERT_EQ(check(spec), std::vector<Problem>{});
  const Surface s = make_primary(spec);
  for (const double turns : {-2.0, -1.0, 1.0, 3.0})
    EXPECT_LE((s.point({0.25 + turns, 0.5}) - s.point({0.25, 0.5})).norm(), 1e-14);
}

TEST(BSplinePrimary, TakesFlatKnots) {
  PrimarySpec spec = spec_of("bspline");
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 5; ++j) spec.points.emplace_back(i, j, i * j);
  spec.degree = {2, 3};
  spec.knots[0] = {0, 0, 0, 0.5, 1, 1, 1};
  spec.knots[1] = {0, 0, 0, 0, 2, 3, 3, 3, 3};
  ASSERT_EQ(check(spec), std::vector<Problem>{});
  const Surface made = make_primary(spec);
  const auto* surface = made.target<BSplineSurface>();
  ASSERT_NE(surface, nullptr);
  EXPECT_EQ(surface->basis_u().breaks(), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(surface->basis_v().multiplicities(), (std::vector<int>{4, 1, 4}));
}

TEST(BSplinePrimary, ClosesWithOnePeriodOfKnots) {
  PrimarySpec spec = spec_of("bspline");
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 6; ++j) spec.points.emplace_back(std::cos(j * pi / 3), std::sin(j * pi / 3), i);
  spec.degree = {2, 3};
  spec.point_rows = 3;
  spec.closed = {false, true};
  spec.knots[1] = {0, 1, 2, 3, 4, 5, 6};
  ASSERT_EQ(check(spec), std::vector<Problem>{});
  const SurfaceDomain d = make_primary(spec).domain();
  EXPECT_TRUE(d.v_closed);
  EXPECT_FALSE(d.u_closed);
  EXPECT_EQ(d.v, (Interval{0, 6}));
}

}  // namespace
}  // namespace blendwright
