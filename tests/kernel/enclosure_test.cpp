// Enclosures of curves and surfaces contain their jets everywhere.
#include "kernel/geometry/enclosure.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "kernel/geometry/bspline.hpp"
#include "kernel/primitives/primary.hpp"
#include "tests/kernel/primary_samples.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

/// Jets are evaluated in plain doubles; their own rounding is far below this part of the largest entry.
constexpr double jet_rounding = 1e-11;

void expect_inside(const ModelVector& model, double x, const Vec3& value, double scale, const char* what) {
  for (std::size_t d = 0; d < 3; ++d) {
    const Bounds b = model[d].at(x);
    const double y = value[static_cast<Eigen::Index>(d)], slack = jet_rounding * scale;
    EXPECT_LE(b.lo - slack, y) << what << ", coordinate " << d;
    EXPECT_GE(b.hi + slack, y) << what << ", coordinate " << d;
  }
}

struct Line {
  UV start, slope;  ///< u = start.u + slope.u t, t in [lo, hi]
  double lo, hi;
};

/// Compares at random places; returns the largest radius of a position.
double expect_enclosed(const Surface& s, const Line& line, Rng& rng) {
  const TaylorModel t = TaylorModel::parameter(line.lo, line.hi);
  SurfaceEnclosure e;
  EXPECT_TRUE(s.enclose(line.start.u + line.slope.u * t, line.start.v + line.slope.v * t, e));
  EXPECT_EQ(e.unproven, "");
  for (int k = 0; k < 8; ++k) {
    const double x = uniform(rng, -1.0, 1.0), at = t.at(x).middle();
    const SurfaceJet j = s.jet({line.start.u + line.slope.u * at, line.start.v + line.slope.v * at});
    const double scale =
        1.0 + j.S.norm() + j.Su.norm() + j.Sv.norm() + j.Suu.norm() + j.Suv.norm() + j.Svv.norm();
    expect_inside(e.S, x, j.S, scale, "S");
    expect_inside(e.Su, x, j.Su, scale, "Su");
    expect_inside(e.Sv, x, j.Sv, scale, "Sv");
    expect_inside(e.Suu, x, j.Suu, scale, "Suu");
    expect_inside(e.Suv, x, j.Suv, scale, "Suv");
    expect_inside(e.Svv, x, j.Svv, scale, "Svv");
  }
  return std::max({e.S[0].radius(), e.S[1].radius(), e.S[2].radius()});
}

/// A straight line through a random part of the domain, `part` of it long.
Line random_line(const SurfaceDomain& d, double part, Rng& rng) {
  const double u = d.u.at(uniform(rng, 0.1, 0.8)), v = d.v.at(uniform(rng, 0.1, 0.8));
  return {{u, v}, {d.u.length() * uniform(rng, -0.1, 0.1) / 0.1, d.v.length()}, 0.0, part};
}

BSplineSurface random_spline(Rng& rng, bool closed_v, int degree) {
  const BSplineBasis u = BSplineBasis::clamped(degree, {0.0, 0.3, 1.0});
  const std::vector<double> breaks{-1.0, -0.6, 0.1, 0.4, 1.2, 1.9, 2.5, 3.0};
  const BSplineBasis v =
      closed_v ? BSplineBasis::closed(degree, breaks) : BSplineBasis::clamped(degree, breaks);
  std::vector<Vec3> control;
  for (int i = 0; i < u.count() * v.count(); ++i)
    control.emplace_back(uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0));
  return {u, v, control};
}

TEST(Enclosure, OfEveryPrimaryContainsItsJets) {
  for (const PrimaryInfo& row : primaries_table())
    for (const test::Sample& sample : test::samples_of(row.kind)) {
      SCOPED_TRACE(sample.spec.kind);
      const Surface s = make_primary(sample.spec);
      for_all([&](Rng& rng) { expect_enclosed(s, random_line(s.domain(), 0.02, rng), rng); }, 10);
    }
}

