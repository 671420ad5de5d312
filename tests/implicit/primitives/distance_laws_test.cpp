// What distance primitives are: ray-linear, positive, enclosed, and equal to each other where they must be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/implicit/primitives/made_primitive.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright {
namespace {

using namespace test;
using List = std::vector<double>;

/// A power x^n is off by a few ulp times (1 + |n ln x|), and terms of a norm that matter have |n ln x| < 36;
/// a norm's 1/n-th power with n >= 0.05 enlarges that up to 20 times, but then |n ln x| is small. 40 * 5 eps
/// * (two norms, two sides) < 1e-12.
constexpr double relative = 1e-12;

std::shared_ptr<const Tape> tape_of(NodeSpec spec) {
  return make_primitive(scene_of({std::move(spec)})).tape;
}

Vec3 direction(Rng& rng) {
  Vec3 d;
  do d = {uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)};
  while (d.norm() > 1.0 || d.norm() < 1e-3);
  return d.normalized();
}

/// |f(o + aX) - a f(o + X)| / (a f), and |X.grad f - f| / sum |x_i f_i|, at a random place.
struct Departure {
  double from_rays, from_euler;
};
Departure departure(const Tape& tape, const Vec3& origin, double reach, Rng& rng) {
  const Vec3 x = uniform(rng, 0.05, 1.0) * reach * direction(rng);
  const double a = log_uniform(rng, 0.1, 10.0), f = value_at(tape, origin + x);
  if (f == 0.0) return {std::abs(value_at(tape, origin + a * x)), gradient_at(tape, origin + x).norm()};
  const Vec3 terms = x.cwiseProduct(gradient_at(tape, origin + x));
  return {std::abs(value_at(tape, origin + a * x) - a * f) / (a * std::abs(f)),
          std::abs(terms.sum() - f) / (terms.cwiseAbs().sum() + std::abs(f))};
}

TEST(RayLinearPrimitives, AreWhatTheySayAndObeyEuler) {
  int seen = 0;
  for (const PrimitiveSample& sample : primitive_samples()) {
    SCOPED_TRACE(sample.id);
    const MadePrimitive made = make_primitive(sample.scene);
    if (!made.node.ray_linear) continue;
    ++seen;
    for_all([&](Rng& rng) {
      const Departure d = departure(*made.tape, made.node.origin, sample.where.hi.norm(), rng);
      EXPECT_LE(d.from_rays, relative);
      EXPECT_LE(d.from_euler, relative);
    });
  }
  EXPECT_GE(seen, 20);
}

TEST(RayLinearPrimitives, AreToldFromOthers) {
  const MadePrimitive segment = make_primitive(scene_of(
      {part("s", "segment_skeleton", {{"p0", List{-3, 0, 0}}, {"p1", List{4, 0, 0}}, {"radius", 5.0}})}));
  EXPECT_FALSE(segment.node.ray_linear);
  const Vec3 x(5, 2, 0.5);
  EXPECT_NEAR(value_at(*segment.tape, 2.0 * x) / value_at(*segment.tape, x), 3.1773, 5e-5);

  const MadePrimitive point = make_primitive(scene_of(
      {part("s", "segment_skeleton", {{"p0", List{1, 2, 3}}, {"p1", List{1, 2, 3}}, {"radius", 5.0}})}));
  EXPECT_TRUE(point.node.ray_linear);
  EXPECT_EQ(point.node.origin, Vec3(1, 2, 3));
}

TEST(DistancePrimitives, AreNeverNegativeAndVanishOffTheOriginOnlyWhenTheySaySo) {
  for (const PrimitiveSample& sample : primitive_samples()) {
    SCOPED_TRACE(sample.id);
    const MadePrimitive made = make_primitive(sample.scene);
    EXPECT_EQ(made.node.level, Level::one);
    EXPECT_EQ(made.node.distance, solid_of(sample.scene).kind != "plane");
    if (!made.node.distance) continue;
    Rng rng(3);
    std::vector<Vec3> points;
    for (int i = 0; i < 20000; ++i) points.push_back(made.node.origin + direction(rng));
    const auto values = values_at(*made.tape, points);
    const double least = *std::min_element(values.begin(), values.end());
    EXPECT_GE(least, 0.0);
    // On 20000 random directions an unbounded one comes within 0.02 of a zero of slope 1/a.
    if (made.node.ray_linear && !made.node.positive) {
      EXPECT_LT(least, 0.02 * *std::max_element(values.begin(), values.end()));
    }
    if (made.node.positive) {
      EXPECT_GT(least, 0.0);
      EXPECT_TRUE(made.node.region(1.0));
    }
  }
}

