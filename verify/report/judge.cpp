// The checks table and the verdict.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "kernel/base/number_text.hpp"
#include "verify/report/blend_report.hpp"

namespace blendwright {
namespace {

struct Case {
  const BlendReport& report;
  const std::array<Continuity, 2>& asked;
  const Tolerance& tolerance;
  LengthUnit unit;
  std::string length, curvature;  ///< units
  std::string_view check;
  std::vector<Finding>& findings;

  void add(std::string text, bool failed) const {
    findings.push_back({std::string(check), std::move(text), failed});
  }
  [[nodiscard]] bool any_asked(Continuity least) const { return std::max(asked[0], asked[1]) >= least; }
};

constexpr double degree = 180.0 / std::numbers::pi;

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

std::string place(const Case& c, double v, const Vec3& point) {
  return joined({" at v = ", number_text(v, 4), " ", place_text(point, c.report.size)});
}
std::string place(const Case& c, UV at, const Vec3& point) {
  return joined({" at u = ", number_text(at.u, 4), ", v = ", number_text(at.v, 4), " ",
                 place_text(point, c.report.size)});
}

// "angle 0.31 deg exceeds 0.001 deg"
std::string exceeds(std::string_view what, double value, double limit, const std::string& unit) {
  if (std::isnan(value)) return std::string(what) + " is not a number";
  return std::string(what) + " " + number_text(value, 3) + " " + unit + " exceeds " + number_text(limit, 3) +
         " " + unit;
}

// One deviation of each seam against its limit; `factor` converts to the unit that is written.
void judge_deviation(const Case& c, Deviation SeamReport::*member, std::string_view what, Continuity least,
                     double limit, double factor, const std::string& unit) {
  for (std::size_t side = 0; side < 2; ++side) {
    const SeamReport& seam = c.report.seams[side];
    if (!seam.measured || seam.samples == 0) continue;
    const Deviation& d = seam.*member;
    const bool judged = c.asked[side] >= least || std::isnan(d.worst);
    if (judged && !(d.worst <= limit))
      c.add(seam.name + ": " + exceeds(what, d.worst * factor, limit * factor, unit) + place(c, d.v, d.point),
            true);
  }
}

void judge_gap(const Case& c) {
  for (const SeamReport& seam : c.report.seams) {
    if (!seam.measured)
      c.add(seam.name + ": not measured, this side has no primary", false);
    else if (seam.samples == 0)
      c.add(seam.name + ": not measured, no samples were asked for", true);
  }
  judge_deviation(c, &SeamReport::gap, "gap", Continuity::G0, c.tolerance.position, 1.0, c.length);
  judge_deviation(c, &SeamReport::surface_gap, "distance from the primary", Continuity::G0,
                  c.tolerance.position, 1.0, c.length);
}

void judge_angle(const Case& c) {
  judge_deviation(c, &SeamReport::angle, "angle", Continuity::G1, c.tolerance.angle.value, degree, "deg");
}

void judge_curvature(const Case& c) {
  judge_deviation(c, &SeamReport::curvature, "curvature jump", Continuity::G2, c.tolerance.curvature, 1.0,
                  c.curvature);
}

void judge_proven(const Case& c) {
  if (!c.report.proven) return;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string text = shortfall((*c.report.proven)[side], c.asked[side], c.tolerance, c.unit);
    if (!text.empty()) c.add((*c.report.proven)[side].name + ": " + text, true);
  }
}

void judge_fold(const Case& c) {
  for (std::size_t side = 0; side < 2; ++side) {
    const SeamReport& seam = c.report.seams[side];
    if (!seam.measured || seam.samples == 0) continue;
    const Deviation& fold = seam.fold;
    // Without tangent planes in common, either direction is a proper sharp edge.
    if (std::isnan(fold.worst))
      c.add(seam.name + ": the direction across the seam is not a number" + place(c, fold.v, fold.point),
            true);
    else if (c.asked[side] >= Continuity::G1 && fold.worst > 0.0)
      c.add(seam.name + ": the blend folds back over the kept part of the primary on " +
                std::to_string(seam.folded) + " of " + std::to_string(seam.samples) + " samples, worst" +
                place(c, fold.v, fold.point),
            true);
  }
  if (c.report.surface_checked && c.report.fold.folded > 0) {
    const Extreme& where = c.report.fold.where;
    c.add(c.report.name + ": the normal turns over by " + number_text(where.value * degree, 3) +
              " deg (limit 90 deg) between neighbouring samples in " + std::to_string(c.report.fold.folded) +
              " places, worst" + place(c, where.at, where.point),
          true);
  }
}

void judge_transversality(const Case& c) {
  constexpr double warned = 0.1;
  for (const SeamReport& seam : c.report.seams) {
    const Deviation& d = seam.transverse;
    if (!seam.measured || seam.samples == 0 || d.worst >= warned) continue;
    const std::string value =
        std::isnan(d.worst) ? "is not a number" : number_text(d.worst, 3) + " is below 0.1";
    c.add(seam.name + ": sine of the angle between the blend's direction and the trimline " + value +
              place(c, d.v, d.point),
          std::isnan(d.worst));
  }
}

void judge_closing(const Case& c) {
  if (!c.report.closing) return;
  const ClosingReport& closing = *c.report.closing;
  const std::string where =
      joined({" at u = ", number_text(closing.u, 4), " ", place_text(closing.point, c.report.size)});
  const auto add = [&](std::string_view what, double value, double limit, double factor,
                       const std::string& unit, bool asked) {
    if ((asked || std::isnan(value)) && !(value <= limit))
      c.add(c.report.name + ": closing seam " + exceeds(what, value * factor, limit * factor, unit) + where,
            true);
  };
  const Tolerance& t = c.tolerance;
  add("gap", closing.gap, t.position, 1.0, c.length, true);
  add("angle", closing.angle.value, t.angle.value, degree, "deg", c.any_asked(Continuity::G1));
  add("curvature jump", closing.curvature, t.curvature, 1.0, c.curvature, c.any_asked(Continuity::G2));
}

void judge_degenerate(const Case& c) {
  const Extreme& area = c.report.fold.smallest_area;
  constexpr double limit = 1e-9;
  if (!c.report.surface_checked || area.value > limit) return;
  const std::string value =
      std::isnan(area.value) ? "is not a number" : number_text(area.value, 3) + " is below 1e-09";
  c.add(
      c.report.name + ": no normal, |Su x Sv| relative to its mean " + value + place(c, area.at, area.point),
      true);
}

void judge_radius(const Case& c) {
  if (!c.report.surface_checked) return;
  const Extreme& r = c.report.minimum_radius;
  if (std::isnan(r.value))
    c.add(c.report.name + ": minimum radius is not a number" + place(c, r.at, r.point), true);
  else if (std::isfinite(r.value))
    c.add(c.report.name + ": minimum radius " + number_text(r.value, 3) + " " + c.length +
              place(c, r.at, r.point),
          false);
}

void judge_penetration(const Case& c) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (!c.report.penetration[side]) continue;
    const auto& [judged, depth] = *c.report.penetration[side];
    const std::string& name = c.report.seams[side].name;
    if (!judged)
      c.add(name + ": penetration of the primary not judged, the blend's far end lies on both sides of it",
            false);
    else if (!(depth.value <= c.tolerance.position))
      c.add(name + ": " + exceeds("penetration of the primary", depth.value, c.tolerance.position, c.length) +
                place(c, depth.at, depth.point),
            true);
  }
}

