// What offsets do to solids: known values and sets, nesting, idempotence, overshoot.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "implicit/scene/scene.hpp"
#include "tests/implicit/offset/offset_samples.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using List = std::vector<double>;

Scene offset_of(SceneSpec solid, const std::string& kind, Values values) {
  values["of"] = ref(solid.solid);
  solid.nodes.push_back(part("offset", kind, std::move(values)));
  solid.solid = "offset";
  solid.strict = false;
  return build_scene(solid);
}
ScalarField field_of(SceneSpec solid, const std::string& kind, Values values) {
  return offset_of(std::move(solid), kind, std::move(values)).field;
}
SceneSpec egg(double a, double b, double c) {
  return scene_of({part("egg", "ellipsoid_quadric", {{"a", a}, {"b", b}, {"c", c}})});
}
SceneSpec box(double x, double y, double z) {
  return scene_of({part("box", "box", {{"half", List{x, y, z}}})});
}
const Box two{Vec3::Constant(-2.0), Vec3::Constant(2.0)};

// The sheet's section 4.3, a check of the trust region.
TEST(BallOffset, OfAnEllipsoidHasKnownValues) {
  EXPECT_NEAR(field_of(egg(3, 2, 1), "ball_offset", {{"distance", 0.3}}).value({1, 1, 1}),
              0.17703133768452179, 1e-15);
  EXPECT_NEAR(field_of(egg(3, 2, 1), "ball_offset", {{"distance", -0.3}}).value({1, 1, 1}),
              -1.0691613735342206, 1e-14);
  EXPECT_NEAR(field_of(egg(3, 2, 1), "ball_offset", {{"distance", -0.3}}).value({0, 0, 0}), 0.91, 1e-15);
}

// Scene 3: a small ball has no void under the ball form, and one under the form along the normal.
TEST(BallOffset, HasNoCavityWhereTheNormalOverShoots) {
  const SceneSpec small =
      scene_of({part("q", "quadric", {{"coefficients", List{-1, -1, -1, 0, 0, 0, 0, 0, 0, 0.04}}})});
  EXPECT_NEAR(field_of(small, "ball_offset", {{"distance", 1.0}}).value({0, 0, 0}), 0.04, 1e-15);
  const Scene along = offset_of(small, "normal_offset", {{"distance", 1.0}});
  EXPECT_NEAR(along.field.value({0.5, 0, 0}), -0.21, 1e-15);
  ASSERT_EQ(along.warnings.size(), 1u);
  EXPECT_NE(along.warnings[0].message.find("cavities"), std::string::npos);
}

// Where the gradient vanishes there is no direction: f itself.
TEST(NormalOffset, IsTheFieldWhereItHasNoDirection) {
  const ScalarField f = field_of(egg(1, 1, 1), "normal_offset", {{"distance", 0.3}});
  EXPECT_EQ(f.value({0, 0, 0}), 1.0);
}

// A larger distance gives a larger solid: everywhere, for every route.
TEST(BallOffset, GrowsWithItsDistance) {
  for (const SceneSpec& solid : {egg(1.4, 1.0, 0.7), box(1, 0.8, 0.6), bumpy(4)}) {
    const double distances[] = {-0.2, -0.1, -1e-3, 0.0, 1e-3, 0.1, 0.3};
    std::vector<ScalarField> fields;
    for (const double d : distances) fields.push_back(field_of(solid, "ball_offset", {{"distance", d}}));
    Rng rng(3);
    for (int i = 0; i < bounded(200); ++i) {
      const Vec3 p = suite::point_in(rng, two);
      for (std::size_t k = 1; k < fields.size(); ++k)
        EXPECT_LE(fields[k - 1].value(p), fields[k].value(p) + 1e-14);
    }
  }
}