/// A point with d = value on the ray from the node's origin, or from the middle of the segment.
Vec3 on_surface(const MadePrimitive& made, const NodeSpec& spec, double value, Rng& rng) {
  const Vec3 d = direction(rng);
  if (spec.kind != "segment_skeleton")
    return made.node.origin + d * (value / value_at(*made.tape, made.node.origin + d));
  const auto &p0 = std::get<List>(spec.values.at("p0")), &p1 = std::get<List>(spec.values.at("p1"));
  const Vec3 centre = 0.5 * Vec3(p0[0] + p1[0], p0[1] + p1[1], p0[2] + p1[2]);
  double lo = 0.0, hi = 1e3;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.5 * (lo + hi);
    (value_at(*made.tape, centre + t * d) <= value ? lo : hi) = t;
  }
  return centre + lo * d;
}

bool sweeps(const std::string& kind) { return kind.rfind("sweep", 0) == 0 || kind == "polar_bar"; }

TEST(Regions, HoldTheirLevelSets) {
  for (const PrimitiveSample& sample : primitive_samples()) {
    const NodeSpec& spec = solid_of(sample.scene);
    if (sweeps(spec.kind)) continue;
    SCOPED_TRACE(sample.id);
    const MadePrimitive made = make_primitive(sample.scene);
    if (!made.node.region(1.0)) continue;
    for_all([&](Rng& rng) {
      const double value = log_uniform(rng, 0.1, 10.0);
      const auto box = made.node.region(value);
      ASSERT_TRUE(box);
      const Vec3 p = on_surface(made, spec, value, rng);
      // The point itself is off by rounding, of its own size and of where it was measured from.
      const double slack = 1e-12 * (p.norm() + value);
      EXPECT_TRUE((Box{box->lo.array() - slack, box->hi.array() + slack}).contains(p)) << p.transpose();
    });
  }
}

/// Where a level set of a primitive other than a generalized distance can touch the side of its box: on an
/// axis, or beside an end of a segment.
std::vector<Vec3> touching(const NodeSpec& spec, const Box& box, int axis, bool high) {
  const double at = (high ? box.hi : box.lo)[axis];
  std::vector<Vec3> points{at * Vec3::Unit(axis)};
  if (spec.kind != "segment_skeleton") return points;
  for (const char* key : {"p0", "p1"}) {
    const auto& p = std::get<List>(spec.values.at(key));
    Vec3 beside(p[0], p[1], p[2]);
    beside[axis] = at;
    points.push_back(beside);
  }
  return points;
}

TEST(Regions, TouchTheirLevelSetsOnEverySide) {
  for (const PrimitiveSample& sample : primitive_samples()) {
    const NodeSpec& spec = solid_of(sample.scene);
    if (sweeps(spec.kind) || spec.kind == "generalized_distance") continue;
    SCOPED_TRACE(sample.id);
    const MadePrimitive made = make_primitive(sample.scene);
    if (!made.node.region(1.0)) continue;
    for (const double value : {0.5, 1.0, 7.0})
      for (int side = 0; side < 6; ++side) {
        const Box region = *made.node.region(value);
        if (!std::isfinite((side % 2 == 1 ? region.hi : region.lo)[side / 2])) continue;  // no side there
        const auto values = values_at(*made.tape, touching(spec, region, side / 2, side % 2 == 1));
        EXPECT_NEAR(*std::min_element(values.begin(), values.end()), value, 1e-9 * value) << "side " << side;
      }
  }
}

