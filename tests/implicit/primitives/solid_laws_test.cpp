// What quadrics, perturbations, freeforms and exact distances are, by other means than their own formulas.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "implicit/scene/scene.hpp"
#include "tests/implicit/primitives/made_primitive.hpp"
#include "tests/implicit/primitives/solid_samples.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using ::testing::HasSubstr;
using List = std::vector<double>;

std::array<double, 10> all_at(const Tape& tape, const Vec3& p) {
  std::array<double, 10> out{};
  const double x[] = {p.x()}, y[] = {p.y()}, z[] = {p.z()};
  tape.evaluate(Order::hessian, {x, y, z}, out);
  return out;
}

NodeSpec unit_sphere(const char* name = "q") {
  return part(name, "ellipsoid_quadric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}});
}
SceneSpec unit_bump(double power) {
  return scene_of({unit_sphere(), part("case", "perturbation", {{"of", ref("q")}, {"power", power}})});
}

// ---- Perturbations ------------------------------------------------------------------------------------

/// R = (1 - x^2)^k inside x = 1: R_xx = 8 there for k = 2, and 0 for k = 3; outside 0.
TEST(Perturbations, AreOneOrderLessSmoothThanTheirPower) {
  const double e = 1e-9;
  for (const auto& [power, jump] : {std::pair{2.0, 8.0}, std::pair{3.0, 0.0}, std::pair{4.0, 0.0}}) {
    SCOPED_TRACE(power);
    const auto tape = build_tape(unit_bump(power));
    // d^3 R / dx^3 is at most 8 * 24 near x = 1, so R_xx is within 200 e of its limit.
    EXPECT_NEAR(all_at(*tape, {1.0 - e, 0, 0})[4], jump, 200.0 * e);
    EXPECT_EQ(all_at(*tape, {1.0 + e, 0, 0})[4], 0.0);
    EXPECT_NEAR(all_at(*tape, {1.0 - e, 0, 0})[1], 0.0, 10.0 * e);
  }
}

/// Differences of R_xx across the border over a step h: those of a C^3 function go to 0 with h, those of a
/// C^2 one whose third derivative jumps too, those of k = 2 do not.
TEST(Perturbations, HaveTheSmoothnessRatiosOfTheirPower) {
  const auto change = [](double power, double h) {
    const auto tape = build_tape(unit_bump(power));
    return std::abs(all_at(*tape, {1.0 - h, 0, 0})[4] - all_at(*tape, {1.0 + h, 0, 0})[4]);
  };
  // R_xx just inside, with s = 1 - x: 8, 48 s, 192 s^2 for k = 2, 3, 4, to a relative error of some s.
  EXPECT_NEAR(change(2.0, 1e-3) / change(2.0, 1e-4), 1.0, 0.05);
  EXPECT_NEAR(change(3.0, 1e-3) / change(3.0, 1e-4), 10.0, 0.5);
  EXPECT_NEAR(change(4.0, 1e-3) / change(4.0, 1e-4), 100.0, 5.0);
}

TEST(Perturbations, TakeAnyFunctionAndAFreeTerm) {
  const auto tape =
      build_tape(scene_of({part("q", "sphere", {{"radius", 1.0}}),
                           part("case", "perturbation",
                                {{"of", ref("q")}, {"weight", -2.0}, {"power", 2.0}, {"free_term", 0.5}})}));
  EXPECT_DOUBLE_EQ(value_at(*tape, {1.2, 0, 0}), -2.0 * 0.3 * 0.3);
  EXPECT_EQ(value_at(*tape, {1.5001, 0, 0}), 0.0);
}

/// free_term of the perturbation against a term of the base: the first changes the bump alone, the second
/// adds the same everywhere.
TEST(Freeforms, HaveTwoDifferentFreeTerms) {
  const auto scene = [](double base, double bump) {
    return scene_of(
        {part("base", "quadric", {{"coefficients", List{-1, -1, -1, 0, 0, 0, 0, 0, 0, 1 + base}}}),
         part("q", "quadric", {{"coefficients", List{-9, -9, -9, 0, 0, 0, 18, 0, 0, -8}}}),
         part("bump", "perturbation", {{"of", ref("q")}, {"free_term", bump}}),
         part("case", "freeform", {{"base", ref("base")}, {"bumps", refs({"bump"})}})});
  };
  const auto plain = build_tape(scene(0.0, 0.0)), offset = build_tape(scene(0.1, 0.0)),
             grown = build_tape(scene(0.0, 0.1));
  for_all([&](Rng& rng) {
    const Vec3 p(uniform(rng, -2, 2), uniform(rng, -2, 2), uniform(rng, -2, 2));
    EXPECT_NEAR(value_at(*offset, p) - value_at(*plain, p), 0.1, 1e-14 * 100.0);  // values below 100
  });
  EXPECT_EQ(value_at(*grown, {-0.5, 0, 0}), value_at(*plain, {-0.5, 0, 0}));
  EXPECT_GT(value_at(*grown, {1.0, 0, 0}), value_at(*plain, {1.0, 0, 0}) + 0.1);
}

// ---- Freeforms ----------------------------------------------------------------------------------------

/// A sphere with `count` small bumps on a lattice over it.
SceneSpec bumpy(int count) {
  std::vector<NodeSpec> nodes{unit_sphere("base")};
  std::vector<std::string> bumps;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, angle = 2.399963229728653 * i, r = std::sqrt(1.0 - z * z);
    const Vec3 c(r * std::cos(angle), r * std::sin(angle), z);
    const double s2 = 0.2 * 0.2;
    const std::string name = "bump " + std::to_string(i);
    nodes.push_back(
        part("q" + name, "quadric",
             {{"coefficients", List{-1 / s2, -1 / s2, -1 / s2, 0, 0, 0, 2 * c.x() / s2, 2 * c.y() / s2,
                                    2 * c.z() / s2, 1.0 - c.squaredNorm() / s2}}}));
    nodes.push_back(part(name, "perturbation", {{"of", ref("q" + name)}, {"weight", 0.3}}));
    bumps.push_back(name);
  }
  nodes.push_back(part("case", "freeform", {{"base", ref("base")}, {"bumps", refs(bumps)}}));
  return scene_of(std::move(nodes));
}

