#include "verify/report/blend_report.hpp"

#include <algorithm>
#include <limits>

#include "verify/continuity/paired_seams.hpp"
#include "verify/surface/sample_grid.hpp"

namespace blendwright {
namespace {

// Part `k` of `parts` equal parts of the work.
Progress part(const Progress& whole, int k, int parts) {
  return {[&whole, k, parts](double fraction, std::string_view stage) {
            whole.report((k + fraction) / parts, stage);
          },
          whole.stop};
}

void check_surface(const BlendUnderTest& under_test, const VerifyOptions& options, BlendReport& report) {
  const detail::SampleGrid grid(under_test.blend, options.nu, options.nv);
  report.fold = detail::fold(under_test.blend, grid);
  report.minimum_radius = detail::minimum_radius(under_test.blend, grid);
  for (std::size_t side = 0; side < 2; ++side)
    if (under_test.seams[side].primary)
      report.penetration[side] = detail::penetration(under_test.blend, grid, 2, under_test.seams[side]);
  report.self_intersection = detail::self_intersection(grid);
}

/// Longest side of the box around a coarse grid of points; what is not a number does not count.
double size_of(const Surface& surface) {
  constexpr int cells = 8;
  const SurfaceDomain domain = surface.domain();
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const Vec3 p =
          surface.jet({domain.u.at(double(i) / double(cells)), domain.v.at(double(j) / double(cells))}).S;
      if (!p.allFinite()) continue;
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  return std::max((high - low).maxCoeff(), 0.0);
}

void measure_again(const BlendUnderTest& under_test, BlendReport& report) {
  const auto& [blend, primaries] = *under_test.second;
  BlendReport::Second second;
  for (std::size_t side = 0; side < 2; ++side)
    second.seams[side] = second_path(under_test.seams[side], report.seams[side], {blend, primaries[side]});
  if (report.closing) second.closing = second_closing(under_test.blend, *report.closing, blend);
  report.second = std::move(second);
}

}  // namespace

BlendReport verify_blend(const BlendUnderTest& blend, const std::string& stage, const VerifyOptions& options,
                         const Progress& progress) {
  BlendReport report;
  report.name = blend.name;
  report.stage = stage;
  report.size = size_of(blend.blend);
  report.seams = detail::check_paired_seams(blend.seams, options.seam, part(progress, 0, 2));
  if (options.certify)
    report.proven = {certify_seam(blend.seams[0], report.seams[0]),
                     certify_seam(blend.seams[1], report.seams[1])};
  if (blend.closed) report.closing = check_closing(blend.blend);
  if (blend.second) measure_again(blend, report);
  report.surface_checked = options.surface_checks;
  if (options.surface_checks) check_surface(blend, options, report);
  if (options.fairness) report.fairness = fairness(blend.blend, *options.fairness);
  progress.at(1.0, "verifying " + blend.name);
  return report;
}

}  // namespace blendwright
