// Primitives that are merged into their users: one step in place of two, the same field.
#include <gtest/gtest.h>

#include <memory>

#include "implicit/operators/potential.hpp"
#include "implicit/operators/soft.hpp"
#include "implicit/operators/soft_ellipsoid.hpp"
#include "implicit/primitives/lp_metric.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright::test {
namespace {

const Box around{Vec3::Constant(-3.0), Vec3::Constant(3.0)};

struct Ellipsoid {
  Vec3 axes;
  Frame frame;
  explicit Ellipsoid(Rng& rng) {
    for (int i = 0; i < 3; ++i) axes[i] = uniform(rng, 0.3, 2.0);
    const Eigen::Quaterniond turn(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1),
                                  uniform(rng, 0.1, 1));
    const Eigen::Matrix3d m = turn.normalized().toRotationMatrix();
    frame = Frame(m, -m.transpose() * suite::point_in(rng, around));
  }
  [[nodiscard]] StepIndex distance(TapeBuilder& builder) const {
    detail::LpMetric metric;
    metric.inverse_axes = axes.cwiseInverse();
    metric.n = detail::Power(2.0);
    metric.inverse_n = detail::Power(0.5);
    return builder.add(op_for<detail::LpMetric>(), std::make_shared<const detail::LpMetric>(metric), frame);
  }
};
StepIndex blanc(TapeBuilder& builder, StepIndex distance, double softness) {
  return builder.add(op_for<detail::Blanc>(), std::make_shared<const detail::Blanc>(detail::Blanc{softness}),
                     {}, {&distance, 1});
}
StepIndex sum(TapeBuilder& builder, StepIndex a, StepIndex b) {
  static const auto body = std::make_shared<const detail::SoftSum>();
  const StepIndex args[] = {a, b};
  return builder.add(op_for<detail::SoftSum>(), body, {}, args);
}

/// A soft sum of ellipsoids, merged, and the same with a second user of every distance.
struct BothWays {
  std::vector<Ellipsoid> ellipsoids;
  std::vector<double> softness;
  std::shared_ptr<const Tape> merged, apart;
  explicit BothWays(Rng& rng, int count) {
    for (int i = 0; i < count; ++i) {
      ellipsoids.emplace_back(rng);
      softness.push_back(i % 3 == 0 ? 0.0 : uniform(rng, 0.0, 3.0));
    }
    merged = tape(false);
    apart = tape(true);
  }
  [[nodiscard]] std::shared_ptr<const Tape> tape(bool keep_apart) const {
    TapeBuilder builder;
    std::vector<StepIndex> fields;
    for (std::size_t i = 0; i < ellipsoids.size(); ++i) {
      const StepIndex d = ellipsoids[i].distance(builder);
      fields.push_back(blanc(builder, d, softness[i]));
      // A second user of the distance keeps it apart: its potential at d + 1, which is 0.
      if (keep_apart) fields.back() = sum(builder, fields.back(), shared_zero(builder, d));
      builder.member({fields.back(), Level::half, static_cast<std::uint32_t>(i)});
    }
    StepIndex total = fields[0];
    for (std::size_t i = 1; i < fields.size(); ++i) total = sum(builder, total, fields[i]);
    return builder.finish(total);
  }
  static StepIndex shared_zero(TapeBuilder& builder, StepIndex d) {
    static const auto body = std::make_shared<const detail::Blanc>();
    const StepIndex far[] = {sum(builder, d, builder.constant(1.0))};
    return builder.add(op_for<detail::Blanc>(), body, {}, far);
  }
};

TEST(Merge, ASoftSumOfEllipsoidsIsOneStepEach) {
  Rng rng(1);
  const BothWays both(rng, 20);
  EXPECT_EQ(both.merged->size(), 20u);
  EXPECT_EQ(both.merged->slots(), 1u);
  EXPECT_GT(both.apart->size(), 80u);
}