/// The largest x_j of d <= 1 is 1 / min d over the plane x_j = 1, where d is convex: nested golden sections.
double largest_coordinate(const Tape& tape, int j) {
  const auto inner = [&](double s) {
    const auto at = [&](double t) {
      Vec3 p = Vec3::Unit(j);
      p[(j + 1) % 3] = s;
      p[(j + 2) % 3] = t;
      return value_at(tape, p);
    };
    double lo = -5.0, hi = 5.0;
    for (int i = 0; i < 50; ++i) {
      const double a = lo + 0.381966 * (hi - lo), b = lo + 0.618034 * (hi - lo);
      (at(a) < at(b) ? hi : lo) = at(a) < at(b) ? b : a;
    }
    return at(lo);
  };
  double lo = -5.0, hi = 5.0;
  for (int i = 0; i < 50; ++i) {
    const double a = lo + 0.381966 * (hi - lo), b = lo + 0.618034 * (hi - lo);
    (inner(a) < inner(b) ? hi : lo) = inner(a) < inner(b) ? b : a;
  }
  return 1.0 / inner(lo);
}

TEST(Regions, OfGeneralizedDistancesAreTightWithinAPercent) {
  int seen = 0;
  for (const PrimitiveSample& sample : primitive_samples()) {
    if (solid_of(sample.scene).kind != "generalized_distance") continue;
    SCOPED_TRACE(sample.id);
    const MadePrimitive made = make_primitive(sample.scene);
    if (!made.node.region(1.0)) continue;
    ++seen;
    const Box box = *made.node.region(1.0);
    for (int j = 0; j < 3; ++j) {
      const double exact = largest_coordinate(*made.tape, j);
      EXPECT_GE(box.hi[j], exact * (1.0 - 1e-12));
      EXPECT_LE(box.hi[j], exact * 1.01);
      EXPECT_EQ(box.lo[j], -box.hi[j]);
    }
  }
  EXPECT_GE(seen, 5);
}

/// Two tapes that must be one function.
void expect_equal(const Tape& a, const Tape& b, Rng& rng) {
  const Vec3 x = uniform(rng, 0.0, 10.0) * direction(rng);
  const double f = value_at(b, x);
  EXPECT_NEAR(value_at(a, x), f, relative * std::max(1e-3, std::abs(f)));
  EXPECT_LE((gradient_at(a, x) - gradient_at(b, x)).norm(), 1e-10 * gradient_at(b, x).norm());
}

