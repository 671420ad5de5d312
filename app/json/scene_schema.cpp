// The schema of a scene, from the rows of node_kinds().
#include <algorithm>
#include <stdexcept>

#include "app/json/scene_keys.hpp"
#include "app/json/scene_reader.hpp"
#include "app/json/schema_parts.hpp"

namespace blendwright {
namespace {

using namespace schema_parts;
using Type = NodeParam::Type;

Value closed_object(const char* key, Value value) {
  return Value::object({{"type", "object"},
                        {"properties", Value::object({{key, std::move(value)}})},
                        {"required", Value::array({key})},
                        {"additionalProperties", false}});
}

Value words_schema(std::span<const std::string_view> words) {
  Value::Array all;
  for (const std::string_view word : words) all.emplace_back(word);
  return Value::object({{"enum", std::move(all)}});
}

Value param_schema(const NodeParam& p, const KeyInfo& key) {
  const Value number = reference("number"), node = reference("node");
  switch (p.type) {
    case Type::number:
    case Type::integer:  // whether a formula gives a whole number is beyond a schema
      return number_within(key);
    case Type::word:
      return words_schema(p.words);
    case Type::point:
      return reference("point");
    case Type::points:
      return list_of(reference("point"), 1);
    case Type::numbers:
      return p.count == 0 ? list_of(number, 1) : exactly(number, p.count);
    case Type::rows:
      return exactly(exactly(number, p.columns), p.count);
    case Type::formulas:
      return exactly(reference("formula"), p.count);
    case Type::node:
      return node;
    case Type::nodes:
      return list_of(node, std::max<std::size_t>(p.count, 1));
    case Type::number_or_contour:
      return either({number_within(key), closed_object("contour", node)});
  }
  throw std::logic_error("type of a node's parameter");
}

Value node_schema(const NodeKind& kind) {
  const auto property = [&](const KeyInfo& key) {
    for (const NodeParam& p : kind.params)
      if (p.info.name == key.name) return param_schema(p, key);
    return reference("node_kind");
  };
  Value schema = object_schema(node_object(kind), property);
  schema.add("title", kind.equation);
  return schema;
}

}  // namespace

std::string scene_schema() {
  Value schema = schema_head("blendwright scene");
  const Value root = object_schema(scene_object(), [](const KeyInfo& key) { return reference(key.type); });
  for (const JsonMember& m : *root.members()) schema.add(m.key, m.value);

  Value definitions = common_types();
  definitions.add("unit", family_schema(word_family("unit")));
  definitions.add("adjust", map_of(exactly(reference("number"), 2)));
  definitions.add("nodes", map_of(reference("node_object")));
  definitions.add("node", either({Value::object({{"type", "string"}, {"description", "the name of a node"}}),
                                  reference("node_object")}));
  std::vector<std::string> kinds;
  Value::Array names;
  for (const NodeKind* kind : node_kinds()) {
    kinds.emplace_back(kind->name);
    names.emplace_back(kind->name);
  }
  definitions.add("node_kind", Value::object({{"enum", std::move(names)}}));
  definitions.add("node_object", by_kind("node", kinds));
  for (const NodeKind* kind : node_kinds())
    definitions.add(definition("node " + std::string(kind->name)), node_schema(*kind));
  schema.add("$defs", std::move(definitions));
  return json_text(schema);
}

}  // namespace blendwright
