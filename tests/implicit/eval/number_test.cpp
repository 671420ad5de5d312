// One formula gives the same value and derivatives for every number type.
#include <gtest/gtest.h>

#include <cmath>

#include "implicit/primitives/lp_metric.hpp"

namespace blendwright {
namespace {

TEST(LpMetric, IsExactOnTheAxis) {
  detail::LpMetric body;
  body.inverse_axes = Vec3(0.125, 0.125, 0.0625);
  body.n = detail::Power(20.0);
  body.inverse_n = detail::Power(1.0 / 20.0);
  EXPECT_EQ(scalar_value(op_for<detail::LpMetric>(), &body, Vec3(4, 0, 0)), 0.5);
}

}  // namespace
}  // namespace blendwright
