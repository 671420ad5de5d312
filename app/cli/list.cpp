#include <algorithm>

#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/choices.hpp"
#include "app/json/job_keys.hpp"
#include "app/json/json_value.hpp"
#include "verify/report/blend_report.hpp"

namespace blendwright {
namespace {

/// A row as `list` shows it.
struct Row {
  std::string name, description, keys;
};
using Rows = std::vector<Row>;

Rows words(std::string_view family) {
  Rows rows;
  for (const Word& w : word_family(family).words)
    rows.push_back({std::string(w.name), std::string(w.description), ""});
  return rows;
}

std::string key_names(const ObjectInfo& object) {
  std::string keys;
  for (const KeyInfo& k : object.keys) {
    if (k.name == "kind" || k.name == "axis" || k.name == "placement") continue;
    keys += (keys.empty() ? "" : ", ") + k.name;
  }
  return keys;
}

Rows primaries() {
  Rows rows;
  for (const std::string& kind : primary_kinds()) {
    const ObjectInfo& object = job_object("primary " + kind);
    rows.push_back({kind, object.description, key_names(object)});
  }
  return rows;
}

Rows trimlines() {
  Rows rows = words("trimline");
  for (Row& row : rows) row.keys = key_names(job_object("trimline " + row.name));
  return rows;
}

Rows shapes() {
  Rows rows;
  for (const KeyInfo& k : job_object("shape").keys) rows.push_back({k.name, k.description, ""});
  return rows;
}

Rows checks() {
  Rows rows;
  for (const CheckInfo& c : checks_table())
    rows.push_back({std::string(c.name), std::string(c.description), ""});
  return rows;
}

struct Family {
  const char* name;
  Rows (*rows)();
};
constexpr Family families[] = {
    {"primaries", primaries},
    {"trimlines", trimlines},
    {"magnitudes", [] { return words("magnitude_rule"); }},
    {"shapes", shapes},
    {"exporters", [] { return words("format"); }},
    {"checks", checks},
    {"families", [] { return words("family"); }},
};

}  // namespace

std::vector<std::string> listed_families() {
  std::vector<std::string> names;
  for (const Family& f : families) names.emplace_back(f.name);
  return names;
}

int list(const ListCommand& command, const Console& console) {
  return guarded(console, "list " + command.family, [&] {
    const auto family = std::find_if(std::begin(families), std::end(families),
                                     [&](const Family& f) { return f.name == command.family; });
    if (family == std::end(families)) throw InputError("", "there is no family of this name");
    if (command.json) {
      JsonValue::Array rows;
      for (const Row& r : family->rows()) {
        rows.push_back(JsonValue::object({{"name", r.name}, {"description", r.description}}));
        if (!r.keys.empty()) rows.back().add("keys", r.keys);
      }
      console.out() << json_text(std::move(rows));
      return exit_done;
    }
    TextRows table;
    for (const Row& r : family->rows()) {
      table.push_back({r.name, r.description});
      if (!r.keys.empty()) table.push_back({"", "keys: " + r.keys});
    }
    console.out() << aligned(table);
    return exit_done;
  });
}

}  // namespace blendwright
