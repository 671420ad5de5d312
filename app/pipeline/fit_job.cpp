#include "app/pipeline/fit_job.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/json/job_reader.hpp"
#include "app/json/job_writer.hpp"
#include "app/json/json_value.hpp"
#include "app/pipeline/build_primaries.hpp"
#include "app/pipeline/obstacle.hpp"
#include "app/pipeline/progress_part.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr std::array<const char*, 2> side_names{"from", "to"};
/// Places along a trimline where its distance to an obstacle is looked at.
constexpr int clearance_places = 129;

/// The fit names what it was given: "objectives/1/radius", "sides/0/factor", "shape/q". A job says "fit/...",
/// and "from" and "to".
std::string job_where(const std::string& where) {
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string index = "sides/" + std::to_string(i), bare = std::to_string(i);
    if (where.rfind(index, 0) == 0) return side_names[i] + where.substr(index.size());
    for (const char* list : {"unknowns/magnitudes/", "unknowns/tangent_angle/"})
      if (where == list + bare) return "fit/" + where;
  }
  if (where == "samples_u") return "fit/samples/0";
  if (where == "samples_v") return "fit/samples/1";
  if (where == "max_iterations") return "fit/iterations";
  if (where == "bounds/tangent_angle") return "fit/bounds/tangent_angle_deg";
  const bool own = where.rfind("shape", 0) == 0 || where.rfind("correspondence", 0) == 0;
  return own || where.empty() ? where : "fit/" + where;
}

/// Points of a scan are in a file: "objectives/0/points/17" becomes its name, and the message says which one.
void name_scan(Problem& problem, const ShapeFitOptions& options) {
  for (std::size_t i = 0; i < options.objectives.size(); ++i) {
    const std::string list = "objectives/" + std::to_string(i) + "/points";
    if (!std::holds_alternative<ScannedPoints>(options.objectives[i]) || problem.where.rfind(list, 0) != 0)
      continue;
    if (problem.where.size() > list.size())
      problem.message.insert(0, "point " + problem.where.substr(list.size() + 1) + " (counted from 0): ");
    problem.where = "objectives/" + std::to_string(i) + "/file";
  }
}

InputError in_blend(const InputError& error, const std::string& pointer, const ShapeFitOptions& options) {
  std::vector<Problem> problems = error.problems();
  for (Problem& p : problems)
    if (p.where.empty() || p.where.front() != '/') {
      name_scan(p, options);
      const std::string where = job_where(p.where);
      p.where = pointer + (where.empty() ? "" : "/") + where;
    }
  return InputError(std::move(problems));
}

std::string place(double v, const Vec3& p) {
  const auto text = [](double x) { return number_text(x, 4); };
  return "v = " + text(v) + " (" + text(p[0]) + ", " + text(p[1]) + ", " + text(p[2]) + ")";
}

/// A blend of the job with its trimlines, as the fit starts from it.
struct Start {
  BlendEntry entry;
  std::string pointer;
  std::vector<BuiltTrimline> lines;  ///< from, to; none for literal data without them
  FitSpec asked;
};

const BuiltPrimary& primary_of(const std::vector<BuiltPrimary>& primaries, const std::string& name,
                               const std::string& where) {
  const auto at =
      std::find_if(primaries.begin(), primaries.end(), [&](const BuiltPrimary& p) { return p.name == name; });
  if (at == primaries.end()) throw InputError(where, "there is no primary \"" + name + "\"");
  return *at;
}

Start start_of(const BlendEntry& entry, const JobSpec& job, const std::vector<BuiltPrimary>& primaries) {
  Start start{entry, "/blends/" + entry.name, {}, {}};
  if (entry.literal()) return start;
  for (std::size_t i = 0; i < 2; ++i) {
    const BlendSideEntry& side = entry.sides[i];
    const std::string where = start.pointer + "/" + side_names[i];
    start.lines.push_back(build_trimline(*side.trimline,
                                         primary_of(primaries, side.primary, where + "/primary"),
                                         job.constants, where + "/trimline"));
  }
  return start;
}

