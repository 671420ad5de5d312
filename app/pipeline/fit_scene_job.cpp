#include "app/pipeline/fit_scene_job.hpp"

#include <charconv>
#include <map>

#include "app/json/json_value.hpp"
#include "app/json/scene_writer.hpp"
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
  outcome.text = scene_text(text, outcome.fit.spec);
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
