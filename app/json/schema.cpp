// JSON Schema (draft 2020-12) from the tables that the reader and the report writer use.
#include "app/json/job_reader.hpp"
#include "app/json/report_objects.hpp"
#include "app/json/schema_parts.hpp"

namespace blendwright {
namespace {

using namespace schema_parts;

/// The types that only jobs have.
void add_job_types(Value& definitions) {
  const Value number = reference("number"), formula = reference("formula");
  const Value types = Value::object({
      {"numbers", list_of(number)},
      {"range", exactly(number, 2)},
      {"number_or_3", either({number, exactly(number, 3)})},
      {"formulas2", exactly(formula, 2)},
      {"formulas3", exactly(formula, 3)},
      {"points2", list_of(exactly(number, 2), 2)},
      {"points3", list_of(exactly(number, 3), 2)},
      {"grid", list_of(list_of(exactly(number, 3), 2), 2)},
      {"degrees", exactly(Value::object({{"type", "integer"}, {"minimum", 1}, {"maximum", 25}}), 2)},
      {"knots", exactly(list_of(number), 2)},
      {"closed_pair", exactly(typed("boolean"), 2)},
      {"law", either({number, list_of(exactly(number, 2), 2)})},
      {"booleans", either({typed("boolean"), exactly(typed("boolean"), 2)})},
      {"counts", either({number, exactly(number, 2)})},
      {"points", list_of(exactly(number, 3), 1)},
      {"objectives", list_of(reference("objective"), 1)},
      {"pairs", list_of(exactly(number, 2), 1)},
      {"shifts", list_of(exactly(number, 3), 1)},
      {"axes", exactly(exactly(number, 3), 3)},
      {"frame_or_axes", either({reference("frame"), reference("frame_axes")})},
      {"formats", list_of(reference("format"), 1)},
      {"primaries", map_of(reference("primary"))},
      {"blends", map_of(reference("blend"))},
  });
  for (const JsonMember& m : *types.members()) definitions.add(m.key, m.value);
}

Value job_property(const KeyInfo& key) {
  if (key.type == "number") return number_within(key);
  if (key.type == "trimline" || key.type == "objective") return reference(key.type + "_kind");
  if (key.type == "trimline_object") return reference("trimline");
  return reference(key.type);
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
  if (type == "seconds") return map_of(typed("number"));
  if (type == "point") return exactly(report_type("number"), 3);
  return reference(type);
}

}  // namespace

std::string job_schema() {
  const ObjectInfo& job = job_object("job");
  Value schema = schema_head("blendwright job");
  const Value root = object_schema(job, job_property);
  for (const JsonMember& m : *root.members()) schema.add(m.key, m.value);

  Value definitions = common_types();
  add_job_types(definitions);
  for (const WordFamily& f : word_families())
    definitions.add(std::string(f.name) + (f.name == "trimline" || f.name == "objective" ? "_kind" : ""),
                    family_schema(f));
  Value::Array kinds;
  for (const std::string& kind : primary_kinds()) kinds.emplace_back(kind);
  definitions.add("primary_kind", Value::object({{"enum", std::move(kinds)}}));
  definitions.add("primary", by_kind("primary", primary_kinds()));
  std::vector<std::string> trimlines;
  for (const auto& kind : trimline_choices()) trimlines.emplace_back(kind.name);
  definitions.add("trimline", by_kind("trimline", trimlines));
  std::vector<std::string> objectives;
  for (const auto& kind : objective_choices()) objectives.emplace_back(kind.name);
  definitions.add("objective", by_kind("objective", objectives));
  for (const ObjectInfo& object : job_objects())
    if (object.name != "job") definitions.add(definition(object.name), object_schema(object, job_property));
  schema.add("$defs", std::move(definitions));
  return json_text(schema);
}

std::string report_schema() { return schema_parts::report_schema_of("blendwright report", report_objects()); }

namespace schema_parts {

std::string report_schema_of(const char* title, const std::vector<ObjectInfo>& objects) {
  const auto property = [](const KeyInfo& key) { return report_type(key.type); };
  Value schema = schema_head(title);
  const Value root = object_schema(objects.front(), property);
  for (const JsonMember& m : *root.members()) schema.add(m.key, m.value);
  Value definitions{Value::Object()};
  for (std::size_t i = 1; i < objects.size(); ++i)
    definitions.add(objects[i].name, object_schema(objects[i], property));
  schema.add("$defs", std::move(definitions));
  return json_text(schema);
}

}  // namespace schema_parts
}  // namespace blendwright
