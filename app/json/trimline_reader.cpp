#include "app/json/job_parts.hpp"

#include <numbers>

namespace blendwright {
namespace {

/// The two parameters of a primary as a trimline names them; STEP faces have plain u and v.
struct Parameters {
  std::array<std::string, 2> keys{"u", "v"};
  std::array<std::string, 2> in_radians{"u", "v"};  ///< other keys for those that are angles
  std::array<bool, 2> angular{false, false};
};

Parameters parameters_of(const std::string& kind) {
  const PrimaryInfo* row = find_primary(kind);
  if (!row) return {};
  return {{parameter_key(*row, 0), parameter_key(*row, 1)},
          {parameter_key(*row, 0, "_rad"), parameter_key(*row, 1, "_rad")},
          row->angular};
}

/// Reports a key that names a parameter of some primary, but not of this one; whether there is one.
bool refuse_foreign_keys(ObjectReader& object, const std::string& kind, const Parameters& own) {
  bool foreign = false;
  for (const KeyInfo& k : job_object("trimline isoline").keys) {
    if (k.name == "kind" || k.name == "shift" || k.name.rfind("range", 0) == 0 || !object.has(k.name))
      continue;
    if (k.name == own.keys[0] || k.name == own.keys[1]) continue;
    if (k.name == own.in_radians[0] || k.name == own.in_radians[1]) continue;
    foreign = true;
    object.problem(k.name, "a " + kind + " has no parameter of this name; must be \"" + own.keys[0] +
                               "\" or \"" + own.keys[1] + "\"");
  }
  return foreign;
}

/// `along`: the parameter that runs along the line.
void read_isoline_range(ObjectReader& object, const Parameters& own, std::size_t along, TrimlineSpec& spec) {
  const bool angle = own.angular[along];
  const char* key = angle ? "range_deg" : "range";
  const std::vector<const char*> others =
      angle ? std::vector{"range"} : std::vector{"range_deg", "range_rad"};
  for (const char* wrong : others)
    if (object.has(wrong))
      object.problem(wrong, "the range is along \"" + own.keys[along] + "\"; must be \"" + key + "\"");
  spec.range = object.range(key);
  if (!angle) return;
  object.exclude("range_rad", "range_deg", "both give the same range");
  if (spec.range) spec.range = Interval{degrees(spec.range->lo).value, degrees(spec.range->hi).value};
  if (const auto range = object.range("range_rad")) spec.range = range;
}

void read_isoline(ObjectReader& object, const std::string& kind, TrimlineSpec& spec) {
  const Parameters own = parameters_of(kind);
  const bool foreign = refuse_foreign_keys(object, kind, own);
  const auto has = [&](std::size_t i) { return object.has(own.keys[i]) || object.has(own.in_radians[i]); };
  const auto given = [&](std::size_t i) {
    return object.has(own.in_radians[i]) ? own.in_radians[i] : own.keys[i];
  };
  if (has(0) && has(1)) object.exclude(given(1), given(0), "an isoline fixes one parameter");
  if (!foreign && !has(0) && !has(1))
    object.problem(own.keys[0],
                   "is missing; an isoline must give \"" + own.keys[0] + "\" or \"" + own.keys[1] + "\"");
  const std::size_t fixed = has(1) ? 1 : 0;
  spec.direction = fixed == 0 ? IsoDirection::constant_u : IsoDirection::constant_v;
  spec.value = object.number(own.keys[fixed]).value_or(0.0);
  if (own.angular[fixed]) {
    object.exclude(own.in_radians[fixed], own.keys[fixed], "both give the same angle");
    spec.value = object.number(own.in_radians[fixed]).value_or(degrees(spec.value).value);
  }
  read_isoline_range(object, own, 1 - fixed, spec);
}

/// `periods`: of the curve's coordinates, 0 or none where they have none.
void read_curve(ObjectReader& object, std::size_t dimension, const std::vector<double>& periods,
                CurveSpec& curve, Reading& reading) {
  object.exclude("points", "curve", "both describe the line");
  object.exclude("v", "points", "a line through points has no range");
  if (!object.has("curve") && !object.has("points"))
    object.problem("curve", "is missing; must be given, or \"points\"");
  curve.v = object.range("v").value_or(Interval{0.0, 2.0 * std::numbers::pi});
  if (const auto formulas = object.formulas("curve", dimension, {"v"})) {
    curve.formulas = *formulas;
    curve.closed = closes(curve.formulas, curve.v, reading.constants, periods);
  }
  if (const JsonValue* value = object.find("points"))
    if (const auto points = reading.points(*value, object.at("points"), dimension)) {
      curve.points = *points;
      if (curve.points.size() > 3 && curve.points.front() == curve.points.back()) {
        curve.points.pop_back();
        curve.closed = true;
      }
    }
  if (const auto closed = object.boolean("closed")) curve.closed = *closed;
}

void read_edge(ObjectReader& object, TrimlineSpec& spec, Reading& reading) {
  spec.edge.near = object.point("near");
  const JsonValue* kind = object.find("curve");
  if (!kind) return;
  std::vector<std::string> kinds;
  for (const Word& w : word_family("edge_kind").words) kinds.emplace_back(w.name);
  if (const auto i = reading.word(*kind, object.at("curve"), kinds)) spec.edge.curve = kinds[*i];
}

/// Whether the line closes, hence what else a shift must be, is known when it is built.
void read_shift(ObjectReader& object, TrimlineSpec& spec, Reading& reading) {
  const JsonValue* value = object.find("shift");
  if (!value) return;
  const std::string where = object.at("shift");
  if (!value->items() || value->items()->empty())
    return reading.problem(where,
                           described(*value) + ", must be a list of [t, du, dv], such as [[0.5, 0, 2]]");
  for (std::size_t i = 0; i < value->items()->size(); ++i)
    if (const auto p = reading.numbers((*value->items())[i], where + "/" + std::to_string(i), 3))
      spec.shift.push_back({(*p)[0], {(*p)[1], (*p)[2]}});
  if (reading.faulty(where)) return;
  for (const Problem& p : check_shift(spec.shift, false, where)) reading.problem(p.where, p.message);
}

}  // namespace

TrimlineSpec read_trimline(const JsonValue& value, const std::string& where, const std::string& name,
                           const KnownPrimary& primary, Reading& reading) {
  TrimlineSpec spec;
  const JsonValue* word = value.find("kind");
  std::vector<std::string> names;
  for (const auto& c : trimline_choices()) names.emplace_back(c.name);
  if (!value.members()) {
    reading.problem(where, described(value) + ", must be an object with \"kind\"");
    return spec;
  }
  if (!word) {
    reading.problem(where + "/kind", "is missing; must be " + listed(names));
    return spec;
  }
  const auto chosen = reading.choice(*word, where + "/kind", trimline_choices());
  if (!chosen) return spec;
  spec.kind = *chosen;
  const std::string object_name = "trimline " + std::string(word_for(trimline_choices(), *chosen));
  ObjectReader object(value, where, job_object(object_name), reading);
  using enum TrimlineSpec::Kind;
  switch (spec.kind) {
    case isoline:
      if (!primary.kind.empty()) read_isoline(object, primary.kind, spec);
      break;
    case parameters:
      read_curve(object, 2, {primary.periods[0], primary.periods[1]}, spec.curve, reading);
      break;
    case projected:
      read_curve(object, 3, {}, spec.curve, reading);
      spec.along = object.direction("direction");
      break;
    case edge:
    case edge_chain:
      if (!primary.kind.empty() && primary.kind != step_face_kind)
        reading.problem(where + "/kind", "takes an edge of a STEP face, but \"" + name + "\" is a " +
                                             primary.kind + "; use isoline, parameters or projected");
      read_edge(object, spec, reading);
      break;
  }
  read_shift(object, spec, reading);
  return spec;
}

}  // namespace blendwright
