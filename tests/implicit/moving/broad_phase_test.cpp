// Boxes of many bodies: which meet, which are apart, and what they have in common.
#include "implicit/relations/broad_phase.hpp"

#include <gtest/gtest.h>

#include "tests/implicit/moving/motions.hpp"

namespace blendwright::test {
namespace {

using detail::OrientedBox;

Box random_box(Rng& rng, double reach, double size) {
  const Vec3 c = random_vector(rng, reach);
  const Vec3 h = size * (Vec3::Constant(1.1) + random_vector(rng, 1.0));
  return {c - h, c + h};
}
Vec3 point_in(Rng& rng, const Box& b) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = uniform(rng, b.lo[i], b.hi[i]);
  return p;
}

TEST(MeetingBoxes, AreThoseThatHaveAPointInCommon) {
  for_all(
      [](Rng& rng) {
        std::vector<Box> boxes;
        for (int i = integer(rng, 0, 150); i-- > 0;) boxes.push_back(random_box(rng, 3.0, 0.3));
        std::vector<std::pair<std::size_t, std::size_t>> expected;
        for (std::size_t i = 0; i < boxes.size(); ++i)
          for (std::size_t j = i + 1; j < boxes.size(); ++j)
            if (common(boxes[i], boxes[j])) expected.emplace_back(i, j);
        EXPECT_EQ(detail::meeting_boxes(boxes), expected);
      },
      100);
}

TEST(MeetingBoxes, TouchingOnesMeetToo) {
  const Box a{Vec3::Zero(), Vec3::Ones()}, b{Vec3::Ones(), Vec3::Constant(2.0)};
  const Box c{Vec3::Constant(1.0 + 1e-15), Vec3::Constant(2.0)};
  EXPECT_EQ(detail::meeting_boxes(std::vector{a, b}).size(), 1u);
  EXPECT_EQ(detail::meeting_boxes(std::vector{a, c}).size(), 0u);
  EXPECT_EQ(detail::meeting_boxes(std::vector{a, a, a}).size(), 3u);
}

TEST(OrientedBoxes, WithACommonPointAreNeverApart) {
  int thin = 0;
  for_all(
      [&](Rng& rng) {
        const Box a = random_box(rng, 2.0, uniform(rng, 0.01, 1.0));
        const Box b = random_box(rng, 2.0, uniform(rng, 0.01, 1.0));
        const RigidMotion at_a = random_motion(rng, 2.0);
        RigidMotion at_b = random_motion(rng, 2.0);
        Vec3 in_a = point_in(rng, a), in_b = point_in(rng, b);
        if (rng.next() % 2 == 0) {  // corners, edges and faces: nothing but this point in common, at most
          ++thin;
          for (int i = 0; i < 3; ++i) {
            if (rng.next() % 2 == 0) in_a[i] = a.hi[i];
            if (rng.next() % 2 == 0) in_b[i] = b.lo[i];
          }
        }
        at_b.t += at_a(in_a) - at_b(in_b);
        const OrientedBox oa = detail::moved(a, at_a), ob = detail::moved(b, at_b);
        EXPECT_FALSE(detail::apart(oa, ob));
        const auto around = [](const OrientedBox& o) {
          const Vec3 reach = o.axes.cwiseAbs() * o.half;
          return Box{o.centre - reach, o.centre + reach};
        };
        const auto shared = common(around(oa), around(ob));
        ASSERT_TRUE(shared);
        const auto box = detail::common_box(*shared, oa, ob);
        ASSERT_TRUE(box);
        // The point is known to rounding, which the boxes were widened by.
        EXPECT_TRUE(box->contains(at_a(in_a)));
        EXPECT_TRUE(shared->contains(box->lo) && shared->contains(box->hi));
      },
      3000);
  EXPECT_GT(thin, 1000);
}

TEST(OrientedBoxes, WithASlabBetweenThemAreApart) {
  int boxes_meet = 0;
  for_all(
      [&](Rng& rng) {
        const Box a = random_box(rng, 0.0, 1.0), b = random_box(rng, 0.0, 1.0);
        const RigidMotion at_a = random_motion(rng, 2.0);
        RigidMotion at_b = random_motion(rng, 2.0);
        const Vec3 n = random_vector(rng, 1.0).normalized();
        const auto support = [](const Box& box, const RigidMotion& m, const Vec3& d) {
          const Vec3 own = m.R.transpose() * d;
          return m(box.centre() + own.cwiseSign().cwiseProduct(0.5 * box.size()));
        };
        at_b.t += support(a, at_a, n) + 1e-9 * n - support(b, at_b, -n);
        EXPECT_TRUE(detail::apart(detail::moved(a, at_a), detail::moved(b, at_b)));
        // Control: the axis-aligned boxes around them mostly meet.
        const auto reach = [](const Box& box, const RigidMotion& m) {
          return Vec3(m.R.cwiseAbs() * (0.5 * box.size()));
        };
        const Vec3 t = at_a(a.centre()) - at_b(b.centre());
        if ((t.cwiseAbs().array() <= (reach(a, at_a) + reach(b, at_b)).array()).all()) ++boxes_meet;
      },
      2000);
  EXPECT_GT(boxes_meet, 500);
}

TEST(OrientedBoxes, FarFromEachOtherHaveNothingInCommon) {
  const Box unit{-Vec3::Ones(), Vec3::Ones()};
  const OrientedBox a = detail::moved(unit, {}),
                    b = detail::moved(unit, {Eigen::Matrix3d::Identity(), {2.5, 0, 0}});
  EXPECT_FALSE(detail::common_box({Vec3::Constant(-9.0), Vec3::Constant(9.0)}, a, b));
  const OrientedBox c = detail::moved(unit, {Eigen::Matrix3d::Identity(), {1.5, 0, 0}});
  const auto shared = detail::common_box({Vec3::Constant(-9.0), Vec3::Constant(9.0)}, a, c);
  ASSERT_TRUE(shared);
  EXPECT_NEAR(shared->lo.x(), 0.5, 1e-12);
  EXPECT_NEAR(shared->hi.x(), 1.0, 1e-12);
}

}  // namespace
}  // namespace blendwright::test