// Brute force: no value in the ball is larger, by more than the tolerance, and some nearly reach it.
TEST(BallOffset, IsTheLargestValueInTheBall) {
  const double radius = 0.25;
  for (const double sign : {1.0, -1.0}) {
    const SceneSpec solid = bumpy(12);
    const ScalarField f = build_scene(solid).field;
    const ScalarField F = field_of(solid, "ball_offset", {{"distance", sign * radius}, {"tolerance", 1e-8}});
    Rng rng(4);
    for (int i = 0; i < bounded(60); ++i) {
      const Vec3 x = suite::point_in(rng, two);
      const double top = sign * F.value(x);
      std::vector<Vec3> points;
      while (points.size() < 4000) {
        const Vec3 w = suite::point_in(rng, {Vec3::Constant(-1.0), Vec3::Constant(1.0)});
        if (w.norm() <= 1.0) points.push_back(x + (points.size() % 2 == 0 ? radius : radius / w.norm()) * w);
      }
      const FieldValues values = f.evaluate(Order::value, points);
      double best = -1e300, least = 1e300;
      for (std::size_t k = 0; k < points.size(); ++k) {
        best = std::max(best, sign * values.value(k));
        least = std::min(least, sign * values.value(k));
      }
      EXPECT_LE(best, top + 1e-7 * (best - least));
      EXPECT_GE(best, top - 0.05 * (best - least));
    }
  }
}

// The routes agree with the search: a quadric as a freeform without bumps is none of the special ones.
TEST(BallOffset, ByQuadricsAgreesWithTheSearch) {
  const List a{-1.586, 1.356, -1.174, -1.272, -0.961, 0.639, -0.998, 1.069, 0.105, 1.618};
  const SceneSpec exact = scene_of({part("q", "quadric", {{"coefficients", a}})});
  const SceneSpec searched =
      scene_of({part("q", "quadric", {{"coefficients", a}}), part("f", "freeform", {{"base", ref("q")}})});
  for (const double d : {0.3, -0.3}) {
    const ScalarField f = field_of(exact, "ball_offset", {{"distance", d}}),
                      g = field_of(searched, "ball_offset", {{"distance", d}});
    Rng rng(5);
    for (int i = 0; i < bounded(200); ++i) {
      const Vec3 p = suite::point_in(rng, two);
      EXPECT_NEAR(f.value(p), g.value(p), 1e-13 * std::max(1.0, std::abs(f.value(p))));
    }
  }
}

// An edge of the solid becomes a part of a cylinder: the best point is on the diagonal, where f has an edge.
TEST(BallOffset, OfEdgesHasTheNormalsOfARoundEdge) {
  const auto plane = [](const char* name, List a) {
    return part(name, "quadric", {{"coefficients", std::move(a)}});
  };
  const SceneSpec wedge =
      scene_of({plane("x", {0, 0, 0, 0, 0, 0, -1, 0, 0, 1}), plane("y", {0, 0, 0, 0, 0, 0, 0, -1, 0, 1}),
                part("both", "min", {{"of", refs({"x", "y"})}})});
  const ScalarField f = field_of(wedge, "ball_offset", {{"distance", 0.3}});
  const Vec3 p(1.2, 1.2, 0.4);
  const FieldValues v = f.evaluate(Order::gradient, std::span<const Vec3>(&p, 1));
  EXPECT_NEAR(v.value(0), 0.3 / std::sqrt(2.0) - 0.2, 1e-6);
  // A point within 1e-6 of the best value is within sqrt(2 * 0.3 * 1e-6) of the diagonal.
  const Vec3 n = v.gradient(0).normalized();
  EXPECT_NEAR(n.x(), -std::sqrt(0.5), 3e-3);
  EXPECT_NEAR(n.y(), -std::sqrt(0.5), 3e-3);
}

