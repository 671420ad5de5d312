#include "kernel/primitives/primary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/geometry/bspline.hpp"
#include "kernel/primitives/quadrics.hpp"
#include "kernel/primitives/swept.hpp"
#include "tests/support/for_all.hpp"
#include "tests/support/jet_matchers.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::HasConsistentJetAt;
using test::HasConsistentPartialsAt;
using test::Rng;
using test::uniform;

constexpr double pi = std::numbers::pi;

PrimarySpec spec_of(std::string kind, std::map<std::string, double> numbers = {},
                    std::optional<Interval> u = {}, std::optional<Interval> v = {}) {
  PrimarySpec spec;
  spec.kind = std::move(kind);
  spec.numbers = std::move(numbers);
  spec.u = u;
  spec.v = v;
  return spec;
}

PrimarySpec typed(std::array<const char*, 3> S, Interval u, Interval v) {
  PrimarySpec spec = spec_of("formula", {}, u, v);
  spec.formulas.assign(S.begin(), S.end());
  return spec;
}

PrimarySpec bspline_sample() {
  PrimarySpec spec = spec_of("bspline");
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 8; ++j) spec.points.emplace_back(i, j, std::sin(0.7 * i) * std::cos(0.9 * j));
  spec.degree = {4, 5};
  spec.point_rows = 6;
  return spec;
}

/// Equation of the surface in x, y, z, scaled to size 1; 0 on the surface.
using Equation = double (*)(const Vec3&);
struct Sample {
  PrimarySpec spec;
  Equation equation = nullptr;
};

/// One or more samples of each kind; the tests below ask for those of every row of the table.
std::vector<Sample> samples_of(std::string_view kind) {
  const Interval u{0.2, 1.3};
  std::vector<Sample> samples;
  const auto add = [&](PrimarySpec spec, Equation equation) {
    if (spec.kind == kind) samples.push_back({std::move(spec), equation});
  };
  add(spec_of("plane", {}, Interval{-1, 2}, Interval{-3, 1}), [](const Vec3& p) { return p[2]; });
  add(spec_of("cylinder", {{"radius", 3}}, u),
      [](const Vec3& p) { return (p[0] * p[0] + p[1] * p[1]) / 9 - 1; });
  add(spec_of("elliptic_cylinder", {{"a", 2}, {"b", 3}}, u),
      [](const Vec3& p) { return p[0] * p[0] / 4 + p[1] * p[1] / 9 - 1; });
  add(spec_of("cone", {{"radius", 1}, {"half_angle_deg", 30}}, u),
      [](const Vec3& p) { return std::hypot(p[0], p[1]) - (1 + p[2] * std::tan(pi / 6)); });
  add(spec_of("elliptic_cone", {{"a", 2}, {"b", 3}, {"height", -4}}, u),
      [](const Vec3& p) { return p[0] * p[0] / 4 + p[1] * p[1] / 9 - p[2] * p[2] / 16; });
  add(spec_of("irregular_cone", {{"radius", 2}, {"height", 3}}, u, Interval{0.1, 3}), [](const Vec3& p) {
    const double t = p[2] / 3, v = std::acos(p[0] / (2 * t));
    return p[1] / (2 * t) - v * std::sin(v);
  });
  add(spec_of("sphere", {{"radius", 2}}), [](const Vec3& p) { return p.squaredNorm() / 4 - 1; });
  add(spec_of("ellipsoid", {{"a", 1}, {"b", 2}, {"c", 3}}),
      [](const Vec3& p) { return p[0] * p[0] + p[1] * p[1] / 4 + p[2] * p[2] / 9 - 1; });
  add(spec_of("torus", {{"major_radius", 3}, {"minor_radius", 1}}),
      [](const Vec3& p) { return std::hypot(std::hypot(p[0], p[1]) - 3, p[2]) - 1; });
  add(spec_of("elliptic_paraboloid", {{"a", 1}, {"b", 2}, {"c", -3}}, u),
      [](const Vec3& p) { return p[2] / -3 - p[0] * p[0] - p[1] * p[1] / 4; });
  add(spec_of("hyperboloid_one_sheet", {{"a", 1}, {"b", 2}, {"c", 3}}, Interval{-1, 1}),
      [](const Vec3& p) { return p[0] * p[0] + p[1] * p[1] / 4 - p[2] * p[2] / 9 - 1; });
  add(spec_of("hyperboloid_two_sheets", {{"a", 1}, {"b", 2}, {"c", -3}}, u), [](const Vec3& p) {
    return p[2] < 0 ? p[2] * p[2] / 9 - p[0] * p[0] - p[1] * p[1] / 4 - 1 : 1.0;  // c < 0: the lower sheet
  });
  PrimarySpec vase = spec_of("revolution", {}, Interval{0, 2});
  vase.formulas = {"1 + 0.2*sin(2*u)", "u"};
  add(vase, [](const Vec3& p) { return std::hypot(p[0], p[1]) - (1 + 0.2 * std::sin(2 * p[2])); });
  PrimarySpec turned = spec_of("revolution");
  for (int i = 0; i < 9; ++i) turned.points.emplace_back(1.0 + 0.1 * std::cos(i), 0.3 * i, 0.0);
  add(turned, nullptr);
  PrimarySpec ring = spec_of("revolution");
  for (int i = 0; i < 12; ++i) ring.points.emplace_back(3 + std::cos(i * pi / 6), std::sin(i * pi / 6), 0.0);
  ring.points_closed = true;
  add(ring, nullptr);
  PrimarySpec wave = spec_of("extrusion", {}, Interval{0, 1}, Interval{0, 3});
  wave.formulas = {"v", "sin(v)", "0"};
  wave.direction = Vec3(0, 0, 5);
  add(wave, [](const Vec3& p) { return p[1] - std::sin(p[0]); });
  PrimarySpec rail = spec_of("extrusion", {}, Interval{0, 1});
  for (int i = 0; i < 7; ++i) rail.points.emplace_back(i, i * i * 0.1, 0.0);
  rail.direction = Vec3(1, 0, 1);
  add(rail, nullptr);
  add(bspline_sample(), nullptr);
  add(typed({"u", "v", "0.2*u^2 - 0.1*v^2"}, {-1, 1}, {-1, 1}),
      [](const Vec3& p) { return p[2] - 0.2 * p[0] * p[0] + 0.1 * p[1] * p[1]; });
  return samples;
}

