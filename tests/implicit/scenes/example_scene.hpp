#pragma once
// The scenes of examples/scenes and what the tests of their criteria share: fields of their nodes, and
// numbers as the papers print them.
#include <gtest/gtest.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "implicit/scene/scene.hpp"

namespace blendwright::test {

/// Any function of points, a batch at a time.
using PointFunction = std::function<std::vector<double>(std::span<const Vec3>)>;

/// The field's values.
[[nodiscard]] PointFunction values(const ScalarField& field);
/// inside() of the field's level: positive in the solid.
[[nodiscard]] PointFunction depth(const ScalarField& field);

/// One file of examples/scenes.
class ExampleScene {
 public:
  /// `name` without folder and ending. Throws like the scene reader.
  explicit ExampleScene(const std::string& name);
  explicit ExampleScene(SceneSpec spec) : spec_(std::move(spec)) {}
  [[nodiscard]] const SceneSpec& spec() const { return spec_; }
  /// The field of one node.
  [[nodiscard]] ScalarField field(const std::string& node) const;
  [[nodiscard]] ScalarField field() const { return field(spec_.solid); }
  /// The nodes that no other node uses, in the order of the file: what the scene shows.
  [[nodiscard]] std::vector<std::string> solids() const;
  /// The same scene with another number in a node.
  [[nodiscard]] ExampleScene with(const std::string& node, const std::string& key, double number) const;

 private:
  SceneSpec spec_;
};

/// All files of examples/scenes, in the order of their names.
[[nodiscard]] std::vector<std::string> example_scenes();

/// Whether the value rounds to the printed digits: it is within half a unit of the last one.
[[nodiscard]] ::testing::AssertionResult prints_as(double value, std::string_view digits);

}  // namespace blendwright::test
