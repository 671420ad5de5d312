#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/base/number_text.hpp"
#include "kernel/math/formula.hpp"
#include "kernel/primitives/primary_shapes.hpp"

namespace blendwright {
namespace {

using Problems = std::vector<Problem>;

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const auto nearest = nearest_word(word, known.data(), known.size());
  return nearest ? "; did you mean \"" + *nearest + "\"?" : std::string();
}

std::string count_text(std::size_t n) { return number_text(static_cast<double>(n)); }

void check_kind(const PrimarySpec& spec, Problems& problems) {
  std::vector<std::string> kinds;
  std::string list;
  for (const PrimaryInfo& row : primaries_table()) {
    kinds.emplace_back(row.kind);
    list += (list.empty() ? "" : ", ") + kinds.back();
  }
  problems.push_back(
      {"kind", "is \"" + spec.kind + "\", must be one of " + list + suggestion(spec.kind, kinds)});
}

/// "must be > 0", "must be >= 0", "must be > 0 and <= 89.999", "must not be 0".
std::string requirement(const ParamInfo& p) {
  if (p.min < 0.0) return "must be a number that is not 0";
  const std::string low = std::string("must be ") + (p.min_allowed ? ">= " : "> ") + number_text(p.min);
  return p.max < std::numeric_limits<double>::max() ? low + " and <= " + number_text(p.max) : low;
}

bool fulfils(const ParamInfo& p, double value) {
  if (!std::isfinite(value)) return false;
  if (p.min < 0.0) return value != 0.0;
  return (p.min_allowed ? value >= p.min : value > p.min) && value <= p.max;
}

void check_numbers(const PrimarySpec& spec, const PrimaryInfo& row, Problems& problems) {
  std::vector<std::string> known;
  for (const ParamInfo& p : row.numbers) {
    known.emplace_back(p.name);
    const auto given = spec.numbers.find(known.back());
    if (given == spec.numbers.end())
      problems.push_back({known.back(), "is missing, " + requirement(p)});
    else if (!fulfils(p, given->second))
      problems.push_back({known.back(), "is " + number_text(given->second) + ", " + requirement(p)});
  }
  for (const auto& [name, value] : spec.numbers)
    if (std::find(known.begin(), known.end(), name) == known.end())
      problems.push_back({name, "is not a number of kind \"" + spec.kind + "\"" + suggestion(name, known)});
}

void check_texts(const PrimarySpec& spec, const PrimaryInfo& row, Problems& problems) {
  const std::string key = row.texts.empty() ? "formulas" : std::string(row.texts);
  const auto wanted = static_cast<std::size_t>(row.text_count);
  if (row.texts.empty()) {
    if (!spec.formulas.empty())
      problems.push_back({key, "are given, but kind \"" + spec.kind + "\" takes none"});
    return;
  }
  if (spec.formulas.empty() && row.takes_points) {
    if (spec.points.empty())
      problems.push_back({key, "is missing; give " + count_text(wanted) + " formulas, or points"});
    return;
  }
  if (spec.formulas.size() != wanted)
    problems.push_back(
        {key, "has " + count_text(spec.formulas.size()) + " formulas, must have " + count_text(wanted)});
  const std::vector<std::string> variables(row.variables.begin(), row.variables.end());
  for (std::size_t i = 0; i < spec.formulas.size(); ++i) {
    try {
      static_cast<void>(Formula(spec.formulas[i], variables, spec.constants));
    } catch (const InputError& e) {
      problems.push_back({key + "/" + count_text(i), e.what()});
    }
  }
}

void check_points(const PrimarySpec& spec, const PrimaryInfo& row, Problems& problems) {
  if (!row.takes_points) {
    if (!spec.points.empty())
      problems.push_back({"points", "are given, but kind \"" + spec.kind + "\" takes none"});
    return;
  }
  const bool is_profile = !row.texts.empty();
  if (is_profile && spec.points.empty()) return;  // formulas
  if (is_profile && !spec.formulas.empty())
    problems.push_back(
        {"points", "are given together with \"" + std::string(row.texts) + "\", must be one of the two"});
  if (spec.points.size() < 4)
    problems.push_back({"points", "are " + count_text(spec.points.size()) + ", must be at least 4"});
  for (std::size_t i = 0; i < spec.points.size(); ++i)
    if (!spec.points[i].allFinite()) problems.push_back({"points/" + count_text(i), "is not finite"});
}

void check_bspline(const PrimarySpec& spec, Problems& problems) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (spec.degree[k] < 1 || spec.degree[k] > 25)
      problems.push_back(
          {"degree/" + count_text(k), "is " + number_text(spec.degree[k]) + ", must be from 1 to 25"});
    if (!std::is_sorted(spec.knots[k].begin(), spec.knots[k].end()) ||
        !std::all_of(spec.knots[k].begin(), spec.knots[k].end(), [](double x) { return std::isfinite(x); }))
      problems.push_back({"knots/" + count_text(k), "must be finite numbers that do not decrease"});
    if (k == 0 ? spec.u.has_value() : spec.v.has_value())
      problems.push_back({k == 0 ? "u" : "v", "is given, but a bspline takes its range from its knots"});
  }
}

