// Affine frames: composition, boxes, refusals.
#include <gtest/gtest.h>

#include "kernel/base/error.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright::test {
namespace {

Frame random_frame(Rng& rng) {
  Eigen::Matrix3d m;
  do {
    for (int i = 0; i < 9; ++i) m.data()[i] = uniform(rng, -2.0, 2.0);
  } while (std::abs(m.determinant()) < 0.1);
  return Frame(m, suite::point_in(rng, {Vec3::Constant(-3.0), Vec3::Constant(3.0)}));
}
Box random_box(Rng& rng) { return suite::box_in(rng, {Vec3::Constant(-2.0), Vec3::Constant(2.0)}); }

TEST(Frame, InnerAfterOuterIsBothInTurn) {
  for_all([](Rng& rng) {
    const Frame outer = random_frame(rng), inner = random_frame(rng);
    const Vec3 x = suite::point_in(rng, {Vec3::Constant(-2.0), Vec3::Constant(2.0)});
    // Sums of nine products of numbers up to 30.
    EXPECT_NEAR((inner.after(outer).local(x) - inner.local(outer.local(x))).norm(), 0.0, 1e-12);
    EXPECT_EQ(Frame{}.after(outer), outer);
    EXPECT_EQ(inner.after(Frame{}), inner);
  });
}

TEST(Frame, BoxesHoldWhatTheirPointsBecome) {
  for_all([](Rng& rng) {
    const Frame f = random_frame(rng);
    const Box x = random_box(rng), y = f.local(x), back = f.scene(y);
    for (int i = 0; i < 50; ++i) {
      const Vec3 p = suite::point_in(rng, x);
      EXPECT_TRUE(y.contains(f.local(p)));
      EXPECT_TRUE(back.contains(p));
    }
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner(k & 1 ? x.hi[0] : x.lo[0], k & 2 ? x.hi[1] : x.lo[1], k & 4 ? x.hi[2] : x.lo[2]);
      EXPECT_TRUE(y.contains(f.local(corner)));
    }
  });
}

// Negative control of the test above: a box that is a little smaller misses a corner.
TEST(Frame, BoxesAreTight) {
  for_all([](Rng& rng) {
    const Frame f = random_frame(rng);
    const Box x = random_box(rng);
    const Box y = f.local(x);
    Box reached{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
    for (int k = 0; k < 8; ++k) {
      const Vec3 p =
          f.local({k & 1 ? x.hi[0] : x.lo[0], k & 2 ? x.hi[1] : x.lo[1], k & 4 ? x.hi[2] : x.lo[2]});
      reached = hull(reached, {p, p});
    }
    EXPECT_LT((y.hi - reached.hi).cwiseAbs().maxCoeff() + (y.lo - reached.lo).cwiseAbs().maxCoeff(), 1e-12);
  });
}

TEST(Frame, KnowsTheIdentity) {
  EXPECT_TRUE(Frame{}.identity);
  EXPECT_TRUE(Frame(Eigen::Matrix3d::Identity(), Vec3::Zero()).identity);
  EXPECT_FALSE(Frame(Eigen::Matrix3d::Identity(), Vec3::UnitX()).identity);
}

TEST(Frame, RefusesWhatCannotBeTurnedBack) {
  Eigen::Matrix3d flat = Eigen::Matrix3d::Identity();
  flat(2, 2) = 0.0;
  EXPECT_THROW(Frame(flat, Vec3::Zero()), InputError);
  flat(2, 2) = 1e-13;
  EXPECT_NO_THROW(Frame(flat, Vec3::Zero())) << "small is not singular";
  flat.row(2) = flat.row(1) * 2.0;
  flat(2, 0) = 1e-13;
  EXPECT_THROW(Frame(flat, Vec3::Zero()), InputError);
  EXPECT_THROW(Frame(Eigen::Matrix3d::Zero(), Vec3::Zero()), InputError);
  EXPECT_THROW(Frame(Eigen::Matrix3d::Identity(), Vec3(0, std::nan(""), 0)), InputError);
}

}  // namespace
}  // namespace blendwright::test
