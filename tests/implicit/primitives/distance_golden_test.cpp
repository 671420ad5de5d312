// Every golden case of a distance primitive, on the scalar, the vector and the derivative kernels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/implicit/primitives/made_primitive.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/soft_golden.hpp"

namespace blendwright {
namespace {

using namespace test;

/// The tolerances that the data come with: 1e-12 of a value and 1e-10 of a gradient, each relative to
/// max(1e-3, its largest magnitude). The gradient convention of points that are not smooth is not compared.
bool agrees(const SoftPoint& golden, const double* value, const Vec3* gradient) {
  if (!(std::abs(*value - golden.value) <= 1e-12 * std::max(1e-3, std::abs(golden.value)))) return false;
  if (gradient == nullptr) return true;
  if (!gradient->allFinite()) return false;
  const Vec3 expected(golden.gradient[0], golden.gradient[1], golden.gradient[2]);
  const double size = std::max(1e-3, expected.cwiseAbs().maxCoeff());
  return !golden.smooth || (*gradient - expected).cwiseAbs().maxCoeff() <= 1e-10 * size;
}

/// Results of all three orders, by the vector kernels and by the scalar ones.
void expect_golden(const Tape& tape, const std::vector<SoftPoint>& points) {
  std::vector<double> x, y, z;
  for (const SoftPoint& p : points) {
    x.push_back(p.at.at(0));
    y.push_back(p.at.at(1));
    z.push_back(p.at.at(2));
  }
  const std::size_t n = points.size();
  for (const Order order : {Order::value, Order::gradient, Order::hessian})
    for (const bool scalar : {false, true}) {
      std::vector<double> out(n * components(order));
      scalar ? tape.evaluate_scalar(order, {x, y, z}, out) : tape.evaluate(order, {x, y, z}, out);
      for (std::size_t i = 0; i < n; ++i) {
        Vec3 g = Vec3::Zero();
        if (order != Order::value) g = {out[n + i], out[2 * n + i], out[3 * n + i]};
        EXPECT_TRUE(agrees(points[i], &out[i], order == Order::value ? nullptr : &g))
            << "point " << i << ", order " << static_cast<int>(order)
            << (scalar ? ", scalar: " : ", vector: ") << out[i] << " for " << points[i].value << ", gradient "
            << g.transpose();
      }
      for (const double component : out) EXPECT_FALSE(std::isnan(component));
    }
}

TEST(GoldenDistances, AreReached) {
  std::set<std::string> seen;
  for (const SoftCase& c : read_soft_golden(golden_folder())) {
    const NodeKind* kind = c.kind == "distance" ? find_node_kind(c.function) : nullptr;
    if (kind == nullptr || kind->family != NodeFamily::distance) continue;
    SCOPED_TRACE(c.id);
    const MadePrimitive made = make_primitive(c.scene);
    ASSERT_TRUE(made.tape) << (made.problems.empty() ? "" : made.problems[0].message);
    expect_golden(*made.tape, c.points);
    seen.insert(c.function);
  }
  for (const char* kind : {"plane", "slab", "lp_metric", "superquadric", "asymmetric_superellipsoid",
                           "generalized_distance", "segment_skeleton", "capsule_gauge"})
    EXPECT_TRUE(seen.contains(kind)) << kind;
}

TEST(GoldenDistances, RefuseValuesAndGradientsThatAreOff) {
  const SoftPoint golden{.at = {1, 2, 3}, .value = 2.0, .gradient = {0.5, 0.0, 0.25}};
  const double right = 2.0, off = 2.0 * (1.0 + 2e-12);
  const Vec3 slope(0.5, 0.0, 0.25), bent(0.5, 1e-10, 0.25);
  EXPECT_TRUE(agrees(golden, &right, &slope));
  EXPECT_FALSE(agrees(golden, &off, nullptr));
  EXPECT_FALSE(agrees(golden, &right, &bent));
}

}  // namespace
}  // namespace blendwright
