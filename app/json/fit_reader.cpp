#include "app/json/fit_reader.hpp"

#include <cmath>

#include "app/json/job_parts.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

/// A whole number within the limits of its key.
std::optional<int> whole(ObjectReader& object, std::string_view key) {
  const auto x = object.number(key);
  if (!x) return std::nullopt;
  if (*x == std::floor(*x) && *x <= 1e6) return static_cast<int>(*x);
  object.problem(key, "is " + number_text(*x) + ", must be a whole number");
  return std::nullopt;
}

/// One whole number for both, or a list of two; each in [least, most].
std::optional<std::array<int, 2>> two_counts(ObjectReader& object, std::string_view key, int least, int most,
                                             bool one_for_both, Reading& reading) {
  const JsonValue* value = object.find(key);
  if (!value) return std::nullopt;
  std::vector<double> x;
  if (value->items() || !one_for_both) {
    const auto two = reading.numbers(*value, object.at(key), 2);
    if (!two) return std::nullopt;
    x = *two;
  } else {
    const auto one = reading.number(*value, object.at(key));
    if (!one) return std::nullopt;
    x = {*one, *one};
  }
  for (const double n : x)
    if (!(n == std::floor(n) && n >= least && n <= most)) {
      object.problem(key, "has " + number_text(n) + ", must be whole numbers in [" + std::to_string(least) +
                              ", " + std::to_string(most) + "]");
      return std::nullopt;
    }
  return std::array{static_cast<int>(x[0]), static_cast<int>(x[1])};
}

std::optional<std::array<bool, 2>> two_booleans(ObjectReader& object, std::string_view key) {
  const JsonValue* value = object.find(key);
  if (!value) return std::nullopt;
  if (const bool* both = value->boolean()) return std::array{*both, *both};
  const auto* items = value->items();
  if (items && items->size() == 2 && (*items)[0].boolean() && (*items)[1].boolean())
    return std::array{*(*items)[0].boolean(), *(*items)[1].boolean()};
  object.problem(key, described(*value) + ", must be true, false or two of them, [from, to]");
  return std::nullopt;
}

void read_unknowns(const JsonValue& value, const std::string& where, FitUnknowns& unknowns,
                   Reading& reading) {
  ObjectReader object(value, where, job_object("fit_unknowns"), reading);
  if (!value.members()) return;
  const auto each = object.boolean("tension_per_component"), coefficients = object.boolean("coefficients");
  unknowns.tension_per_component = each.value_or(false);
  unknowns.coefficients = coefficients.value_or(false);
  // Either of them stands instead of the one tension.
  const bool other = unknowns.tension_per_component || unknowns.coefficients;
  const auto tension = object.boolean("tension");
  unknowns.tension = tension.value_or(!other);
  if (tension.value_or(false) && other)
    object.problem("tension",
                   "contradicts " +
                       object.at(unknowns.coefficients ? "coefficients" : "tension_per_component") +
                       ": both choose the roots of the sweep equation; remove one of them");
  if (const auto n = two_counts(object, "magnitudes", 0, 64, true, reading)) unknowns.magnitudes = *n;
  if (const auto b = two_booleans(object, "tangent_angle")) unknowns.tangent_angle = *b;
  unknowns.correspondence = whole(object, "correspondence").value_or(0);
}

void read_bounds(const JsonValue& value, const std::string& where, FitBounds& bounds, Reading& reading) {
  ObjectReader object(value, where, job_object("fit_bounds"), reading);
  if (const auto x = object.range("tension")) bounds.tension = *x;
  if (const auto x = object.range("magnitude")) bounds.magnitude = *x;
  if (const auto x = object.number("tangent_angle_deg")) bounds.tangent_angle = degrees(*x);
  if (const auto x = object.number("least_speed")) bounds.least_speed = *x;
  if (const auto x = object.number("prior")) bounds.prior = *x;
}

std::vector<Vec3> read_targets(ObjectReader& object, Reading& reading) {
  const JsonValue* value = object.find("points");
  if (!value) return {};
  std::vector<Vec3> points;
  if (!value->items() || value->items()->empty()) {
    object.problem("points", described(*value) + ", must be a list of points, such as [[1, 0, 2]]");
    return points;
  }
  for (std::size_t i = 0; i < value->items()->size(); ++i)
    if (const auto p = reading.point((*value->items())[i], object.at("points") + "/" + std::to_string(i)))
      points.push_back(*p);
  return points;
}

