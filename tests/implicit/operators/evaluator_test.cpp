// Every operation under the suite that all tapes must pass: kernels agree, derivatives are those of the
// values, ranges hold, shortened tapes have the same bits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "implicit/operators/distance_operation.hpp"
#include "implicit/operators/hoffmann.hpp"
#include "implicit/operators/potential.hpp"
#include "implicit/operators/range_map.hpp"
#include "implicit/primitives/lp_metric.hpp"
#include "tests/implicit/operators/op_tape.hpp"
#include "tests/implicit/operators/operator_names.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright::test {
namespace {

// Arguments that are coordinates: no primitive in between. The few differences that say nothing sit at
// borders.
EvaluatorSuite over(const Box& box, std::uint64_t seed) {
  return {.where = box, .points = 60, .boxes = 30, .samples = 60, .seed = seed, .useless_share = 0.25};
}
Box from_zero(double x, double y, double z) { return {Vec3::Zero(), Vec3(x, y, z)}; }

TEST(Potential, PassesTheSuite) {
  for_all(
      [](Rng& rng) {
        const double s = integer(rng, 0, 3) == 0 ? 0.0 : log_uniform(rng, 1e-3, 30.0);
        const EvaluatorSuite suite = over(from_zero(1.2, 1, 1), rng.next());
        EXPECT_EQ(evaluator_faults(*op_tape(detail::Blanc{s}, 1), suite), no_faults) << s;
        EXPECT_EQ(evaluator_faults(*op_tape(detail::Wyvill{}, 1), suite), no_faults);
        EXPECT_EQ(evaluator_faults(*op_tape(detail::Gaussian{}, 1), suite), no_faults);
        EXPECT_EQ(evaluator_faults(*op_tape(detail::GaussianWindowed{}, 1), suite), no_faults);
      },
      100);
}

TEST(RangeMap, PassesTheSuite) {
  for_all(
      [](Rng& rng) {
        const double w1 = log_uniform(rng, 0.05, 3.0), w2 = std::min(1.0, w1 * log_uniform(rng, 0.05, 2.0));
        const auto suite = over(from_zero(2, 1, 1), rng.next());
        EXPECT_EQ(evaluator_faults(*op_tape(detail::RangeMap{w1, w2}, 1), suite), no_faults)
            << w1 << " " << w2;
      },
      100);
}

TEST(VirMap, PassesTheSuite) {
  for_all(
      [](Rng& rng) {
        const bool coupled = integer(rng, 0, 1) == 1;
        const double floor = log_uniform(rng, 0.01, 0.3);
        const double w2 =
            coupled ? uniform(rng, 0.1, 1.0) * std::min(1.0, 2.0 * floor) : uniform(rng, 0.1, 1.0);
        // T rounds by 1/w0 times more than its arguments do.
        EvaluatorSuite suite = over(from_zero(1.5, 2, 1), rng.next());
        EXPECT_EQ(evaluator_faults(*op_tape(detail::VirMap{w2, floor, coupled}, 2), suite), no_faults)
            << w2 << " " << floor << " " << coupled;
      },
      100);
}

TEST(VirMap, CoupledRangesHoldForAnyInnerRadius) {
  for_all(
      [](Rng& rng) {
        const detail::VirMap body{uniform(rng, 0.1, 1.0), log_uniform(rng, 0.01, 0.3), true};
        EvaluatorSuite suite = over(from_zero(0.8, 2, 1), rng.next());
        suite.differences = false;  // w2 > 2 w: T has corners where it is cut at 0
        EXPECT_EQ(evaluator_faults(*op_tape(body, 2), suite), no_faults) << body.w2 << " " << body.w_floor;
      },
      100);
}

TEST(DistanceOperation, PassesTheSuite) {
  for_all(
      [](Rng& rng) {
        const double n = integer(rng, 0, 1) == 0 ? integer(rng, 1, 6) : log_uniform(rng, 0.3, 8.0);
        const auto suite = over({Vec3::Constant(1e-3), Vec3(1.5, 2, 1)}, rng.next());
        EXPECT_EQ(evaluator_faults(*op_tape(detail::Dilation(n), 2), suite), no_faults) << n;
        // d below T, but for a corner: beyond there E is infinite, and next to it too steep for differences
        EvaluatorSuite erosion = over({Vec3(0, 0.7, 0), Vec3(0.8, 2, 1)}, rng.next());
        EXPECT_EQ(evaluator_faults(*op_tape(detail::Erosion{n}, 2), erosion), no_faults) << n;
      },
      100);
}

TEST(Operator, PassesTheSuiteOnCoordinates) {
  for (const detail::OperatorId id : all_operators())
    for_all(
        [&](Rng& rng) {
          const detail::OperatorValues v = random_values(rng, id);
          const auto tape = combination_tape(detail::combination(id, v), 2 + rng.next() % 2);
          EvaluatorSuite suite = over(usual_arguments(id), rng.next());
          // Next to r1 r2 the blend nears a chord with corners; small radii leave few points inside.
          suite.useless_share = 0.6;
          EXPECT_EQ(evaluator_faults(*tape, suite), no_faults)
              << detail::operator_row(id).name << " n " << v.n << " r " << v.r1 << " " << v.r2 << " p "
              << v.p;
        },
        100);
}

/// P of a random ellipsoid, exactly 0 in most of the box [-2, 2]^3.
StepIndex soft_ellipsoid(TapeBuilder& builder, Rng& rng) {
  detail::LpMetric metric;
  for (int i = 0; i < 3; ++i) metric.inverse_axes[i] = 1.0 / log_uniform(rng, 0.5, 2.0);
  metric.n = detail::Power(2.0);
  metric.inverse_n = detail::Power(0.5);
  Vec3 centre;
  for (int i = 0; i < 3; ++i) centre[i] = uniform(rng, -1.5, 1.5);
  const StepIndex d = builder.add(std::make_shared<const detail::LpMetric>(metric),
                                  Frame(Eigen::Matrix3d::Identity(), -centre), {});
  return builder.add(std::make_shared<const detail::Blanc>(detail::Blanc{uniform(rng, 0.0, 2.0)}), Frame(),
                     {d});
}

TEST(Operator, PassesTheSuiteOnSoftObjects) {
  std::size_t shortened = 0;
  for (const detail::OperatorId id : all_operators()) {
    const auto level = detail::operator_row(id).level;
    if (level && *level != Level::half) continue;
    for_all(
        [&](Rng& rng) {
          TapeBuilder builder;
          std::vector<StepIndex> operands;
          for (int k = integer(rng, 2, 5); k > 0; --k) operands.push_back(soft_ellipsoid(builder, rng));
          const detail::OperatorValues v = random_values(rng, id);
          const auto tape = builder.finish(detail::combination(id, v)(builder, operands));
          EvaluatorSuite suite = over({Vec3::Constant(-2), Vec3::Constant(2)}, rng.next());
          suite.useless_share = 0.6;
          EXPECT_EQ(evaluator_faults(*tape, suite), no_faults)
              << detail::operator_row(id).name << " n " << v.n << " r " << v.r1 << " " << v.r2 << " p "
              << v.p;
          const auto within = tape->within({Vec3::Constant(1.0), Vec3::Constant(1.5)});
          if (within.model && dynamic_cast<const Tape&>(*within.model).size() + 2 < tape->size()) ++shortened;
        },
        40);
  }
  EXPECT_GT(shortened, 30u);  // the comparison of bits had something to compare
}

TEST(Operator, RangesHoldManySamples) {
  for (const detail::OperatorId id : all_operators())
    for_all(
        [&](Rng& rng) {
          const auto tape = combination_tape(detail::combination(id, random_values(rng, id)), 3);
          const Box box = suite::box_in(rng, usual_arguments(id));
          std::vector<Vec3> points;
          for (int i = 0; i < 2000; ++i) points.push_back(suite::point_in(rng, box));
          const Range range = tape->range(box);
          const suite::Results values = suite::evaluate(*tape, Order::value, points);
          for (std::size_t i = 0; i < points.size(); ++i)
            ASSERT_TRUE(range.contains(values.at(i, 0)))
                << detail::operator_row(id).name << points[i].transpose();
        },
        50);  // 10^5 samples of every operator, 10^6 in a long run
}

TEST(HoffmannPolynomial, PassesTheSuite) {
  EXPECT_EQ(evaluator_faults(*op_tape(detail::HoffmannPolynomial{0.8, 0.3, 0.12}, 2),
                             over({Vec3::Constant(-2), Vec3::Constant(2)}, 1)),
            no_faults);
}

}  // namespace
}  // namespace blendwright::test