void check_range(const PrimarySpec& spec, const PrimaryInfo& row, std::size_t direction, Problems& problems) {
  const std::string key = std::string(row.parameters[direction]) + (row.angular[direction] ? "_deg" : "");
  const std::optional<Interval> range = range_of(spec, row, direction);
  if (!range) {
    problems.push_back({key, "is missing, must be a range [from, to]"});
    return;
  }
  const double unit = row.angular[direction] ? degrees(1.0).value : 1.0;
  const std::string is =
      "is [" + number_text(range->lo / unit, 9) + ", " + number_text(range->hi / unit, 9) + "], ";
  if (!std::isfinite(range->lo) || !std::isfinite(range->hi))
    problems.push_back({key, is + "must be finite"});
  else if (!(range->lo < range->hi))
    problems.push_back({key, is + "must rise from the first number to the second"});
  else if (row.turns[direction] && range->length() > 2.0 * std::numbers::pi && !is_full_turn(*range))
    problems.push_back({key, is + "must not be wider than " + (row.angular[direction] ? "360" : "2 pi")});
}

void check_placement(const PrimarySpec& spec, Problems& problems) {
  const Eigen::Matrix3d& R = spec.placement.R;
  // 1e-9: an error that moves a part of size 1 by less than any tolerance of a joint.
  if (!R.allFinite() || !spec.placement.t.allFinite() || !((R.transpose() * R).isIdentity(1e-9)) ||
      !(R.col(0).cross(R.col(1)).dot(R.col(2)) > 0.0))
    problems.push_back({"placement", "must be a finite rotation and translation"});
}

/// What only evaluation shows: the surface is finite, and closed where it was said to be.
void check_surface(const PrimarySpec& spec, const PrimaryInfo& row, const Surface& surface,
                   Problems& problems) {
  const std::string key(!row.texts.empty() ? row.texts : row.takes_points ? "points" : row.parameters[0]);
  const SurfaceDomain d = surface.domain();
  double size = 0.0;
  constexpr int n = 8;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const UV p{d.u.at(static_cast<double>(i) / n), d.v.at(static_cast<double>(j) / n)};
      const Vec3 S = surface.point(p);
      if (!S.allFinite()) {
        problems.push_back(
            {key, "has no finite value at u = " + number_text(p.u, 6) + ", v = " + number_text(p.v, 6)});
        return;
      }
      size = std::max(size, S.cwiseAbs().maxCoeff());
    }
  for (std::size_t k = 0; k < 2; ++k) {
    if (!(k == 0 ? d.u_closed : d.v_closed) || row.turns[k]) continue;
    double gap = 0.0;
    for (int i = 0; i <= n; ++i) {
      const double t = static_cast<double>(i) / n;
      const SurfaceJet a = surface.jet(k == 0 ? UV{d.u.lo, d.v.at(t)} : UV{d.u.at(t), d.v.lo});
      const SurfaceJet b = surface.jet(k == 0 ? UV{d.u.hi, d.v.at(t)} : UV{d.u.at(t), d.v.hi});
      const double range = k == 0 ? d.u.length() : d.v.length();
      gap = std::max({gap, (a.S - b.S).norm(), ((k == 0 ? a.Su - b.Su : a.Sv - b.Sv) * range).norm()});
    }
    if (!(gap <= 1e-9 * size))
      problems.push_back(
          {spec.points_closed ? "closed" : (k == 0 ? "closed_u" : "closed_v"),
           "is true, but the two ends differ by " + scientific_text(gap) + " in position or tangent"});
  }
}

}  // namespace

std::vector<Problem> check(const PrimarySpec& spec) {
  Problems problems;
  const PrimaryInfo* row = find_primary(spec.kind);
  if (!row) {
    check_kind(spec, problems);
    return problems;
  }
  check_numbers(spec, *row, problems);
  check_texts(spec, *row, problems);
  check_points(spec, *row, problems);
  const bool is_bspline = row->takes_points && row->texts.empty();
  if (is_bspline) check_bspline(spec, problems);
  for (std::size_t k = 0; k < 2; ++k) check_range(spec, *row, k, problems);
  if (row->check) row->check(spec, problems);
  check_placement(spec, problems);
  if (!problems.empty()) return problems;
  try {
    check_surface(spec, *row, row->make(spec), problems);
  } catch (const InputError& e) {
    problems = e.problems();
  } catch (const GeometryError& e) {
    problems.push_back({"points", e.what()});
  }
  return problems;
}

}  // namespace blendwright