TEST(Freeforms, DropBumpsWhoseSupportABoxDoesNotMeet) {
  const auto tape = build_tape(bumpy(20));
  const Box far{Vec3::Constant(-0.1), Vec3::Constant(0.1)};
  const auto none = tape->within(far);
  ASSERT_TRUE(none.model);
  EXPECT_EQ(dynamic_cast<const Tape&>(*none.model).size(), 1u);  // the base alone
  // Bumps are 0.2 wide and their centres at least 0.5 apart, so a box of 0.05 meets one at most.
  Rng rng(3);
  std::size_t most = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 c = suite::point_in(rng, {Vec3::Constant(-1.2), Vec3::Constant(1.2)});
    const auto within = tape->within({c.array() - 0.025, c.array() + 0.025});
    ASSERT_TRUE(within.model);
    most = std::max(most, dynamic_cast<const Tape&>(*within.model).size());
  }
  EXPECT_EQ(most, 2u);
  EXPECT_EQ(tape->size(), 21u);  // one step for every bump
}

/// A drop list is inherited: what a box leaves out is not looked at again in its parts.
TEST(Freeforms, ShortenedTapesGetShorterInSmallerBoxes) {
  const auto tape = build_tape(bumpy(20));
  const Box half{Vec3::Constant(-1.3), Vec3(1.3, 1.3, 0.0)};
  const auto first = tape->within(half);
  ASSERT_TRUE(first.model);
  const auto& shorter = dynamic_cast<const Tape&>(*first.model);
  EXPECT_LT(shorter.size(), tape->size());
  const Box part_of{Vec3(0.8, -0.2, -0.2), Vec3(1.2, 0.2, 0.0)};
  const auto second = shorter.within(part_of), direct = tape->within(part_of);
  ASSERT_TRUE(second.model && direct.model);
  EXPECT_EQ(dynamic_cast<const Tape&>(*second.model).size(), dynamic_cast<const Tape&>(*direct.model).size());
  EXPECT_EQ(second.range, direct.range);
}

/// The box |x_i| <= 0.2 deep inside the unit sphere's support: M < |A44|, and the bump must stay.
TEST(Freeforms, KeepABumpDeepInsideItsSupport) {
  const SceneSpec spec =
      scene_of({part("base", "box", {{"half", List{1, 1, 1}}}), unit_sphere(),
                part("bump", "perturbation", {{"of", ref("q")}}),
                part("case", "freeform", {{"base", ref("base")}, {"bumps", refs({"bump"})}})});
  const auto tape = build_tape(spec);
  const Box box{Vec3::Constant(-0.2), Vec3::Constant(0.2)};
  EXPECT_FALSE(tape->within(box).model);  // nothing was left out
  const Range range = tape->range(box);
  EXPECT_GE(range.hi, 2.0);         // 1 + 1^3 at the origin
  EXPECT_GE(range.lo, 0.8 + 0.68);  // 0.88^3 = 0.681
  EXPECT_LE(range.lo, 0.8 + 0.681473);
}

