// Ranges, boxes, levels, and curvatures of level surfaces from derivatives of the field.
#include <gtest/gtest.h>

#include <memory>

#include "kernel/field/scalar_field.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

Vec3 random_point(Rng& rng, double reach) {
  return {uniform(rng, -reach, reach), uniform(rng, -reach, reach), uniform(rng, -reach, reach)};
}
Box random_box(Rng& rng) {
  const Vec3 a = random_point(rng, 3.0), b = random_point(rng, 3.0);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}
Vec3 point_in(Rng& rng, const Box& b) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = uniform(rng, b.lo[i], b.hi[i]);
  return p;
}

TEST(Range, OfMagnitudesHoldsThem) {
  EXPECT_EQ(magnitude({2.0, 3.0}), (Range{2.0, 3.0}));
  EXPECT_EQ(magnitude({-3.0, -2.0}), (Range{2.0, 3.0}));
  EXPECT_EQ(magnitude({-3.0, 2.0}), (Range{0.0, 3.0}));
  for_all([](Rng& rng) {
    const double a = uniform(rng, -2.0, 2.0), b = uniform(rng, -2.0, 2.0), t = uniform(rng, 0.0, 1.0);
    const Range r{std::min(a, b), std::max(a, b)};
    EXPECT_TRUE(magnitude(r).contains(std::abs(r.lo + t * (r.hi - r.lo))));
  });
}

TEST(Range, WidensOutwardAndKeepsZero) {
  EXPECT_EQ((Range{0.0, 0.0}).widened(0.1), (Range{0.0, 0.0}));
  EXPECT_TRUE((Range{0.0, 0.0}).constant());
  const Range r = Range{-2.0, 4.0}.widened(0.25);
  EXPECT_EQ(r, (Range{-2.5, 5.0}));
  EXPECT_FALSE((Range{1.0, 2.0}).contains(2.5));
  EXPECT_TRUE(Range::everything().contains(-1e308));
}

TEST(Box, HullAndCommonPartAreWhatTheyHold) {
  for_all([](Rng& rng) {
    const Box a = random_box(rng), b = random_box(rng);
    const Box h = hull(a, b);
    const auto c = common(a, b);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random_point(rng, 3.0);
      if (a.contains(p) || b.contains(p)) {
        EXPECT_TRUE(h.contains(p));
      }
      EXPECT_EQ(c.has_value() && c->contains(p), a.contains(p) && b.contains(p));
    }
    EXPECT_TRUE(a.contains(a.centre()));
    EXPECT_TRUE(h.contains(point_in(rng, a)));
  });
  EXPECT_FALSE(common({Vec3::Zero(), Vec3::Ones()}, {Vec3::Constant(2.0), Vec3::Constant(3.0)}));
}

TEST(Level, InsideIsPositiveInTheSolid) {
  EXPECT_GT(inside(Level::zero, -0.1), 0.0);
  EXPECT_GT(inside(Level::one, 0.9), 0.0);
  EXPECT_GT(inside(Level::half, 0.6), 0.0);
  EXPECT_GT(inside(Level::function, 0.1), 0.0);
  for (const Level level : {Level::zero, Level::one, Level::half, Level::function})
    EXPECT_EQ(inside(level, surface_value(level)), 0.0);
}

/// Derivatives of a field at a point, written down by hand.
struct Derivatives {
  Vec3 gradient;
  std::array<double, 6> hessian;  // xx, yy, zz, xy, xz, yz
};

/// Of s f: the same surface seen as another level convention or scale.
std::optional<LevelCurvature> curvature(const Derivatives& d, double s, Level level) {
  std::array<double, 6> h = d.hessian;
  for (double& x : h) x *= s;
  return level_curvature(s * d.gradient, h, level);
}

/// The expected curvatures in every convention. All fields are given so that they grow outward; in the
/// conventions with sense +1 values grow inward, so the sign of the field turns.
void expect_curvature(const Derivatives& d, double mean, double gaussian) {
  for (const Level level : {Level::zero, Level::one, Level::half, Level::function}) {
    const auto k = curvature(d, -2.5 * sense(level), level);
    ASSERT_TRUE(k);
    // A dozen roundings of terms that are at most 100 times the result.
    EXPECT_NEAR(k->mean, mean, 1e-12 * (1.0 + std::abs(mean)));
    EXPECT_NEAR(k->gaussian, gaussian, 1e-12 * (1.0 + std::abs(gaussian)));
  }
}

TEST(LevelCurvature, OfASphereIsThatOfItsRadius) {
  for_all([](Rng& rng) {
    const double radius = log_uniform(rng, 0.1, 10.0);
    const Vec3 p = radius * random_point(rng, 1.0).normalized();
    expect_curvature({2.0 * p, {2, 2, 2, 0, 0, 0}}, 1.0 / radius, 1.0 / (radius * radius));
  });
}