UV random_inside(Rng& rng, const SurfaceDomain& d) {
  // Differences reach 2 / 500 of the range to each side; spline profiles end at their border.
  return {d.u.at(uniform(rng, 0.02, 0.98)), d.v.at(uniform(rng, 0.02, 0.98))};
}

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
  const BentCylinder bent{make_primary(spec_of("cylinder", {{"radius", 1}}, Interval{0, 1}))};
  EXPECT_THAT(bent, testing::Not(HasConsistentJetAt(UV{0.5, 0.5})));
  EXPECT_THAT(bent, testing::Not(HasConsistentPartialsAt(UV{0.5, 0.5})));
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

struct Broken {
  const char* what;
  PrimarySpec spec;
  std::vector<Problem> problems;
};

template <class Change>
PrimarySpec changed(PrimarySpec spec, Change change) {
  change(spec);
  return spec;
}

std::vector<Broken> broken_specs() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const PrimarySpec cylinder = spec_of("cylinder", {{"radius", 1}}, Interval{0, 1});
  const PrimarySpec vase = samples_of("revolution").at(0).spec;
  const PrimarySpec sheet = samples_of("formula").at(0).spec;
  const PrimarySpec patch = bspline_sample();
  std::vector<Broken> b;
  const auto add = [&](const char* what, const PrimarySpec& spec, auto change,
                       std::vector<Problem> problems) {
    b.push_back({what, changed(spec, change), std::move(problems)});
  };
  add("missing and misspelt", cylinder,
      [](auto& s) {
        s.numbers = {{"raduis", 2.0}};
      },
      {{"radius", "is missing, must be > 0"},
       {"raduis", "is not a number of kind \"cylinder\"; did you mean \"radius\"?"}});
  add("negative", cylinder, [](auto& s) { s.numbers["radius"] = -2; }, {{"radius", "is -2, must be > 0"}});
  add("zero", cylinder, [](auto& s) { s.numbers["radius"] = 0; }, {{"radius", "is 0, must be > 0"}});
  add("NaN", cylinder, [&](auto& s) { s.numbers["radius"] = nan; }, {{"radius", "is nan, must be > 0"}});
  add("no length", cylinder, [](auto& s) { s.u.reset(); },
      {{"length", "is missing, must be a range [from, to]"}});
  add("reversed", cylinder,
      [](auto& s) {
        s.u = Interval{1, 0};
      },
      {{"length", "is [1, 0], must rise from the first number to the second"}});
  add("empty range", cylinder,
      [](auto& s) {
        s.u = Interval{1, 1};
      },
      {{"length", "is [1, 1], must rise from the first number to the second"}});
  add("infinite range", cylinder,
      [](auto& s) {
        s.u = Interval{0, INFINITY};
      },
      {{"length", "is [0, inf], must be finite"}});
  add("wide angle", cylinder,
      [](auto& s) {
        s.v = Interval{0, 400 * pi / 180};
      },
      {{"angle_deg", "is [0, 400], must not be wider than 360"}});
  add("all at once", cylinder,
      [](auto& s) {
        s.numbers["radius"] = -1;
        s.u.reset();
        s.v = Interval{3, 2};
        s.formulas = {"u"};
      },
      {{"radius", "is -1, must be > 0"},
       {"formulas", "are given, but kind \"cylinder\" takes none"},
       {"length", "is missing, must be a range [from, to]"},
       {"angle_deg", "is [171.887339, 114.591559], must rise from the first number to the second"}});
  add("no rotation", cylinder, [](auto& s) { s.placement.R(0, 0) = 2; },
      {{"placement", "must be a finite rotation and translation"}});
  add("mirrored", cylinder, [](auto& s) { s.placement.R(0, 0) = -1; },
      {{"placement", "must be a finite rotation and translation"}});
  add("flat paraboloid", spec_of("elliptic_paraboloid", {{"a", 1}, {"b", 1}, {"c", 0}}, Interval{0, 1}),
      [](auto&) {}, {{"c", "is 0, must be a number that is not 0"}});
  add("steep cone", spec_of("cone", {{"radius", 1}, {"half_angle_deg", 90}}, Interval{0, 1}), [](auto&) {},
      {{"half_angle_deg", "is 90, must be > 0 and <= 89.999"}});
  add("cone past its apex", spec_of("cone", {{"radius", 1}, {"half_angle_deg", 30}}, Interval{-3, 1}),
      [](auto&) {}, {{"length", "is [-3, 1], must not reach beyond the apex at -2"}});
  add("latitude", spec_of("sphere", {{"radius", 1}}, Interval{0, 2}), [](auto&) {},
      {{"latitude_deg", "is [0, 114.592], must lie within [-90, 90]"}});
  add("spindle", spec_of("torus", {{"major_radius", 1}, {"minor_radius", 2}}), [](auto&) {},
      {{"minor_radius", "is 2, must be less than the major_radius 1, or the tube cuts itself"}});
  add("overflow", spec_of("hyperboloid_one_sheet", {{"a", 1}, {"b", 1}, {"c", 1}}, Interval{0, 1000}),
      [](auto&) {}, {{"u", "has no finite value at u = 750, v = 0"}});
  add("two formulas", sheet, [](auto& s) { s.formulas.pop_back(); }, {{"S", "has 2 formulas, must have 3"}});
  add("formula syntax", sheet,
      [](auto& s) {
        s.formulas[1] = "2v";
        s.formulas[2] = "sinn(u)";
      },
      {{"S/1",
        "column 2: found \"v\" after a complete expression; an operator (+ - * / ^) is missing before it, or "
        "it does "
        "not belong here"},
       {"S/2", "column 1: \"sinn\" is not known in a formula in u, v; did you mean \"sin\"?"}});
  add("formula without a range", sheet, [](auto& s) { s.u.reset(); },
      {{"u", "is missing, must be a range [from, to]"}});
  add("not finite", sheet, [](auto& s) { s.formulas[2] = "1/u"; },
      {{"S", "has no finite value at u = 0, v = -1"}});
  add("not closed", sheet,
      [](auto& s) {
        s.closed = {true, false};
      },
      {{"closed_u", "is true, but the two ends differ by 2.0e+00 in position or tangent"}});
  add("profile of the wrong variable", vase, [](auto& s) { s.formulas[0] = "v"; },
      {{"profile/0", "column 1: \"v\" is not known in a formula in u"}});
  add("no profile", vase, [](auto& s) { s.formulas.clear(); },
      {{"profile", "is missing; give 2 formulas, or points"}});
  add("profile twice", vase, [](auto& s) { s.points.assign(6, Vec3(1, 2, 3)); },
      {{"points", "are given together with \"profile\", must be one of the two"}});
  add("few points", vase,
      [](auto& s) {
        s.formulas.clear();
        s.points = {Vec3(1, 0, 0), Vec3(1, 1, 0)};
        s.u.reset();
      },
      {{"points", "are 2, must be at least 4"}});
  add("beyond the points", samples_of("revolution").at(1).spec,
      [](auto& s) {
        s.u = Interval{0, 2};
      },
      {{"u", "is [0, 2], must lie within [0, 1], the range of a profile through points"}});
  add("no direction", samples_of("extrusion").at(0).spec, [](auto& s) { s.direction.setZero(); },
      {{"direction", "is zero or not finite, must be a direction"}});
  add("uneven rows", patch, [](auto& s) { s.point_rows = 5; },
      {{"points",
        "are 48, must be a whole number of equal rows (of which the knots, or the rows given, make 5)"}});
  add("knots for other points", patch, [](auto& s) { s.knots[0] = {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}; },
      {{"knots/0", "stand for 5 control points of degree 4, must stand for 6 (rows of points)"}});
  add("falling knots", patch,
      [](auto& s) {
        s.knots[1] = {1, 0};
      },
      {{"knots/1", "must be finite numbers that do not decrease"}});
  add("degree", patch,
      [](auto& s) {
        s.degree = {0, 26};
      },
      {{"degree/0", "is 0, must be from 1 to 25"}, {"degree/1", "is 26, must be from 1 to 25"}});
  add("degree too high for the points", patch,
      [](auto& s) {
        s.degree = {6, 3};
      },
      {{"points", "have 6 rows, must have at least 7 for degree 6"}});
  add("range of a bspline", patch,
      [](auto& s) {
        s.u = Interval{0, 1};
      },
      {{"u", "is given, but a bspline takes its range from its knots"}});
  add("point not finite", patch, [&](auto& s) { s.points[7][1] = nan; }, {{"points/7", "is not finite"}});
  return b;
}