TEST(Freeforms, ReachToTheUnionOfTheirBaseAndBumps) {
  const auto scene = [](double weight) {
    return scene_of({unit_sphere("base"),
                     part("q", "quadric", {{"coefficients", List{-25, -25, -25, 0, 0, 0, 50, 0, 0, -24}}}),
                     part("bump", "perturbation", {{"of", ref("q")}, {"weight", weight}}),
                     part("case", "freeform", {{"base", ref("base")}, {"bumps", refs({"bump"})}})});
  };
  const auto bump = build_scene(scene(0.5)).field.bounds(), dent = build_scene(scene(-0.5)).field.bounds();
  ASSERT_TRUE(bump && dent);
  EXPECT_NEAR(bump->hi.x(), 1.2, 1e-9);  // the bump is the ball of radius 0.2 around (1, 0, 0)
  EXPECT_NEAR(bump->lo.x(), -1.0, 1e-9);
  EXPECT_NEAR(dent->hi.x(), 1.0, 1e-9);
  EXPECT_GE(bump->hi.x(), 1.2);
  EXPECT_GE(dent->hi.x(), 1.0);
}

TEST(Freeforms, WarnOfEmptyAndUnboundedSupports) {
  const auto warnings = [](List q, double free_term) {
    const Scene scene =
        build_scene(scene_of({unit_sphere("base"), part("q", "quadric", {{"coefficients", std::move(q)}}),
                              part("bump", "perturbation", {{"of", ref("q")}, {"free_term", free_term}}),
                              part("case", "freeform", {{"base", ref("base")}, {"bumps", refs({"bump"})}})}));
    std::string text;
    for (const Problem& p : scene.warnings) text += p.where + ": " + p.message + "\n";
    return text;
  };
  EXPECT_EQ(warnings({-1, -1, -1, 0, 0, 0, 0, 0, 0, 1}, 0.0), "");
  EXPECT_THAT(warnings({-1, -1, -1, 0, 0, 0, 0, 0, 0, -1}, 0.0), HasSubstr("/nodes/bump/of: is -1 at most"));
  EXPECT_THAT(warnings({-1, -1, -1, 0, 0, 0, 0, 0, 0, 1}, -1.0), HasSubstr("empty"));
  EXPECT_EQ(warnings({-1, -1, -1, 0, 0, 0, 0, 0, 0, -1}, 2.0), "");
  EXPECT_THAT(warnings({-1, -1, 0, 0, 0, 0, 0, 0, 0, 1}, 0.0), HasSubstr("unbounded"));
}

TEST(Freeforms, RefuseWhatTheyCannotAdd) {
  const auto messages = [](std::vector<NodeSpec> nodes) {
    std::string text;
    for (const Problem& p : problems_of(scene_of(std::move(nodes))))
      text += p.where + ": " + p.message + "\n";
    return text;
  };
  EXPECT_THAT(messages({unit_sphere("base"), unit_sphere(),
                        part("case", "freeform", {{"base", ref("base")}, {"bumps", refs({"q"})}})}),
              HasSubstr("/nodes/case/bumps/0: InvalidParameter: is no perturbation"));
  EXPECT_THAT(messages({ball("base", 1.0), part("case", "freeform", {{"base", ref("base")}})}),
              HasSubstr("/nodes/case/base: LevelMismatch: is of one level"));
  EXPECT_THAT(messages({part("case", "freeform")}), HasSubstr("/nodes/case/base: is missing"));
  EXPECT_THAT(messages({ball("q", 1.0), part("case", "perturbation", {{"of", ref("q")}})}),
              HasSubstr("LevelMismatch"));
  EXPECT_THAT(messages({unit_sphere(), part("case", "perturbation", {{"of", ref("q")}, {"weight", 0.0}})}),
              HasSubstr("/nodes/case/weight: InvalidParameter: is 0"));
  EXPECT_THAT(messages({unit_sphere(), part("case", "perturbation", {{"of", ref("q")}, {"power", 1.0}})}),
              HasSubstr("/nodes/case/power: InvalidParameter: is 1"));
  EXPECT_THAT(messages({part("case", "quadric", {{"coefficients", List(10, 0.0)}})}),
              HasSubstr("/nodes/case/coefficients: InvalidParameter: are all 0"));
  EXPECT_THAT(messages({part("case", "quadric", {{"coefficients", List(9, 1.0)}})}),
              HasSubstr("is a list of 9 numbers, must be a list of 10 numbers"));
  EXPECT_THAT(messages({part("case", "torus", {{"ring", 1.0}, {"tube", 1.0}})}),
              HasSubstr("/nodes/case/tube: InvalidParameter: is 1, must be < ring"));
  EXPECT_THAT(messages({part("case", "box", {{"half", List{1.0, 0.0, 1.0}}})}),
              HasSubstr("/nodes/case/half/1: InvalidParameter: is 0, must be > 0"));
}

