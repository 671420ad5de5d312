#include "kernel/geometry/spline_interpolation.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "kernel/base/error.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using Eigen::Index;
using std::numbers::pi;
using test::for_all;
using test::integer;
using test::Rng;
using test::uniform;

constexpr double eps = 2.220446049250313e-16;

std::vector<double> uniform_breaks(double lo, double hi, int spans) {
  std::vector<double> t;
  for (int i = 0; i <= spans; ++i) t.push_back(lo + (hi - lo) * i / spans);
  return t;
}

std::vector<double> uneven_breaks(Rng& rng, int spans) {
  std::vector<double> t{0.0};
  for (int i = 0; i < spans; ++i) t.push_back(t.back() + uniform(rng, 0.25, 1.0));
  for (double& x : t) x /= t.back();
  t.back() = 1.0;
  return t;
}

// k-th derivative of sin(2 pi t + 0.3).
double wave(double t, int k) { return std::pow(2 * pi, k) * std::sin(2 * pi * t + 0.3 + k * pi / 2); }

BSplineCurve<1> curve_of(const BSplineBasis& basis, const Eigen::MatrixXd& control) {
  std::vector<Eigen::Matrix<double, 1, 1>> poles;
  for (Index i = 0; i < control.rows(); ++i) poles.emplace_back(control(i, 0));
  return {basis, poles};
}

BSplineCurve<1> periodic_wave(int degree, int spans) {
  const BSplineBasis basis = BSplineBasis::closed(degree, uniform_breaks(0, 1, spans));
  Eigen::MatrixXd values(spans, 1);
  for (Index i = 0; i < spans; ++i) values(i, 0) = wave(static_cast<double>(i) / spans, 0);
  return curve_of(basis, periodic_control(basis, values));
}

BSplineCurve<1> complete_wave(int degree, int spans) {
  const BSplineBasis basis = BSplineBasis::clamped(degree, uniform_breaks(0, 0.7, spans));
  Eigen::MatrixXd values(spans + 1, 1), start((degree - 1) / 2, 1), end((degree - 1) / 2, 1);
  for (Index i = 0; i <= spans; ++i) values(i, 0) = wave(basis.breaks()[static_cast<std::size_t>(i)], 0);
  for (Index k = 0; k < start.rows(); ++k) {
    start(k, 0) = wave(0.0, static_cast<int>(k) + 1);
    end(k, 0) = wave(0.7, static_cast<int>(k) + 1);
  }
  return curve_of(basis, complete_control(basis, values, start, end));
}

double error_of_wave(const BSplineCurve<1>& curve) {
  double worst = 0.0;
  const Interval range = curve.domain().v;
  for (int i = 0; i <= 2000; ++i) {
    const double t = range.at(i / 2000.0);
    worst = std::max(worst, std::abs(curve.jet(t).C()[0] - wave(t, 0)));
  }
  return worst;
}

TEST(PeriodicSpline, ConvergesWithOrderDegreePlusOne) {
  for (int degree : {3, 5, 7}) {
    const double ratio = error_of_wave(periodic_wave(degree, 12)) / error_of_wave(periodic_wave(degree, 24));
    // Next term of the error expansion is O(h^2) smaller: 2 pi / 12 squared, about a quarter.
    EXPECT_NEAR(std::log2(ratio), degree + 1, 0.5) << "degree " << degree;
  }
}

