// JSON Schema (draft 2020-12) from the tables that the reader and the report writer use.
#include <cmath>

#include "app/json/choices.hpp"
#include "app/json/job_keys.hpp"
#include "app/json/job_reader.hpp"
#include "app/json/report_objects.hpp"

namespace blendwright {
namespace {

using Value = JsonValue;

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

/// Names with blanks become "primary.cylinder".
std::string definition(std::string name) {
  for (char& c : name)
    if (c == ' ') c = '.';
  return name;
}

/// A number within limits, or a constant formula (whose value the reader checks).
Value number_within(const KeyInfo& key) {
  constexpr double largest = std::numeric_limits<double>::max();
  if (!(key.min > -largest) && !(key.max < largest)) return reference("number");
  Value limited = typed("number");
  if (key.min > -largest) limited.add(key.min_allowed ? "minimum" : "exclusiveMinimum", key.min);
  if (key.max < largest) limited.add("maximum", key.max);
  return either({limited, reference("constant_formula")});
}

/// The basic types of a job's keys.
Value basic_types() {
  const Value number = reference("number"), formula = reference("formula");
  return Value::object({
      {"constant_formula",
       Value::object({{"type", "string"}, {"description", "a constant formula such as \"2*pi\""}})},
      {"number", either({typed("number"), reference("constant_formula")})},
      {"text", typed("string")},
      {"boolean", typed("boolean")},
      {"numbers", list_of(number)},
      {"point", exactly(number, 3)},
      {"range", exactly(number, 2)},
      {"number_or_3", either({number, exactly(number, 3)})},
      {"formula", Value::object({{"type", Value::array({"string", "number"})},
                                 {"description", "a formula such as \"r*cos(v)\""}})},
      {"formulas2", exactly(formula, 2)},
      {"formulas3", exactly(formula, 3)},
      {"points2", list_of(exactly(number, 2), 2)},
      {"points3", list_of(exactly(number, 3), 2)},
      {"grid", list_of(list_of(exactly(number, 3), 2), 2)},
      {"degrees", exactly(Value::object({{"type", "integer"}, {"minimum", 1}, {"maximum", 25}}), 2)},
      {"knots", exactly(list_of(number), 2)},
      {"closed_pair", exactly(typed("boolean"), 2)},
      {"law", either({number, list_of(exactly(number, 2), 2)})},
      {"axes", exactly(exactly(number, 3), 3)},
      {"frame_or_axes", either({reference("frame"), reference("frame_axes")})},
      {"formats", list_of(reference("format"), 1)},
      {"constants", map_of(number)},
      {"primaries", map_of(reference("primary"))},
      {"blends", map_of(reference("blend"))},
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

template <class Property>
Value object_schema(const ObjectInfo& object, Property property) {
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

Value job_property(const KeyInfo& key) {
  if (key.type == "number") return number_within(key);
  if (key.type == "trimline") return reference("trimline_kind");
  if (key.type == "trimline_object") return reference("trimline");
  return reference(key.type);
}

/// An object whose keys depend on its "kind": editors complete the keys of the kind that was typed.
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

/// "text", "list of number", "step or null", or the name of an object of the report.
Value report_type(const std::string& type) {
  const std::string nullable = " or null", list = "list of ";
  if (type.size() > nullable.size() &&
      type.compare(type.size() - nullable.size(), nullable.size(), nullable) == 0)
    return either({report_type(type.substr(0, type.size() - nullable.size())), typed("null")});
  if (type.rfind(list, 0) == 0) return list_of(report_type(type.substr(list.size())));
  if (type == "text") return typed("string");
  if (type == "integer" || type == "boolean") return typed(type.c_str());
  // A figure that is not a number in the end (0/0 at a pole) is null.
  if (type == "number") return Value::object({{"type", Value::array({"number", "null"})}});
  if (type == "point") return exactly(report_type("number"), 3);
  return reference(type);
}

}  // namespace

std::string job_schema() {
  const ObjectInfo& job = job_object("job");
  Value schema = schema_head("blendwright job");
  const Value root = object_schema(job, job_property);
  for (const JsonMember& m : *root.members()) schema.add(m.key, m.value);

  Value definitions = basic_types();
  for (const WordFamily& f : word_families())
    definitions.add(f.name == "trimline" ? "trimline_kind" : std::string(f.name), family_schema(f));
  Value::Array kinds;
  for (const std::string& kind : primary_kinds()) kinds.emplace_back(kind);
  definitions.add("primary_kind", Value::object({{"enum", std::move(kinds)}}));
  definitions.add("primary", by_kind("primary", primary_kinds()));
  std::vector<std::string> trimlines;
  for (const auto& kind : trimline_choices()) trimlines.emplace_back(kind.name);
  definitions.add("trimline", by_kind("trimline", trimlines));
  for (const ObjectInfo& object : job_objects())
    if (object.name != "job") definitions.add(definition(object.name), object_schema(object, job_property));
  schema.add("$defs", std::move(definitions));
  return json_text(schema);
}

std::string report_schema() {
  const auto property = [](const KeyInfo& key) { return report_type(key.type); };
  const auto& objects = report_objects();
  Value schema = schema_head("blendwright report");
  const Value root = object_schema(objects.front(), property);
  for (const JsonMember& m : *root.members()) schema.add(m.key, m.value);
  Value definitions{Value::Object()};
  for (std::size_t i = 1; i < objects.size(); ++i)
    definitions.add(objects[i].name, object_schema(objects[i], property));
  schema.add("$defs", std::move(definitions));
  return json_text(schema);
}

}  // namespace blendwright
