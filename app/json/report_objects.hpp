#pragma once
// A report's objects as tables of fields: the writer calls them, the schema lists them.
#include <span>
#include <string>
#include <vector>

#include "app/json/job_keys.hpp"
#include "app/json/json_value.hpp"
#include "verify/report/blend_report.hpp"

namespace blendwright {

/// One figure of an object of type T. `type`: an object of the report or "number", "integer", "text",
/// "boolean", "point", "any" ("... or null" and "list of ..." are spelled out).
template <class T>
struct Field {
  const char* name;
  const char* type;
  const char* description;
  JsonValue (*value)(const T&);
};

template <class T>
[[nodiscard]] JsonValue written(const T& x, std::span<const Field<T>> fields) {
  JsonValue object{JsonValue::Object()};
  for (const Field<T>& f : fields) object.add(f.name, f.value(x));
  return object;
}

template <class T>
[[nodiscard]] ObjectInfo object_info(std::string name, std::string description,
                                     std::span<const Field<T>> fields) {
  ObjectInfo info{std::move(name), std::move(description), {}};
  for (const Field<T>& f : fields) info.keys.push_back({f.name, f.type, f.description, true});
  return info;
}

[[nodiscard]] JsonValue extreme_json(const Extreme& extreme);
[[nodiscard]] JsonValue fairness_json(const FairnessReport& fairness);
[[nodiscard]] ObjectInfo fairness_object();
[[nodiscard]] JsonValue second_json(const BlendReport::Second& second);
[[nodiscard]] std::vector<ObjectInfo> second_objects();

/// Every object of a report; the first is the report itself.
[[nodiscard]] const std::vector<ObjectInfo>& report_objects();

}  // namespace blendwright