TEST(PeriodicSpline, PassesThroughTheValuesAndIsSmoothAcrossTheSeam) {
  for_all([](Rng& rng) {
    const int n = integer(rng, 6, 40), degree = 5;
    const BSplineBasis basis = BSplineBasis::closed(degree, uneven_breaks(rng, n));
    Eigen::MatrixXd values(n, 1);
    for (Index i = 0; i < n; ++i) values(i, 0) = uniform(rng, -1, 1);
    const Eigen::MatrixXd control = periodic_control(basis, values);
    const BSplineCurve<1> curve = curve_of(basis, control);
    const double size = control.cwiseAbs().maxCoeff();
    for (Index i = 0; i < n; ++i)
      EXPECT_NEAR(curve.jet(basis.breaks()[static_cast<std::size_t>(i)]).C()[0], values(i, 0),
                  1e3 * eps * size);
    const BSplineBasis::Local before = basis.evaluate(std::nextafter(1.0, 0.0), 4),
                              after = basis.evaluate(1.0, 4);
    for (std::size_t k = 0; k <= 4; ++k) {
      double jump = 0.0, terms = 0.0;
      for (int i = 0; i <= degree; ++i) {
        const auto I = static_cast<std::size_t>(i);
        jump += before.value[k][I] * control(basis.index(before.first + i), 0);
        jump -= after.value[k][I] * control(basis.index(after.first + i), 0);
        terms += (std::abs(before.value[k][I]) + std::abs(after.value[k][I])) * size;
      }
      // The step of one rounding in t times the next derivative: spans are >= 1/(4 n + 4), slopes <= 10 (4 n
      // + 4).
      EXPECT_LE(std::abs(jump), 40.0 * (4 * n + 4) * eps * terms) << "derivative " << k;
    }
  });
}

TEST(PeriodicSpline, NeedsDegreePlusOnePoints) {
  const BSplineBasis basis = BSplineBasis::closed(5, uniform_breaks(0, 1, 5));
  EXPECT_THROW((void)periodic_control(basis, Eigen::MatrixXd::Zero(5, 1)), GeometryError);
  const BSplineBasis enough = BSplineBasis::closed(5, uniform_breaks(0, 1, 6));
  EXPECT_NO_THROW((void)periodic_control(enough, Eigen::MatrixXd::Zero(6, 1)));
  EXPECT_THROW((void)periodic_control(enough, Eigen::MatrixXd::Zero(7, 1)), InputError);
  EXPECT_THROW(
      (void)periodic_control(BSplineBasis::closed(4, uniform_breaks(0, 1, 6)), Eigen::MatrixXd::Zero(6, 1)),
      InputError);
  EXPECT_THROW(
      (void)periodic_control(BSplineBasis::clamped(5, uniform_breaks(0, 1, 6)), Eigen::MatrixXd::Zero(6, 1)),
      InputError);
}

TEST(CompleteSpline, ConvergesWithOrderDegreePlusOne) {
  for (int degree : {1, 3, 5, 7, 9}) {
    const double ratio = error_of_wave(complete_wave(degree, 8)) / error_of_wave(complete_wave(degree, 16));
    EXPECT_NEAR(std::log2(ratio), degree + 1, 0.5) << "degree " << degree;
  }
}

TEST(CompleteSpline, ReproducesPolynomialsOfItsDegree) {
  for_all([](Rng& rng) {
    const int degree = 2 * integer(rng, 1, 3) + 1, n = integer(rng, 1, 20), h = (degree - 1) / 2;
    std::vector<double> c(static_cast<std::size_t>(degree) + 1);
    for (double& x : c) x = uniform(rng, -1, 1);
    const auto poly = [&](double t, int k) {
      double sum = 0.0;
      for (int i = degree; i >= k; --i) {
        double f = 1.0;
        for (int j = 0; j < k; ++j) f *= i - j;
        sum = sum * t + f * c[static_cast<std::size_t>(i)];
      }
      return sum;
    };
    const BSplineBasis basis = BSplineBasis::clamped(degree, uneven_breaks(rng, n));
    Eigen::MatrixXd values(n + 1, 1), start(h, 1), end(h, 1);
    for (Index i = 0; i <= n; ++i) values(i, 0) = poly(basis.breaks()[static_cast<std::size_t>(i)], 0);
    for (int k = 1; k <= h; ++k) {
      start(k - 1, 0) = poly(0.0, k);
      end(k - 1, 0) = poly(1.0, k);
    }
    const BSplineCurve<1> curve = curve_of(basis, complete_control(basis, values, start, end));
    // Condition of spline collocation grows like 2^degree; values are below 8.
    for (int i = 0; i <= 50; ++i) EXPECT_NEAR(curve.jet(i / 50.0).C()[0], poly(i / 50.0, 0), 1e-12);
    EXPECT_NEAR(curve.jet(0.0).C1()[0], poly(0.0, 1), 1e-12);
    EXPECT_NEAR(curve.jet(1.0).C1()[0], poly(1.0, 1), 1e-10);
  });
}