TEST(LevelCurvature, OfACylinderIsHalfThatOfItsCircle) {
  for_all([](Rng& rng) {
    const double radius = log_uniform(rng, 0.1, 10.0), angle = uniform(rng, -3.0, 3.0);
    const Vec3 p(radius * std::cos(angle), radius * std::sin(angle), uniform(rng, -1.0, 1.0));
    expect_curvature({{2.0 * p.x(), 2.0 * p.y(), 0.0}, {2, 2, 0, 0, 0, 0}}, 0.5 / radius, 0.0);
  });
}

// f = (s - R)^2 + z^2 with s = sqrt(x^2 + y^2); principal curvatures 1/r and cos v / (R + r cos v).
TEST(LevelCurvature, OfATorusChangesSignInside) {
  for_all([](Rng& rng) {
    const double big = uniform(rng, 2.0, 4.0), small = uniform(rng, 0.3, 1.5);
    const double u = uniform(rng, -3.0, 3.0), v = uniform(rng, -3.0, 3.0);
    const double s = big + small * std::cos(v), a = s - big, x = s * std::cos(u), y = s * std::sin(u);
    const double z = small * std::sin(v);
    const Derivatives d{
        {2 * a * x / s, 2 * a * y / s, 2 * z},
        {2 * (x * x / (s * s) + a * y * y / (s * s * s)), 2 * (y * y / (s * s) + a * x * x / (s * s * s)),
         2.0, 2 * (x * y / (s * s) - a * x * y / (s * s * s)), 0.0, 0.0}};
    const double k1 = 1.0 / small, k2 = std::cos(v) / s;
    expect_curvature(d, 0.5 * (k1 + k2), k1 * k2);
  });
}

// f = z - x y at the origin: a minimal saddle of Gaussian curvature -1.
TEST(LevelCurvature, OfASaddleIsNegative) {
  expect_curvature({Vec3(0, 0, 1), {0, 0, 0, -1, 0, 0}}, 0.0, -1.0);
}

TEST(LevelCurvature, IsAbsentWithoutANormal) {
  EXPECT_FALSE(level_curvature(Vec3::Zero(), {1, 1, 1, 0, 0, 0}, Level::zero));
  EXPECT_FALSE(level_curvature(Vec3(std::nan(""), 0, 0), {1, 1, 1, 0, 0, 0}, Level::zero));
  EXPECT_FALSE(level_curvature(Vec3(1e-200, 0, 0), {1, 1, 1, 0, 0, 0}, Level::zero)) << "not finite";
}

/// f = x + 10 y + 100 z.
class Linear final : public ScalarField::Model {
 public:
  void evaluate(Order order, PointArrays p, std::span<double> out) const override {
    const std::size_t n = p.size();
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = p.x[i] + 10.0 * p.y[i] + 100.0 * p.z[i];
      if (order == Order::value) continue;
      out[n + i] = 1.0;
      out[2 * n + i] = 10.0;
      out[3 * n + i] = 100.0;
      if (order == Order::hessian) out[4 * n + i] = static_cast<double>(i);
    }
  }
  [[nodiscard]] Range range(const Box& b) const override {
    return {b.lo.dot(Vec3(1, 10, 100)), b.hi.dot(Vec3(1, 10, 100))};
  }
  [[nodiscard]] Within within(const Box& b) const override { return {range(b), nullptr}; }
  void nearest_member(PointArrays, std::span<std::uint32_t> out) const override {
    std::fill(out.begin(), out.end(), 0u);
  }
};

TEST(ScalarField, PointsAndArraysMeanTheSame) {
  const ScalarField f(std::make_shared<Linear>(), Level::zero);
  const Vec3 points[] = {{1, 2, 3}, {-1, 0, 1}, {0.5, 0.25, -0.125}};
  const FieldValues v = f.evaluate(Order::hessian, points);
  ASSERT_EQ(v.size, 3u);
  ASSERT_EQ(v.data.size(), 30u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(v.value(i), points[i].dot(Vec3(1, 10, 100)));
    EXPECT_EQ(v.value(i), f.value(points[i]));
    EXPECT_EQ(v.gradient(i), Vec3(1, 10, 100));
    EXPECT_EQ(v.hessian(i), (std::array<double, 6>{static_cast<double>(i), 0, 0, 0, 0, 0}));
  }
  EXPECT_EQ(f.evaluate(Order::value, std::span<const Vec3>{}).data.size(), 0u);
}

}  // namespace
}  // namespace blendwright::test
