#include "verify/continuity/seam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "kernel/base/parallel_for.hpp"
#include "verify/continuity/local_maximum.hpp"
#include "verify/continuity/paired_seams.hpp"
#include "verify/continuity/seam_probe.hpp"

namespace blendwright {
namespace {

using detail::Peak;
using detail::SeamProbe;
using detail::SeamSample;

// Every measured quantity once: where a sample has it, where the report has it, and which end is the bad one.
struct Measure {
  double SeamSample::*value;
  Deviation SeamReport::*result;
  double sign;  // +1: large is bad, -1: small is bad
  int length;   // power of length in its unit
};
constexpr std::array<Measure, 6> measures{{{&SeamSample::gap, &SeamReport::gap, 1.0, 1},
                                           {&SeamSample::surface_gap, &SeamReport::surface_gap, 1.0, 1},
                                           {&SeamSample::angle, &SeamReport::angle, 1.0, 0},
                                           {&SeamSample::curvature, &SeamReport::curvature, 1.0, -1},
                                           {&SeamSample::transverse, &SeamReport::transverse, -1.0, 0},
                                           {&SeamSample::fold, &SeamReport::fold, 1.0, 0}}};

std::vector<double> places(Interval v, std::size_t count) {
  constexpr double golden = 0.6180339887498949;
  std::vector<double> at(count, v.lo);
  for (std::size_t i = 1; i + 1 < count; ++i)
    at[i] = v.at((static_cast<double>(i - 1) + golden) / static_cast<double>(count - 2));
  if (count > 1) at.back() = v.hi;
  return at;
}

// Index of the worst sample; the first one that is not a number when there is one.
std::size_t worst_sample(const std::vector<SeamSample>& samples, const Measure& m) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = samples[i].*m.value;
    if (std::isnan(x)) return i;
    if (m.sign * x > m.sign * (samples[worst].*m.value)) worst = i;
  }
  return worst;
}

// Whether refining could show more than rounding: the worst sample stands out from its neighbours. Exact
// blends are flat at rounding level, and their samples are the dearest.
bool stands_out(const std::vector<SeamSample>& samples, std::size_t i, const Measure& m, double size) {
  const double lo = samples[i == 0 ? 0 : i - 1].*m.value;
  const double hi = samples[std::min(i + 1, samples.size() - 1)].*m.value;
  const double top = samples[i].*m.value;
  const double rounding = 1e-13 * std::abs(top) + 1e-14 * std::pow(size, m.length);
  return std::max(std::abs(top - lo), std::abs(top - hi)) > rounding;
}

Deviation deviation(const SeamProbe& probe, const std::vector<SeamSample>& samples, const Measure& m,
                    bool refine) {
  const std::size_t i = worst_sample(samples, m);
  double squares = 0.0;
  for (const SeamSample& s : samples) squares += (s.*m.value) * (s.*m.value);
  SeamSample worst = samples[i];
  if (refine && samples.size() > 1 && !std::isnan(worst.*m.value) &&
      stands_out(samples, i, m, probe.length())) {
    const double lo = samples[i == 0 ? 0 : i - 1].v, hi = samples[std::min(i + 1, samples.size() - 1)].v;
    const auto f = [&](double v) { return m.sign * (probe.measure(v, samples[i].foot).*m.value); };
    const Peak bracketed = detail::local_maximum(f, lo, hi, {worst.v, m.sign * (worst.*m.value)});
    const Peak peak = detail::polished_maximum(f, lo, hi, bracketed);
    if (peak.at != worst.v) worst = probe.measure(peak.at, samples[i].foot);
  }
  return {worst.*m.value, std::sqrt(squares / static_cast<double>(samples.size())), worst.v, worst.point};
}

using SamplesOfSeams = std::vector<std::vector<SeamSample>>;

// All seams at one v before the next v: a blend swept along v then has its data at v at hand.
SamplesOfSeams sampled(const std::vector<SeamProbe>& probes, std::size_t count) {
  SamplesOfSeams samples(probes.size(), std::vector<SeamSample>(count));
  std::vector<std::vector<double>> v;
  for (const SeamProbe& probe : probes) v.push_back(places(probe.domain(), count));
  // Within a chunk each foot starts from the one before; a chunk's first is searched globally.
  parallel_for(count, 128, [&](std::size_t begin, std::size_t end) {
    std::vector<std::optional<UV>> feet(probes.size());
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < probes.size(); ++k) {
        SeamSample& s = samples[k][i];
        s = probes[k].measure(v[k][i], feet[k]);
        feet[k] = std::isfinite(s.surface_gap) ? std::optional(s.foot) : std::nullopt;
      }
  });
  return samples;
}

void fill(SeamReport& report, const SeamProbe& probe, const std::vector<SeamSample>& samples, bool refine) {
  report.samples = samples.size();
  for (const Measure& m : measures) report.*m.result = deviation(probe, samples, m, refine);
  for (auto* values : {&report.v, &report.gap_at, &report.angle_at, &report.curvature_at})
    values->reserve(samples.size());
  for (const SeamSample& s : samples) {
    report.folded += s.fold > 0.0 ? 1 : 0;
    report.v.push_back(s.v);
    report.gap_at.push_back(s.gap);
    report.angle_at.push_back(s.angle);
    report.curvature_at.push_back(s.curvature);
  }
}

std::vector<SeamReport> check_together(std::span<const Seam> seams, const SeamOptions& options,
                                       const Progress& progress) {
  progress.at(0.0, "measuring the seams");
  std::vector<SeamReport> reports(seams.size());
  std::vector<SeamProbe> probes;
  std::vector<std::size_t> owner;
  for (std::size_t k = 0; k < seams.size(); ++k) {
    reports[k].name = seams[k].name;
    reports[k].measured = seams[k].primary.has_value();
    if (!reports[k].measured || options.samples <= 0) continue;
    probes.emplace_back(seams[k]);
    owner.push_back(k);
  }
  const SamplesOfSeams samples = sampled(probes, static_cast<std::size_t>(std::max(options.samples, 0)));
  progress.at(0.8, "measuring the seams");
  parallel_for(probes.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) fill(reports[owner[p]], probes[p], samples[p], options.refine);
  });
  progress.at(1.0, "measuring the seams");
  return reports;
}

}  // namespace

SeamReport check_seam(const Seam& seam, const SeamOptions& options, const Progress& progress) {
  return check_together({&seam, 1}, options, progress).front();
}

std::array<SeamReport, 2> detail::check_paired_seams(const std::array<Seam, 2>& seams,
                                                     const SeamOptions& options, const Progress& progress) {
  std::vector<SeamReport> reports = check_together(seams, options, progress);
  return {std::move(reports[0]), std::move(reports[1])};
}

Continuity reached(const SeamReport& report, const Tolerance& tolerance) {
  // Every comparison is written so that NaN fails it.
  const bool position =
      report.gap.worst <= tolerance.position && report.surface_gap.worst <= tolerance.position;
  if (report.samples == 0 || !position) return Continuity::none;
  const bool crosses = report.transverse.worst > 0.0 && report.fold.worst <= 0.0 && report.folded == 0;
  if (!crosses || !(report.angle.worst <= tolerance.angle.value)) return Continuity::G0;
  return report.curvature.worst <= tolerance.curvature ? Continuity::G2 : Continuity::G1;
}

}  // namespace blendwright
