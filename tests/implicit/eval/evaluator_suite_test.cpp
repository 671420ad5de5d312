// The suite that other tests rely on finds what it is there to find.
#include "tests/implicit/support/evaluator_suite.hpp"

#include <gmock/gmock.h>

#include "tests/implicit/eval/small_ops.hpp"

namespace blendwright::test {
namespace {

using ::testing::Contains;
using ::testing::StartsWith;

std::vector<std::string> faults_of(const Op& op, const Op& outer = op_for<Window>()) {
  TapeBuilder builder;
  const StepIndex x = builder.add(op, std::make_shared<const Ball>(),
                                  Frame(Eigen::Matrix3d::Identity(), Vec3(0.1, 0.2, 0.3)));
  const StepIndex args[] = {x};
  return evaluator_faults(*builder.finish(builder.add(outer, std::make_shared<const Window>(), {}, args)));
}

/// The vector kernels of |y| with one component changed in every batch that `when` accepts.
template <std::size_t Order, std::size_t Component>
void spoiled(const void* body, const KernelInput& in, double* out) {
  op_for<Ball>().simd.run[Order](body, in, out);
  for (std::size_t i = 0; i < in.count; ++i) out[Component * batch_size + i] *= 1.0 + 1e-4;
}
void nan_kernel(const void*, const KernelInput& in, double* out) {
  for (std::size_t i = 0; i < in.count; ++i) out[i] = std::numeric_limits<double>::quiet_NaN();
}
/// Rounds differently when there are many points.
void crowded(const void* body, const KernelInput& in, double* out) {
  op_for<Ball>().simd.run[0](body, in, out);
  if (in.count > 8)
    for (std::size_t i = 0; i < in.count; ++i) out[i] = std::nextafter(out[i], 10.0);
}

TEST(EvaluatorSuite, FindsNothingWrongWithABall) { EXPECT_EQ(faults_of(op_for<Ball>()), no_faults); }

TEST(EvaluatorSuite, ReportsAValueThatDiffersFromTheScalarOne) {
  Op bad = op_for<Ball>();
  bad.simd.run[0] = spoiled<0, 0>;
  EXPECT_THAT(faults_of(bad), Contains(StartsWith("simd differs from scalar: component 0")));
}
TEST(EvaluatorSuite, ReportsAWrongGradient) {
  Op bad = op_for<Ball>();
  for (std::size_t k : {1u, 2u}) bad.scalar.run[k] = bad.simd.run[k] = k == 1 ? spoiled<1, 2> : spoiled<2, 2>;
  EXPECT_THAT(faults_of(bad), Contains(StartsWith("gradient differs from differences")));
}
TEST(EvaluatorSuite, ReportsAWrongHessian) {
  Op bad = op_for<Ball>();
  bad.scalar.run[2] = bad.simd.run[2] = spoiled<2, 7>;
  EXPECT_THAT(faults_of(bad), Contains(StartsWith("hessian differs from differences")));
}
TEST(EvaluatorSuite, ReportsNotANumber) {
  Op bad = op_for<Ball>();
  bad.simd.run[0] = nan_kernel;
  EXPECT_THAT(faults_of(bad), Contains(StartsWith("not finite")));
}
TEST(EvaluatorSuite, ReportsResultsThatDependOnTheBatch) {
  Op bad = op_for<Ball>();
  bad.simd.run[0] = crowded;
  EXPECT_THAT(faults_of(bad), Contains(StartsWith("depends on the batch")));
}
TEST(EvaluatorSuite, ReportsARangeThatIsTooSmall) {
  Op bad = op_for<Window>();
  bad.range = [](const void* body, const Box& local, std::span<const Range> args) {
    Range r = op_for<Window>().range(body, local, args);
    return Range{r.lo, r.lo + 0.9 * (r.hi - r.lo)};
  };
  EXPECT_THAT(faults_of(op_for<Ball>(), bad), Contains(StartsWith("range misses a value")));
}
TEST(EvaluatorSuite, ReportsALinearBoundThatIsTooNarrow) {
  Op bad = op_for<Window>();
  bad.linear = [](const void* body, const LinearInput& in) {
    const Range r = op_for<Window>().range(body, in.local, in.ranges);
    return constant_bound({r.lo, r.lo + 0.9 * (r.hi - r.lo)});
  };
  EXPECT_THAT(faults_of(op_for<Ball>(), bad), Contains(StartsWith("linear bound misses a value")));
}
TEST(EvaluatorSuite, ReportsAShortcutThatIsTakenTooEarly) {
  Op bad = op_for<Window>();
  bad.shortcut = [](const void*, const Box&, std::span<const Range> args) {
    return args[0].lo > 0.95 ? Shortcut::to_constant(0.0) : Shortcut{};
  };
  EXPECT_THAT(faults_of(op_for<Ball>(), bad), Contains(StartsWith("shortened model differs")));
}
TEST(EvaluatorSuite, ReportsAShortcutThatIsOnlyNearlyEqual) {
  Op bad = op_for<Window>();
  bad.shortcut = [](const void*, const Box&, std::span<const Range> args) {
    return args[0].hi < 2.0 ? Shortcut::to_argument(0) : Shortcut{};
  };
  EXPECT_THAT(faults_of(op_for<Ball>(), bad), Contains(StartsWith("shortened model differs")));
}
TEST(EvaluatorSuite, ReportsDifferencesThatSayNothing) {
  // Waves much shorter than the step leave no two differences alike.
  Op bad = op_for<Ball>();
  bad.simd.run[1] = bad.scalar.run[1] = [](const void* body, const KernelInput& in, double* out) {
    op_for<Ball>().simd.run[1](body, in, out);
    for (std::size_t i = 0; i < in.count; ++i)
      out[i] += 1e-3 * std::sin(1e9 * (in.x[i] * in.x[i] + in.y[i] * in.y[i] + in.z[i] * in.z[i]));
  };
  TapeBuilder builder;
  const auto tape = builder.finish(builder.add(bad, std::make_shared<const Ball>(), Frame{}));
  EXPECT_THAT(evaluator_faults(*tape), Contains(StartsWith("differences say nothing")));
}

}  // namespace
}  // namespace blendwright::test
