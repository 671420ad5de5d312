#include "app/json/job_reader.hpp"

#include <algorithm>

#include "app/json/job_parts.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

void read_tolerance(const JsonValue& value, const std::string& where, Tolerance& tolerance,
                    Reading& reading) {
  ObjectReader object(value, where, job_object("tolerance"), reading);
  if (const auto x = object.number("position")) tolerance.position = *x;
  if (const auto x = object.number("angle_deg")) tolerance.angle = degrees(*x);
  if (const auto x = object.number("curvature")) tolerance.curvature = *x;
}

void read_output(const JsonValue& value, const std::string& where, OutputSpec& output, Reading& reading) {
  ObjectReader object(value, where, job_object("output"), reading);
  if (const auto schema = object.choice("step_schema", step_schema_choices())) output.step_schema = *schema;
  const JsonValue* formats = object.find("formats");
  if (!formats) return;
  if (!formats->items() || formats->items()->empty()) {
    object.problem("formats",
                   described(*formats) + ", must be a list of formats such as [\"step\", \"vtp\"]");
    return;
  }
  output.formats.clear();
  for (std::size_t i = 0; i < formats->items()->size(); ++i) {
    const std::string at = object.at("formats") + "/" + std::to_string(i);
    const auto format = reading.choice((*formats->items())[i], at, format_choices());
    if (!format) continue;
    if (std::find(output.formats.begin(), output.formats.end(), *format) != output.formats.end())
      reading.problem(at, "appears twice; remove one");
    output.formats.push_back(*format);
  }
}

KnownPrimaries read_primaries(ObjectReader& object, JobSpec& job, Reading& reading) {
  KnownPrimaries known;
  for (const JsonMember& m : named(object, "primaries", reading)) {
    const std::string where = object.at("primaries") + "/" + pointer_part(m.key);
    job.primaries.push_back(read_primary(m.key, m.value, where, reading));
    known[m.key] = known_primary(job.primaries.back());
  }
  return known;
}

void read_blends(ObjectReader& object, const KnownPrimaries& known, JobSpec& job, Reading& reading) {
  const auto& blends = named(object, "blends", reading);
  if (object.has("blends") && object.find("blends")->members() && blends.empty())
    object.problem("blends", "is empty, must have at least one blend");
  for (const JsonMember& m : blends) {
    const std::string where = object.at("blends") + "/" + pointer_part(m.key);
    if (known.count(m.key) > 0)
      reading.problem(where, "has the name of a primary; names of blends and primaries must differ");
    job.blends.push_back(read_blend(m.key, m.value, where, known, reading));
  }
}

}  // namespace

JobSpec read_job(std::string_view text, const std::filesystem::path& file) {
  const JsonValue root = parse_json(text, R"(the shortest job has "primaries" and "blends")");
  Reading reading;
  JobSpec job;
  job.name = file == "-" ? "job" : file.stem().string();
  job.folder = file.parent_path();
  job.source_hash = hash_text(text);
  ObjectReader object(root, "", job_object("job"), reading);
  if (root.members()) {
    job.unit = object.choice("unit", unit_choices()).value_or(LengthUnit::millimetre);
    object.text("$schema");
    object.text("description");
    read_constants(object, {"u", "v"}, reading);
    job.constants = reading.constants;
    const KnownPrimaries known = read_primaries(object, job, reading);
    read_blends(object, known, job, reading);
    if (const JsonValue* tolerance = object.find("tolerance"))
      read_tolerance(*tolerance, object.at("tolerance"), job.tolerance, reading);
    if (const JsonValue* output = object.find("output"))
      read_output(*output, object.at("output"), job.output, reading);
  }
  reading.finish(root);
  return job;
}

JobSpec read_job_file(const std::filesystem::path& file) { return read_job(read_json_text(file), file); }

}  // namespace blendwright
