#pragma once
// The same joint told differently: moved, scaled, its sides swapped, its trimlines run through another way.
#include <array>
#include <cctype>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/pipeline/job.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::test {

/// `text` with every name v replaced by (`by`).
inline std::string with_parameter(const std::string& text, const std::string& by) {
  const auto in_name = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_');
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool whole = text[i] == 'v' && !in_name(i + 1) && (i == 0 || !in_name(i - 1));
    result += whole ? "(" + by + ")" : std::string(1, text[i]);
  }
  return result;
}

inline std::string times(double factor, const std::string& text) {
  return "(" + number_text(factor) + ")*(" + text + ")";
}

inline RigidMotion after(const RigidMotion& motion, const RigidMotion& first) {
  return {motion.R * first.R, motion(first.t)};
}

inline void move(CurveSpec& curve, const RigidMotion& motion) {
  for (Vec3& p : curve.points) p = motion(p);
  if (curve.formulas.empty()) return;
  std::vector<std::string> texts;
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::string text = number_text(motion.t[i]);
    for (Eigen::Index j = 0; j < 3; ++j)
      text += " + " + times(motion.R(i, j), curve.formulas[static_cast<std::size_t>(j)]);
    texts.push_back(text);
  }
  curve.formulas = texts;
}

/// Every primary, and what is typed in space, after `motion`.
inline JobSpec moved(JobSpec job, const RigidMotion& motion) {
  for (PrimaryEntry& primary : job.primaries)
    std::visit([&](auto& spec) { spec.placement = after(motion, spec.placement); }, primary.spec);
  for (BlendEntry& blend : job.blends)
    for (BlendSideEntry& side : blend.sides)
      if (side.trimline->kind == TrimlineSpec::Kind::projected) {
        move(side.trimline->curve, motion);
        if (side.trimline->along) side.trimline->along = Vec3(motion.R * *side.trimline->along);
      }
  return job;
}

/// What the parameters u and v of a primary become when all lengths are multiplied by `factor`.
inline std::array<double, 2> parameter_factors(const PrimarySpec& spec, double factor) {
  if (spec.kind == "plane") return {factor, factor};
  if (spec.kind == "cylinder") return {factor, 1.0};
  if (spec.kind == "torus" || spec.kind == "formula") return {1.0, 1.0};
  throw std::logic_error("parameter_factors has no row for " + spec.kind);
}

inline void scale(PrimarySpec& spec, double factor) {
  const auto [fu, fv] = parameter_factors(spec, factor);
  if (spec.u) spec.u = Interval{spec.u->lo * fu, spec.u->hi * fu};
  if (spec.v) spec.v = Interval{spec.v->lo * fv, spec.v->hi * fv};
  for (auto& [name, number] : spec.numbers) number *= factor;
  for (std::string& text : spec.formulas) text = times(factor, text);
  spec.placement.t *= factor;
}

inline void scale(TrimlineSpec& line, std::array<double, 2> parameters, double factor) {
  const bool constant_u = line.direction == IsoDirection::constant_u;
  line.value *= parameters[constant_u ? 0 : 1];
  if (line.range) {
    const double f = parameters[constant_u ? 1 : 0];
    line.range = Interval{line.range->lo * f, line.range->hi * f};
  }
  const bool in_space = line.kind == TrimlineSpec::Kind::projected;
  const std::array<double, 3> f{in_space ? factor : parameters[0], in_space ? factor : parameters[1], factor};
  for (std::size_t i = 0; i < line.curve.formulas.size(); ++i)
    line.curve.formulas[i] = times(f[i], line.curve.formulas[i]);
  for (Vec3& p : line.curve.points) p = p.cwiseProduct(Vec3(f[0], f[1], f[2]));
}

inline const PrimarySpec& primary_of(const JobSpec& job, const std::string& name) {
  for (const PrimaryEntry& primary : job.primaries)
    if (primary.name == name) return std::get<PrimarySpec>(primary.spec);
  throw std::logic_error("no primary " + name);
}

/// All lengths multiplied by `factor`, the tolerances with them.
inline JobSpec scaled(const JobSpec& original, double factor) {
  JobSpec job = original;
  for (PrimaryEntry& primary : job.primaries) scale(std::get<PrimarySpec>(primary.spec), factor);
  for (BlendEntry& blend : job.blends)
    for (BlendSideEntry& side : blend.sides)
      scale(*side.trimline, parameter_factors(primary_of(original, side.primary), factor), factor);
  job.tolerance.position *= factor;
  job.tolerance.curvature /= factor;
  return job;
}

/// From and to exchanged. The cross direction T changes its sign against C', and psi with it.
inline JobSpec swapped(JobSpec job) {
  for (BlendEntry& blend : job.blends) {
    std::swap(blend.sides[0], blend.sides[1]);
    for (BlendSideEntry& side : blend.sides)
      side.side.tangent_angle = Radians(-side.side.tangent_angle.value);
  }
  return job;
}

/// An isoline as typed parameters: the same line on the same range.
inline TrimlineSpec as_parameters(const TrimlineSpec& line, const PrimarySpec& primary) {
  if (line.kind != TrimlineSpec::Kind::isoline) return line;
  const bool constant_u = line.direction == IsoDirection::constant_u;
  const auto& whole = constant_u ? primary.v : primary.u;
  TrimlineSpec typed;
  typed.kind = TrimlineSpec::Kind::parameters;
  typed.curve.formulas = constant_u ? std::vector<std::string>{number_text(line.value), "v"}
                                    : std::vector<std::string>{"v", number_text(line.value)};
  typed.curve.v = line.range ? *line.range : whole.value_or(Interval{0.0, 2.0 * std::numbers::pi});
  typed.curve.closed = !line.range && !whole;
  return typed;
}

/// One trimline by the parameter w with v = shift + w, or v = lo + hi - shift - w when it runs backwards; w
/// has the range of v. Both lines take their direction from line 0, hence the signs of psi; the kept side is
/// seen along the line as it is given.
inline JobSpec run_through(JobSpec job, std::size_t side, bool backwards, double shift) {
  BlendSideEntry& entry = job.blends.at(0).sides.at(side);
  TrimlineSpec line = as_parameters(*entry.trimline, primary_of(job, entry.primary));
  const double start = backwards ? line.curve.v.lo + line.curve.v.hi - shift : shift;
  for (std::string& text : line.curve.formulas)
    text = with_parameter(text, number_text(start) + (backwards ? " - v" : " + v"));
  entry.trimline = line;
  using Keep = SideSpec::Keep;
  if (backwards && entry.side.keep != Keep::automatic)
    entry.side.keep = entry.side.keep == Keep::left ? Keep::right : Keep::left;
  if (side == 0 && backwards)
    for (BlendSideEntry& s : job.blends.at(0).sides)
      s.side.tangent_angle = Radians(-s.side.tangent_angle.value);
  return job;
}

}  // namespace blendwright::test