/// The objective of an object whose keys are checked already; `file`: what it is read from.
FitObjective objective_of(ObjectReader& object, ObjectiveKind kind, std::string& file, Reading& reading) {
  const double weight = object.number("weight").value_or(1.0);
  switch (kind) {
    case ObjectiveKind::thin_plate:
      return ThinPlate{weight};
    case ObjectiveKind::curvature_variation:
      return CurvatureVariation{weight};
    case ObjectiveKind::rolling_ball: {
      RollingBall ball;
      ball.weight = weight;
      if (const JsonValue* radius = object.find("radius"))
        ball.radius = read_law(*radius, object.at("radius"), reading);
      if (const auto across = object.range("across")) ball.across = *across;
      if (!(ball.across.lo >= 0.0 && ball.across.hi <= 1.0))
        object.problem("across", "is [" + number_text(ball.across.lo) + ", " + number_text(ball.across.hi) +
                                     "], must lie within [0, 1], the range of u");
      return ball;
    }
    case ObjectiveKind::pass_through:
      return PassThrough{weight, read_targets(object, reading)};
    case ObjectiveKind::largest_curvature:
      return LargestCurvature{weight, object.number("least_radius").value_or(0.0)};
    case ObjectiveKind::clearance:
      file = object.text("to").value_or("");
      return Clearance{weight, object.number("distance").value_or(0.0), {}, file};
    case ObjectiveKind::no_fold:
      return NoFold{weight, object.number("margin").value_or(0.05)};
    case ObjectiveKind::scanned_points:
      file = object.text("file").value_or("");
      return ScannedPoints{weight, {}, object.number("robust_scale")};
  }
  return ThinPlate{weight};
}

std::optional<FitObjective> read_objective(const JsonValue& value, const std::string& where,
                                           std::string& file, Reading& reading) {
  std::vector<std::string> names;
  for (const auto& c : objective_choices()) names.emplace_back(c.name);
  if (!value.members()) {
    reading.problem(where, described(value) + ", must be an object with \"kind\"");
    return std::nullopt;
  }
  const JsonValue* word = value.find("kind");
  if (!word) {
    reading.problem(where + "/kind", "is missing; must be " + listed(names));
    return std::nullopt;
  }
  const auto kind = reading.choice(*word, where + "/kind", objective_choices());
  if (!kind) return std::nullopt;
  ObjectReader object(value, where,
                      job_object("objective " + std::string(word_for(objective_choices(), *kind))), reading);
  return objective_of(object, *kind, file, reading);
}

void read_objectives(ObjectReader& object, FitSpec& fit, Reading& reading) {
  const JsonValue* list = object.find("objectives");
  if (!list) return;
  if (!list->items() || list->items()->empty()) {
    object.problem(
        "objectives",
        described(*list) + ", must be a list with at least one, such as [{\"kind\": \"thin_plate\"}]");
    return;
  }
  bool weighty = false;
  for (std::size_t i = 0; i < list->items()->size(); ++i) {
    std::string file;
    const std::string at = object.at("objectives") + "/" + std::to_string(i);
    const auto objective = read_objective((*list->items())[i], at, file, reading);
    if (!objective) continue;
    weighty = weighty || std::visit([](const auto& o) { return o.weight > 0.0; }, *objective);
    fit.options.objectives.push_back(*objective);
    fit.files.push_back(file);
  }
  if (!weighty && !reading.faulty(object.at("objectives")))
    object.problem("objectives", "all have weight 0, so that nothing is wanted; give one a weight > 0");
}

}  // namespace

FitSpec read_fit(const JsonValue& value, const std::string& where, Reading& reading) {
  ObjectReader object(value, where, job_object("fit"), reading);
  FitSpec fit;
  if (!value.members()) return fit;
  read_objectives(object, fit, reading);
  if (const JsonValue* unknowns = object.find("unknowns"))
    read_unknowns(*unknowns, object.at("unknowns"), fit.options.unknowns, reading);
  if (const JsonValue* bounds = object.find("bounds"))
    read_bounds(*bounds, object.at("bounds"), fit.options.bounds, reading);
  if (const auto n = two_counts(object, "samples", 2, 100'000, false, reading)) {
    fit.options.samples_u = (*n)[0];
    fit.options.samples_v = (*n)[1];
  }
  fit.options.max_iterations = whole(object, "iterations").value_or(fit.options.max_iterations);
  fit.options.starts = whole(object, "starts").value_or(fit.options.starts);
  return fit;
}

TypedObjective typed_objective(const std::string& text, const std::string& where) {
  const std::size_t equals = text.find('=');
  const std::string kind = text.substr(0, equals);
  const std::string rest = equals == std::string::npos ? "" : text.substr(equals + 1);
  JsonValue value = JsonValue::object({{"kind", kind}});
  if (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    if (kind == "rolling_ball") value.add("radius", rest);
    if (kind == "largest_curvature") value.add("least_radius", rest);
    if (kind == "scanned_points") value.add("file", rest);
    if (kind == "clearance") {
      value.add("distance", rest.substr(0, comma));
      if (comma != std::string::npos) value.add("to", rest.substr(comma + 1));
    }
    if (kind == "pass_through") {
      JsonValue::Array point;
      for (std::size_t at = 0; at <= rest.size();) {
        const std::size_t end = std::min(rest.find(',', at), rest.size());
        point.emplace_back(rest.substr(at, end - at));
        at = end + 1;
      }
      value.add("points", JsonValue::array({JsonValue(point)}));
    }
    if (value.members()->size() == 1) value.add("weight", rest);
  }
  Reading reading;
  std::string file;
  const auto objective = read_objective(value, "", file, reading);
  try {
    reading.finish(value);
  } catch (const InputError& e) {
    std::vector<Problem> problems;
    for (const Problem& p : e.problems())
      problems.push_back(
          {where + " " + in_quotes(text), p.where.substr(p.where.empty() ? 0 : 1) + " " + p.message});
    throw InputError(std::move(problems));
  }
  return {*objective, file};
}

}  // namespace blendwright
