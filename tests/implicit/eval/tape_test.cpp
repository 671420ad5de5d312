// What a tape keeps, how it is walked, and what is left of it over a box.
#include "implicit/eval/tape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "kernel/base/error.hpp"
#include "tests/implicit/eval/small_ops.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright::test {
namespace {

StepIndex ball(TapeBuilder& tape, const Vec3& centre, double radius) {
  return tape.add(op_for<Ball>(), std::make_shared<Ball>(Ball{1.0 / radius}),
                  Frame(Eigen::Matrix3d::Identity(), -centre));
}
template <class Body>
StepIndex combine(TapeBuilder& tape, const std::vector<StepIndex>& args) {
  static const auto body = std::make_shared<const Body>();
  return tape.add(op_for<Body>(), body, Frame{}, args);
}
StepIndex soft_ball(TapeBuilder& tape, const Vec3& centre, double radius) {
  return combine<Window>(tape, {ball(tape, centre, radius)});
}

double value(const Tape& tape, const Vec3& p) {
  double v = 0.0;
  tape.evaluate(Order::value, {{&p.x(), 1}, {&p.y(), 1}, {&p.z(), 1}}, {&v, 1});
  return v;
}

TEST(TapeBuilder, SameStepsAreOne) {
  TapeBuilder builder;
  const auto body = std::make_shared<const Ball>();
  const Frame moved(Eigen::Matrix3d::Identity(), Vec3(1, 2, 3));
  const StepIndex a = builder.add(op_for<Ball>(), body, moved);
  EXPECT_EQ(builder.add(op_for<Ball>(), body, moved), a);
  EXPECT_NE(builder.add(op_for<Ball>(), body, Frame{}), a);
  EXPECT_NE(builder.add(op_for<Ball>(), std::make_shared<const Ball>(), moved), a);
  const StepIndex b = builder.add(op_for<Ball>(), body, Frame{});
  const StepIndex ab = combine<Sum>(builder, {a, b});
  EXPECT_EQ(combine<Sum>(builder, {a, b}), ab);
  EXPECT_NE(combine<Sum>(builder, {b, a}), ab);
  EXPECT_NE(combine<Least>(builder, {a, b}), ab);
  EXPECT_EQ(builder.constant(0.5), builder.constant(0.5));
  EXPECT_NE(builder.constant(0.5), builder.constant(0.25));
  EXPECT_EQ(builder.finish(ab)->size(), 3u);
}

TEST(TapeBuilder, RefusesStepsOfOthers) {
  TapeBuilder builder;
  const StepIndex c = builder.constant(1.0);
  EXPECT_THROW(combine<Sum>(builder, {c, c + 1}), InputError);
  EXPECT_THROW((void)builder.finish(c + 1), InputError);
}

TEST(TapeBuilder, KeepsOnlyWhatTheResultNeeds) {
  TapeBuilder builder;
  const StepIndex a = soft_ball(builder, Vec3::Zero(), 1.0);
  const StepIndex unused = soft_ball(builder, Vec3(1, 0, 0), 1.0);
  builder.member({unused, Level::half, 0});
  builder.member({a, Level::half, 1});
  const auto tape = builder.finish(a);
  EXPECT_EQ(tape->size(), 2u);
  EXPECT_EQ(tape->slots(), 1u) << "the window may be written over the ball";
  std::uint32_t nearest = 7;
  const double x = 0.3, zero = 0.0;
  tape->nearest_member({{&x, 1}, {&zero, 1}, {&zero, 1}}, {&nearest, 1});
  EXPECT_EQ(nearest, 1u);
}

TEST(TapeBuilder, NeedsFewSlotsWhateverTheOrderOfSteps) {
  TapeBuilder builder;
  std::vector<StepIndex> leaves;
  for (int i = 0; i < 1000; ++i) leaves.push_back(ball(builder, Vec3(i, 0, 0), 1.0 + i));
  StepIndex left = leaves[0], right = leaves[999];
  for (std::size_t i = 1; i < 1000; ++i) {
    left = combine<Sum>(builder, {left, leaves[i]});
    right = combine<Sum>(builder, {leaves[999 - i], right});
  }
  EXPECT_EQ(builder.finish(left)->slots(), 2u);
  EXPECT_EQ(builder.finish(right)->slots(), 2u);
}

TEST(TapeBuilder, ConstantsAreTheSameEverywhere) {
  TapeBuilder builder;
  const auto tape = builder.finish(builder.constant(-0.75));
  EXPECT_EQ(tape->range({Vec3::Zero(), Vec3::Ones()}), (Range{-0.75, -0.75}));
  EXPECT_EQ(evaluator_faults(*tape), no_faults);
}

TEST(Tape, DeepChainsWork) {
  constexpr int depth = 100000;
  TapeBuilder builder;
  StepIndex s = builder.constant(1.0);
  const StepIndex one = s;
  for (int i = 0; i < depth; ++i) s = combine<Sum>(builder, {s, one});
  const auto tape = builder.finish(s);
  EXPECT_EQ(tape->size(), depth + 1u);
  EXPECT_EQ(tape->slots(), 2u);
  EXPECT_EQ(value(*tape, Vec3::Zero()), depth + 1.0);
  EXPECT_TRUE(tape->range({Vec3::Zero(), Vec3::Ones()}).contains(depth + 1.0));
}

TEST(Tape, WideStepsWork) {
  constexpr std::size_t width = 100000;
  TapeBuilder builder;
  std::vector<StepIndex> terms;
  for (std::size_t i = 0; i < width; ++i)
    terms.push_back(soft_ball(builder, Vec3(static_cast<double>(i), 0, 0), 0.75));
  const auto tape = builder.finish(combine<Sum>(builder, terms));
  EXPECT_EQ(tape->size(), 2 * width + 1);
  EXPECT_EQ(value(*tape, Vec3(12345, 0, 0)), 1.0);
  const auto near = tape->within({Vec3(7, -0.1, -0.1), Vec3(7.1, 0.1, 0.1)});
  ASSERT_TRUE(near.model);
  EXPECT_EQ(dynamic_cast<const Tape&>(*near.model).size(), 2u);
}

/// A random field of soft balls, sums and minima in [-2, 2]^3, and the same as a plain function.
struct RandomField {
  std::shared_ptr<const Tape> tape;
  std::vector<Vec3> centres;
  std::vector<double> radii;
  struct Operation {
    bool least;
    std::size_t a, b;
  };
  std::vector<Operation> operations;

