// Moved fields, by models that know nothing of motions.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>

#include "kernel/base/error.hpp"
#include "kernel/field/rigid_motion.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

Vec3 random_point(Rng& rng, double reach) {
  return {uniform(rng, -reach, reach), uniform(rng, -reach, reach), uniform(rng, -reach, reach)};
}
Vec3 point_in(Rng& rng, const Box& b) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = uniform(rng, b.lo[i], b.hi[i]);
  return p;
}
RigidMotion random_motion(Rng& rng, double reach = 5.0) {
  const Eigen::Vector4d q(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
  return {Eigen::Quaterniond(q.normalized()).toRotationMatrix(), random_point(rng, reach)};
}

/// f = 4 - x^2 - 2 y^2 - 3 z^2 + x y + z, level function; two members, the sides of y = 0.
class Bowl final : public ScalarField::Model {
 public:
  [[nodiscard]] static double value(const Vec3& p) {
    return 4.0 - p.x() * p.x() - 2.0 * p.y() * p.y() - 3.0 * p.z() * p.z() + p.x() * p.y() + p.z();
  }
  [[nodiscard]] static Vec3 gradient(const Vec3& p) {
    return {-2.0 * p.x() + p.y(), -4.0 * p.y() + p.x(), -6.0 * p.z() + 1.0};
  }
  [[nodiscard]] static Eigen::Matrix3d hessian() {
    Eigen::Matrix3d h;
    h << -2, 1, 0, 1, -4, 0, 0, 0, -6;
    return h;
  }
  void evaluate(Order order, PointArrays p, std::span<double> out) const override {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 x(p.x[i], p.y[i], p.z[i]), g = gradient(x);
      out[i] = value(x);
      if (order == Order::value) continue;
      for (std::size_t c = 0; c < 3; ++c) out[(1 + c) * n + i] = g[static_cast<Eigen::Index>(c)];
      if (order == Order::gradient) continue;
      const double h[6] = {-2, -4, -6, 1, 0, 0};
      for (std::size_t c = 0; c < 6; ++c) out[(4 + c) * n + i] = h[c];
    }
  }
  [[nodiscard]] Range range(const Box& box) const override { return linear(box).range(); }
  [[nodiscard]] LinearBound linear(const Box& box) const override {
    const Vec3 c = box.centre(), h = 0.5 * box.size();
    const double cross = h.x() * h.y();
    LinearBound bound{value(c),
                      gradient(c).cwiseProduct(h),
                      {-h.x() * h.x() - 2.0 * h.y() * h.y() - 3.0 * h.z() * h.z() - cross, cross}};
    // Terms of at most |X|^2 and |X|, a few dozen roundings.
    const double size = box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).sum() + 2.0;
    return bound.widened(64.0 * eps * size * size);
  }
  /// Without a cheaper model below y = 0.
  [[nodiscard]] Within within(const Box& box) const override {
    return {range(box), box.lo.y() > 0.0 ? std::make_shared<Bowl>() : nullptr};
  }
  void nearest_member(PointArrays p, std::span<std::uint32_t> out) const override {
    for (std::size_t i = 0; i < p.size(); ++i) out[i] = p.y[i] < 0.0 ? 1 : 0;
  }
};

const Box around{Vec3::Constant(-3.0), Vec3::Constant(3.0)};
ScalarField bowl() { return {std::make_shared<Bowl>(), Level::function, around, {"right", "left"}}; }

// Coordinates up to 20 are uncertain by a few units of round-off of 20 after a motion; values change by at
// most |gradient| <= 6 * 20 times that, gradients by 6 times, and both have a few roundings of their own.
constexpr double coordinate = 20.0, uncertain = 16.0 * eps * coordinate;

