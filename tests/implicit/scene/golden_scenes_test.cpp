// Golden scenes: distances and fields, through every evaluator.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "implicit/scene/scene.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/soft_golden.hpp"

namespace blendwright::test {
namespace {

// The data are exact to 17 digits; the formulas lose up to two digits of 53-bit arithmetic on the way
// (2e-14, gradients 2e-13), vector functions add 4 ulp each.
constexpr double value_tolerance = 1e-12, gradient_tolerance = 1e-10, least_scale = 1e-3;

const std::vector<SoftCase>& golden() {
  static const std::vector<SoftCase> all = read_soft_golden(golden_folder());
  return all;
}

/// What is wrong with one point's numbers f, fx, fy, fz (or f alone); "" for nothing.
std::string fault(const SoftPoint& point, const std::vector<double>& found) {
  const double scale = std::max(least_scale, std::abs(point.value));
  if (std::isinf(point.value) ? found[0] != point.value
                              : !(std::abs(found[0] - point.value) <= value_tolerance * scale))
    return "value " + testing::PrintToString(found[0]);
  double slope = least_scale;
  for (const double g : point.gradient) slope = std::max(slope, std::abs(g));
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (!std::isfinite(found[i])) return "gradient is not finite";
    if (point.smooth && !(std::abs(found[i] - point.gradient[i - 1]) <= gradient_tolerance * slope))
      return "gradient " + testing::PrintToString(found[i]) + " for " +
             testing::PrintToString(point.gradient[i - 1]);
  }
  return "";
}

struct Evaluator {
  std::string name;
  Order order;
  bool scalar;
};
const std::vector<Evaluator> evaluators = {{"scalar", Order::value, true},
                                           {"scalar gradient", Order::gradient, true},
                                           {"scalar second order", Order::hessian, true},
                                           {"batch", Order::value, false},
                                           {"batch gradient", Order::gradient, false},
                                           {"batch second order", Order::hessian, false}};

/// Faults of all points of a case.
std::vector<std::string> faults(const Tape& tape, const SoftCase& c, const Evaluator& evaluator) {
  std::vector<double> x, y, z;
  for (const SoftPoint& p : c.points) {
    x.push_back(p.at[0]);
    y.push_back(p.at[1]);
    z.push_back(p.at[2]);
  }
  const std::size_t size = x.size(), shown = evaluator.order == Order::value ? 1 : 4;
  std::vector<double> out(components(evaluator.order) * size);
  if (evaluator.scalar)
    tape.evaluate_scalar(evaluator.order, {x, y, z}, out);
  else
    tape.evaluate(evaluator.order, {x, y, z}, out);
  std::vector<std::string> list;
  for (std::size_t i = 0; i < size; ++i) {
    std::vector<double> found;
    for (std::size_t k = 0; k < shown; ++k) found.push_back(out[k * size + i]);
    const std::string text = fault(c.points[i], found);
    if (!text.empty())
      list.push_back(c.id + " point " + std::to_string(i) + ", " + evaluator.name + ": " + text);
  }
  return list;
}

std::vector<SoftCase> scenes() {
  std::vector<SoftCase> found;
  for (const SoftCase& c : golden())
    if (c.kind == "distance" || c.kind == "field") found.push_back(c);
  return found;
}

TEST(GoldenScenes, AreMetByEveryEvaluator) {
  ASSERT_FALSE(scenes().empty());
  for (const SoftCase& c : scenes()) {
    SCOPED_TRACE(c.id);
    std::shared_ptr<const Tape> tape;
    ASSERT_NO_THROW(tape = build_tape(c.scene));
    for (const Evaluator& evaluator : evaluators)
      EXPECT_THAT(faults(*tape, c, evaluator), testing::IsEmpty());
  }
}

// A value that is 1e-11 off, and a partial that is 1e-9 off, are seen.
TEST(GoldenScenes, SeeWrongNumbers) {
  for (SoftCase c : scenes()) {
    const std::shared_ptr<const Tape> tape = build_tape(c.scene);
    for (SoftPoint& p : c.points) {
      const SoftPoint right = p;
      std::vector<double> found = {right.value};
      found.insert(found.end(), right.gradient.begin(), right.gradient.end());
      EXPECT_EQ(fault(right, found), "");
      if (std::isfinite(p.value)) {
        found[0] += 1e-11 * std::max(least_scale, std::abs(p.value));
        EXPECT_NE(fault(right, found), "");
        found[0] = right.value;
      }
      if (!p.smooth) continue;
      double slope = least_scale;
      for (const double g : p.gradient) slope = std::max(slope, std::abs(g));
      found[2] += 1e-9 * slope;
      EXPECT_NE(fault(right, found), "");
    }
  }
}

// Ranges over small boxes around the points hold the golden values.
TEST(GoldenScenes, LieInTheirRanges) {
  for (const SoftCase& c : scenes()) {
    const std::shared_ptr<const Tape> tape = build_tape(c.scene);
    for (const SoftPoint& p : c.points)
      for (const double half : {0.0, 1e-3, 0.5, 20.0}) {
        const Vec3 at(p.at[0], p.at[1], p.at[2]);
        const Range range = tape->range({at.array() - half, at.array() + half});
        const double slack = 1e-12 * std::max(least_scale, std::abs(p.value));
        EXPECT_TRUE(std::isinf(p.value) ? range.hi == p.value
                                        : range.lo - slack <= p.value && p.value <= range.hi + slack)
            << c.id << ": " << p.value << " in [" << range.lo << ", " << range.hi << "]";
      }
  }
}

/// The functions that tests of this project compute, by the golden file's kind.
std::set<std::string> known_functions(const std::string& kind) {
  std::set<std::string> names;
  const auto add_family = [&](NodeFamily family) {
    for (const NodeKind* row : node_kinds())
      if (row->family == family) names.emplace(row->name);
  };
  if (kind == "potential") {
    for (const NodeParam& p : find_node_kind("soft_object")->params)
      if (p.info.name == "potential") names.insert(p.words.begin(), p.words.end());
  } else if (kind == "range_map") {
    names = {"T"};
  } else if (kind == "vir_map") {
    names = {"T_vir"};
  } else if (kind == "operator") {
    add_family(NodeFamily::operation);
    add_family(NodeFamily::distance_operation);
    names.insert("hoffmann_polynomial");
  } else if (kind == "distance") {
    add_family(NodeFamily::distance);
    add_family(NodeFamily::distance_operation);
    add_family(NodeFamily::operation);
    add_family(NodeFamily::placement);
  } else if (kind == "field") {
    names = {"tree"};
  }
  return names;
}

TEST(GoldenFile, HasNoFunctionThatIsNotThere) {
  std::set<std::string> kinds;
  for (const SoftCase& c : golden()) {
    EXPECT_TRUE(known_functions(c.kind).contains(c.function)) << c.id << ": " << c.kind << ' ' << c.function;
    kinds.insert(c.kind);
  }
  EXPECT_THAT(kinds,
              testing::ElementsAre("distance", "field", "operator", "potential", "range_map", "vir_map"));
  EXPECT_FALSE(known_functions("operator").contains("teapot"));
}

}  // namespace
}  // namespace blendwright::test