TEST(CompleteSpline, KeepsTheGivenEndDerivatives) {
  const BSplineCurve<1> curve = complete_wave(5, 9);
  // The step is 0.078: rounding of a second difference of values of size 1 is eps / h^2 times the triangle's
  // constants.
  for (double t : {0.0, 0.7}) {
    EXPECT_NEAR(curve.jet(t).C1()[0], wave(t, 1), 1e-12);
    EXPECT_NEAR(curve.jet(t).C2()[0], wave(t, 2), 1e-10);
  }
}

TEST(InterpolatePoints, ConvergesOnOpenAndClosedCurves) {
  const auto error = [](int n, bool closed) {
    std::vector<Vec3> points;
    std::vector<double> t;
    const double end = closed ? 2 * pi : 2.0;
    for (int i = 0; i < n; ++i) t.push_back(end * i / (closed ? n : n - 1));
    for (double x : t) points.emplace_back(std::cos(x), std::sin(x), std::cos(2 * x));
    if (closed) t.push_back(end);
    const BSplineCurve<3> curve = interpolate_points<3>(points, t, closed);
    double worst = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const double x = end * i / 1000;
      worst = std::max(worst, (curve.jet(x).C() - Vec3(std::cos(x), std::sin(x), std::cos(2 * x))).norm());
    }
    return worst;
  };
  EXPECT_NEAR(std::log2(error(20, true) / error(40, true)), 6.0, 0.5);
  EXPECT_NEAR(std::log2(error(17, false) / error(33, false)), 6.0,
              0.8);  // one-sided end derivatives converge more slowly
}

TEST(InterpolatePoints, IsExactForAPolynomialCurveOfItsDegree) {
  std::vector<Vec2> points;
  std::vector<double> t{0, 0.1, 0.25, 0.3, 0.55, 0.6, 0.8, 1.0};
  for (double x : t) points.emplace_back(x, 1 - x * x * x * x * x);
  const BSplineCurve<2> curve = interpolate_points<2>(points, t, false);
  for (double x : {0.05, 0.4, 0.9}) EXPECT_LE((curve.jet(x).C() - Vec2(x, 1 - std::pow(x, 5))).norm(), 1e-12);
}

