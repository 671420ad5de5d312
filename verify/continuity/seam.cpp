#include "verify/continuity/seam.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/base/parallel_for.hpp"
#include "verify/continuity/golden_section.hpp"
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
};
constexpr std::array<Measure, 6> measures{{{&SeamSample::gap, &SeamReport::gap, 1.0},
                                           {&SeamSample::surface_gap, &SeamReport::surface_gap, 1.0},
                                           {&SeamSample::angle, &SeamReport::angle, 1.0},
                                           {&SeamSample::curvature, &SeamReport::curvature, 1.0},
                                           {&SeamSample::transverse, &SeamReport::transverse, -1.0},
                                           {&SeamSample::fold, &SeamReport::fold, 1.0}}};

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

Deviation deviation(const SeamProbe& probe, const std::vector<SeamSample>& samples, const Measure& m,
                    bool refine) {
  const std::size_t i = worst_sample(samples, m);
  double squares = 0.0;
  for (const SeamSample& s : samples) squares += (s.*m.value) * (s.*m.value);
  SeamSample worst = samples[i];
  if (refine && samples.size() > 1 && !std::isnan(worst.*m.value)) {
    const double lo = samples[i == 0 ? 0 : i - 1].v, hi = samples[std::min(i + 1, samples.size() - 1)].v;
    const auto f = [&](double v) { return m.sign * (probe.measure(v, samples[i].foot).*m.value); };
    const Peak peak = detail::golden_maximum(f, lo, hi, {worst.v, m.sign * (worst.*m.value)}, 1e-3);
    if (peak.at != worst.v) worst = probe.measure(peak.at, samples[i].foot);
  }
  return {worst.*m.value, std::sqrt(squares / static_cast<double>(samples.size())), worst.v, worst.point};
}

std::vector<SeamSample> sampled(const SeamProbe& probe, std::size_t count) {
  const std::vector<double> v = places(probe.domain(), count);
  std::vector<SeamSample> samples(count);
  // Within a chunk each foot starts from the one before; a chunk's first is searched globally.
  parallel_for(count, 128, [&](std::size_t begin, std::size_t end) {
    std::optional<UV> foot;
    for (std::size_t i = begin; i < end; ++i) {
      samples[i] = probe.measure(v[i], foot);
      foot.reset();
      if (std::isfinite(samples[i].surface_gap)) foot = samples[i].foot;
    }
  });
  return samples;
}

}  // namespace

SeamReport check_seam(const Seam& seam, const SeamOptions& options, const Progress& progress) {
  SeamReport report;
  report.name = seam.name;
  report.measured = seam.primary.has_value();
  if (!report.measured || options.samples <= 0) return report;

  progress.at(0.0, "measuring a seam");
  const SeamProbe probe(seam);
  const std::vector<SeamSample> samples = sampled(probe, static_cast<std::size_t>(options.samples));
  progress.at(0.8, "measuring a seam");
  report.samples = samples.size();
  // Six refinements of some twenty samples each: worth spreading, and independent of each other.
  parallel_for(measures.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      report.*measures[k].result = deviation(probe, samples, measures[k], options.refine);
  });
  for (const SeamSample& s : samples) {
    report.folded += s.fold > 0.0 ? 1 : 0;
    report.v.push_back(s.v);
    report.gap_at.push_back(s.gap);
    report.angle_at.push_back(s.angle);
    report.curvature_at.push_back(s.curvature);
  }
  progress.at(1.0, "measuring a seam");
  return report;
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
