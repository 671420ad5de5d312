// Bounds of quadrics over boxes: golden values, nesting, and what a test for a zero must not do.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "implicit/primitives/quadric.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright::test {
namespace {

using detail::QuadricCoefficients;

const Box cube{Vec3::Constant(-1.0), Vec3::Constant(1.0)};

QuadricCoefficients coefficients(const std::vector<double>& list) {
  QuadricCoefficients a{};
  std::copy(list.begin(), list.end(), a.begin());
  return a;
}
Vec3 vector(const std::vector<double>& v) { return {v.at(0), v.at(1), v.at(2)}; }

void expect_range(Range r, const std::vector<double>& golden) {
  EXPECT_NEAR(r.lo, golden.at(0), 1e-12 * std::max(1.0, std::abs(golden.at(0))));
  EXPECT_NEAR(r.hi, golden.at(1), 1e-12 * std::max(1.0, std::abs(golden.at(1))));
}

TEST(QuadricBounds, AreTheGoldenOnes) {
  std::size_t seen = 0;
  for (const RelationCase& c : read_relation_golden(golden_folder())) {
    if (c.function != "quadric_box") continue;
    SCOPED_TRACE(c.id);
    const QuadricCoefficients a = coefficients(c.parameters.lists.at("A"));
    for (const RelationSample& s : c.samples) {
      const Vec3 centre = vector(s.lists.at("centre")), half = vector(s.lists.at("half"));
      const QuadricCoefficients t = detail::remapped(a, centre, half);
      for (std::size_t i = 0; i < 10; ++i) {
        const double golden = s.lists.at("remapped").at(i);
        EXPECT_NEAR(t[i], golden, 1e-12 * std::max(1.0, std::abs(golden))) << i;
      }
      expect_range(detail::sum_bound(t), s.lists.at("sum_bound"));
      expect_range(detail::tight_bound(t), s.lists.at("tight_bound"));
      expect_range(detail::exact_range(t), s.lists.at("exact_range"));
      ++seen;
    }
  }
  EXPECT_EQ(seen, 24u);
}

QuadricCoefficients random_coefficients(Rng& rng) {
  QuadricCoefficients a{};
  for (double& x : a) x = uniform(rng, 0.0, 1.0) < 0.2 ? 0.0 : uniform(rng, -2.0, 2.0);
  return a;
}

double value_at(const QuadricCoefficients& a, const Vec3& p) {
  const detail::Quadric body{a};
  return scalar_value(op_for<detail::Quadric>(), &body, p);
}

TEST(QuadricBounds, AreInsideEachOther) {
  for_all([](Rng& rng) {
    const QuadricCoefficients a = random_coefficients(rng);
    const Range exact = detail::exact_range(a), tight = detail::tight_bound(a), sum = detail::sum_bound(a);
    const double slack = 1e-13 * (sum.hi - sum.lo);  // a dozen roundings of terms of this size
    EXPECT_LE(tight.lo, exact.lo + slack);
    EXPECT_GE(tight.hi, exact.hi - slack);
    EXPECT_LE(sum.lo, tight.lo + slack);
    EXPECT_GE(sum.hi, tight.hi - slack);
    // The exact range is attained: some point of the sub-faces has it. Samples come near it from inside.
    double lo = 1e300, hi = -1e300;
    for (int i = 0; i < 3000; ++i) {
      Vec3 p = suite::point_in(rng, cube);
      for (int k = 0; k < 3; ++k)
        if (uniform(rng, 0.0, 1.0) < 0.4) p[k] = p[k] < 0.0 ? -1.0 : 1.0;
      lo = std::min(lo, value_at(a, p));
      hi = std::max(hi, value_at(a, p));
    }
    EXPECT_GE(lo, exact.lo - slack);
    EXPECT_LE(hi, exact.hi + slack);
    // 3000 samples, of which hundreds lie on each sort of sub-face, come within a tenth of the width.
    EXPECT_LE(std::max(lo - exact.lo, exact.hi - hi), 0.1 * (exact.hi - exact.lo));
  });
}

TEST(QuadricBounds, AreExactWithoutCrossTerms) {
  for_all([](Rng& rng) {
    QuadricCoefficients a = random_coefficients(rng);
    a[3] = a[4] = a[5] = 0.0;
    const Range exact = detail::exact_range(a), tight = detail::tight_bound(a);
    EXPECT_NEAR(tight.lo, exact.lo, 1e-13 * 20.0);  // ten terms of at most 2
    EXPECT_NEAR(tight.hi, exact.hi, 1e-13 * 20.0);
  });
}

/// The box |x_i| <= 0.2 inside the unit sphere: M = 0.12 < |A44| = 1, and still the perturbation is there.
TEST(QuadricBounds, KeepAPerturbationInTheMiddleOfItsSupport) {
  const QuadricCoefficients sphere{-1, -1, -1, 0, 0, 0, 0, 0, 0, 1};
  const QuadricCoefficients t = detail::remapped(sphere, Vec3::Zero(), Vec3::Constant(0.2));
  EXPECT_NEAR(detail::tight_bound(t).lo, 0.88, 1e-15);
  EXPECT_NEAR(detail::tight_bound(t).hi, 1.0, 1e-15);
  EXPECT_NEAR(detail::sum_bound(t).lo, 0.88, 1e-15);
  EXPECT_NEAR(detail::sum_bound(t).hi, 1.12, 1e-15);
  const Box box{Vec3::Constant(-0.2), Vec3::Constant(0.2)};
  const Range q = detail::quadric_range(sphere, box);
  const detail::Perturbation bump{1.0, 3, 0.0};
  const Op& op = op_for<detail::Perturbation>();
  EXPECT_EQ(op.shortcut(&bump, box, {&q, 1}).kind, Shortcut::Kind::none);
  const Range outside{-2.0, -1e-9};
  EXPECT_EQ(op.shortcut(&bump, box, {&outside, 1}).kind, Shortcut::Kind::constant);
}

/// A quadric far from its box's origin: the remapped free term has cancelled, the slack must not have.
TEST(QuadricBounds, HoldFarFromTheOrigin) {
  for_all([](Rng& rng) {
    QuadricCoefficients a{-1, -1, -1, 0, 0, 0, 0, 0, 0, 1};
    const double far = log_uniform(rng, 1.0, 1e7);
    Frame frame;
    frame.offset = -far * Vec3(uniform(rng, 0.5, 1.0), uniform(rng, 0.5, 1.0), uniform(rng, 0.5, 1.0));
    frame.identity = false;
    a = detail::seen_through(a, frame);
    const Vec3 centre = -frame.offset, half = Vec3::Constant(log_uniform(rng, 1e-9, 1.0));
    const Box box{centre - half, centre + half};
    const Range range = detail::quadric_range(a, box);
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(range.contains(value_at(a, suite::point_in(rng, box))));
  });
}

TEST(QuadricRegion, HoldsAnEllipsoidAndIsTight) {
  for_all([](Rng& rng) {
    // A random ellipsoid: semi-axes s, turned and moved by a frame.
    const Vec3 s(log_uniform(rng, 0.1, 10.0), log_uniform(rng, 0.1, 10.0), log_uniform(rng, 0.1, 10.0));
    const QuadricCoefficients unit{
        -1 / (s.x() * s.x()), -1 / (s.y() * s.y()), -1 / (s.z() * s.z()), 0, 0, 0, 0, 0, 0, 1};
    const Eigen::Matrix3d turn = Eigen::Quaterniond(uniform(rng, -1, 1), uniform(rng, -1, 1),
                                                    uniform(rng, -1, 1), uniform(rng, 0.1, 1))
                                     .normalized()
                                     .toRotationMatrix();
    const Vec3 move(uniform(rng, -5, 5), uniform(rng, -5, 5), uniform(rng, -5, 5));
    const Frame frame(turn, -(turn.transpose() * move));
    const QuadricCoefficients a = detail::seen_through(unit, frame);
    const double value = uniform(rng, -3.0, 0.9);
    const auto box = detail::quadric_region(a, value);
    ASSERT_TRUE(box);
    // In the frame's coordinates the body is |Y_i / s_i|^2 <= 1 - value, so its reach along x_i is this norm.
    for (int i = 0; i < 3; ++i) {
      const double reach = std::sqrt(1.0 - value) * s.cwiseProduct(turn.row(i).transpose()).norm();
      EXPECT_LE(box->lo[i], move[i] - reach);
      EXPECT_GE(box->hi[i], move[i] + reach);
      // cond <= 1e4 here, so that the margins are below 1e-9 of the terms, which are below 1e5 of the reach.
      EXPECT_NEAR(box->hi[i] - box->lo[i], 2.0 * reach, 1e-3 * reach);
    }
    const auto top = detail::top_of(a);
    ASSERT_TRUE(top);
    EXPECT_NEAR((top->at - move).norm(), 0.0, 1e-8);
    EXPECT_NEAR(top->value, 1.0, 1e-8);
  });
}

TEST(QuadricRegion, OfAxisAlignedSolidsHasTheEndsThatThereAre) {
  const double inf = std::numeric_limits<double>::infinity();
  // Ends move out by 8 eps of the terms, whose sum is below 20 here, and 16 eps of themselves: below 1e-13.
  // Ball of radius 2 about x = 1 in the first two axes: a cylinder; slabs; half-spaces; a parabolic trough.
  const auto cylinder = detail::quadric_region({-1, -1, 0, 0, 0, 0, 2, 0, 0, 3}, 0.0);
  ASSERT_TRUE(cylinder);
  EXPECT_NEAR(cylinder->lo.x(), -1.0, 1e-13);
  EXPECT_NEAR(cylinder->hi.x(), 3.0, 1e-13);
  EXPECT_NEAR(cylinder->hi.y(), 2.0, 1e-13);
  EXPECT_EQ(cylinder->lo.z(), -inf);
  EXPECT_EQ(cylinder->hi.z(), inf);
  const auto slab = detail::quadric_region({0, 0, -1, 0, 0, 0, 0, 0, 5, 0}, 0.0);
  ASSERT_TRUE(slab);
  EXPECT_NEAR(slab->lo.z(), 0.0, 1e-13);
  EXPECT_NEAR(slab->hi.z(), 5.0, 1e-13);
  EXPECT_EQ(slab->hi.x(), inf);
  const auto half = detail::quadric_region({0, 0, 0, 0, 0, 0, -2, 0, 0, 6}, 0.0);
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->hi.x(), 3.0, 1e-13);
  EXPECT_EQ(half->lo.x(), -inf);
  const auto trough = detail::quadric_region({-1, 0, 0, 0, 0, 0, 0, 0, -1, 4}, 0.0);  // z <= 4 - x^2
  ASSERT_TRUE(trough);
  EXPECT_EQ(trough->lo.x(), -inf);
  EXPECT_NEAR(trough->hi.z(), 4.0, 1e-13);
}