// ---- Exact distances ----------------------------------------------------------------------------------

bool is_distance(const SolidSample& s) {
  return s.kind == "sphere" || s.kind == "ellipsoid" || s.kind == "torus" || s.kind == "box";
}

TEST(ExactDistances, SaySo) {
  for (const SolidSample& s : solid_samples())
    EXPECT_EQ(make_primitive(s.scene).node.exact_distance, is_distance(s)) << s.id;
}

TEST(ExactDistances, StayExactWhenTurnedButNotWhenScaled) {
  const auto placed = [](Values values) {
    values["of"] = ref("solid");
    return make_primitive(scene_of({part("solid", "torus", {{"ring", 2.0}, {"tube", 0.5}}),
                                    part("case", "place", values)}))
        .node.exact_distance;
  };
  EXPECT_TRUE(placed({{"move", List{1, 2, 3}}, {"turn_deg", 33.0}, {"axis", List{1, 2, 3}}}));
  EXPECT_FALSE(placed({{"scale", 1.001}}));
}

/// The gradient is a unit vector, and the nearest point X - f grad f lies on the surface.
TEST(ExactDistances, HaveUnitGradientsAndFeetOnTheSurface) {
  for (const SolidSample& s : solid_samples()) {
    if (!is_distance(s)) continue;
    SCOPED_TRACE(s.id);
    const auto tape = build_tape(s.scene);
    Rng rng(8);
    for (int i = 0; i < bounded(2000); ++i) {
      const Vec3 p = suite::point_in(rng, s.where);
      const auto f = all_at(*tape, p);
      const Vec3 g(f[1], f[2], f[3]);
      EXPECT_NEAR(g.norm(), 1.0, 1e-12);
      // Two evaluations with errors of some dozen roundings of numbers below 5, the gradient's times f.
      EXPECT_NEAR(value_at(*tape, p - f[0] * g), 0.0, 1e-12) << suite::text(p);
    }
  }
}

/// Of a distance, H g = 0: straight lines are its gradient lines.
TEST(ExactDistances, DoNotBendAlongTheirGradients) {
  for (const SolidSample& s : solid_samples()) {
    if (!is_distance(s)) continue;
    SCOPED_TRACE(s.id);
    const auto tape = build_tape(s.scene);
    Rng rng(9);
    for (int i = 0; i < 500; ++i) {
      const auto f = all_at(*tape, suite::point_in(rng, s.where));
      const Vec3 g(f[1], f[2], f[3]);
      Eigen::Matrix3d h;
      h << f[4], f[7], f[8], f[7], f[5], f[9], f[8], f[9], f[6];
      EXPECT_LE((h * g).norm(), 1e-11 * std::max(1.0, h.norm()));
    }
  }
}

/// The distance to the ellipsoid by a search over its surface: x = s cos..., refined from a grid.
double searched_distance(const Vec3& s, const Vec3& p) {
  const auto at = [&](double u, double v) {
    return Vec3(s.x() * std::cos(u) * std::cos(v), s.y() * std::sin(u) * std::cos(v), s.z() * std::sin(v));
  };
  double best = 1e300, bu = 0.0, bv = 0.0;
  for (int i = 0; i < 72; ++i)
    for (int j = -18; j <= 18; ++j) {
      const double u = i * M_PI / 36.0, v = j * M_PI / 36.0, d = (at(u, v) - p).norm();
      if (d < best) best = d, bu = u, bv = v;
    }
  for (double step = 0.1; step > 1e-9; step *= 0.5)
    for (bool better = true; better;) {  // until no neighbour at this step is nearer
      better = false;
      for (int k = 0; k < 8; ++k) {
        const double u = bu + step * std::cos(k * M_PI / 4.0), v = bv + step * std::sin(k * M_PI / 4.0);
        const double d = (at(u, v) - p).norm();
        if (d < best) best = d, bu = u, bv = v, better = true;
      }
    }
  return best;
}

