#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/json/job_parts.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

RigidMotion read_motion(ObjectReader& primary, Reading& reading) {
  primary.exclude("placement", "axis", "both place the surface");
  const char* key = primary.has("axis") ? "axis" : "placement";
  const JsonValue* value = primary.find(key);
  if (!value) return {};
  ObjectReader axis(*value, primary.at(key), job_object("axis"), reading);
  const Vec3 origin = axis.point("origin").value_or(Vec3::Zero());
  const auto direction = axis.direction("direction"), x = axis.direction("x_direction");
  if (reading.faulty(axis.where())) return {};
  try {
    return RigidMotion::from_axis(origin, direction.value_or(Vec3::UnitZ()), x.value_or(Vec3::Zero()));
  } catch (const InputError& e) {
    for (const Problem& p : e.problems())
      reading.problem(axis.where() + (p.where.empty() ? "" : "/" + p.where), p.message);
    return {};
  }
}

StepFaceSpec read_step_face(ObjectReader& object, Reading& reading) {
  StepFaceSpec spec;
  spec.file = object.text("file").value_or("");
  if (const JsonValue* value = object.find("select")) {
    ObjectReader select(*value, object.at("select"), job_object("face_selector"), reading);
    if (const JsonValue* kind = select.find("surface")) {
      std::vector<std::string> kinds;
      for (const Word& w : word_family("face_kind").words) kinds.emplace_back(w.name);
      if (const auto i = reading.word(*kind, select.at("surface"), kinds)) spec.select.surface = kinds[*i];
    }
    spec.select.near = select.point("near");
  }
  spec.placement = read_motion(object, reading);
  return spec;
}

/// The kind's formulas, or points to run through where the kind takes them, never both.
void read_profile(ObjectReader& object, const PrimaryInfo& row, PrimarySpec& spec, Reading& reading) {
  const std::string key(row.texts);
  const std::vector<std::string> variables(row.variables.begin(), row.variables.end());
  const auto count = static_cast<std::size_t>(row.text_count);
  spec.formulas = object.formulas(key, count, variables).value_or(std::vector<std::string>());
  if (!row.takes_points) return;
  object.exclude("points", key, "both describe the profile");
  if (!object.has(key) && !object.has("points"))
    object.problem(key, "is missing; must be given, or \"points\"");
  if (const JsonValue* points = object.find("points"))
    spec.points = reading.points(*points, object.at("points"), count).value_or(std::vector<Vec3>());
  spec.points_closed = object.boolean("closed").value_or(false);
}

void read_control_points(ObjectReader& object, PrimarySpec& spec, Reading& reading) {
  const JsonValue* value = object.find("points");
  if (!value) return;
  const auto* rows = value->items();
  if (!rows || rows->size() < 2) {
    object.problem("points", described(*value) + ", must be a list of at least 2 rows of points");
    return;
  }
  std::size_t width = 0;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const std::string where = object.at("points") + "/" + std::to_string(i);
    const auto row = reading.points((*rows)[i], where, 3);
    if (!row) continue;
    if (width == 0) width = row->size();
    if (row->size() != width)
      reading.problem(where, "is a row of " + std::to_string(row->size()) + " points, must have " +
                                 std::to_string(width) + " as the first row");
    spec.points.insert(spec.points.end(), row->begin(), row->end());
  }
  spec.point_rows = static_cast<int>(rows->size());
}

void read_bspline(ObjectReader& object, PrimarySpec& spec, Reading& reading) {
  read_control_points(object, spec, reading);
  if (const JsonValue* degree = object.find("degree")) {
    const auto d = reading.numbers(*degree, object.at("degree"), 2);
    for (std::size_t i = 0; d && i < 2; ++i) {
      if ((*d)[i] >= 1.0 && (*d)[i] <= 25.0 && (*d)[i] == std::floor((*d)[i]))
        spec.degree[i] = static_cast<int>((*d)[i]);
      else
        object.problem("degree", "is [" + number_text((*d)[0]) + ", " + number_text((*d)[1]) +
                                     "], must be two whole numbers from 1 to 25");
    }
  }
  if (const JsonValue* knots = object.find("knots")) {
    const auto* both = knots->items();
    if (!both || both->size() != 2) {
      object.problem("knots", described(*knots) + ", must be two lists of numbers, for u and v");
      return;
    }
    for (std::size_t i = 0; i < 2; ++i)
      spec.knots[i] = reading.numbers((*both)[i], object.at("knots") + "/" + std::to_string(i))
                          .value_or(std::vector<double>());
  }
}