/// A trimline that the obstacle reaches: no shape of the blend can change where it starts.
void check_clearance(const Start& start, const Clearance& clearance, const std::string& where,
                     LengthUnit unit, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < start.lines.size(); ++i) {
    const Trimline& line = start.lines[i].line;
    double least = std::numeric_limits<double>::infinity(), at = 0.0;
    for (int k = 0; k < clearance_places; ++k) {
      const double v = line.domain().v.at(k / (clearance_places - 1.0));
      const double d = clearance.obstacle(line.jet(v).C()).distance;
      if (d < least) least = d, at = v;
    }
    const std::string nearest = "is " + number_text(std::abs(least), 3) + " " + name(unit) +
                                (least < 0.0 ? " inside " : " from ") + in_quotes(clearance.name) + " at " +
                                place(at, line.jet(at).C());
    const std::string side = side_names[i];
    // Rounding of a distance is far below a millionth of what is asked for.
    if (least <= 1e-6 * clearance.distance)
      throw InputError(where,
                       "the trimline \"" + side + "\" " + nearest +
                           ": a blend starts there whatever its shape; move the trimline or the obstacle");
    if (least < clearance.distance)
      warnings.push_back(where + ": the trimline \"" + side + "\" " + nearest + ", nearer than " +
                         number_text(clearance.distance) + ", which no shape of the blend can change");
  }
}

