#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/choices.hpp"
#include "app/json/job_keys.hpp"
#include "app/json/json_value.hpp"
#include "app/json/scene_keys.hpp"
#include "app/pipeline/mesh_job.hpp"
#include "verify/report/blend_report.hpp"

namespace blendwright {
namespace {

/// A row as `list` shows it; what is empty is not shown.
struct Row {
  std::string name, description, keys, equation{}, source{}, family{};
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

/// Optional ones in brackets.
std::string param_names(const NodeKind& kind) {
  std::string names;
  for (const NodeParam& p : kind.params) {
    const std::string key(p.info.name);
    names += (names.empty() ? "" : ", ") + (is_required(p) ? key : "[" + key + "]");
  }
  return names;
}

/// The parameters of a kind of node, for programs.
JsonValue params_json(std::string_view kind) {
  JsonValue::Array params;
  for (const KeyInfo& k : node_object(*find_node_kind(kind)).keys)
    if (k.name != "kind")
      params.push_back(JsonValue::object(
          {{"name", k.name}, {"type", k.type}, {"description", k.description}, {"required", k.required}}));
  return params;
}

Rows nodes() {
  Rows rows;
  for (const NodeKind* kind : node_kinds())
    rows.push_back({std::string(kind->name), std::string(kind->description), param_names(*kind),
                    std::string(kind->equation), std::string(kind->source), std::string(name(kind->family))});
  return rows;
}

Rows named_rows(std::span<const NamedRow> all) {
  Rows rows;
  for (const NamedRow& r : all) rows.push_back({std::string(r.name), std::string(r.description), ""});
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
  const char* description;
  Rows (*rows)();
};
constexpr Family families[] = {
    {"primaries", "kinds of primary surface", primaries},
    {"trimlines", "kinds of trimline", trimlines},
    {"continuities", "what a side may be asked to reach", [] { return words("continuity"); }},
    {"magnitudes", "rules for the length of the cross tangent", [] { return words("magnitude_rule"); }},
    {"keeps", "which part of a primary stays", [] { return words("keep"); }},
    {"correspondences", "which points of the trimlines are joined",
     [] { return words("correspondence_rule"); }},
    {"shapes", "controls of a blend's shape", shapes},
    {"modes", "what the sweep equation holds for", [] { return words("mode"); }},
    {"frames", "axes of the coefficients b, c and d", [] { return words("frame"); }},
    {"families", "sixth-order families, for G2", [] { return words("family"); }},
    {"objectives", "what a fit may ask of a blend", [] { return words("objective"); }},
    {"units", "units of length", [] { return words("unit"); }},
    {"exporters", "formats of the output", [] { return words("format"); }},
    {"schemas", "STEP application protocols", [] { return words("step_schema"); }},
    {"checks", "what is measured and judged", checks},
    {"nodes", "kinds of node in a scene of soft objects", nodes},
    {"meshes", "formats that meshes of scenes are written in", [] { return named_rows(mesh_formats()); }},
    {"columns", "what is known of each point of such a mesh", [] { return named_rows(mesh_columns()); }},
};

Rows family_rows() {
  Rows rows;
  for (const Family& f : families) rows.push_back({f.name, f.description, ""});
  return rows;
}

Rows rows_of(const std::string& name) {
  if (name.empty()) return family_rows();
  for (const Family& f : families)
    if (f.name == name) return f.rows();
  throw InputError("", "there is no family of this name");
}

/// What a row has besides its name and description.
std::vector<std::pair<std::string, std::string>> further(const Row& r) {
  std::vector<std::pair<std::string, std::string>> all{
      {"family", r.family}, {"equation", r.equation}, {"keys", r.keys}, {"source", r.source}};
  std::erase_if(all, [](const auto& part) { return part.second.empty(); });
  return all;
}

/// Rows of one family after another, under its name where there is more than one.
void print(const Rows& rows, std::ostream& out) {
  for (std::size_t i = 0; i < rows.size();) {
    const std::string& family = rows[i].family;
    TextRows table;
    for (; i < rows.size() && rows[i].family == family; ++i) {
      table.push_back({rows[i].name, rows[i].description});
      for (const auto& [what, text] : further(rows[i]))
        if (what != "family") table.push_back({"", what + ": " + text});
    }
    if (!family.empty()) out << family << '\n';
    out << aligned(table);
  }
}

}  // namespace

std::vector<std::string> listed_families() {
  std::vector<std::string> names;
  for (const Family& f : families) names.emplace_back(f.name);
  return names;
}

int list(const ListCommand& command, const Console& console) {
  return guarded(console, command.family.empty() ? "list" : "list " + command.family, [&] {
    const Rows rows = rows_of(command.family);
    if (command.json) {
      JsonValue::Array items;
      for (const Row& r : rows) {
        items.push_back(JsonValue::object({{"name", r.name}, {"description", r.description}}));
        for (const auto& [what, text] : further(r)) items.back().add(what, text);
        if (!r.family.empty()) items.back().add("parameters", params_json(r.name));
      }
      console.out() << json_text(std::move(items));
      return exit_done;
    }
    print(rows, console.out());
    return exit_done;
  });
}

}  // namespace blendwright