TEST(InterpolatePoints, RefusesBadInputAndNamesIt) {
  const auto problem = [](std::vector<Vec2> points, const std::vector<double>& t, bool closed,
                          int degree) -> std::string {
    try {
      (void)interpolate_points<2>(points, t, closed, degree);
      return "accepted";
    } catch (const InputError& e) {
      return e.problems().front().where;
    }
  };
  const std::vector<Vec2> four{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(problem(four, {0, 1, 2, 3}, false, 3), "accepted");
  EXPECT_EQ(problem(four, {0, 1, 2, 3, 4}, true, 3), "accepted");
  EXPECT_EQ(problem(four, {0, 1, 2, 3}, false, 5), "points");
  EXPECT_EQ(problem(four, {0, 1, 2, 3}, false, 2), "degree");
  EXPECT_EQ(problem(four, {0, 1, 2, 3}, true, 3), "parameters");
  EXPECT_EQ(problem(four, {0, 1, 1, 3}, false, 3), "parameters");
  EXPECT_EQ(problem({{0, 0}, {1, 0}, {1, 0}, {0, 1}}, {0, 1, 2, 3}, false, 3), "points/1");
  EXPECT_EQ(problem({{0, 0}, {1, 0}, {1, 1}, {0, 0}}, {0, 1, 2, 3, 4}, true, 3), "points/3");
  EXPECT_EQ(problem({{0, 0}, {1, 0}, {1, std::nan("")}, {0, 1}}, {0, 1, 2, 3}, false, 3), "points/2");
}

TEST(ChordParameters, AreProportionalToDistances) {
  EXPECT_THAT(chord_parameters<2>({{0, 0}, {3, 4}, {3, 9}}, false), testing::ElementsAre(0.0, 0.5, 1.0));
  EXPECT_THAT(chord_parameters<2>({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true),
              testing::ElementsAre(0, 0.25, 0.5, 0.75, 1));
  EXPECT_THROW((void)chord_parameters<2>({{0, 0}}, false), InputError);
}

/// Torus patch: closed in both directions, or the open part u in [0, 1].
struct TestTorus {
  bool open = false;
  [[nodiscard]] SurfaceDomain domain() const {
    return {{0.0, open ? 1.0 : 2 * pi}, {0.0, 2 * pi}, !open, true};
  }
  [[nodiscard]] SurfacePartials partials(UV p) const {
    SurfacePartials d;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) {
        const double c = std::cos(p.u + i * pi / 2), s = std::sin(p.u + i * pi / 2),
                     r = 0.4 * c + (i == 0 ? 1.0 : 0.0);
        d(i, j) =
            Vec3(r * std::cos(p.v + j * pi / 2), r * std::sin(p.v + j * pi / 2), j == 0 ? 0.4 * s : 0.0);
      }
    return d;
  }
  [[nodiscard]] SurfaceJet jet(UV p) const {
    const SurfacePartials d = partials(p);
    return {d(0, 0), d(1, 0), d(0, 1), d(2, 0), d(1, 1), d(0, 2)};
  }
};

TEST(FitSurface, MeetsItsToleranceBetweenItsSamples) {
  for (bool open : {false, true}) {
    const TestTorus torus{open};
    const SurfaceFit fit = fit_surface(torus, {.tolerance = 1e-7});
    EXPECT_LE(fit.error, 1e-7);
    EXPECT_EQ(fit.surface.domain().u_closed, !open);
    EXPECT_TRUE(fit.surface.domain().v_closed);
    double worst = 0.0;
    const SurfaceDomain domain = torus.domain();
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j) {
        const UV p{domain.u.at(i / 200.0), domain.v.at(j / 200.0)};
        worst = std::max(worst, (fit.surface.jet(p).S - torus.jet(p).S).norm());
      }
    EXPECT_LE(worst, 1.1 * fit.error);  // three samples per span miss little of a peak in the middle
  }
}

TEST(FitSurface, KeepsTheEndDerivativesOfOpenDirections) {
  const TestTorus torus{true};
  const BSplineSurface spline = fit_surface(torus, {.tolerance = 1e-9}).surface;
  const double v = spline.basis_v().breaks()[3];  // at a break the v-interpolation is exact
  for (double u : {0.0, 1.0}) {
    EXPECT_LE((spline.jet({u, v}).Su - torus.jet({u, v}).Su).norm(), 1e-12);
    EXPECT_LE((spline.jet({u, v}).Suu - torus.jet({u, v}).Suu).norm(), 1e-10);
  }
}

TEST(FitSurface, RefusesWhatItCannotReach) {
  EXPECT_THROW((void)fit_surface(TestTorus{}, {.tolerance = 1e-12, .max_spans = 16}), ConvergenceError);
  EXPECT_THROW((void)fit_surface(TestTorus{}, {.tolerance = 0.0}), InputError);
  EXPECT_THROW((void)fit_surface(TestTorus{}, {.degree = 4}), InputError);
  const BSplineBasis open = BSplineBasis::clamped(5, {0, 1}),
                     closed = BSplineBasis::closed(5, uniform_breaks(0, 1, 8));
  EXPECT_THROW((void)interpolate_surface(TestTorus{true}, closed, closed), InputError);
  EXPECT_THROW((void)interpolate_surface(TestTorus{true}, BSplineBasis::clamped(7, {0, 1}), closed),
               InputError);
}

}  // namespace
}  // namespace blendwright
