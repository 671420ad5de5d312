#pragma once
// A scene as plain data: named nodes that refer to each other by name. This is what a scene file says, and
// what a C++ program writes; build_scene() checks it and turns it into a field.
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "kernel/base/units.hpp"

namespace blendwright {

/// Another node of the scene.
struct NodeRef {
  std::string name;
  bool operator==(const NodeRef&) const = default;
};

/// A number (lengths in the scene's unit, angles in degrees under keys that end in _deg), a word or formula,
/// a point or list of numbers, a list of points or matrix rows, formulas, one node, several nodes. Where a node
/// is meant, a text is its name.
using NodeValue = std::variant<double, std::string, std::vector<double>, std::vector<std::vector<double>>,
                               std::vector<std::string>, NodeRef, std::vector<NodeRef>>;

struct NodeSpec {
  std::string name;  ///< unique in the scene
  std::string kind;  ///< a row of node_kinds()
  std::map<std::string, NodeValue> values;
  std::string where{};  ///< JSON pointer of the node, for messages; empty: "/nodes/<name>"
  bool operator==(const NodeSpec&) const = default;
};

struct SceneSpec {
  LengthUnit unit = LengthUnit::millimetre;
  /// Whether a scene that is legal but probably not meant (an erosion that cuts through, a contour inside its
  /// object) is an error; a warning otherwise.
  bool strict = true;
  std::vector<NodeSpec> nodes;  ///< in any order
  std::string solid;            ///< the node whose solid is meant
  bool operator==(const SceneSpec&) const = default;
};

}  // namespace blendwright
