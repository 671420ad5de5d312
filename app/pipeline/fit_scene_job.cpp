#include "app/pipeline/fit_scene_job.hpp"

#include <charconv>
#include <map>

#include "app/json/json_places.hpp"
#include "app/json/json_value.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/point_files.hpp"

namespace blendwright {
namespace {

std::vector<Vec3> scanned_points(const std::string& file) {
  const std::string ending = lower_case_extension(file);
  if (ending == ".stl" || ending == ".obj" || ending == ".ply") return read_mesh(file).points;
  return read_points(file);
}

std::optional<double> whole_number(std::string_view text) {
  double x = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(x) : std::nullopt;
}

/// The library's names of its arguments as what a person typed.
InputError as_typed(const InputError& error) {
  const std::map<std::string, std::string> flags{{"points", "--points"},
                                                 {"robust_scale", "--robust-scale"},
                                                 {"start_from_points", "--from-points"},
                                                 {"max_iterations", "--max-iterations"}};
  std::vector<Problem> problems = error.problems();
  for (Problem& p : problems) {
    if (const auto flag = flags.find(p.where); flag != flags.end()) p.where = flag->second;
    if (p.where.starts_with("unknowns/")) p.where = "--unknown";
  }
  return InputError(std::move(problems));
}

/// Keys and list indices of a JSON pointer.
JsonEdit::Path path_of(const std::string& pointer) {
  JsonEdit::Path path;
  std::string part;
  for (std::size_t i = 1; i <= pointer.size(); ++i) {
    if (i == pointer.size() || pointer[i] == '/') {
      path.push_back(std::move(part));
      part.clear();
    } else if (pointer[i] == '~' && i + 1 < pointer.size()) {
      part += pointer[++i] == '1' ? '/' : '~';
    } else {
      part += pointer[i];
    }
  }
  return path;
}

JsonValue json_of(const NodeValue& value) {
  if (const double* x = std::get_if<double>(&value)) return *x;
  JsonValue::Array items;
  for (const double x : std::get<std::vector<double>>(value)) items.emplace_back(x);
  return items;
}

/// The text with every number of `after` that differs from `before`.
std::string changed_text(const std::string& text, const SceneSpec& before, const SceneSpec& after) {
  JsonEdit edit(text, json_place(text).begin, [](const JsonValue& v) { return v; });
  for (std::size_t i = 0; i < after.nodes.size(); ++i) {
    const NodeSpec &old = before.nodes[i], &node = after.nodes[i];
    const JsonEdit::Path at = path_of(node.where.empty() ? "/nodes/" + pointer_part(node.name) : node.where);
    const auto below = [&](const std::string& key) {
      JsonEdit::Path path = at;
      path.push_back(key);
      return path;
    };
    for (const auto& [key, value] : node.values)
      if (const auto known = old.values.find(key); known == old.values.end() || known->second != value)
        edit.set(below(key), json_of(value));
    for (const auto& [key, value] : old.values)
      if (!node.values.contains(key)) edit.remove(below(key));
  }
  return edit.text();
}

}  // namespace

SceneUnknown typed_unknown(const std::string& text, const std::string& where) {
  const auto fail = [&] {
    return InputError(where,
                      "is " + in_quotes(text) +
                          ", must be like form/a=1,10: node, key, lowest and highest value; or body/turn");
  };
  const std::size_t equal = text.rfind('='), slash = text.rfind('/', equal);
  if (slash == std::string::npos || slash == 0) throw fail();
  SceneUnknown unknown{text.substr(0, slash), text.substr(slash + 1, equal - slash - 1), {}};
  if (unknown.key == "turn") {
    if (equal != std::string::npos) throw fail();
    return unknown;
  }
  const std::size_t comma = equal == std::string::npos ? equal : text.find(',', equal);
  if (comma == std::string::npos) throw fail();
  const std::string_view whole(text);
  const auto low = whole_number(whole.substr(equal + 1, comma - equal - 1)),
             high = whole_number(whole.substr(comma + 1));
  if (!low || !high) throw fail();
  unknown.bounds = {*low, *high};
  return unknown;
}

SceneFitOutcome run_scene_fit(const std::string& text, const std::string& file, const SceneFitJob& job,
                              const Progress& progress) {
  SceneFitOptions options = job.options;
  std::vector<Problem> problems;
  for (const std::string& unknown : job.unknowns) {
    try {
      options.unknowns.push_back(typed_unknown(unknown, "--unknown"));
    } catch (const InputError& e) {
      problems.push_back(e.problems().front());
    }
  }
  if (job.points.empty()) problems.push_back({"--points", "is missing, must be a file of points"});
  if (!problems.empty()) throw InputError(std::move(problems));
  SceneFitOutcome outcome{build_scene_text(text, file), job.points, {}, {}};
  const std::vector<Vec3> points = scanned_points(job.points);
  try {
    outcome.fit = fit_scene(outcome.before.spec, points, options, progress);
  } catch (const InputError& e) {
    throw as_typed(e);
  }
  outcome.text = changed_text(text, outcome.before.spec, outcome.fit.spec);
  // What is written is what was found: the text is read again, and is a scene.
  const SceneFile again = build_scene_text(outcome.text, file);
  if (again.spec != outcome.fit.spec)
    throw std::logic_error("the fitted scene's text reads back as another scene");
  return outcome;
}

std::string scene_fit_json(const SceneFitOutcome& outcome) {
  const SceneFitResult& fit = outcome.fit;
  JsonValue report = JsonValue::object(
      {{"scene", outcome.before.name},
       {"input_hash", outcome.before.source_hash},
       {"unit", name(outcome.before.spec.unit)},
       {"points", outcome.points_name},
       {"count", fit.points},
       {"inliers", fit.inliers},
       {"rms_before", fit.rms_before},
       {"rms", fit.rms},
       {"worst", fit.worst},
       {"worst_point", JsonValue::array({fit.worst_point.x(), fit.worst_point.y(), fit.worst_point.z()})},
       {"converged", fit.converged},
       {"condition", fit.condition}});
  JsonValue::Array numbers, not_unique, warnings, costs;
  for (const FittedNumber& n : fit.numbers)
    numbers.push_back(JsonValue::object({{"name", n.name},
                                         {"before", n.start},
                                         {"after", n.value},
                                         {"deviation", n.deviation},
                                         {"at_bound", n.at_bound},
                                         {"determined", n.determined}}));
  for (const std::string& s : fit.not_unique) not_unique.emplace_back(s);
  for (const std::string& s : fit.warnings) warnings.emplace_back(s);
  for (const double c : fit.costs) costs.emplace_back(c);
  report.add("numbers", std::move(numbers));
  report.add("not_unique", std::move(not_unique));
  report.add("warnings", std::move(warnings));
  report.add("costs", std::move(costs));
  return json_text(report);
}

}  // namespace blendwright