void read_closed_directions(ObjectReader& object, PrimarySpec& spec) {
  const JsonValue* value = object.find("closed");
  if (!value) return;
  const auto* both = value->items();
  if (both && both->size() == 2 && (*both)[0].boolean() && (*both)[1].boolean())
    spec.closed = {*(*both)[0].boolean(), *(*both)[1].boolean()};
  else
    object.problem("closed", described(*value) + ", must be [u, v] with true or false for each");
}

std::optional<Interval> read_domain(ObjectReader& object, const PrimaryInfo& row, std::size_t direction) {
  auto range = object.range(parameter_key(row, direction));
  if (range && row.angular[direction]) range = Interval{degrees(range->lo).value, degrees(range->hi).value};
  return range;
}

PrimarySpec read_formula_primary(ObjectReader& object, const PrimaryInfo& row, Reading& reading) {
  PrimarySpec spec;
  spec.kind = std::string(row.kind);
  spec.constants = reading.constants;
  for (const ParamInfo& p : row.numbers)
    if (const auto x = object.number(p.name)) spec.numbers[std::string(p.name)] = *x;
  if (!row.texts.empty())
    read_profile(object, row, spec, reading);
  else if (row.takes_points)
    read_bspline(object, spec, reading);
  if (closed_by_direction(row)) read_closed_directions(object, spec);
  if (job_object("primary " + spec.kind).find("direction"))
    if (const auto d = object.direction("direction")) spec.direction = *d;
  spec.u = read_domain(object, row, 0);
  spec.v = read_domain(object, row, 1);
  spec.placement = read_motion(object, reading);
  return spec;
}

/// Problems of the spec that reading alone cannot see, under the keys of the file.
void check_whole(const PrimarySpec& spec, const ObjectReader& object, Reading& reading) {
  for (const Problem& p : check(spec)) {
    std::string key = p.where;
    if (key == "closed_u") key = "closed/0";
    if (key == "closed_v") key = "closed/1";
    const std::string where = object.where() + (key.empty() ? "" : "/" + key);
    if (!reading.faulty(where)) reading.problem(where, p.message);
  }
}

/// The length after which the surface repeats in a direction, 0 where it does not.
double period_of(const PrimarySpec& spec, const PrimaryInfo& row, std::size_t i) {
  const auto& given = i == 0 ? spec.u : spec.v;
  const std::optional<Interval> range = given ? given : row.domain[i];
  const auto& knots = spec.knots[i];
  if (spec.closed[i]) return knots.empty() ? (range ? range->length() : 0.0) : knots.back() - knots.front();
  constexpr double turn = 2.0 * std::numbers::pi;
  return row.turns[i] && range && std::abs(range->length() - turn) <= 1e-9 * turn ? turn : 0.0;
}

}  // namespace

KnownPrimary known_primary(const PrimaryEntry& entry) {
  const auto* spec = std::get_if<PrimarySpec>(&entry.spec);
  if (!spec) return {std::string(step_face_kind), {0.0, 0.0}};
  const PrimaryInfo* row = find_primary(spec->kind);
  if (!row) return {};
  return {spec->kind, {period_of(*spec, *row, 0), period_of(*spec, *row, 1)}};
}

PrimaryEntry read_primary(const std::string& name, const JsonValue& value, const std::string& where,
                          Reading& reading) {
  PrimaryEntry entry{name, PrimarySpec()};
  const JsonValue* kind = value.find("kind");
  if (!value.members()) {
    reading.problem(where, described(value) + ", must be an object with \"kind\"");
    return entry;
  }
  if (!kind) {
    reading.problem(where + "/kind", "is missing; must be " + listed(primary_kinds()));
    return entry;
  }
  const auto index = reading.word(*kind, where + "/kind", primary_kinds());
  if (!index) return entry;
  const std::string& chosen = primary_kinds()[*index];
  ObjectReader object(value, where, job_object("primary " + chosen), reading);
  if (const PrimaryInfo* row = find_primary(chosen)) {
    PrimarySpec spec = read_formula_primary(object, *row, reading);
    check_whole(spec, object, reading);
    entry.spec = std::move(spec);
  } else {
    entry.spec = read_step_face(object, reading);
  }
  return entry;
}

}  // namespace blendwright
