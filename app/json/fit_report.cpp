#include "app/json/fit_report.hpp"

#include "app/json/choices.hpp"
#include "app/json/report_objects.hpp"
#include "app/json/schema_parts.hpp"
#include "app/pipeline/write_outputs.hpp"

namespace blendwright {
namespace {

struct Report {
  const JobSpec& job;
  const FitJobResult& result;
  const std::vector<WrittenFile>& files;
};

template <class T>
JsonValue all(const std::vector<T>& items, std::span<const Field<T>> fields) {
  JsonValue::Array list;
  for (const T& item : items) list.push_back(written<T>(item, fields));
  return list;
}

JsonValue texts(const std::vector<std::string>& items) {
  return JsonValue::Array(items.begin(), items.end());
}
JsonValue numbers(const std::vector<double>& items) { return JsonValue::Array(items.begin(), items.end()); }

constexpr Field<FittedParameter> parameter_fields[] = {
    {"name", "text", "what it is, as in a job", [](const FittedParameter& p) { return JsonValue(p.name); }},
    {"start", "number", "value before", [](const FittedParameter& p) { return JsonValue(p.start); }},
    {"value", "number", "value after", [](const FittedParameter& p) { return JsonValue(p.value); }},
    {"change", "number", "how much it changed",
     [](const FittedParameter& p) { return JsonValue(p.value - p.start); }},
    {"deviation", "number", "standard deviation; null: not determined",
     [](const FittedParameter& p) { return JsonValue(p.deviation); }},
    {"lowest", "number", "its lower bound", [](const FittedParameter& p) { return JsonValue(p.bounds.lo); }},
    {"highest", "number", "its upper bound", [](const FittedParameter& p) { return JsonValue(p.bounds.hi); }},
    {"at_bound", "boolean", "whether a bound holds it",
     [](const FittedParameter& p) { return JsonValue(p.at_bound); }}};

constexpr Field<ObjectiveChange> objective_fields[] = {
    {"name", "text", "what is wanted", [](const ObjectiveChange& o) { return JsonValue(o.name); }},
    {"weight", "number", "how much it counts", [](const ObjectiveChange& o) { return JsonValue(o.weight); }},
    {"measure", "text", "what before and after are",
     [](const ObjectiveChange& o) { return JsonValue(o.measure); }},
    {"unit", "text", "their unit", [](const ObjectiveChange& o) { return JsonValue(o.unit); }},
    {"before", "number", "at the start", [](const ObjectiveChange& o) { return JsonValue(o.before); }},
    {"after", "number", "of the result", [](const ObjectiveChange& o) { return JsonValue(o.after); }},
    {"fulfilled", "boolean", "whether its target is met; true for those without one",
     [](const ObjectiveChange& o) { return JsonValue(o.fulfilled); }}};

constexpr Field<FittedBlend> blend_fields[] = {
    {"name", "text", "name of the blend", [](const FittedBlend& b) { return JsonValue(b.name); }},
    {"fulfilled", "boolean", "every objective that has a target meets it",
     [](const FittedBlend& b) { return JsonValue(b.fulfilled()); }},
    {"converged", "boolean", "whether the last steps no longer changed anything",
     [](const FittedBlend& b) { return JsonValue(b.fit.converged); }},
    {"objectives", "list of objective", "what is wanted, before and after",
     [](const FittedBlend& b) { return all<ObjectiveChange>(b.fit.objectives, objective_fields); }},
    {"parameters", "list of parameter", "what changed, and by how much",
     [](const FittedBlend& b) { return all<FittedParameter>(b.fit.parameters, parameter_fields); }},
    {"costs", "list of number", "what was minimised: at the start, and after each iteration",
     [](const FittedBlend& b) { return numbers(b.fit.costs); }},
    {"condition", "number", "of the scaled Jacobian; null: infinite",
     [](const FittedBlend& b) { return JsonValue(b.fit.condition); }},
    {"singular_values", "list of number", "of the scaled Jacobian",
     [](const FittedBlend& b) { return numbers(b.fit.singular_values); }},
    {"not_unique", "list of text", "what the objectives leave open",
     [](const FittedBlend& b) { return texts(b.fit.not_unique); }},
    {"warnings", "list of text", "bounds that hold something, objectives that are not met",
     [](const FittedBlend& b) { return texts(b.warnings); }}};

constexpr Field<WrittenFile> file_fields[] = {
    {"path", "text", "where it is", [](const WrittenFile& f) { return JsonValue(f.path.string()); }},
    {"kind", "text", "what it is", [](const WrittenFile& f) { return JsonValue(f.kind); }},
    {"bytes", "integer", "its size", [](const WrittenFile& f) { return JsonValue(f.bytes); }}};

constexpr Field<Report> report_fields[] = {
    {"program", "text", "name and version",
     [](const Report&) { return JsonValue("blendwright " BLENDWRIGHT_VERSION); }},
    {"job", "text", "name of the job", [](const Report& r) { return JsonValue(r.job.name); }},
    {"source_hash", "text", "of the job's text",
     [](const Report& r) { return JsonValue(r.job.source_hash); }},
    {"unit", "text", "unit of all lengths",
     [](const Report& r) { return JsonValue(word_for(unit_choices(), r.job.unit)); }},
    {"fulfilled", "boolean", "every objective that has a target meets it",
     [](const Report& r) { return JsonValue(r.result.fulfilled()); }},
    {"verified", "boolean", "the fitted blends reach the continuity that was asked of them",
     [](const Report& r) { return JsonValue(verified(r.result.verified)); }},
    {"blends", "list of fitted_blend", "the blends that were fitted",
     [](const Report& r) { return all<FittedBlend>(r.result.blends, blend_fields); }},
    {"files", "list of file", "what was written",
     [](const Report& r) { return all<WrittenFile>(r.files, file_fields); }}};

}  // namespace

std::string fit_report_json(const JobSpec& job, const FitJobResult& result,
                            const std::vector<WrittenFile>& files, bool times) {
  JsonValue report = written<Report>({job, result, files}, report_fields);
  if (times) {
    JsonValue seconds{JsonValue::Object()};
    for (const StageTime& t : result.times) seconds.add(t.stage, t.seconds);
    report.add("times", std::move(seconds));
  }
  return json_text(report);
}

const std::vector<ObjectInfo>& fit_report_objects() {
  static const std::vector<ObjectInfo> objects = [] {
    ObjectInfo report = object_info<Report>("fit_report", "What a fit changed", report_fields);
    report.keys.push_back({"times", "seconds", "only when clock readings were asked for"});
    return std::vector<ObjectInfo>{
        report, object_info<FittedBlend>("fitted_blend", "One fitted blend", blend_fields),
        object_info<ObjectiveChange>("objective", "One objective", objective_fields),
        object_info<FittedParameter>("parameter", "One unknown", parameter_fields),
        object_info<WrittenFile>("file", "One file", file_fields)};
  }();
  return objects;
}

std::string fit_report_schema() {
  return schema_parts::report_schema_of("blendwright fit report", fit_report_objects());
}

}  // namespace blendwright
