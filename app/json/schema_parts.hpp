#pragma once
// Private: what the schemas of jobs, scenes and reports are put together from (JSON Schema, draft 2020-12).
#include <initializer_list>
#include <string>
#include <vector>

#include "app/json/choices.hpp"
#include "app/json/job_keys.hpp"
#include "app/json/json_value.hpp"

namespace blendwright::schema_parts {

using Value = JsonValue;

[[nodiscard]] Value reference(const std::string& name);
[[nodiscard]] Value typed(const char* type);
[[nodiscard]] Value either(std::initializer_list<Value> options);
[[nodiscard]] Value list_of(Value item);
[[nodiscard]] Value list_of(Value item, std::size_t least);
[[nodiscard]] Value exactly(Value item, std::size_t count);
[[nodiscard]] Value map_of(Value item);

/// Names with blanks become "primary.cylinder".
[[nodiscard]] std::string definition(std::string name);
/// A number within the key's limits, or a constant formula (whose value the reader checks).
[[nodiscard]] Value number_within(const KeyInfo& key);
/// Numbers, formulas, texts, constants, points: the types that every file has.
[[nodiscard]] Value common_types();
[[nodiscard]] Value family_schema(const WordFamily& family);
/// An object whose keys depend on its "kind": editors complete the keys of the kind that was typed. Each kind
/// is the definition "<what>.<kind>".
[[nodiscard]] Value by_kind(const char* what, const std::vector<std::string>& kinds);
[[nodiscard]] Value schema_head(const char* title);
/// The schema of a report from its tables; the first object is the report itself.
[[nodiscard]] std::string report_schema_of(const char* title, const std::vector<ObjectInfo>& objects);

template <class Property>
[[nodiscard]] Value object_schema(const ObjectInfo& object, Property property) {
  Value v = Value::object({{"type", "object"}, {"description", object.description}});
  Value properties{Value::Object()};
  Value::Array required;
  for (const KeyInfo& key : object.keys) {
    Value p = property(key);
    if (!key.description.empty()) p.add("description", key.description);
    properties.add(key.name, std::move(p));
    if (key.required) required.emplace_back(key.name);
  }
  v.add("properties", std::move(properties));
  if (!required.empty()) v.add("required", std::move(required));
  v.add("additionalProperties", false);
  return v;
}

}  // namespace blendwright::schema_parts