TEST(Placed, IsTheFieldAtThePointsMovedBack) {
  for_all([](Rng& rng) {
    const RigidMotion motion = random_motion(rng);
    const ScalarField moved = placed(bowl(), motion);
    std::vector<Vec3> own, there;
    for (int i = 0; i < 20; ++i) {
      own.push_back(random_point(rng, 4.0));
      there.push_back(motion(own.back()));
    }
    const FieldValues v = moved.evaluate(Order::hessian, there);
    std::vector<double> x, y, z;
    for (const Vec3& p : there) {
      x.push_back(p.x());
      y.push_back(p.y());
      z.push_back(p.z());
    }
    std::vector<std::uint32_t> nearest(own.size());
    moved.model().nearest_member({x, y, z}, nearest);
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_NEAR(v.value(i), Bowl::value(own[i]), 6.0 * coordinate * uncertain);
      EXPECT_LE((v.gradient(i) - motion.R * Bowl::gradient(own[i])).norm(), 8.0 * uncertain * 6.0);
      const Eigen::Matrix3d H = motion.R * Bowl::hessian() * motion.R.transpose();
      const double expected[6] = {H(0, 0), H(1, 1), H(2, 2), H(0, 1), H(0, 2), H(1, 2)};
      for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(v.hessian(i)[c], expected[c], 64.0 * eps * 6.0);
      EXPECT_EQ(nearest[i], own[i].y() < 0.0 ? 1u : 0u);
    }
    EXPECT_EQ(moved.members(), bowl().members());
    EXPECT_EQ(moved.level(), Level::function);
  });
}

TEST(Placed, BoundsHoldAndAreAsNarrowAsThoseOfTheTurnedBox) {
  double widest = 0.0;
  for_all([&](Rng& rng) {
    const RigidMotion motion = random_motion(rng);
    const ScalarField moved = placed(bowl(), motion);
    const Vec3 c = motion(random_point(rng, 3.0)), h = random_point(rng, 1.0).cwiseAbs();
    const Box box{c - h, c + h};
    const Range range = moved.range(box);
    const LinearBound linear = moved.linear(box);
    EXPECT_EQ(moved.model().within(box).range, range);
    for (int i = 0; i < 30; ++i) {
      const Vec3 p = i < 8 ? Vec3(c + h.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)))
                           : point_in(rng, box);
      const double value = moved.value(p);
      EXPECT_TRUE(range.contains(value));
      const double straight = linear.value + linear.slope.dot((p - c).cwiseQuotient(h));
      const double slack = 8.0 * eps * (std::abs(straight) + linear.slope.lpNorm<1>());
      EXPECT_GE(value, straight + linear.rest.lo - slack);
      EXPECT_LE(value, straight + linear.rest.hi + slack);
    }
    // The turned box, by hand.
    const Vec3 own_c = inverse(motion)(c), own_h = motion.R.transpose().cwiseAbs() * h;
    const Range own = Bowl().range({own_c - own_h, own_c + own_h});
    widest = std::max(widest, (range.hi - range.lo) / (own.hi - own.lo));
    const Range rest = Bowl().linear({own_c - own_h, own_c + own_h}).rest;
    EXPECT_LE(linear.rest.hi - linear.rest.lo, 1.01 * (rest.hi - rest.lo));
  });
  EXPECT_LE(widest, 1.01);
  EXPECT_GE(widest, 0.99) << "nothing was compared";
}

// Of a point there is nothing to turn: the bound is that of the point, for any thinness of the box.
TEST(Placed, BoundsOfThinBoxesHold) {
  for_all([](Rng& rng) {
    const RigidMotion motion = random_motion(rng);
    const ScalarField moved = placed(bowl(), motion);
    const Vec3 c = motion(random_point(rng, 3.0));
    for (const Vec3& h : {Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(1e-14, 1e-3, 0)}) {
      const Box box{c - h, c + h};
      const Range range = moved.range(box), linear = moved.linear(box).range();
      for (int i = 0; i < 10; ++i) {
        const double value = moved.value(point_in(rng, box));
        EXPECT_TRUE(range.contains(value));
        EXPECT_TRUE(linear.contains(value));
      }
      if (h.isZero()) {
        EXPECT_LE(range.hi - range.lo, 1e-10);
        EXPECT_LE(linear.hi - linear.lo, 1e-10);
      }
    }
  });
}