TEST(Merge, LeavesOtherExponentsAndSharedPrimitivesAlone) {
  TapeBuilder builder;
  detail::LpMetric metric;
  metric.inverse_axes = Vec3::Ones();
  metric.n = detail::Power(4.0);
  metric.inverse_n = detail::Power(0.25);
  const StepIndex d =
      builder.add(op_for<detail::LpMetric>(), std::make_shared<const detail::LpMetric>(metric), {});
  EXPECT_EQ(builder.finish(blanc(builder, d, 0.0))->size(), 2u);
  Rng rng(2);
  const StepIndex shared = Ellipsoid(rng).distance(builder);
  EXPECT_EQ(builder.finish(blanc(builder, shared, 0.0))->size(), 1u);
  EXPECT_EQ(builder.finish(sum(builder, blanc(builder, shared, 0.0), blanc(builder, shared, 1.0)))->size(),
            4u)
      << "two potentials of one distance";
}

// Both ways round each operation once; d and d^2 differ by a few ulp, which P' <= 2 + 16 s / 9 < 8 and its
// derivatives turn into less than 1e-13 of the sum of 8 fields; axes of 0.3 make gradients and curvatures up
// to 30 and 300.
TEST(Merge, KeepsTheField) {
  for_all(
      [](Rng& rng) {
        const BothWays both(rng, 8);
        std::vector<Vec3> points;
        for (int i = 0; i < 300; ++i) points.push_back(suite::point_in(rng, around));
        const auto a = suite::evaluate(*both.merged, Order::hessian, points);
        const auto b = suite::evaluate(*both.apart, Order::hessian, points);
        for (std::size_t i = 0; i < points.size(); ++i)
          for (std::size_t c = 0; c < 10; ++c)
            ASSERT_NEAR(a.at(i, c), b.at(i, c), c == 0 ? 1e-13 : c < 4 ? 1e-12 : 1e-10) << c;
      },
      50);
}

TEST(Merge, PassesTheSuite) {
  for_all(
      [](Rng& rng) {
        const BothWays both(rng, integer(rng, 1, 6));
        EXPECT_EQ(evaluator_faults(*both.merged, {.where = around, .points = 40, .boxes = 30, .samples = 20}),
                  no_faults);
      },
      30);
}

TEST(Merge, MembersAreStillTold) {
  for_all(
      [](Rng& rng) {
        const BothWays both(rng, 8);
        std::vector<double> xyz[3];
        const Box box = suite::box_in(rng, around);
        for (int i = 0; i < 300; ++i) {
          const Vec3 p = suite::point_in(rng, box);
          for (int k = 0; k < 3; ++k) xyz[k].push_back(p[k]);
        }
        const PointArrays points{xyz[0], xyz[1], xyz[2]};
        std::vector<std::uint32_t> merged(300), apart(300), near(300);
        both.merged->nearest_member(points, merged);
        both.apart->nearest_member(points, apart);
        EXPECT_EQ(merged, apart);
        const auto within = both.merged->within(box);
        if (!within.model) return;
        within.model->nearest_member(points, near);
        EXPECT_EQ(near, merged) << "members that do not reach the box have no gradient there";
      },
      50);
}

// The second derivatives at the centre exist, though those of the distance do not.
TEST(Merge, IsSmoothAtTheCentre) {
  TapeBuilder builder;
  detail::LpMetric metric;
  metric.inverse_axes = Vec3(1.0, 0.5, 0.25);
  metric.n = detail::Power(2.0);
  metric.inverse_n = detail::Power(0.5);
  const StepIndex d =
      builder.add(op_for<detail::LpMetric>(), std::make_shared<const detail::LpMetric>(metric), {});
  const auto at = suite::evaluate(*builder.finish(blanc(builder, d, 0.0)), Order::hessian, {Vec3::Zero()});
  EXPECT_EQ(at.data, (std::vector<double>{1, 0, 0, 0, -4, -1, -0.25, 0, 0, 0}));
}

}  // namespace
}  // namespace blendwright::test
