// Every golden case of an offset, on both kinds of kernels and with derivatives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "implicit/scene/scene.hpp"
#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright::test {
namespace {

using List = std::vector<double>;

/// The body of a case (the node "case") with its offset on top.
SceneSpec offset_scene(const RelationCase& c) {
  const auto& numbers = c.parameters.numbers;
  SceneSpec scene = c.scene;
  NodeSpec node = part("offset", "", {{"of", ref("case")}});
  if (c.function == "iso_offset") {
    node.kind = "iso_offset";
    node.values["value"] = numbers.at("C");
  } else if (c.function == "along_normal_offset") {
    node.kind = "normal_offset";
    node.values["distance"] = numbers.at("D");
  } else if (c.function == "constant_radius_offset_quadric" ||
             c.function == "constant_radius_offset_freeform") {
    node.kind = "ball_offset";
    node.values["distance"] = (c.parameters.flags.at("external") ? 1.0 : -1.0) * numbers.at("D");
  } else if (c.function == "opening_of_box") {
    node.kind = "opening";
    node.values["radius"] = numbers.at("r");
  } else {
    // {x <= 0} u {y <= 0}
    node.kind = "closing";
    node.values["radius"] = numbers.at("r");
    scene = scene_of({part("left", "quadric", {{"coefficients", List{0, 0, 0, 0, 0, 0, -1, 0, 0, 0}}}),
                      part("below", "quadric", {{"coefficients", List{0, 0, 0, 0, 0, 0, 0, -1, 0, 0}}}),
                      part("case", "max", {{"of", refs({"left", "below"})}})});
  }
  scene.nodes.push_back(std::move(node));
  scene.solid = "offset";
  return scene;
}

/// Of a value 1e-12, of a derivative 1e-10, relative to max(1, |value|).
bool agrees(double value, double golden, double relative, double size) {
  return std::abs(value - golden) <= relative * std::max(1.0, std::abs(size));
}

void expect_sample(const Tape& tape, const RelationSample& s) {
  const double x[] = {s.x().at(0)}, y[] = {s.x().at(1)}, z[] = {s.x().at(2)};
  for (const Order order : {Order::value, Order::gradient, Order::hessian})
    for (const bool scalar : {false, true}) {
      std::vector<double> out(components(order));
      scalar ? tape.evaluate_scalar(order, {x, y, z}, out) : tape.evaluate(order, {x, y, z}, out);
      EXPECT_TRUE(agrees(out[0], s.value(), 1e-12, s.value())) << out[0] << " for " << s.value();
      if (order == Order::value || s.gradient() == nullptr) continue;
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE(agrees(out[1 + i], s.gradient()->at(i), 1e-10, s.value()))
            << i << ": " << out[1 + i] << " for " << s.gradient()->at(i);
    }
}

TEST(GoldenOffsets, AreReached) {
  const std::map<std::string, std::size_t> expected{{"iso_offset", 2},
                                                    {"along_normal_offset", 2},
                                                    {"opening_of_box", 1},
                                                    {"closing_of_right_angle", 1},
                                                    {"constant_radius_offset_quadric", 6},
                                                    {"constant_radius_offset_freeform", 2}};
  std::map<std::string, std::size_t> seen;
  std::size_t samples = 0, ties = 0;
  for (const RelationCase& c : read_relation_golden(golden_folder())) {
    if (!expected.contains(c.function)) {
      EXPECT_EQ(c.function.find("offset"), std::string::npos) << c.function;
      continue;
    }
    SCOPED_TRACE(c.id);
    ++seen[c.function];
    const auto tape = build_tape(offset_scene(c));
    for (const RelationSample& s : c.samples) {
      SCOPED_TRACE(::testing::PrintToString(s.x()));
      expect_sample(*tape, s);
      ++samples;
      if (s.gradient() == nullptr) ++ties;
    }
  }
  EXPECT_EQ(seen, expected);
  EXPECT_EQ(samples, 110u);
  EXPECT_EQ(ties, 1u);
}

TEST(GoldenOffsets, ComparisonsRefuseWhatIsOff) {
  EXPECT_TRUE(agrees(2.0, 2.0 + 1.9e-12, 1e-12, 2.0));
  EXPECT_FALSE(agrees(2.0, 2.0 + 2.1e-12, 1e-12, 2.0));
}

}  // namespace
}  // namespace blendwright::test