// Placements that keep shapes, and those that do not: the offset of the placed solid has the radius D.
TEST(BallOffset, OfPlacedSolidsIsMeasuredOutside) {
  SceneSpec ball =
      scene_of({part("s", "sphere", {{"radius", 0.5}}),
                part("p", "place", {{"of", ref("s")}, {"scale", 2.0}, {"move", List{1, 0, 0}}})});
  EXPECT_NEAR(field_of(ball, "ball_offset", {{"distance", 0.3}}).value({2.3, 0, 0}), 0.0, 1e-15);
  SceneSpec stretched =
      scene_of({part("s", "ellipsoid_quadric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}}),
                part("p", "affine",
                     {{"of", ref("s")},
                      {"matrix", std::vector<List>{{0.5, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}}})});
  const ScalarField f = field_of(stretched, "ball_offset", {{"distance", 0.3}});
  EXPECT_NEAR(f.value({2.3, 0, 0}), 0.0, 1e-15);
  EXPECT_NEAR(f.value({0, 1.3, 0}), 0.0, 1e-15);
  // The offset itself can be placed, too.
  SceneSpec later = scene_of({part("s", "sphere", {{"radius", 0.5}}),
                              part("o", "ball_offset", {{"of", ref("s")}, {"distance", 0.25}}),
                              part("p", "place", {{"of", ref("o")}, {"scale", 2.0}})});
  EXPECT_NEAR(build_scene(later).field.value({1.5, 0, 0}), 0.0, 1e-15);
}

// Scene 2: the volume of the opening of a box is that of the smaller box, grown (Steiner).
TEST(Opening, OfABoxHasTheVolumeOfSteiner) {
  const double r = 0.2;
  const ScalarField f = field_of(box(1, 0.8, 0.6), "opening", {{"radius", r}});
  const double pi = std::numbers::pi;
  const Vec3 h(0.8, 0.6, 0.4);
  const double steiner = 8.0 * h.prod() + 8.0 * r * (h[0] * h[1] + h[0] * h[2] + h[1] * h[2]) +
                         2.0 * pi * r * r * h.sum() + 4.0 / 3.0 * pi * r * r * r;
  EXPECT_NEAR(steiner, 3.68589966375522, 1e-12);
  // Quadrature along z: the solid's height over (x, y) is between roots of f, exact to 1e-12; over the octant
  // by the midpoint rule, which loses O(h^1.5) at the rim of the circle's arcs.
  const int n = 400;
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) points.push_back({(i + 0.5) / n, 0.8 * (j + 0.5) / n, 0.0});
  std::vector<double> lo(points.size(), 0.0), hi(points.size(), 0.6);
  for (int k = 0; k < 40; ++k) {
    for (std::size_t i = 0; i < points.size(); ++i) points[i].z() = 0.5 * (lo[i] + hi[i]);
    const FieldValues values = f.evaluate(Order::value, points);
    for (std::size_t i = 0; i < points.size(); ++i) (values.value(i) >= 0.0 ? lo[i] : hi[i]) = points[i].z();
  }
  double volume = 0.0;
  for (const double z : hi) volume += 8.0 * z * 0.8 / (n * n);
  EXPECT_NEAR(volume, steiner, 2e-4);
}

/// Points, apart from the surface, at which two fields have different signs.
int different_signs(const ScalarField& a, const ScalarField& b, const Box& where, int count, double apart) {
  Rng rng(6);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(suite::point_in(rng, where));
  const FieldValues fa = a.evaluate(Order::value, points), fb = b.evaluate(Order::value, points);
  int different = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::abs(fa.value(i)) > apart && (fa.value(i) > 0.0) != (fb.value(i) > 0.0)) ++different;
  return different;
}
SceneSpec twice(SceneSpec solid, const std::string& kind, double radius) {
  solid.nodes.push_back(part("once", kind, {{"of", ref(solid.solid)}, {"radius", radius}}));
  solid.solid = "once";
  return solid;
}

