// Golden values of set operations and blends, on every kernel.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "implicit/operators/function_liming.hpp"
#include "implicit/operators/function_local.hpp"
#include "implicit/operators/function_rockwood.hpp"
#include "implicit/operators/sharp.hpp"
#include "implicit/primitives/quadric.hpp"
#include "tests/implicit/functions/argument_tape.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright::test {
namespace {

/// An operation as the data have it: of arguments `argument` times x, with the sign `result` of its value.
/// Partials have the sign of both.
struct Subject {
  Combination combine{};
  double argument = 1.0, result = 1.0;
};

Join join_of(const RelationCase& c) { return c.parameters.flags.at("union") ? Join::unite : Join::intersect; }

/// R_0 and material, as rows make them.
template <class Body>
Combination with_material(Join join, Body body) {
  return [set = r_alpha(0.0, join), material = step(body), sum = step(detail::Sum{})](
             TapeBuilder& tape, std::span<const StepIndex> args) {
    const StepIndex both[] = {set(tape, args.first(2)), material(tape, args)};
    return sum(tape, both);
  };
}

Combination ricci_one(const std::string& function, double p) {
  using enum detail::OperatorId;
  const detail::OperatorId id = function == "ricci_union"          ? ricci_union_one
                                : function == "ricci_intersection" ? ricci_intersection_one
                                                                   : ricci_difference_one;
  return detail::combination(id, {.n = p});
}

/// Nothing for functions that are no set operation and no blend.
Subject subject_of(const RelationCase& c) {
  const auto number = [&](const char* key) { return c.parameters.numbers.at(key); };
  const auto list = [&](const char* key) { return c.parameters.lists.at(key); };
  if (c.function == "r_alpha") return {r_alpha(number("alpha"), join_of(c))};
  if (c.function == "r_0m") return {r_m(static_cast<int>(number("m")), join_of(c))};
  if (c.function.starts_with("ricci_")) return {ricci_one(c.function, number("p"))};
  if (c.function == "liming") return {step(detail::Liming{number("u"), 1})};
  // Exterior coordinates are those of f < 0.
  if (c.function == "liming_clipped")
    return {step(detail::LimingClipped{number("c_a"), number("c_b"), number("r"), number("u"), Join::unite}),
            -1.0};
  if (c.function == "rockwood")
    return {step(detail::RockwoodRaw{detail::SuperEllipse(list("r"), number("w"))}), -1.0, -1.0};
  if (c.function == "rockwood_displacement")
    return {rockwood(list("r"), number("w"), Join::unite), -1.0, -1.0};
  if (c.function == "pasko_savchenko_blend") {
    const auto a = list("a");
    return {with_material(join_of(c), detail::EdgeMaterial{a[0], a[1], a[2]})};
  }
  if (c.function == "bounded_blend") {
    const auto a = list("a");
    return {with_material(join_of(c), detail::BoundedMaterial{a[0], a[1], a[2], a[3]})};
  }
  return {};
}

/// The largest errors as multiples of what the data come with: 1e-12 and 1e-10, relative to max(1, |value|).
struct Excess {
  double value = 0.0, gradient = 0.0;
};
Excess excess(const RelationSample& s, const Subject& of, const Partials& found) {
  const double size = std::max(1.0, std::abs(s.value()));
  Excess e{std::abs(of.result * found.value - s.value()) / (1e-12 * size), 0.0};
  if (s.gradient() == nullptr) return e;
  for (std::size_t i = 0; i < s.x().size(); ++i)
    e.gradient =
        std::max(e.gradient, std::abs(of.result * of.argument * found.partials[i] - s.gradient()->at(i)) /
                                 (1e-10 * size));
  return e;
}
std::vector<double> arguments(const RelationSample& s, const Subject& of) {
  std::vector<double> at = s.x();
  for (double& x : at) x *= of.argument;
  return at;
}

const std::vector<RelationCase>& golden() {
  static const std::vector<RelationCase> all = read_relation_golden(golden_folder());
  return all;
}

TEST(FunctionGolden, EveryCaseIsMetByEveryKernel) {
  std::map<std::string, int> seen;
  for (const RelationCase& c : golden()) {
    const Subject of = subject_of(c);
    if (!of.combine) continue;
    SCOPED_TRACE(c.id);
    for (const RelationSample& s : c.samples) {
      SCOPED_TRACE(testing::PrintToString(s.x()));
      for (const By by : {By::vector_kernels, By::scalar_kernels}) {
        const std::vector<double> at = arguments(s, of);
        const Excess e = excess(s, of, partials(of.combine, at, by));
        EXPECT_LE(e.value, 1.0);
        EXPECT_LE(e.gradient, 1.0);
        if (at.size() <= 3) {
          EXPECT_EQ(value(of.combine, at, by), partials(of.combine, at, by).value);
        }
      }
      ++seen[c.function];
    }
  }
  for (const char* function :
       {"r_alpha", "r_0m", "ricci_union", "ricci_intersection", "ricci_difference", "liming",
        "liming_clipped", "rockwood", "rockwood_displacement", "pasko_savchenko_blend", "bounded_blend"})
    EXPECT_GE(seen[function], 8) << function;
}

TEST(FunctionGolden, SeesErrorsOfTwiceTheTolerance) {
  int seen = 0;
  for (const RelationCase& c : golden()) {
    const Subject of = subject_of(c);
    if (!of.combine) continue;
    for (const RelationSample& s : c.samples) {
      Partials found = partials(of.combine, arguments(s, of));
      const double size = std::max(1.0, std::abs(s.value()));
      found.value += 2.1e-12 * size;
      found.partials.back() += 2.1e-10 * size;
      EXPECT_GT(excess(s, of, found).value, 1.0) << c.id;
      if (s.gradient() != nullptr) {
        EXPECT_GT(excess(s, of, found).gradient, 1.0) << c.id;
      }
      ++seen;
    }
  }
  EXPECT_GT(seen, 300);
}

/// With n = e^-phi the operators of constructive geometry become those of level function: the same data give
/// their values, -ln of everything. Relative errors of n are absolute ones of phi.
TEST(FunctionGolden, RicciOfFunctionsIsRicciOfExponentials) {
  int seen = 0;
  for (const RelationCase& c : golden()) {
    if (!c.function.starts_with("ricci_")) continue;
    SCOPED_TRACE(c.id);
    const Join join = c.function == "ricci_union"          ? Join::unite
                      : c.function == "ricci_intersection" ? Join::intersect
                                                           : Join::subtract;
    const Combination combine = ricci(c.parameters.numbers.at("p"), join);
    for (const RelationSample& s : c.samples) {
      std::vector<double> phi;
      for (const double x : s.x()) phi.push_back(-std::log(x));
      const Partials found = partials(combine, phi);
      EXPECT_NEAR(found.value, -std::log(s.value()), 1e-12);
      for (std::size_t i = 0; i < phi.size(); ++i)  // d phi_U/d phi_i = (x_i/U) dU/dx_i
        EXPECT_NEAR(found.partials[i], s.gradient()->at(i) * s.x()[i] / s.value(), 1e-10);
      ++seen;
    }
  }
  EXPECT_GE(seen, 100);
}

}  // namespace
}  // namespace blendwright::test
