#include "kernel/geometry/bspline.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "kernel/base/error.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::integer;
using test::Rng;
using test::uniform;

constexpr double eps = 2.220446049250313e-16;

std::vector<double> random_breaks(Rng& rng, int spans) {
  std::vector<double> t{uniform(rng, -2.0, 2.0)};
  for (int i = 0; i < spans; ++i) t.push_back(t.back() + uniform(rng, 0.2, 1.0));
  return t;
}

BSplineBasis random_basis(Rng& rng, bool periodic) {
  const int degree = integer(rng, 1, 7), spans = integer(rng, 2, 9);
  std::vector<int> m(static_cast<std::size_t>(spans) + 1);
  for (int& k : m) k = integer(rng, 1, std::min(degree, 2));
  if (periodic) m.back() = m.front();
  if (!periodic) m.front() = m.back() = degree + 1;
  return {degree, random_breaks(rng, spans), m, periodic};
}

std::vector<Vec3> random_points(Rng& rng, int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    points.emplace_back(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
  return points;
}

double value(const BSplineBasis::Local& N, int k, int i) {
  return N.value[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
}

// The definition, by recursion on a knot vector: an independent construction of one basis function.
double cox_de_boor(const std::vector<double>& knots, std::size_t i, int p, double t) {
  if (p == 0) return knots[i] <= t && t < knots[i + 1] ? 1.0 : 0.0;
  const auto P = static_cast<std::size_t>(p);
  double sum = 0.0;
  if (knots[i + P] > knots[i])
    sum += (t - knots[i]) / (knots[i + P] - knots[i]) * cox_de_boor(knots, i, p - 1, t);
  if (knots[i + P + 1] > knots[i + 1])
    sum += (knots[i + P + 1] - t) / (knots[i + P + 1] - knots[i + 1]) * cox_de_boor(knots, i + 1, p - 1, t);
  return sum;
}

TEST(BSplineBasis, IsAPartitionOfUnityWithDerivativesThatCancel) {
  for_all([](Rng& rng) {
    const BSplineBasis basis = random_basis(rng, integer(rng, 0, 1) == 1);
    const Interval domain = basis.domain();
    const BSplineBasis::Local N = basis.evaluate(uniform(rng, domain.lo, domain.hi), 4);
    for (int k = 0; k <= 4; ++k) {
      double sum = 0.0, size = 0.0;
      for (int i = 0; i <= basis.degree(); ++i) {
        sum += value(N, k, i);
        size += std::abs(value(N, k, i));
        if (k == 0) {
          EXPECT_GE(value(N, k, i), 0.0);
        }
      }
      // degree + 1 <= 8 terms, each a chain of at most 8 products: some 64 roundings of the largest.
      EXPECT_NEAR(sum, k == 0 ? 1.0 : 0.0, 64 * eps * (1.0 + size)) << "derivative " << k;
    }
  });
}

TEST(BSplineBasis, AgreesWithTheRecursiveDefinition) {
  for_all([](Rng& rng) {
    const BSplineBasis basis = random_basis(rng, false);
    std::vector<double> knots;
    for (std::size_t i = 0; i < basis.breaks().size(); ++i)
      knots.insert(knots.end(), static_cast<std::size_t>(basis.multiplicities()[i]), basis.breaks()[i]);
    const double t = uniform(rng, basis.domain().lo, basis.domain().hi);
    const BSplineBasis::Local N = basis.evaluate(t, 0);
    for (int i = 0; i < basis.count(); ++i) {
      const bool local = i >= N.first && i <= N.first + basis.degree();
      EXPECT_NEAR(local ? value(N, 0, i - N.first) : 0.0,
                  cox_de_boor(knots, static_cast<std::size_t>(i), basis.degree(), t), 64 * eps);
    }
  });
}

TEST(BSplineBasis, OfAPeriodicDomainUsesControlsZeroToDegreeOnTheFirstSpan) {
  const BSplineBasis simple = BSplineBasis::closed(3, {0, 1, 2, 3, 4, 5, 6});
  EXPECT_EQ(simple.count(), 6);
  EXPECT_EQ(simple.evaluate(0.5, 0).first, 0);
  EXPECT_EQ(simple.evaluate(1.0, 0).first, 1);
  // Uniform cubic at a break: 1/6, 4/6, 1/6, 0.
  const BSplineBasis::Local N = simple.evaluate(0.0, 0);
  EXPECT_NEAR(value(N, 0, 0), 1.0 / 6.0, eps);
  EXPECT_NEAR(value(N, 0, 1), 4.0 / 6.0, eps);
  EXPECT_NEAR(value(N, 0, 3), 0.0, eps);
  const BSplineBasis doubled(3, {0, 1, 2, 3, 4}, {2, 1, 2, 1, 2}, true);
  EXPECT_EQ(doubled.count(), 6);
  EXPECT_EQ(doubled.evaluate(0.5, 0).first, 0);
  EXPECT_EQ(doubled.evaluate(1.5, 0).first, 1);
  EXPECT_EQ(doubled.evaluate(2.5, 0).first, 3);
  EXPECT_EQ(doubled.index(6), 0);
  EXPECT_EQ(doubled.index(-1), 5);
}

TEST(BSplineBasis, WrapsPeriodicParametersAndClampsOpenOnes) {
  for_all([](Rng& rng) {
    const BSplineBasis closed = random_basis(rng, true), open = random_basis(rng, false);
    const Interval a = closed.domain(), b = open.domain();
    const double t = uniform(rng, a.lo, a.hi);
    const BSplineBasis::Local at = closed.evaluate(t, 1), turned = closed.evaluate(t + 3.0 * a.length(), 1);
    if (at.first == turned.first) {
      // Wrapping moves t by a few roundings of its size (<= 40), which the slope (<= degree / 0.2) amplifies.
      for (int i = 0; i <= closed.degree(); ++i)
        EXPECT_NEAR(value(at, 0, i), value(turned, 0, i), 40 * 8 * eps * 35);
    }
    EXPECT_EQ(closed.evaluate(a.hi, 2).value, closed.evaluate(a.lo, 2).value);
    EXPECT_EQ(open.evaluate(b.hi + 1.0, 2).value, open.evaluate(b.hi, 2).value);
    EXPECT_EQ(open.evaluate(b.lo - 1.0, 2).value, open.evaluate(b.lo, 2).value);
  });
}

TEST(BSplineBasis, ReproducesLinesFromGrevilleAbscissae) {
  for_all([](Rng& rng) {
    const BSplineBasis basis = random_basis(rng, false);
    const std::vector<double> g = basis.greville();
    ASSERT_EQ(static_cast<int>(g.size()), basis.count());
    const double t = uniform(rng, basis.domain().lo, basis.domain().hi);
    const BSplineBasis::Local N = basis.evaluate(t, 0);
    double sum = 0.0;
    for (int i = 0; i <= basis.degree(); ++i)
      sum += value(N, 0, i) * g[static_cast<std::size_t>(N.first + i)];
    EXPECT_NEAR(sum, t, 64 * eps * 12.0);  // |g| <= 12
  });
}

TEST(BSplineBasis, RefusesBadInputAndNamesIt) {
  const auto problem = [](int degree, std::vector<double> breaks, std::vector<int> m,
                          bool periodic) -> std::string {
    try {
      const BSplineBasis basis(degree, std::move(breaks), std::move(m), periodic);
      return "accepted";
    } catch (const InputError& e) {
      return e.problems().front().where;
    }
  };
  EXPECT_EQ(problem(3, {0, 1, 2}, {4, 1, 4}, false), "accepted");
  EXPECT_EQ(problem(0, {0, 1}, {1, 1}, false), "degree");
  EXPECT_EQ(problem(26, {0, 1}, {27, 27}, false), "degree");
  EXPECT_EQ(problem(3, {0}, {4}, false), "breaks");
  EXPECT_EQ(problem(3, {0, 1, 1}, {4, 1, 4}, false), "breaks/2");
  EXPECT_EQ(problem(3, {0, std::nan(""), 2}, {4, 1, 4}, false), "breaks/1");
  EXPECT_EQ(problem(3, {0, 1, 2}, {4, 4}, false), "multiplicities");
  EXPECT_EQ(problem(3, {0, 1, 2}, {3, 1, 4}, false), "multiplicities/0");
  EXPECT_EQ(problem(3, {0, 1, 2}, {4, 4, 4}, false), "multiplicities/1");
  EXPECT_EQ(problem(3, {0, 1, 2}, {1, 1, 2}, true), "multiplicities");
  EXPECT_THROW((BSplineCurve<3>(BSplineBasis::clamped(3, {0, 1}), std::vector<Vec3>(3, Vec3::Zero()))),
               InputError);
  EXPECT_THROW((BSplineCurve<3>(BSplineBasis::clamped(1, {0, 1}), {Vec3::Zero(), Vec3(0, 0, std::nan(""))})),
               InputError);
}

TEST(BSplineCurve, JetAgreesWithCentralDifferences) {
  for_all([](Rng& rng) {
    const BSplineBasis basis = BSplineBasis::clamped(5, random_breaks(rng, 4));
    const BSplineCurve<3> curve(basis, random_points(rng, basis.count()));
    const double h = 1e-4, t = uniform(rng, basis.domain().lo + h, basis.domain().hi - h);
    const CurveJet<3> at = curve.jet(t), before = curve.jet(t - h), after = curve.jet(t + h);
    for (std::size_t k = 0; k + 1 < 4; ++k) {
      // Truncation h^2/6 |D[k+3]|, with |D[k]| <= 2 (2 p / 0.2)^k; across a knot of the 5th derivative h
      // |jump| of D[5].
      const double scale = 2.0 * std::pow(50.0, static_cast<double>(k) + 3.0);
      const double rounding = eps * std::pow(50.0, static_cast<double>(k)) * 64 / h;
      EXPECT_LE(((after.D[k] - before.D[k]) / (2.0 * h) - at.D[k + 1]).norm(), h * h * scale + rounding) << k;
    }
  });
}

TEST(BSplineCurve, IsSmoothAcrossTheSeamToDegreeMinusOne) {
  for_all([](Rng& rng) {
    const BSplineBasis basis = BSplineBasis::closed(5, random_breaks(rng, 8));
    const BSplineCurve<3> curve(basis, random_points(rng, basis.count()));
    const double hi = basis.domain().hi;
    const CurveJet<3> before = curve.jet(std::nextafter(hi, -1e9)), after = curve.jet(hi);
    for (std::size_t k = 0; k < 4; ++k)
      // One rounding of t (|t| <= 10) times the next derivative, and the rounding of the evaluation itself.
      EXPECT_LE((before.D[k] - after.D[k]).norm(),
                200 * eps * 10 * 2 * std::pow(50.0, static_cast<double>(k) + 1.0))
          << k;
  });
}

TEST(BSplineCurve, WithATripleBreakIsNotSmoothThere) {
  const BSplineBasis basis(3, {0, 1, 2}, {4, 3, 4}, false);
  const BSplineCurve<2> corner(basis, {{0, 0}, {0.3, 0}, {0.6, 0}, {1, 0}, {1, 0.3}, {1, 0.6}, {1, 1}});
  EXPECT_GT((corner.jet(std::nextafter(1.0, 0.0)).C1() - corner.jet(1.0).C1()).norm(), 1.0);
}

TEST(BSplineSurface, IsExactForATensorPolynomial) {
  // x = u, y = v, z = u v: bilinear, as a degree (2, 3) surface through Greville abscissae.
  const BSplineBasis bu = BSplineBasis::clamped(2, {0, 1, 3}), bv = BSplineBasis::clamped(3, {-1, 0, 2});
  const std::vector<double> gu = bu.greville(), gv = bv.greville();
  std::vector<Vec3> control;
  for (double u : gu)
    for (double v : gv) control.emplace_back(u, v, u * v);
  const BSplineSurface surface(bu, bv, control);
  const SurfaceJet jet = surface.jet({1.25, 0.5});
  EXPECT_LE((jet.S - Vec3(1.25, 0.5, 0.625)).norm(), 32 * eps);
  EXPECT_LE((jet.Su - Vec3(1, 0, 0.5)).norm(), 32 * eps);
  EXPECT_LE((jet.Sv - Vec3(0, 1, 1.25)).norm(), 32 * eps);
  EXPECT_LE((jet.Suv - Vec3(0, 0, 1)).norm(), 64 * eps);
  EXPECT_LE(jet.Suu.norm() + jet.Svv.norm(), 256 * eps);
  EXPECT_LE((surface.edge_u(1).jet(0.5).C() - surface.jet({3.0, 0.5}).S).norm(), 32 * eps);
  EXPECT_THROW((void)surface.edge_u(2), InputError);
}

TEST(BSplineSurface, PartialsAreDerivativesOfEachOther) {
  for_all(
      [](Rng& rng) {
        const BSplineBasis bu = BSplineBasis::clamped(5, {0.0, 0.5, 1.0, 1.5}),
                           bv = BSplineBasis::closed(6, {0, 1, 2, 3, 4, 5, 6});
        const BSplineSurface surface(bu, bv, random_points(rng, bu.count() * bv.count()));
        const double h = 1e-4;
        const UV p{uniform(rng, 0.1, 0.4), uniform(rng, 0.1, 0.9)};  // inside one span: all derivatives exist
        const SurfacePartials at = surface.partials(p);
        const SurfacePartials u0 = surface.partials({p.u - h, p.v}), u1 = surface.partials({p.u + h, p.v});
        const SurfacePartials v0 = surface.partials({p.u, p.v - h}), v1 = surface.partials({p.u, p.v + h});
        for (int i = 0; i < 4; ++i)
          for (int j = 0; i + j < 4; ++j) {
            // |d^{i+j}| <= 2 (2 * 5 / 0.25)^i (2 * 6 / 1)^j; truncation h^2/6 of the third derivative beyond.
            const double scale = 2.0 * std::pow(40.0, i) * std::pow(12.0, j),
                         rounding = 256 * eps * scale / h;
            EXPECT_LE(((u1(i, j) - u0(i, j)) / (2 * h) - at(i + 1, j)).norm(),
                      h * h * scale * 64000 + rounding);
            EXPECT_LE(((v1(i, j) - v0(i, j)) / (2 * h) - at(i, j + 1)).norm(),
                      h * h * scale * 1728 + rounding);
          }
        const SurfaceJet jet = surface.jet(p);
        EXPECT_EQ(jet.Suv, at(1, 1));
        EXPECT_EQ(jet.Svv, at(0, 2));
      },
      50);
}

}  // namespace
}  // namespace blendwright
