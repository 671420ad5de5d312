#include "app/pipeline/run_job.hpp"

#include <algorithm>

#include "app/pipeline/boundary_strip.hpp"
#include "app/pipeline/build_blend.hpp"
#include "app/pipeline/build_primaries.hpp"
#include "app/pipeline/second_surfaces.hpp"
#include "kernel/base/number_text.hpp"
#include "parametric/trimline/crossing.hpp"

namespace blendwright {
namespace {

constexpr std::array<const char*, 2> side_names{"from", "to"};

const BuiltPrimary* find(const std::vector<BuiltPrimary>& primaries, const std::string& name) {
  const auto it =
      std::find_if(primaries.begin(), primaries.end(), [&](const BuiltPrimary& p) { return p.name == name; });
  return it == primaries.end() ? nullptr : &*it;
}

/// The trimlines of a blend's two sides; problems of both sides are reported together.
std::array<std::optional<BuiltTrimline>, 2> build_trimlines(const BlendEntry& entry, const JobSpec& job,
                                                            const std::vector<BuiltPrimary>& primaries,
                                                            const std::string& pointer) {
  std::array<std::optional<BuiltTrimline>, 2> lines;
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < 2; ++i) {
    const BlendSideEntry& side = entry.sides[i];
    if (!side.trimline) continue;
    const std::string where = pointer + "/" + side_names[i];
    try {
      const BuiltPrimary* primary = find(primaries, side.primary);
      if (!primary) throw InputError(where + "/primary", "there is no primary \"" + side.primary + "\"");
      lines[i] = build_trimline(*side.trimline, *primary, job.constants, where + "/trimline");
    } catch (const InputError& e) {
      problems.insert(problems.end(), e.problems().begin(), e.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return lines;
}

Blend build_literal(const BlendEntry& entry, const JobSpec& job, std::array<std::optional<Trimline>, 2> lines,
                    const std::string& pointer) {
  const CurveDomain domain = entry.v.value_or(CurveDomain{{0.0, 1.0}, false});
  std::vector<EndCondition> ends;
  for (std::size_t i = 0; i < 2; ++i) {
    try {
      ends.push_back(literal_end(*entry.sides[i].literal, domain, job.constants));
    } catch (const InputError& e) {
      throw e.under(pointer + "/" + side_names[i]);
    }
    ends[i].continuity = entry.sides[i].side.continuity;
  }
  return make_literal_blend(ends[0], ends[1], entry.shape, std::move(lines));
}

/// Builder errors name a side as "sides/0/..." and its law as "factor"; a job says "from" and "to", and
/// "magnitude/factor".
std::string job_where(std::string where) {
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string index = "sides/" + std::to_string(i);
    if (where.rfind(index, 0) == 0) where = side_names[i] + where.substr(index.size());
    const std::string factor = std::string(side_names[i]) + "/factor";
    if (where.rfind(factor, 0) == 0)
      where = std::string(side_names[i]) + "/magnitude" + where.substr(factor.size() - 7);
  }
  return where;
}

/// Literal data leave the kept part of primary 0 and enter that of primary 1, by definition; along the line
/// the majority decides, since typed tangents need not be good ones.
bool literal_keeps_left(const Trimline& line, const EndCondition& end, std::size_t side) {
  double out = 0.0;
  for (int i = 0; i < 16; ++i) {
    const double v = line.domain().v.at((i + 0.377) / 16.0);
    const CurveJet<2> at = line.pcurve().jet(v);
    const SurfaceJet P = line.primary().jet({at.C()[0], at.C()[1]});
    const Vec3 k = P.Su.cross(P.Sv).cross(line.jet(v).C1());
    const Vec3 T = derivative(end.series(v).T, 0);
    const double scale = k.norm() * T.norm();
    if (scale > 0.0) out += k.dot(T) / scale;
  }
  return (side == 0) == (out < 0.0);
}

/// A primary without a blend is in no output: that is hardly meant.
std::vector<std::string> unused_primaries(const JobSpec& job) {
  std::vector<std::string> warnings;
  for (const PrimaryEntry& p : job.primaries) {
    const bool used = std::any_of(job.blends.begin(), job.blends.end(), [&](const BlendEntry& b) {
      return b.sides[0].primary == p.name || b.sides[1].primary == p.name;
    });
    if (!used) warnings.push_back("/primaries/" + p.name + ": is used by no blend and will not be written");
  }
  return warnings;
}

bool from_step_edge(const BlendSideEntry& side) {
  using Kind = TrimlineSpec::Kind;
  return side.trimline && side.trimline->shift.empty() &&
         (side.trimline->kind == Kind::edge || side.trimline->kind == Kind::edge_chain);
}

BlendFit fit(const BlendEntry& entry, const OdeBlend& blend, const JobSpec& job,
             const Progress& progress) try {
  return fit_blend(blend, fit_options(job.tolerance), Progress{.stop = progress.stop});
} catch (const GeometryError& e) {
  throw GeometryError("/blends/" + entry.name + ": " + e.what());
} catch (const ConvergenceError& e) {
  throw ConvergenceError("/blends/" + entry.name + ": " + e.what());
}

}  // namespace

BuiltBlend build_blend(const BlendEntry& entry, const JobSpec& job,
                       const std::vector<BuiltPrimary>& primaries, std::vector<std::string>& warnings) {
  const std::string pointer = "/blends/" + entry.name;
  try {
    auto lines = build_trimlines(entry, job, primaries, pointer);
    if (entry.literal()) {
      std::array<std::optional<Trimline>, 2> on_v;
      for (std::size_t i = 0; i < 2; ++i)
        if (lines[i]) on_v[i] = lines[i]->line;
      return {build_literal(entry, job, on_v, pointer), {}, on_v};
    }
    BlendSpec spec{{entry.sides[0].side, entry.sides[1].side}, entry.correspondence, entry.shape};
    for (std::size_t i = 0; i < 2; ++i) {
      if (spec.sides[i].keep == SideSpec::Keep::automatic && lines[i]->keep)
        spec.sides[i].keep = *lines[i]->keep;
      if (lines[i]->edge_deviation > job.tolerance.position)
        warnings.push_back(pointer + "/" + side_names[i] + "/trimline: the part's edge is up to " +
                           number_text(lines[i]->edge_deviation, 3) + " " + name(job.unit) +
                           " away from its face; the blend starts on the face");
    }
    return {make_blend(lines[0]->line, lines[1]->line, spec, job.tolerance.position),
            {spec.sides[0].keep, spec.sides[1].keep},
            {lines[0]->line, lines[1]->line}};
  } catch (const InputError& e) {
    std::vector<Problem> problems = e.problems();
    for (Problem& p : problems)
      if (p.where.empty() || p.where.front() != '/')
        p.where = pointer + (p.where.empty() ? "" : "/") + job_where(p.where);
    throw InputError(std::move(problems));
  } catch (const GeometryError& e) {
    const std::string text = e.what();
    throw GeometryError(text.rfind("/blends/", 0) == 0 ? text : pointer + ": " + text);
  }
}

void refuse_crossing(const BlendEntry& other, const Blend& other_blend, const BlendEntry& added,
                     const Blend& added_blend) {
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const BlendSideEntry &a = other.sides[i], &b = added.sides[k];
      if (a.primary != b.primary || a.primary.empty() || from_step_edge(a) || from_step_edge(b)) continue;
      if (!other_blend.trimlines[i] || !added_blend.trimlines[k]) continue;
      const auto found = crossing(*other_blend.trimlines[i], *added_blend.trimlines[k]);
      if (!found) continue;
      const auto text = [](double x) { return number_text(x, 4); };
      throw GeometryError("/blends/" + added.name + "/" + side_names[k] +
                          "/trimline: crosses the trimline /blends/" + other.name + "/" + side_names[i] +
                          " on primary \"" + a.primary + "\" at v = " + text(found->v1) + " (" +
                          text(found->point[0]) + ", " + text(found->point[1]) + ", " +
                          text(found->point[2]) + "); move one of them");
    }
}

Seam blend_seam(const BlendEntry& entry, const Blend& blend, const Surface& surface, std::size_t side) {
  const EndCondition& end = blend.surface.end(static_cast<int>(side));
  const auto& line = blend.trimlines[side];
  Seam s{
      entry.name + "/" + side_names[side], surface, static_cast<int>(side), std::nullopt, std::nullopt, true};
  if (line) {
    s.primary = line->primary();
    s.pcurve = line->pcurve();
    s.kept_left = blend.tangents ? blend.tangents->kept_left[side] : literal_keeps_left(*line, end, side);
  } else {
    const BoundaryStrip strip(end, static_cast<int>(side));
    s.primary = strip;
    s.pcurve = strip.line();
    s.kept_left = side == 0;  // n x C' = (T x C') x C' points towards -T
  }
  return s;
}

BlendFitOptions fit_options(const Tolerance& tolerance) {
  BlendFitOptions options;
  options.position = 0.3 * tolerance.position;
  options.angle = Radians(0.1 * tolerance.angle.value);
  options.curvature = 0.1 * tolerance.curvature;
  return options;
}

BlendUnderTest under_test(const BlendResult& result, const Surface& surface) {
  const auto seam = [&](std::size_t i) { return blend_seam(result.entry, result.blend, surface, i); };
  BlendUnderTest whole{
      result.entry.name, surface, {seam(0), seam(1)}, result.blend.surface.domain().v_closed};
  whole.second = second_surfaces(whole);
  return whole;
}

std::vector<std::string> program_defects(const JobResult& result) {
  std::vector<std::string> all;
  for (const BlendResult& blend : result.blends)
    for (const BlendReport& stage : blend.stages)
      for (std::string& text : disagreements(stage, result.job.unit)) all.push_back(std::move(text));
  return all;
}

JobResult run_job(const JobSpec& job, const Progress& progress, const RunOptions& options) {
  JobResult result;
  result.job = job;
  result.options = options;
  const VerifyOptions checks{.certify = options.certify, .fairness = options.fairness};
  result.warnings = unused_primaries(job);
  StopWatch watch;
  progress.at(0.0, "building the primaries");
  const std::vector<BuiltPrimary> primaries = build_primaries(job);
  for (const BuiltPrimary& p : primaries) result.primaries.emplace_back(p.name, p.surface);
  result.times.push_back({"primaries", watch.lap()});

  double building = 0.0, fitting = 0.0, verifying = 0.0;
  for (std::size_t i = 0; i < job.blends.size(); ++i) {
    const BlendEntry& entry = job.blends[i];
    const double done = static_cast<double>(i) / static_cast<double>(job.blends.size());
    const auto stage = [&](const char* doing) { progress.at(done, std::string(doing) + " " + entry.name); };
    stage("building");
    watch.lap();
    Blend blend = build_blend(entry, job, primaries, result.warnings).blend;
    for (const std::string& w : blend.warnings) result.warnings.push_back("/blends/" + entry.name + ": " + w);
    building += watch.lap();
    stage("fitting");
    BlendFit fitted = fit(entry, blend.surface, job, progress);
    fitting += watch.lap();
    stage("verifying");
    BlendResult r{entry, std::move(blend), std::move(fitted), {}, {}};
    for (const BlendResult& other : result.blends)
      refuse_crossing(other.entry, other.blend, r.entry, r.blend);
    for (std::size_t s = 0; s < 2; ++s)
      if (r.blend.trimlines[s]) r.primaries[s] = r.blend.trimlines[s]->primary();
    r.stages.push_back(verify_blend(under_test(r, r.blend.surface), "formula", checks));
    r.stages.push_back(verify_blend(under_test(r, r.fit.surface), "fitted", checks));
    verifying += watch.lap();
    result.blends.push_back(std::move(r));
  }
  result.times.insert(result.times.end(),
                      {{"building", building}, {"fitting", fitting}, {"verifying", verifying}});
  return result;
}

}  // namespace blendwright
