// Golden values of potentials, range maps and operators, on every kernel.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "implicit/operators/distance_operation.hpp"
#include "implicit/operators/hoffmann.hpp"
#include "implicit/operators/potential.hpp"
#include "implicit/operators/range_map.hpp"
#include "tests/implicit/operators/op_tape.hpp"
#include "tests/implicit/operators/operator_names.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/soft_golden.hpp"

namespace blendwright::test {
namespace {

std::shared_ptr<const Tape> one_argument_tape(const SoftCase& c) {
  if (c.function == "blanc") return op_tape(detail::Blanc{c.numbers.at("s")}, 1);
  if (c.function == "wyvill") return op_tape(detail::Wyvill{}, 1);
  if (c.function == "gaussian") return op_tape(detail::Gaussian{}, 1);
  if (c.function == "gaussian_windowed") return op_tape(detail::GaussianWindowed{}, 1);
  if (c.function == "T") return op_tape(detail::RangeMap{c.numbers.at("w1"), c.numbers.at("w2")}, 1);
  return nullptr;
}

std::shared_ptr<const Tape> tape_of(const SoftCase& c, std::size_t k) {
  if (c.kind == "potential" || c.kind == "range_map") return one_argument_tape(c);
  if (c.function == "T_vir")
    return op_tape(
        detail::VirMap{c.numbers.at("w2"), c.numbers.at("w_floor"), c.words.at("inner") == "coupled"}, k);
  if (c.function == "dilation") return op_tape(detail::Dilation(c.numbers.at("n")), k);
  if (c.function == "erosion") return op_tape(detail::Erosion{c.numbers.at("n")}, k);
  if (c.function == "hoffmann_polynomial")
    return op_tape(detail::HoffmannPolynomial{c.numbers.at("r1"), c.numbers.at("r2"), c.numbers.at("p")}, k);
  const auto id = operator_named(c.function);
  return id ? combination_tape(detail::combination(*id, values_of(c.numbers)), k) : nullptr;
}

/// Largest error of a value, and of its partials, as multiples of what the sheet of formulas grants: 1e-12
/// and 1e-10, relative to max(1e-3, magnitude). Infinite when something is not finite that must be.
struct Excess {
  double value = 0.0, gradient = 0.0;
};
Excess excess(const SoftPoint& p, const std::vector<double>& out, Order order) {
  Excess e;
  if (out[0] != p.value) e.value = std::abs(out[0] - p.value) / (1e-12 * std::max(1e-3, std::abs(p.value)));
  if (std::isnan(e.value)) e.value = std::numeric_limits<double>::infinity();
  if (order == Order::value) return e;
  double scale = 1e-3;
  for (const double g : p.gradient) scale = std::max(scale, std::abs(g));
  for (std::size_t i = 0; i < p.gradient.size(); ++i) {
    const double error = p.smooth ? std::abs(out[1 + i] - p.gradient[i]) / (1e-10 * scale) : 0.0;
    e.gradient =
        std::max(e.gradient, std::isfinite(out[1 + i]) ? error : std::numeric_limits<double>::infinity());
  }
  for (const double x : out)
    if (std::isnan(x)) e.gradient = std::numeric_limits<double>::infinity();
  return e;
}

std::vector<double> evaluated(const Tape& tape, const SoftPoint& p, Order order, bool simd) {
  double at[3] = {0.0, 0.0, 0.0};
  std::ranges::copy(p.at, at);
  std::vector<double> out(components(order));
  const PointArrays points{{&at[0], 1}, {&at[1], 1}, {&at[2], 1}};
  simd ? tape.evaluate(order, points, out) : tape.evaluate_scalar(order, points, out);
  return out;
}

bool is_ours(const SoftCase& c) { return c.kind != "distance" && c.kind != "field"; }

TEST(OperatorGolden, EveryCaseIsMetByEveryKernel) {
  std::map<std::string, int> count;
  for (const SoftCase& c : read_soft_golden(golden_folder())) {
    if (!is_ours(c)) continue;
    SCOPED_TRACE(c.id);
    for (const SoftPoint& p : c.points) {
      const std::shared_ptr<const Tape> tape = tape_of(c, p.at.size());
      ASSERT_NE(tape, nullptr) << "unknown function " << c.function;
      for (const Order order : {Order::value, Order::gradient, Order::hessian})
        for (const bool simd : {false, true}) {
          const Excess e = excess(p, evaluated(*tape, p, order, simd), order);
          EXPECT_LE(e.value, 1.0) << "point " << testing::PrintToString(p.at) << (simd ? " simd" : " scalar");
          EXPECT_LE(e.gradient, 1.0) << "point " << testing::PrintToString(p.at)
                                     << (simd ? " simd" : " scalar");
        }
    }
    ++count[c.kind];
  }
  for (const char* kind : {"potential", "range_map", "vir_map", "operator"})
    EXPECT_GT(count[kind], 0) << kind;
}

TEST(OperatorGolden, SeesErrorsOfTwiceTheTolerance) {
  int points = 0;
  for (const SoftCase& c : read_soft_golden(golden_folder())) {
    if (!is_ours(c)) continue;
    for (SoftPoint p : c.points) {
      const std::shared_ptr<const Tape> tape = tape_of(c, p.at.size());
      ASSERT_NE(tape, nullptr);
      if (!std::isfinite(p.value) || !p.smooth) continue;
      const std::vector<double> out = evaluated(*tape, p, Order::gradient, true);
      double scale = 1e-3;
      for (const double g : p.gradient) scale = std::max(scale, std::abs(g));
      p.value += 2e-12 * std::max(1e-3, std::abs(p.value));
      p.gradient.back() += 2e-10 * scale;
      EXPECT_GT(excess(p, out, Order::gradient).value, 1.0) << c.id;
      EXPECT_GT(excess(p, out, Order::gradient).gradient, 1.0) << c.id;
      ++points;
    }
  }
  EXPECT_GT(points, 0);
}

}  // namespace
}  // namespace blendwright::test
