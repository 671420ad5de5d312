#include "parametric/blend.hpp"

#include <algorithm>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "parametric/trimline/crossing.hpp"
#include "parametric/trimline/line_point.hpp"
#include "parametric/trimline/zero_scan.hpp"

namespace blendwright {
namespace {

using Warnings = std::vector<std::string>;

std::string of_side(std::size_t side) { return side_name(side) + std::string(": "); }

/// Harmless degenerate points become warnings, corners end the attempt.
void check_degenerate(const Trimline& line, std::size_t side, Warnings& warnings) {
  for (const DegeneratePoint& p : degenerate_points(line)) {
    const bool cusp = p.kind == DegeneratePoint::Kind::cusp;
    const std::string what = cusp ? "the trimline stops (|C'| = 0) "
                                  : "the trimline passes a pole of its primary (|Su x Sv| = 0) ";
    if (p.harmless()) {
      warnings.push_back(of_side(side) + what + place(p.v, p.point) +
                         "; both sides agree, the limit is taken");
      continue;
    }
    const double turn = std::max(p.normal_turn, p.tangent_turn);
    throw GeometryError(of_side(side) + what + place(p.v, p.point) + " with a corner of " +
                        number_text(Radians(turn).degrees(), 4) + " deg; split the blend there");
  }
}

void check_crossing(const Trimline& line, std::size_t side) {
  const auto found = self_crossing(line);
  if (!found) return;
  throw GeometryError(of_side(side) + "the trimline crosses or overlaps itself: v = " +
                      number_text(found->v0, 6) + " and v = " + number_text(found->v1, 6) +
                      " are one point " + point_text(found->point) + "; it must pass every point once");
}

void warn_of_stops(const EndCondition& end, std::size_t side, Warnings& warnings) {
  const auto speed = [&](double v) {
    return derivative(end.series(wrapped(end.domain, v).inside).C, 1).norm();
  };
  std::vector<double> values;
  for (const double v : zero_scan_places(end.domain)) values.push_back(speed(v));
  for (const double v : zeros(end.domain, values, speed))
    warnings.push_back(of_side(side) + "the boundary curve stops (|C'| = 0) " +
                       place(v, derivative(end.series(v).C, 0)) +
                       "; the blend has no tangent plane there unless T makes one");
}

void warn_of_small_angles(const EndCondition& end, std::size_t side, Warnings& warnings) {
  constexpr int samples = 64;
  double least = 1.0, at = end.domain.v.lo;
  for (int i = 0; i <= samples; ++i) {
    const double v = end.domain.v.at(static_cast<double>(i) / samples);
    const EndSeries s = end.series(v);
    const Vec3 T = derivative(s.T, 0), C1 = derivative(s.C, 1);
    const double size = T.norm() * C1.norm();
    if (!(size > 0.0) || T.cross(C1).norm() >= least * size) continue;
    least = T.cross(C1).norm() / size;
    at = v;
  }
  if (least < 0.1)
    warnings.push_back(of_side(side) + "the cross tangent is nearly parallel to the trimline " +
                       place(at, derivative(end.series(at).C, 0)) + ", sine " + number_text(least, 3) +
                       "; below 0.1 the tangent plane is ill defined");
}

void warn_of_shape(const OdeBlend& surface, Warnings& warnings) {
  double kappa = 0.0;
  for (int k = 0; k < 3; ++k) kappa = std::max(kappa, surface.basis(k).kappa());
  if (kappa > 1e3)
    warnings.push_back("the shape parameters are near a resonance: condition " + scientific_text(kappa) +
                       ", above 1e3 the shape is wild");
}

OdeBlend surface_of(const EndCondition& end0, const EndCondition& end1, const BlendShape& shape) try {
  return OdeBlend(end0, end1, shape);
} catch (const InputError& e) {
  throw e.under("shape");
}

Correspondence corresponded(const Trimline& line0, const Trimline& line1,
                            const CorrespondenceSpec& spec) try {
  return correspond(line0, line1, spec);
} catch (const InputError& e) {
  throw e.under("correspondence");
}

}  // namespace

Blend make_blend(const Trimline& line0, const Trimline& line1, const BlendSpec& spec, double tolerance) {
  Warnings warnings;
  check_degenerate(line0, 0, warnings);
  check_degenerate(line1, 1, warnings);
  check_crossing(line0, 0);
  check_crossing(line1, 1);
  Correspondence lines = corresponded(line0, line1, spec.correspondence);
  CrossTangents tangents = cross_tangents(lines, spec.sides, tolerance);
  OdeBlend surface = surface_of(tangents.ends[0], tangents.ends[1], spec.shape);
  // With a conormal tangent the sine is cos psi >= 1/2; only a chord can run along its trimline.
  for (std::size_t i = 0; i < 2; ++i)
    if (spec.sides[i].continuity == Continuity::G0) warn_of_small_angles(tangents.ends[i], i, warnings);
  if (lines.twist > degrees(40.0).value)
    warnings.push_back("the connecting lines are twisted by up to " +
                       number_text(Radians(lines.twist).degrees(), 3) +
                       " deg; check the direction and the seam of the trimlines");
  warn_of_shape(surface, warnings);
  return {std::move(surface), {lines.line0, lines.line1}, lines, std::move(tangents), std::move(warnings)};
}

Blend make_literal_blend(const EndCondition& end0, const EndCondition& end1, const BlendShape& shape,
                         std::array<std::optional<Trimline>, 2> lines) {
  Warnings warnings;
  OdeBlend surface = surface_of(end0, end1, shape);
  for (std::size_t i = 0; i < 2; ++i) {
    warn_of_stops(surface.end(static_cast<int>(i)), i, warnings);
    warn_of_small_angles(surface.end(static_cast<int>(i)), i, warnings);
  }
  warn_of_shape(surface, warnings);
  return {std::move(surface), std::move(lines), std::nullopt, std::nullopt, std::move(warnings)};
}

}  // namespace blendwright
