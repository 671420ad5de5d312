#include "app/json/job_reader.hpp"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <iterator>
#include <set>

#include "app/json/job_parts.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/math/formula.hpp"

namespace blendwright {
namespace {

/// Names become parts of file names and STEP names.
bool good_name(const std::string& name) {
  return !name.empty() && name.size() <= 60 && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
  });
}

/// The members of an object of named things; reports names that cannot be used.
const JsonValue::Object& named(ObjectReader& job, const char* key, Reading& reading) {
  static const JsonValue::Object none;
  const JsonValue* value = job.find(key);
  if (!value) return none;
  const auto* members = value->members();
  if (!members) {
    job.problem(key, described(*value) + ", must be an object: {\"name\": {...}, ...}");
    return none;
  }
  for (const JsonMember& m : *members)
    if (!good_name(m.key))
      reading.problem(job.at(key) + "/" + pointer_part(m.key),
                      "is named " + in_quotes(m.key) +
                          "; a name must be 1 to 60 of the letters a-z and A-Z, digits, \"_\" and \"-\"");
  return *members;
}

bool parses(const std::string& formula, const std::map<std::string, double>& constants) {
  try {
    [[maybe_unused]] const Formula parsed(formula, {}, constants);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// What is wrong with the name of a constant: a formula must read it as this constant and nothing else.
std::string constant_name_problem(const std::string& name) {
  if (name == "u" || name == "v" || name == "pi" || parses(name + "(1)", {}) || parses(name + "(1, 1)", {}))
    return ", which formulas use already; choose another name";
  if (parses(name, {{name, 1.5}}) && (name == "e" || !parses(name, {}))) return "";
  return "; the name of a constant must be a letter, then letters, digits or \"_\"";
}

void read_constants(ObjectReader& job, Reading& reading) {
  for (const JsonMember& m : named(job, "let", reading)) {
    const std::string where = job.at("let") + "/" + pointer_part(m.key);
    const auto value = reading.number(m.value, where);
    if (!good_name(m.key)) continue;
    const std::string trouble = constant_name_problem(m.key);
    if (!trouble.empty())
      reading.problem(where, "is named " + in_quotes(m.key) + trouble);
    else if (value)
      reading.constants[m.key] = *value;
  }
}

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
  const JsonValue root = parse_json(text);
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
    read_constants(object, reading);
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

JobSpec read_job_file(const std::filesystem::path& file) {
  if (file == "-") {
    std::string text;
    for (char block[65536]; std::cin.read(block, sizeof block), std::cin.gcount() > 0;) {
      text.append(block, static_cast<std::size_t>(std::cin.gcount()));
      if (text.size() > largest_json_text) break;
    }
    return read_job(text, file);
  }
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  if (!error && bytes > largest_json_text)
    throw InputError("", "is larger than " + std::to_string(largest_json_text >> 20) + " MB, the limit");
  return read_job(read_text_file(file, largest_json_text), file);
}

}  // namespace blendwright