TEST(EllipsoidDistance, IsTheNearestPointOfASearch) {
  for_all([](Rng& rng) {
    const Vec3 s(log_uniform(rng, 0.3, 3.0), log_uniform(rng, 0.3, 3.0), log_uniform(rng, 0.3, 3.0));
    const auto tape =
        build_tape(scene_of({part("case", "ellipsoid", {{"a", s.x()}, {"b", s.y()}, {"c", s.z()}})}));
    const Vec3 p(uniform(rng, -3, 3), uniform(rng, -3, 3), uniform(rng, -3, 3));
    const double f = value_at(*tape, p), searched = searched_distance(s, p);
    EXPECT_LE(std::abs(f), searched * (1.0 + 1e-12));  // a search finds no nearer point
    // No neighbour at a step of 1e-9 is nearer, and the distance is flat at its least: of second order in
    // what is left, but where the axes differ by 10 and the valley is narrow.
    EXPECT_GE(std::abs(f), searched - 1e-8);
    EXPECT_EQ(f > 0.0, p.cwiseQuotient(s).squaredNorm() < 1.0);
  });
}

/// Inside the focal ellipse of a symmetry plane there are two feet, above and below: the limit t = -s_min^2.
/// With semi-axes 3, 2, 1 and z = 0 the foot has x_P = 9 x/8, y_P = 4 y/3, z_P = sqrt(1 - (3x/8)^2 -
/// (2y/3)^2).
TEST(EllipsoidDistance, HasItsLimitOnSymmetryPlanes) {
  const auto tape = build_tape(scene_of({part("case", "ellipsoid", {{"a", 3.0}, {"b", 2.0}, {"c", 1.0}})}));
  for_all([&](Rng& rng) {
    const double x = uniform(rng, -2.6, 2.6), y = uniform(rng, -1.4, 1.4);
    const double inner = 1.0 - 9.0 * x * x / 64.0 - 4.0 * y * y / 9.0;
    if (inner <= 1e-3) return;
    const double expected = std::hypot(x / 8.0, y / 3.0, std::sqrt(inner));
    EXPECT_NEAR(value_at(*tape, {x, y, 0.0}), expected, 1e-14 * 10.0);
    // From above and from below the values meet, for however small a step.
    for (const double z : {1e-300, -1e-300, 1e-150, 1e-100, 1e-30, -1e-16})
      EXPECT_NEAR(value_at(*tape, {x, y, z}), expected, 1e-14 * 10.0) << z;
    const Vec3 above = gradient_at(*tape, {x, y, 1e-100}), on = gradient_at(*tape, {x, y, 0.0});
    EXPECT_NEAR((above - on).norm(), 0.0, 1e-12);
  });
  EXPECT_EQ(value_at(*tape, Vec3::Zero()), 1.0);
}

/// Along the long axis the medial axis ends where the curvature's centre is: x = 8/3 for 3, 2, 1. Beyond it
/// the tip is nearest.
TEST(EllipsoidDistance, ReachesTheEndOfTheMedialAxis) {
  const auto tape = build_tape(scene_of({part("case", "ellipsoid", {{"a", 3.0}, {"b", 2.0}, {"c", 1.0}})}));
  for (const double e : {1e-15, 1e-12, 1e-8, 1e-4, 0.1})
    EXPECT_NEAR(value_at(*tape, {8.0 / 3.0 + e, 0, 0}), 1.0 / 3.0 - e, 1e-14);
  for (const double x : {8.0 / 3.0 - 1e-12, 8.0 / 3.0 - 1e-6, 8.0 / 3.0 - 1e-2, 1.0})
    EXPECT_NEAR(value_at(*tape, {x, 0, 0}), std::sqrt(1.0 - x * x / 8.0), 1e-14 * 10.0) << x;
}

TEST(EllipsoidDistance, AgreesWithTheSphereAndScales) {
  for_all([](Rng& rng) {
    const double r = log_uniform(rng, 1e-20, 1e20);
    const auto ellipsoid = build_tape(scene_of({part("case", "ellipsoid", {{"a", r}, {"b", r}, {"c", r}})}));
    const Vec3 p = r * Vec3(uniform(rng, -3, 3), uniform(rng, -3, 3), uniform(rng, -3, 3));
    EXPECT_NEAR(value_at(*ellipsoid, p) / r, 1.0 - p.norm() / r, 1e-14 * 10.0);
  });
}

}  // namespace
}  // namespace blendwright::test