  explicit RandomField(Rng& rng) {
    TapeBuilder builder;
    std::vector<StepIndex> steps;
    for (int i = integer(rng, 1, 12); i-- > 0;) {
      centres.push_back(suite::point_in(rng, {Vec3::Constant(-2), Vec3::Constant(2)}));
      radii.push_back(uniform(rng, 0.2, 2.0));
      steps.push_back(soft_ball(builder, centres.back(), radii.back()));
      builder.member({steps.back(), Level::half, static_cast<std::uint32_t>(steps.size() - 1)});
    }
    for (int i = integer(rng, 0, 15); i-- > 0;) {
      const int last = static_cast<int>(steps.size()) - 1;
      operations.push_back({integer(rng, 0, 2) == 0, static_cast<std::size_t>(integer(rng, 0, last)),
                            static_cast<std::size_t>(integer(rng, 0, last))});
      const auto& o = operations.back();
      steps.push_back(o.least ? combine<Least>(builder, {steps[o.a], steps[o.b]})
                              : combine<Sum>(builder, {steps[o.a], steps[o.b]}));
    }
    tape = builder.finish(steps.back());
  }
  [[nodiscard]] double at(const Vec3& p) const {
    std::vector<double> v;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const double d = std::min(1.0, (p - centres[i]).norm() / radii[i]);
      v.push_back((1.0 - d * d) * (1.0 - d * d));
    }
    for (const auto& o : operations) v.push_back(o.least ? std::min(v[o.a], v[o.b]) : v[o.a] + v[o.b]);
    return v.back();
  }
};

// All operands lie in [0, 1] and every operation adds an error of at most a few ulp of its result, which
// sums of up to 15 doublings bound by 2^15; 1e-13 of the result and 1e-14 near zero are far above.
TEST(Tape, ComputesWhatItsStepsSay) {
  for_all([](Rng& rng) {
    const RandomField f(rng);
    std::vector<Vec3> points;
    for (int i = 0; i < 300; ++i)
      points.push_back(suite::point_in(rng, {Vec3::Constant(-2), Vec3::Constant(2)}));
    const suite::Results r = suite::evaluate(*f.tape, Order::value, points);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(r.at(i, 0), f.at(points[i]), 1e-14 + 1e-13 * std::abs(r.at(i, 0)));
  });
}

TEST(Tape, PassesTheSuite) {
  int shorter = 0;
  for_all(
      [&](Rng& rng) {
        const RandomField f(rng);
        EXPECT_EQ(evaluator_faults(*f.tape, {.points = 40, .boxes = 20, .samples = 20}), no_faults);
        if (f.tape->within(suite::box_in(rng, {Vec3::Constant(-2), Vec3::Constant(2)})).model) ++shorter;
      },
      60);
  EXPECT_GT(shorter, 10) << "most boxes miss some ball";
}

TEST(Tape, WithoutPointsNothingIsWritten) {
  TapeBuilder builder;
  const auto tape = builder.finish(soft_ball(builder, Vec3::Zero(), 1.0));
  for (const Order order : {Order::value, Order::gradient, Order::hessian}) tape->evaluate(order, {}, {});
  tape->nearest_member({}, {});
}