TEST(QuadricRegion, HoldsEveryPointOfAxisAlignedSolids) {
  for_all([](Rng& rng) {
    QuadricCoefficients a{};
    for (const int i : {0, 1, 2, 6, 7, 8})
      if (integer(rng, 0, 1) == 1)
        a[static_cast<std::size_t>(i)] = uniform(rng, i < 3 ? -2.0 : -3.0, i < 3 ? 0.0 : 3.0);
    a[9] = uniform(rng, -2.0, 5.0);
    const double value = uniform(rng, -3.0, 3.0);
    const auto box = detail::quadric_region(a, value);
    if (!box) return;
    for (int k = 0; k < 200; ++k) {
      const Vec3 p(uniform(rng, -6, 6), uniform(rng, -6, 6), uniform(rng, -6, 6));
      if (value_at(a, p) >= value) {
        EXPECT_TRUE(box->contains(p)) << p.transpose();
      }
    }
  });
}

TEST(QuadricRegion, IsUnboundedForAllButEllipsoids) {
  for (const QuadricCoefficients& a :
       {QuadricCoefficients{-1, -1, 1, 0, 0, 0, 0, 0, 0, 1},    // hyperboloid
        QuadricCoefficients{1, 1, 1, 0, 0, 0, 0, 0, 0, -1},     // outside of a ball
        QuadricCoefficients{-1, -1, -1, 2, 0, 0, 0, 0, 0, 1}})  // -(x-y)^2-z^2+1
    EXPECT_FALSE(detail::quadric_region(a, 0.0));
  EXPECT_TRUE(detail::quadric_region({-1, -1, -1, 0, 0, 0, 0, 0, 0, 1}, 0.0));
}

}  // namespace
}  // namespace blendwright::test
