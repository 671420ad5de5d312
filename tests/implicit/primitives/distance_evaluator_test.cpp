// The laws of all evaluators, on every distance primitive.
#include <gtest/gtest.h>

#include "tests/implicit/primitives/made_primitive.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright {
namespace {

using namespace test;

TEST(DistancePrimitives, ObeyTheLawsOfEvaluation) {
  for (const PrimitiveSample& sample : primitive_samples()) {
    SCOPED_TRACE(sample.id);
    const auto tape = make_primitive(sample.scene).tape;
    ASSERT_TRUE(tape);
    EXPECT_EQ(evaluator_faults(*tape, {.where = sample.where}), no_faults);
  }
}

}  // namespace
}  // namespace blendwright
