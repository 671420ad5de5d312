#include "app/json/scene_keys.hpp"

#include <cmath>
#include <stdexcept>

#include "app/json/object_reader.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using Type = NodeParam::Type;

bool is_numeric(const NodeParam& p) {
  return p.type == Type::number || p.type == Type::integer || p.type == Type::number_or_contour;
}

/// What the value is when the key is left out; empty: there is no default.
std::string default_of(const NodeParam& p) {
  if (is_numeric(p)) return std::isnan(p.info.fallback) ? "" : number_text(p.info.fallback);
  return p.type == Type::word && !p.required ? std::string(p.words.front()) : "";
}

}  // namespace

const ObjectInfo& scene_object() {
  static const ObjectInfo scene{
      "scene",
      "A scene of blendwright: named nodes that make a solid",
      {{"$schema", "text", "for editors"},
       {"description", "text", "for people"},
       {"unit", "unit", "unit of all lengths; default mm"},
       {"strict", "boolean",
        "false: what is legal but probably not meant is a warning instead of an error; default true"},
       {"let", "constants", "named constants for formulas; later ones may use earlier ones"},
       {"nodes", "nodes", "nodes by name, in any order"},
       {"solid", "node", "the node whose solid is meant: its name, or the node itself", true},
       {"adjust", "adjust",
        "numbers that \"view\" has sliders for: node/key, or node/key/index of a list, and the lowest and "
        "highest value"}}};
  return scene;
}

bool is_required(const NodeParam& p) { return is_numeric(p) ? std::isnan(p.info.fallback) : p.required; }

std::string type_text(const NodeParam& p) {
  const std::string n = std::to_string(p.count);
  switch (p.type) {
    case Type::number:
      return "a number";
    case Type::integer:
      return "a whole number";
    case Type::word:
      return listed({p.words.begin(), p.words.end()});
    case Type::point:
      return "a point [x, y, z]";
    case Type::points:
      return "a list of points [x, y, z]";
    case Type::numbers:
      return p.count == 0 ? "a list of numbers" : "a list of " + n + " numbers";
    case Type::rows:
      return n + " rows of " + std::to_string(p.columns) + " numbers";
    case Type::formulas:
      return "a list of " + n + " formulas of t";
    case Type::node:
      return "a node: its name or an object";
    case Type::nodes:
      return "a list of nodes: names or objects";
    case Type::number_or_contour:
      return "a number or {\"contour\": node}";
  }
  throw std::logic_error("type of a node's parameter");
}

ObjectInfo node_object(const NodeKind& kind) {
  ObjectInfo object{"node " + std::string(kind.name), std::string(kind.description), {}};
  object.keys.push_back({"kind", "node_kind", "the node's kind", true});
  for (const NodeParam& p : kind.params) {
    const std::string fallback = default_of(p);
    object.keys.push_back(
        {std::string(p.info.name), type_text(p),
         std::string(p.info.description) + (fallback.empty() ? "" : "; default " + fallback), is_required(p),
         p.info.min, p.info.min_allowed, p.info.max});
  }
  return object;
}

}  // namespace blendwright
