// The laws of all evaluators, on every solid; ranges and linear bounds over many boxes.
#include <gtest/gtest.h>

#include <set>

#include "implicit/scene/node.hpp"
#include "implicit/scene/scene.hpp"
#include "tests/implicit/primitives/solid_samples.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

TEST(Solids, HaveASampleOfEveryRow) {
  std::set<std::string_view> seen;
  for (const SolidSample& s : solid_samples()) seen.insert(s.kind);
  for (const NodeKind& row : solid_kinds()) EXPECT_TRUE(seen.contains(row.name)) << row.name;
}

TEST(Solids, ObeyTheLawsOfEvaluation) {
  for (const SolidSample& s : solid_samples()) {
    SCOPED_TRACE(s.id);
    EXPECT_EQ(evaluator_faults(*build_tape(s.scene), {.where = s.where, .useless_share = s.useless_share}),
              no_faults);
  }
}

/// 10^6 pairs of a box and a point in it for every sample of a family, 10^7 in long runs.
TEST(Solids, RangesAndLinearBoundsHoldMillionsOfSamples) {
  constexpr int boxes = 2000, points = 500;
  for (const SolidSample& s : solid_samples()) {
    SCOPED_TRACE(s.id);
    const auto tape = build_tape(s.scene);
    Rng rng(11);
    suite::Faults faults;
    for (int b = 0; b < bounded(boxes); ++b) {
      const Box box = suite::box_in(rng, s.where);
      std::vector<Vec3> inside{box.lo, box.hi, box.centre()};
      while (inside.size() < points) inside.push_back(suite::point_in(rng, box));
      const suite::Results values = suite::evaluate(*tape, Order::value, inside);
      const Range range = tape->range(box);
      for (std::size_t i = 0; i < inside.size(); ++i)
        if (!range.contains(values.at(i, 0))) faults.add("range misses a value", suite::text(inside[i]));
      suite::check_linear(*tape, box, inside, values, faults);
    }
    EXPECT_EQ(faults.list(), no_faults);
  }
}

TEST(Solids, HaveRangesOverBoxesWithoutEnd) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const SolidSample& s : solid_samples()) {
    SCOPED_TRACE(s.id);
    const auto tape = build_tape(s.scene);
    Rng rng(12);
    std::vector<Vec3> points;
    for (int i = 0; i < 100; ++i)
      points.push_back(log_uniform(rng, 0.1, 1e100) * suite::point_in(rng, s.where));
    const suite::Results values = suite::evaluate(*tape, Order::hessian, points);
    suite::Faults faults;
    suite::check_finite(values, points, faults);
    EXPECT_EQ(faults.list(), no_faults);
    for (const Box& box : {Box{Vec3::Constant(-infinity), Vec3::Constant(infinity)},
                           Box{Vec3(-infinity, 0.1, 0.1), Vec3(2.0, infinity, 0.2)},
                           Box{Vec3::Constant(-1e300), Vec3::Constant(1e300)}}) {
      const Range range = tape->range(box), linear = tape->linear(box).range();
      EXPECT_LE(range.lo, range.hi);
      EXPECT_LE(linear.lo, linear.hi);
      for (std::size_t i = 0; i < points.size(); ++i)
        if (box.contains(points[i])) {
          EXPECT_TRUE(range.contains(values.at(i, 0)));
          EXPECT_TRUE(linear.contains(values.at(i, 0)));
        }
    }
  }
}

/// What a bound leaves open over boxes of half sizes h and h/4 around the same point.
double openness(const Tape& tape, const Vec3& centre, double h) {
  const Range rest = tape.linear({centre.array() - h, centre.array() + h}).rest;
  return rest.hi - rest.lo;
}

/// The second-order terms of Q over |t_i| <= h are exactly what is left: 16 times less for h/4. Rounding adds
/// less than 1e-13 of the coefficients' terms.
TEST(LinearBounds, OfSmoothSolidsConvergeQuadratically) {
  std::size_t tried = 0;
  for (const SolidSample& s : solid_samples()) {
    if (s.kind != "quadric" && s.kind != "freeform" && s.kind != "ellipsoid_quadric") continue;
    if (s.id == "half-space" || s.id == "mixed-freeform") continue;  // nothing is left; not smooth
    SCOPED_TRACE(s.id);
    const auto tape = build_tape(s.scene);
    Rng rng(5);
    double wide = 0.0, narrow = 0.0;
    for (int i = 0; i < 100; ++i) {
      const Vec3 centre = suite::point_in(rng, s.where);
      wide += openness(*tape, centre, 0.02);
      narrow += openness(*tape, centre, 0.005);
      ++tried;
    }
    // Third-order terms are at most a few times h of the second-order ones; bumps of k = 2 add none.
    EXPECT_LE(narrow, wide / 14.0);
    EXPECT_GE(narrow, wide / 18.0);
  }
  EXPECT_GE(tried, 500u);
}

/// Distances are not smooth everywhere; away from the medial axis they converge alike, on average.
TEST(LinearBounds, OfDistancesConvergeNearTheSurface) {
  for (const SolidSample& s : solid_samples()) {
    if (s.id != "ellipsoid-3-2-1" && s.kind != "torus" && s.kind != "sphere") continue;
    if (s.id == "thin-torus") continue;  // its medial circle is everywhere near
    SCOPED_TRACE(s.id);
    const auto tape = build_tape(s.scene);
    Rng rng(6);
    double wide = 0.0, narrow = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 centre = suite::point_in(rng, s.where);
      const Range f = tape->range({centre, centre});
      if (std::abs(f.lo) > 0.2) continue;
      wide += openness(*tape, centre, 0.02);
      narrow += openness(*tape, centre, 0.005);
    }
    EXPECT_GT(wide, 0.0);
    EXPECT_LE(narrow, wide / 12.0);
  }
}

/// The solid slope x >= 0.
SceneSpec one_quadric(double slope) {
  return scene_of(
      {part("case", "quadric", {{"coefficients", std::vector<double>{0, 0, 0, 0, 0, 0, slope, 0, 0, 0}}})});
}

TEST(LinearBounds, SeeThatTwoFunctionsChangeTogether) {
  // x and -x: their sum is 0, which ranges cannot know.
  const ScalarField plus = build_scene(one_quadric(1.0)).field, minus = build_scene(one_quadric(-1.0)).field;
  const Box box{Vec3::Constant(-1.0), Vec3::Constant(1.0)};
  const LinearBound sum = plus.linear(box) + minus.linear(box);
  EXPECT_LT(sum.range().hi - sum.range().lo, 1e-13);
  EXPECT_GE(plus.range(box).hi + minus.range(box).hi, 2.0);
}

}  // namespace
}  // namespace blendwright::test
