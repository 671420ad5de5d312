#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kernel/base/error.hpp"
#include "tests/kernel/primary_samples.hpp"

namespace blendwright {
namespace {

using test::bspline_sample;
using test::pi;
using test::samples_of;
using test::spec_of;

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

}  // namespace
}  // namespace blendwright