TEST(Opening, IsIdempotent) {
  const Box where{Vec3::Constant(-1.2), Vec3::Constant(1.2)};
  for (const SceneSpec& solid :
       {box(1, 0.8, 0.6), scene_of({part("s", "torus", {{"ring", 0.7}, {"tube", 0.4}})})}) {
    const ScalarField once = field_of(solid, "opening", {{"radius", 0.2}});
    const ScalarField again = field_of(twice(solid, "opening", 0.2), "opening", {{"radius", 0.2}});
    EXPECT_EQ(different_signs(once, again, where, 100'000, 1e-9), 0);
    const ScalarField other = field_of(twice(solid, "opening", 0.2), "opening", {{"radius", 0.35}});
    if (solid.nodes[0].kind == "box") {
      EXPECT_GT(different_signs(once, other, where, 100'000, 1e-9), 0);
    }
  }
}

// By the closed form, and again by a search: the second closing has none.
TEST(Closing, IsIdempotent) {
  const auto plane = [](const char* name, List a) {
    return part(name, "quadric", {{"coefficients", std::move(a)}});
  };
  const SceneSpec corner =
      scene_of({plane("x", {0, 0, 0, 0, 0, 0, -1, 0, 0, 0}), plane("y", {0, 0, 0, 0, 0, 0, 0, -1, 0, 0}),
                part("both", "max", {{"of", refs({"x", "y"})}})});
  const ScalarField plain = build_scene(corner).field;
  const ScalarField once = field_of(corner, "closing", {{"radius", 0.5}});
  const ScalarField again = field_of(twice(corner, "closing", 0.5), "closing", {{"radius", 0.5}});
  const Box where{Vec3::Constant(-0.2), Vec3::Constant(0.8)};
  // The search is within 1e-6 of the range of f over the ball, which is at most 1.
  EXPECT_EQ(different_signs(once, again, where, bounded(200), 1e-6), 0);
  EXPECT_GT(different_signs(once, plain, where, bounded(200), 1e-6), 0);
}

// Two searches in each other: few points.
TEST(Closing, FillsAConcaveEdgeUpToTheBall) {
  const SceneSpec boxes = scene_of({part("a", "box", {{"half", List{0.5, 0.5, 0.5}}}),
                                    part("b", "place", {{"of", ref("a")}, {"move", List{0.7, 0.7, 0.0}}}),
                                    part("c", "max", {{"of", refs({"a", "b"})}})});
  const ScalarField plain = build_scene(boxes).field;
  const ScalarField once = field_of(boxes, "closing", {{"radius", 0.2}});
  // The edges where the boxes meet run along z at (0.5, 0.2) and (0.2, 0.5); the fillet's ball touches x =
  // 0.5 and y = 0.2 from outside, its centre is (0.7, 0.0).
  const Vec3 edge(0.5, 0.2, 0.0), centre(0.7, 0.0, 0.0);
  const Vec3 middle = centre + 0.2 * (edge - centre).normalized();
  EXPECT_LT(plain.value(middle), 0.0);
  EXPECT_NEAR(once.value(middle), 0.0, 1e-5);
  EXPECT_GT(once.value(middle + 0.01 * (edge - centre).normalized()), 0.0);
  EXPECT_LT(once.value(middle - 0.01 * (edge - centre).normalized()), 0.0);
}

// Opening takes away, closing adds; both keep the order of solids.
TEST(OpeningAndClosing, LieOnTheirSidesOfTheSolid) {
  for (const SceneSpec& solid :
       {box(1, 0.8, 0.6), scene_of({part("s", "torus", {{"ring", 1.0}, {"tube", 0.3}})}),
        scene_of({part("s", "ellipsoid", {{"a", 1.5}, {"b", 1.0}, {"c", 0.8}})})}) {
    const ScalarField f = build_scene(solid).field;
    const ScalarField open = field_of(solid, "opening", {{"radius", 0.2}}),
                      closed = field_of(solid, "closing", {{"radius", 0.2}});
    Rng rng(7);
    for (int i = 0; i < bounded(2000); ++i) {
      const Vec3 p = suite::point_in(rng, two);
      EXPECT_LE(open.value(p), f.value(p) + 1e-13);
      EXPECT_GE(closed.value(p), f.value(p) - 1e-13);
    }
  }
}

// Of distances with a closed form the result is a distance: |grad| = 1 and no point is nearer to the surface
// than it says.
TEST(Opening, OfABoxIsAnExactDistance) {
  const ScalarField f = field_of(box(1, 0.8, 0.6), "opening", {{"radius", 0.25}});
  Rng rng(8);
  for (int i = 0; i < bounded(500); ++i) {
    const Vec3 p = suite::point_in(rng, two);
    const FieldValues v = f.evaluate(Order::gradient, std::span<const Vec3>(&p, 1));
    EXPECT_NEAR(v.gradient(0).norm(), 1.0, 1e-12);
    EXPECT_NEAR(f.value(p - v.value(0) * v.gradient(0)), 0.0, 1e-12);
  }
}

TEST(Shell, IsAWallAroundTheSurface) {
  const SceneSpec ball = scene_of({part("s", "sphere", {{"radius", 1.0}})});
  const ScalarField f = field_of(ball, "shell", {{"inner", 0.1}, {"outer", 0.2}});
  for (const double r : {0.0, 0.5, 0.89, 0.91, 1.0, 1.19, 1.21, 2.0})
    EXPECT_EQ(f.value({0, r, 0}) > 0.0, r > 0.9 && r < 1.2) << r;
}

// The levels of soft objects and zero levels are offset on the inside's side.
TEST(Offsets, OfAllLevelsGrowTheSolid) {
  const SceneSpec zero = scene_of({ball("d", 1.0), part("z", "zero_level", {{"of", ref("d")}})});
  const SceneSpec half = scene_of({ball("d", 2.0), soft("s", "d")});  // 1/2 at d = 1/2
  const SceneSpec one = scene_of({ball("d", 1.0), part("z", "zero_level", {{"of", ref("d")}}),
                                  part("o", "convert", {{"of", ref("z")}, {"to", std::string("one")}})});
  for (const SceneSpec& solid : {zero, half, one}) {
    const ScalarField f = build_scene(solid).field;
    for (const char* kind : {"ball_offset", "normal_offset"})
      for (const double d : {0.1, -0.1}) {
        const ScalarField F = field_of(solid, kind, {{"distance", d}});
        EXPECT_EQ(F.level(), f.level());
        EXPECT_NEAR(inside(F.level(), F.value({0, 1.0 + d, 0})), 0.0, 1e-12) << kind << name(f.level());
        EXPECT_GT(inside(F.level(), F.value({0, 0.99 + d, 0})), 0.0);
      }
    const ScalarField F = field_of(solid, "iso_offset", {{"value", 0.05}});
    EXPECT_NEAR(inside(F.level(), F.value({0.6, 0.8, 0.3})),
                inside(f.level(), f.value({0.6, 0.8, 0.3})) + 0.05, 1e-15);
  }
}

// What is left over says so.
TEST(Offsets, SayThatNothingIsLeft) {
  const auto warnings = [](const SceneSpec& solid, const std::string& kind, Values values) {
    return offset_of(solid, kind, std::move(values)).warnings.size();
  };
  EXPECT_EQ(warnings(egg(3, 2, 1), "ball_offset", {{"distance", -1.01}}), 1u);
  EXPECT_EQ(warnings(egg(3, 2, 1), "ball_offset", {{"distance", -0.99}}), 0u);
  EXPECT_EQ(warnings(egg(3, 2, 1), "iso_offset", {{"value", -1.01}}), 1u);
  EXPECT_EQ(warnings(egg(3, 2, 1), "iso_offset", {{"value", -0.99}}), 0u);
  EXPECT_EQ(warnings(box(1, 0.8, 0.6), "ball_offset", {{"distance", -0.61}}), 1u);
  EXPECT_EQ(warnings(box(1, 0.8, 0.6), "ball_offset", {{"distance", -0.59}}), 0u);
  EXPECT_EQ(warnings(box(1, 0.8, 0.6), "opening", {{"radius", 0.61}}), 1u);
  EXPECT_EQ(warnings(box(1, 0.8, 0.6), "shell", {{"inner", 0.61}, {"outer", 0.1}}), 1u);
  EXPECT_EQ(warnings(scene_of({part("s", "torus", {{"ring", 1.0}, {"tube", 0.3}})}), "ball_offset",
                     {{"distance", -0.31}}),
            1u);
  EXPECT_EQ(warnings(bumpy(4), "ball_offset", {{"distance", -2.0}}), 1u);
  EXPECT_EQ(warnings(bumpy(4), "ball_offset", {{"distance", -0.2}}), 0u);
}

}  // namespace
}  // namespace blendwright::test