TEST(DistancePrimitives, AreOneFunctionWhereTheirFormulasMeet) {
  for_all(
      [](Rng& rng) {
        const double a = uniform(rng, 0.5, 5), b = uniform(rng, 0.5, 5), c = uniform(rng, 0.5, 5),
                     n = uniform(rng, 0.6, 20.0);
        const auto lp = tape_of(part("l", "lp_metric", {{"a", a}, {"b", b}, {"c", c}, {"n", n}}));
        expect_equal(
            *tape_of(part("q", "superquadric", {{"a", a}, {"b", b}, {"c", c}, {"n1", n}, {"n2", n}})), *lp,
            rng);
        expect_equal(*tape_of(part("y", "asymmetric_superellipsoid",
                                   {{"x", List{a, a}}, {"y", List{b, b}}, {"z", List{c, c}}, {"n", n}})),
                     *lp, rng);
        const double m = 1.0 + n;
        const std::vector<List> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        expect_equal(*tape_of(part("g", "generalized_distance", {{"normals", axes}, {"n", m}})),
                     *tape_of(part("l", "lp_metric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}, {"n", m}})), rng);
        const Vec3 v = direction(rng);
        const List normal{v.x(), v.y(), v.z()};
        expect_equal(
            *tape_of(part("g", "generalized_distance", {{"normals", std::vector<List>{normal}}, {"n", m}})),
            *tape_of(part("s", "slab", {{"normal", normal}, {"a", 1.0}})), rng);
        expect_equal(*tape_of(part("c", "capsule_gauge", {{"below", 0.0}, {"above", 0.0}, {"radius", a}})),
                     *tape_of(part("p", "segment_skeleton",
                                   {{"p0", List{0, 0, 0}}, {"p1", List{0, 0, 0}}, {"radius", a}})),
                     rng);
      },
      100);
}

TEST(CapsuleGauge, IsTheScaleAtWhichThePointIsOnTheCapsule) {
  for_all([](Rng& rng) {
    const double below = uniform(rng, 0, 9), above = uniform(rng, 0, 9), radius = log_uniform(rng, 0.1, 10);
    const auto gauge =
        tape_of(part("c", "capsule_gauge", {{"below", below}, {"above", above}, {"radius", radius}}));
    const auto distance =
        tape_of(part("s", "segment_skeleton",
                     {{"p0", List{0, 0, -below}}, {"p1", List{0, 0, above}}, {"radius", radius}}));
    const Vec3 x = log_uniform(rng, 0.01, 100) * direction(rng);
    // The distance at X/t has the rounding of coordinates up to 9 + 10 over a radius of 0.1 at least.
    EXPECT_NEAR(value_at(*distance, x / value_at(*gauge, x)), 1.0, 1e-12);
  });
}

TEST(Skeletons, AreLipschitzWithTheInverseOfTheirRadius) {
  double steepest = 0.0;
  for_all([&](Rng& rng) {
    const double radius = log_uniform(rng, 0.1, 10);
    const auto segment = tape_of(
        part("s", "segment_skeleton", {{"p0", List{1, -2, 0}}, {"p1", List{4, 3, 5}}, {"radius", radius}}));
    const auto capsule =
        tape_of(part("c", "capsule_gauge", {{"below", 2.0}, {"above", 6.0}, {"radius", radius}}));
    const Vec3 x = 10.0 * direction(rng), y = x + log_uniform(rng, 1e-3, 10.0) * direction(rng);
    for (const auto& tape : {segment, capsule}) {
      const double slope = radius * std::abs(value_at(*tape, x) - value_at(*tape, y)) / (x - y).norm();
      EXPECT_LE(slope, 1.0 + 1e-10);  // rounding: 1e-14 of values up to 100 over steps of 1e-3
      steepest = std::max(steepest, slope);
    }
  });
  EXPECT_GT(steepest, 0.9);
}

TEST(Norms, OverflowNowhereAndDerivativesStayFinite) {
  const auto box = tape_of(part("l", "lp_metric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}, {"n", 20.0}}));
  EXPECT_NEAR(value_at(*box, {1e30, 2e30, 0}), 2.0000000953673884e30, 1e-12 * 2e30);
  EXPECT_NEAR(value_at(*box, {1e-30, 0, 3e-30}), 3.0000000000430194e-30, 1e-12 * 3e-30);
  EXPECT_EQ(value_at(*box, {1e200, 1e-200, 0}), 1e200);
  // Scaled by powers of two the terms differ from those of (1, 1, 1); the 20th root of S <= 3 2^20 errs by
  // less than 4e-15 (1 + ln(S)/20) = 7e-15 on either side.
  const double corner = value_at(*box, {1, 1, 1}) * 1e300;
  EXPECT_NEAR(value_at(*box, {1e300, 1e300, -1e300}), corner, 1.4e-14 * corner);
  for (const PrimitiveSample& sample : primitive_samples()) {
    if (sweeps(solid_of(sample.scene).kind)) continue;
    SCOPED_TRACE(sample.id);
    const auto tape = make_primitive(sample.scene).tape;
    for_all([&](Rng& rng) {
      double x[3];
      for (double& c : x) c = (integer(rng, 0, 1) == 0 ? -1.0 : 1.0) * log_uniform(rng, 1e-300, 1e150);
      if (integer(rng, 0, 2) == 0) x[integer(rng, 0, 2)] = 0.0;
      for (const bool scalar : {false, true}) {
        double out[10];
        const PointArrays point{{&x[0], 1}, {&x[1], 1}, {&x[2], 1}};
        scalar ? tape->evaluate_scalar(Order::hessian, point, out)
               : tape->evaluate(Order::hessian, point, out);
        for (const double v : out) EXPECT_TRUE(std::isfinite(v)) << x[0] << ' ' << x[1] << ' ' << x[2];
      }
    });
  }
}

}  // namespace
}  // namespace blendwright
