#include "tests/implicit/scenes/example_scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <set>
#include <stdexcept>

#include "app/json/scene_reader.hpp"

namespace blendwright::test {
namespace {

std::filesystem::path folder() { return std::filesystem::path(BLENDWRIGHT_SOURCE_DIR) / "examples/scenes"; }

}  // namespace

PointFunction values(const ScalarField& field) {
  return [field](std::span<const Vec3> points) {
    FieldValues v = field.evaluate(Order::value, points);
    v.data.resize(points.size());
    return std::move(v.data);
  };
}

PointFunction depth(const ScalarField& field) {
  return [field](std::span<const Vec3> points) {
    FieldValues v = field.evaluate(Order::value, points);
    v.data.resize(points.size());
    for (double& x : v.data) x = inside(field.level(), x);
    return std::move(v.data);
  };
}

ExampleScene::ExampleScene(const std::string& name) : spec_(read_scene_file(folder() / (name + ".json"))) {}

ScalarField ExampleScene::field(const std::string& node) const {
  SceneSpec chosen = spec_;
  chosen.solid = node;
  return build_scene(chosen).field;
}

std::vector<std::string> ExampleScene::solids() const {
  std::set<std::string> used;
  for (const NodeSpec& node : spec_.nodes)
    for (const auto& [key, value] : node.values) {
      if (const auto* one = std::get_if<NodeRef>(&value)) used.insert(one->name);
      if (const auto* several = std::get_if<std::vector<NodeRef>>(&value))
        for (const NodeRef& ref : *several) used.insert(ref.name);
    }
  std::vector<std::string> free;
  for (const NodeSpec& node : spec_.nodes)
    if (!used.contains(node.name)) free.push_back(node.name);
  return free;
}

ExampleScene ExampleScene::with(const std::string& node, const std::string& key, double number) const {
  SceneSpec changed = spec_;
  const auto found = std::find_if(changed.nodes.begin(), changed.nodes.end(),
                                  [&](const NodeSpec& n) { return n.name == node; });
  if (found == changed.nodes.end()) throw std::runtime_error("the scene has no node " + node);
  found->values.at(key) = number;
  return ExampleScene(std::move(changed));
}

std::vector<std::string> example_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder()))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

::testing::AssertionResult prints_as(double value, std::string_view digits) {
  const double printed = std::stod(std::string(digits));
  const auto point = digits.find('.');
  const auto decimals = point == std::string_view::npos ? 0 : digits.size() - point - 1;
  // A tie may round either way after the radius search's own rounding.
  const double half_unit = 0.5 * std::pow(10.0, -static_cast<double>(decimals)) + 1e-12;
  if (std::abs(value - printed) <= half_unit) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << std::setprecision(12) << value << " is not " << digits;
}

}  // namespace blendwright::test