TEST(Placed, ModelsOfABoxAreMovedToo) {
  const RigidMotion motion{Eigen::AngleAxisd(1.0, Vec3::UnitX()).toRotationMatrix(), Vec3(1, 2, 3)};
  const ScalarField moved = placed(bowl(), motion);
  const Vec3 c = motion(Vec3(0.0, 1.0, 0.0)), out = motion(Vec3(0.0, -1.0, 0.0));
  const auto near = moved.model().within({c - Vec3::Constant(0.1), c + Vec3::Constant(0.1)});
  ASSERT_TRUE(near.model);
  EXPECT_EQ(ScalarField(near.model, Level::function).value(c), moved.value(c));
  EXPECT_FALSE(moved.model().within({out - Vec3::Constant(0.1), out + Vec3::Constant(0.1)}).model);
}

TEST(Placed, PlacementsOfPlacementsCompose) {
  for_all([](Rng& rng) {
    const RigidMotion a = random_motion(rng), b = random_motion(rng);
    const ScalarField twice = placed(placed(bowl(), a), b);
    const ScalarField once = placed(bowl(), {b.R * a.R, b(a.t)});
    for (int i = 0; i < 10; ++i) {
      const Vec3 p = b(a(random_point(rng, 3.0)));
      EXPECT_NEAR(twice.value(p), once.value(p), 6.0 * coordinate * uncertain);
    }
    const ScalarField back = placed(placed(bowl(), a), inverse(a));
    const Vec3 p = random_point(rng, 3.0);
    EXPECT_NEAR(back.value(p), bowl().value(p), 6.0 * coordinate * uncertain);
  });
}

TEST(Placed, BoundsEncloseTheMovedBox) {
  for_all([](Rng& rng) {
    const RigidMotion motion = random_motion(rng);
    const auto bounds = placed(bowl(), motion).bounds();
    ASSERT_TRUE(bounds);
    double reached = -std::numeric_limits<double>::infinity();
    for (unsigned k = 0; k < 8; ++k) {
      const Vec3 p = motion(3.0 * Vec3(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0));
      EXPECT_TRUE(bounds->contains(p));
      reached = std::max(reached, p.x());
    }
    EXPECT_NEAR(bounds->hi.x(), reached, 1e-12) << "no larger than needed";
  });
  EXPECT_FALSE(
      placed({std::make_shared<Bowl>(), Level::function}, {Eigen::Matrix3d::Identity(), Vec3::Ones()})
          .bounds());
  const double infinity = std::numeric_limits<double>::infinity();
  const Box slab{Vec3(-infinity, -infinity, 0.0), Vec3(infinity, infinity, 1.0)};
  Rng rng(2);
  EXPECT_FALSE(placed({std::make_shared<Bowl>(), Level::function, slab}, random_motion(rng)).bounds());
}

TEST(Placed, TheIdentityChangesNothing) {
  const ScalarField field = bowl();
  EXPECT_EQ(&placed(field, {}).model(), &field.model());
  EXPECT_EQ(placed(field, {}).bounds(), field.bounds());
}

TEST(Placed, RefusesWhatIsNoRigidMotion) {
  RigidMotion shear, mirror, lost, far;
  shear.R(0, 1) = 1e-6;
  mirror.R(2, 2) = -1.0;
  lost.R(1, 1) = std::nan("");
  far.t.x() = std::numeric_limits<double>::infinity();
  for (const RigidMotion& m : {shear, mirror, lost, far}) EXPECT_THROW((void)placed(bowl(), m), InputError);
  shear.R(0, 1) = 1e-12;
  EXPECT_NO_THROW((void)placed(bowl(), shear)) << "what rounding leaves of a rotation";
}

}  // namespace
}  // namespace blendwright::test