TEST(Enclosure, OfSplinesContainsTheJetsOnBothSidesOfKnots) {
  for (const bool closed : {false, true})
    for (const int degree : {2, 3, 5})
      for_all(
          [&](Rng& rng) {
            const BSplineSurface s = random_spline(rng, closed, degree);
            expect_enclosed(s, {{uniform(rng, 0.0, 1.0), 0.0}, {0.0, 1.0}, 0.05, 0.15}, rng);  // over v = 0.1
            expect_enclosed(s, {{0.25, 0.5}, {1.0, 0.3}, 0.0, 0.1}, rng);                      // over u = 0.3
            expect_enclosed(s, {{0.0, 0.0}, {0.0, 1.0}, 0.1, 0.4}, rng);  // from knot to knot
            if (closed) {
              expect_enclosed(s, {{0.5, 0.0}, {0.0, 1.0}, 2.9, 3.1}, rng);   // over the seam
              expect_enclosed(s, {{0.5, 0.0}, {0.0, 1.0}, 6.9, 7.05}, rng);  // a turn further
            }
          },
          20);
}

TEST(Enclosure, OfASplineWithinASpanIsExactButForRounding) {
  for_all([](Rng& rng) {
    const BSplineSurface s = random_spline(rng, false, 5);
    const double radius = expect_enclosed(s, {{0.1, 0.0}, {0.0, 1.0}, -0.55, 0.05}, rng);
    EXPECT_LT(radius, 1e-12);
  });
}

TEST(Enclosure, OverAKnotNarrowsWithThePiece) {
  // Degree 5, simple knots: the pieces on both sides differ by O(w^5) in position, O(w^3) in second
  // derivatives.
  Rng rng(7);
  const BSplineSurface s = random_spline(rng, false, 5);
  const auto radius = [&](double w) {
    SurfaceEnclosure e;
    s.enclose(0.5, TaylorModel::parameter(0.1 - w, 0.1 + w), e);
    return e.Svv[0].radius();
  };
  EXPECT_GT(radius(0.1), 1e-6);
  EXPECT_LT(radius(0.01), radius(0.1) / 500.0);
}

TEST(Enclosure, LeavesOpenDomainsUnknown) {
  Rng rng(3);
  const BSplineSurface s = random_spline(rng, false, 3);
  SurfaceEnclosure e;
  s.enclose(0.5, TaylorModel::parameter(2.9, 3.1), e);
  EXPECT_FALSE(e.S[0].finite());
  s.enclose(0.5, TaylorModel::parameter(-1.0, 3.0), e);  // too many spans at once
  EXPECT_FALSE(e.S[0].finite());
}

TEST(Enclosure, IsRefusedByShapesThatOnlyHavePoints) {
  struct Plain {
    [[nodiscard]] SurfaceJet jet(UV) const { return {}; }
    [[nodiscard]] SurfacePartials partials(UV) const { return {}; }
    [[nodiscard]] SurfaceDomain domain() const { return {}; }
  };
  SurfaceEnclosure e;
  EXPECT_FALSE(Surface(Plain{}).enclose(TaylorModel(0.0), TaylorModel(0.0), e));
}

TEST(Enclosure, OfCurvesContainsTheirJets) {
  for_all([](Rng& rng) {
    const BSplineBasis basis = BSplineBasis::closed(4, {0.0, 0.2, 0.5, 0.6, 0.9, 1.0});
    std::vector<Vec2> control;
    for (int i = 0; i < basis.count(); ++i)
      control.emplace_back(uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0));
    const Curve2 curve = BSplineCurve<2>(basis, control);
    const double lo = uniform(rng, 0.0, 0.9);
    const TaylorModel t = TaylorModel::parameter(lo, lo + 0.05);
    CurveEnclosure e;
    ASSERT_TRUE(curve.enclose(t, e));
    const double x = uniform(rng, -1.0, 1.0);
    const CurveJet<2> j = curve.jet(t.at(x).middle());
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t d = 0; d < 2; ++d) {
        const double y = j.D[k][static_cast<Eigen::Index>(d)], slack = jet_rounding * (1.0 + j.D[2].norm());
        EXPECT_LE(e.D[k][d].at(x).lo - slack, y);
        EXPECT_GE(e.D[k][d].at(x).hi + slack, y);
      }
  });
}

}  // namespace
}  // namespace blendwright