void judge_self_intersection(const Case& c) {
  const auto& [pairs, where, other] = c.report.self_intersection;
  if (!c.report.surface_checked || (pairs == 0 && !std::isnan(where.value))) return;
  if (std::isnan(where.value))
    c.add(c.report.name + ": self-intersection unknown, the surface is not a number" +
              place(c, where.at, where.point),
          true);
  else
    c.add(c.report.name + ": the blend passes through itself, " + std::to_string(pairs) +
              " pairs of triangles, deepest " + number_text(where.value, 3) + " " + c.length +
              place(c, where.at, where.point) + " and at u = " + number_text(other.u, 4) +
              ", v = " + number_text(other.v, 4),
          true);
}

struct Check {
  CheckInfo info;
  void (*run)(const Case&);
};
constexpr std::array<Check, 11> checks{{
    {{"gap", "distance of the blend's edge from the trimline and from the primary; from G0 on"}, judge_gap},
    {{"angle", "angle between the tangent planes of blend and primary; from G1 on"}, judge_angle},
    {{"curvature jump", "difference of the normal curvatures across the trimline; G2"}, judge_curvature},
    {{"proven bounds",
      "what was asked for is not proven between the samples; only when bounds were asked for"},
     judge_proven},
    {{"fold", "the blend leaves the trimline back over the kept part (from G1 on), or its normal turns over"},
     judge_fold},
    {{"transversality", "the blend leaves the trimline almost along it: sine below 0.1; a warning"},
     judge_transversality},
    {{"closing seam", "mismatch of a closed blend where it closes, in what the sides ask for"},
     judge_closing},
    {{"degenerate surface", "the blend has no normal: |Su x Sv| below 1e-9 of its mean"}, judge_degenerate},
    {{"minimum radius", "smallest radius of curvature of the blend; a note"}, judge_radius},
    {{"penetration", "the blend passes through a primary, away from the side where its far end lies"},
     judge_penetration},
    {{"self-intersection", "the blend passes through itself, sampled by triangles"}, judge_self_intersection},
}};

}  // namespace

std::vector<Finding> judge(const BlendReport& report, const std::array<Continuity, 2>& asked,
                           const Tolerance& tolerance, LengthUnit unit) {
  std::vector<Finding> findings;
  const std::string length = name(unit);
  for (const Check& check : checks)
    check.run({report, asked, tolerance, unit, length, "1/" + length, check.info.name, findings});
  return findings;
}

std::string place_text(const Vec3& point, double size, std::string_view separator) {
  // Rounding of the coordinates themselves is no place, however small the blend.
  const double resolution = std::max(1e-3 * size, 1e-12 * point.cwiseAbs().maxCoeff());
  return joined({"(", place_text(point.x(), resolution), separator, place_text(point.y(), resolution),
                 separator, place_text(point.z(), resolution), ")"});
}

std::vector<CheckInfo> checks_table() {
  std::vector<CheckInfo> rows;
  for (const Check& check : checks) rows.push_back(check.info);
  return rows;
}

}  // namespace blendwright