TEST(PrimaryCheck, NamesEveryProblemWithItsPlace) {
  for (const Broken& b : broken_specs()) {
    SCOPED_TRACE(b.what);
    const std::vector<Problem> problems = check(b.spec);
    ASSERT_EQ(problems.size(), b.problems.size())
        << (problems.empty() ? "" : problems[0].where + ": " + problems[0].message);
    for (std::size_t i = 0; i < problems.size(); ++i) {
      EXPECT_EQ(problems[i].where, b.problems[i].where);
      EXPECT_EQ(problems[i].message, b.problems[i].message);
    }
    EXPECT_THROW(static_cast<void>(make_primary(b.spec)), InputError);
  }
}

TEST(PrimaryCheck, SuggestsTheNearestKind) {
  const std::vector<Problem> problems = check(spec_of("cilinder"));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where, "kind");
  EXPECT_THAT(problems[0].message, testing::StartsWith("is \"cilinder\", must be one of plane, cylinder, "));
  EXPECT_THAT(problems[0].message, testing::EndsWith("; did you mean \"cylinder\"?"));
}

TEST(PrimaryCheck, KnotsThatTheBasisRefusesAreProblemsOfTheKnots) {
  PrimarySpec spec = bspline_sample();
  spec.knots[0] = {0, 0, 0, 0.1, 0.1, 0.2, 0.3, 1, 1, 1, 1};  // not clamped at the ends
  const std::vector<Problem> problems = check(spec);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where, "knots/0");
}

TEST(PrimariesTable, RowsAreNamedOnceAndFound) {
  for (const PrimaryInfo& row : primaries_table()) EXPECT_EQ(find_primary(row.kind), &row);
  EXPECT_EQ(find_primary("teapot"), nullptr);
}

}  // namespace
}  // namespace blendwright