TEST(Tape, PointsThatAreNotFiniteChangeNoOthers) {
  TapeBuilder builder;
  const auto tape = builder.finish(soft_ball(builder, Vec3::Zero(), 1.0));
  std::vector<Vec3> points(20, Vec3(0.1, 0.2, 0.3));
  const double expected = value(*tape, points[0]);
  points[3].y() = std::numeric_limits<double>::quiet_NaN();
  points[9].x() = std::numeric_limits<double>::infinity();
  const suite::Results r = suite::evaluate(*tape, Order::value, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i != 3 && i != 9) {
      EXPECT_EQ(r.at(i, 0), expected);
    }
  }
}

TEST(Within, LeavesTheMembersThatReachTheBox) {
  TapeBuilder builder;
  StepIndex sum = soft_ball(builder, Vec3::Zero(), 1.0);
  builder.member({sum, Level::half, 0});
  for (int i = 1; i < 1000; ++i) {
    const StepIndex next = soft_ball(builder, Vec3(i, 0, 0), 1.0);
    builder.member({next, Level::half, static_cast<std::uint32_t>(i)});
    sum = combine<Sum>(builder, {sum, next});
  }
  const auto tape = builder.finish(sum);
  const Box box{Vec3(500.25, -0.1, -0.1), Vec3(500.75, 0.1, 0.1)};
  const auto near = tape->within(box);
  ASSERT_TRUE(near.model);
  const auto& less = dynamic_cast<const Tape&>(*near.model);
  EXPECT_EQ(less.size(), 5u) << "two balls, two windows, one sum";
  EXPECT_EQ(less.slots(), 2u);
  EXPECT_EQ(near.range, tape->range(box));
  EXPECT_FALSE(less.within(box).model) << "there is nothing more to leave out";
  EXPECT_FALSE(tape->within({Vec3(-1, -1, -1), Vec3(1000, 1, 1)}).model);

  // The surfaces stand 0.54 from the centres, so between two of them each point is nearer to the other one's.
  const double x[] = {500.3, 500.7}, zero[] = {0.0, 0.0};
  std::uint32_t nearest[2];
  less.nearest_member({x, zero, zero}, nearest);
  EXPECT_THAT(nearest, ::testing::ElementsAre(501u, 500u));
}

TEST(Within, AFieldThatIsZeroOnTheBoxBecomesAConstant) {
  TapeBuilder builder;
  const auto tape = builder.finish(
      combine<Sum>(builder, {soft_ball(builder, Vec3::Zero(), 1.0), soft_ball(builder, Vec3(1, 0, 0), 1.0)}));
  const auto far = tape->within({Vec3::Constant(5), Vec3::Constant(6)});
  EXPECT_EQ(far.range, (Range{0.0, 0.0}));
  ASSERT_TRUE(far.model);
  EXPECT_EQ(dynamic_cast<const Tape&>(*far.model).size(), 1u);
  EXPECT_FALSE(far.model->within({Vec3::Constant(5), Vec3::Constant(6)}).model);
}

TEST(NearestMember, IsTheOneWithTheNearestSurface) {
  for_all([](Rng& rng) {
    TapeBuilder builder;
    std::vector<StepIndex> terms;
    std::vector<Vec3> centres;
    for (std::uint32_t i = 0; i < 5; ++i) {
      centres.push_back(suite::point_in(rng, {Vec3::Constant(-2), Vec3::Constant(2)}));
      terms.push_back(ball(builder, centres.back(), 1.0));  // level one: first-order distance is exact
      builder.member({terms.back(), Level::one, i});
    }
    const auto tape = builder.finish(combine<Sum>(builder, terms));
    std::vector<double> xyz[3];
    for (int i = 0; i < 600; ++i)
      for (auto& c : xyz) c.push_back(uniform(rng, -3.0, 3.0));
    std::vector<std::uint32_t> nearest(600);
    tape->nearest_member({xyz[0], xyz[1], xyz[2]}, nearest);
    for (std::size_t i = 0; i < 600; ++i) {
      double distance[5];
      for (std::size_t k = 0; k < 5; ++k)
        distance[k] = std::abs((Vec3(xyz[0][i], xyz[1][i], xyz[2][i]) - centres[k]).norm() - 1.0);
      ASSERT_LT(nearest[i], 5u);
      EXPECT_LE(distance[nearest[i]], *std::min_element(distance, distance + 5) + 1e-13);
    }
  });
}

TEST(NearestMember, TakesTheLowestIndexOnTies) {
  TapeBuilder builder;
  const StepIndex a = ball(builder, Vec3(1, 0, 0), 1.0), b = ball(builder, Vec3(-1, 0, 0), 1.0);
  builder.member({a, Level::one, 1});
  builder.member({b, Level::one, 0});
  const auto tape = builder.finish(combine<Least>(builder, {a, b}));
  const double zero = 0.0, half = 0.5;
  std::uint32_t nearest = 7;
  tape->nearest_member({{&zero, 1}, {&half, 1}, {&zero, 1}}, {&nearest, 1});
  EXPECT_EQ(nearest, 0u);
}

}  // namespace
}  // namespace blendwright::test