/// Reads what the objectives name, and looks whether the trimlines allow it.
void read_files(Start& start, const JobSpec& job, const std::filesystem::path& folder,
                std::vector<std::string>& warnings) {
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < start.asked.files.size(); ++i) {
    const std::string& file = start.asked.files[i];
    FitObjective& objective = start.asked.options.objectives[i];
    const std::string at = start.pointer + "/fit/objectives/" + std::to_string(i);
    std::string where = at;
    try {
      if (auto* clearance = std::get_if<Clearance>(&objective)) {
        where = at + "/to";
        clearance->obstacle = read_obstacle(file, folder, job.unit);
        check_clearance(start, *clearance, where, job.unit, warnings);
      } else if (auto* scan = std::get_if<ScannedPoints>(&objective)) {
        where = at + "/file";
        scan->points = read_scan(file, folder);
      }
    } catch (const InputError& e) {
      for (const Problem& p : e.problems())
        problems.push_back({p.where.rfind("/blends", 0) == 0 ? p.where : where,
                            p.where.empty() || p.where == where
                                ? p.message
                                : in_quotes(file) + ", " + p.where + ": " + p.message});
    } catch (const IoError& e) {
      throw IoError(where + ": " + e.what());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

ShapeFitResult fitted(const Start& start, const JobSpec& job, const Progress& progress) try {
  const BlendEntry& entry = start.entry;
  if (entry.literal()) {
    const CurveDomain domain = entry.v.value_or(CurveDomain{{0.0, 1.0}, false});
    std::vector<EndCondition> ends;
    for (std::size_t i = 0; i < 2; ++i) {
      try {
        ends.push_back(literal_end(*entry.sides[i].literal, domain, job.constants));
      } catch (const InputError& e) {
        throw e.under(start.pointer + "/" + side_names[i]);
      }
      ends.back().continuity = entry.sides[i].side.continuity;
    }
    ShapeFitResult result = fit_literal_shape(ends[0], ends[1], entry.shape, start.asked.options, progress);
    return result;
  }
  BlendSpec spec{{entry.sides[0].side, entry.sides[1].side}, entry.correspondence, entry.shape};
  for (std::size_t i = 0; i < 2; ++i)
    if (spec.sides[i].keep == SideSpec::Keep::automatic && start.lines[i].keep)
      spec.sides[i].keep = *start.lines[i].keep;
  return fit_shape(start.lines[0].line, start.lines[1].line, spec, job.tolerance.position,
                   start.asked.options, progress);
} catch (const InputError& e) {
  throw in_blend(e, start.pointer, start.asked.options);
} catch (const ConvergenceError& e) {
  throw ConvergenceError(start.pointer + ": " + e.what());
} catch (const GeometryError& e) {
  throw GeometryError(start.pointer + ": " + e.what());
}

/// The entry with what the fit changed; what it was not asked to change stays as it was typed.
BlendEntry with_result(BlendEntry entry, const ShapeFitResult& fit) {
  entry.shape = fit.spec.shape;
  if (entry.literal()) return entry;
  for (std::size_t i = 0; i < 2; ++i) {
    const SideSpec::Keep keep = entry.sides[i].side.keep;
    entry.sides[i].side = fit.spec.sides[i];
    entry.sides[i].side.keep = keep;
  }
  entry.correspondence = fit.spec.correspondence;
  return entry;
}

/// What each blend is asked for: its own "fit", with the objectives of the options instead when there are
/// any.
std::vector<Start> asked_of(const JobSpec& job, const FitJobOptions& options,
                            const std::vector<BuiltPrimary>& primaries) {
  std::vector<Start> starts;
  for (const BlendEntry& entry : job.blends) {
    if (!entry.fit && options.objectives.empty()) continue;
    Start start = start_of(entry, job, primaries);
    if (entry.fit) start.asked = *entry.fit;
    if (!options.objectives.empty()) {
      start.asked.options.objectives = options.objectives;
      start.asked.files = options.files;
    }
    if (options.starts) start.asked.options.starts = *options.starts;
    start.asked.options.threads = options.threads;
    starts.push_back(std::move(start));
  }
  if (starts.empty())
    throw InputError(
        "/blends",
        "none says what is wanted of its shape; give one a \"fit\": {\"objectives\": [{\"kind\": "
        "\"thin_plate\"}]}, or call with --objective thin_plate");
  return starts;
}

}  // namespace

bool FittedBlend::fulfilled() const {
  return std::all_of(fit.objectives.begin(), fit.objectives.end(),
                     [](const ObjectiveChange& o) { return o.fulfilled; });
}

bool FitJobResult::fulfilled() const {
  return std::all_of(blends.begin(), blends.end(), [](const FittedBlend& b) { return b.fulfilled(); });
}

FitJobResult run_fit_job(const std::string& text, const JobSpec& job, const FitJobOptions& options,
                         const Progress& progress) {
  FitJobResult result;
  StopWatch watch;
  progress.at(0.0, "building the primaries");
  const std::vector<BuiltPrimary> primaries = build_primaries(job);
  std::vector<Start> starts = asked_of(job, options, primaries);
  for (Start& start : starts) {
    FittedBlend blend{start.entry.name, start.entry, start.entry, {}, {}, {}};
    read_files(start, job, options.objectives.empty() ? job.folder : std::filesystem::path(), blend.warnings);
    blend.asked = start.asked;
    result.blends.push_back(std::move(blend));
  }
  result.times.push_back({"reading", watch.lap()});

  JobSpec after = job;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double share = 0.9 / static_cast<double>(starts.size()), done = share * static_cast<double>(i);
    const Progress part = part_of(progress, done, done + share);
    FittedBlend& blend = result.blends[i];
    blend.fit = fitted(starts[i], job, part);
    for (ObjectiveChange& o : blend.fit.objectives)
      if (o.unit == "model units") o.unit = blendwright::name(job.unit);
    blend.warnings.insert(blend.warnings.end(), blend.fit.warnings.begin(), blend.fit.warnings.end());
    blend.after = with_result(blend.before, blend.fit);
    for (BlendEntry& entry : after.blends)
      if (entry.name == blend.name) entry = blend.after;
  }
  result.times.push_back({"fitting", watch.lap()});

  progress.at(0.9, "verifying");
  const std::string fitted_text = job_text(text, after);
  result.verified =
      run_job(read_job(fitted_text, job.folder / (job.name + ".json")), Progress{.stop = progress.stop});
  result.text = moved_job_text(fitted_text, job.folder, options.folder);  // a folder that may not exist yet
  result.times.push_back({"verifying", watch.lap()});
  return result;
}

Plot convergence_plot(const FitJobResult& result) {
  Plot plot{.title = "Convergence",
            .x_label = "iteration",
            .y_label = "cost",
            .curves = {},
            .logarithmic = true,
            .limit = {}};
  for (const FittedBlend& blend : result.blends) {
    PlotCurve curve{blend.name, {}, blend.fit.costs};
    for (std::size_t i = 0; i < curve.y.size(); ++i) curve.x.push_back(static_cast<double>(i));
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace blendwright
