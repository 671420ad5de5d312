#include "app/json/schema_parts.hpp"

#include <limits>

namespace blendwright::schema_parts {

Value reference(const std::string& name) { return Value::object({{"$ref", "#/$defs/" + name}}); }
Value typed(const char* type) { return Value::object({{"type", type}}); }
Value either(std::initializer_list<Value> options) {
  return Value::object({{"anyOf", Value::array(options)}});
}
Value list_of(Value item) { return Value::object({{"type", "array"}, {"items", std::move(item)}}); }
Value list_of(Value item, std::size_t least) {
  Value v = list_of(std::move(item));
  v.add("minItems", least);
  return v;
}
Value exactly(Value item, std::size_t count) {
  Value v = list_of(std::move(item), count);
  v.add("maxItems", count);
  return v;
}
Value map_of(Value item) {
  return Value::object({{"type", "object"}, {"additionalProperties", std::move(item)}});
}

std::string definition(std::string name) {
  for (char& c : name)
    if (c == ' ') c = '.';
  return name;
}

Value number_within(const KeyInfo& key) {
  constexpr double largest = std::numeric_limits<double>::max();
  if (!(key.min > -largest) && !(key.max < largest)) return reference("number");
  Value limited = typed("number");
  if (key.min > -largest) limited.add(key.min_allowed ? "minimum" : "exclusiveMinimum", key.min);
  if (key.max < largest) limited.add("maximum", key.max);
  return either({limited, reference("constant_formula")});
}

Value common_types() {
  const Value number = reference("number");
  return Value::object({
      {"constant_formula",
       Value::object({{"type", "string"}, {"description", "a constant formula such as \"2*pi\""}})},
      {"number", either({typed("number"), reference("constant_formula")})},
      {"text", typed("string")},
      {"boolean", typed("boolean")},
      {"point", exactly(number, 3)},
      {"formula", Value::object({{"type", Value::array({"string", "number"})},
                                 {"description", "a formula such as \"r*cos(v)\""}})},
      {"constants", map_of(number)},
  });
}

Value family_schema(const WordFamily& family) {
  Value v = Value::object({{"description", family.description}});
  Value::Array options;
  for (const Word& w : family.words) {
    Value option = Value::object({{"const", w.name}});
    if (!w.description.empty()) option.add("description", w.description);
    options.push_back(std::move(option));
  }
  v.add("oneOf", std::move(options));
  return v;
}

Value by_kind(const char* what, const std::vector<std::string>& kinds) {
  Value::Array names, cases;
  for (const std::string& kind : kinds) {
    names.emplace_back(kind);
    const Value is =
        Value::object({{"properties", Value::object({{"kind", Value::object({{"const", kind}})}})}});
    cases.push_back(
        Value::object({{"if", is}, {"then", reference(definition(std::string(what) + " " + kind))}}));
  }
  return Value::object(
      {{"type", "object"},
       {"required", Value::array({"kind"})},
       {"properties", Value::object({{"kind", Value::object({{"enum", std::move(names)}})}})},
       {"allOf", std::move(cases)}});
}

Value schema_head(const char* title) {
  return Value::object({{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}});
}

}  // namespace blendwright::schema_parts
