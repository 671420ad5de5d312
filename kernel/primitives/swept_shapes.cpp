#include <numbers>

#include "kernel/base/number_text.hpp"
#include "kernel/geometry/spline_interpolation.hpp"
#include "kernel/primitives/primary_shapes.hpp"
#include "kernel/primitives/swept.hpp"

namespace blendwright {
namespace {

std::vector<Formula> formulas_of(const PrimarySpec& spec) {
  const PrimaryInfo& row = *find_primary(spec.kind);
  const std::vector<std::string> variables(row.variables.begin(), row.variables.end());
  std::vector<Formula> formulas;
  for (const std::string& text : spec.formulas) formulas.emplace_back(text, variables, spec.constants);
  return formulas;
}

/// Curve through the points of the spec (their first Dim coordinates) over chord length on [0, 1].
template <int Dim>
BSplineCurve<Dim> profile_through_points(const PrimarySpec& spec) try {
  std::vector<Eigen::Matrix<double, Dim, 1>> points;
  for (const Vec3& p : spec.points) points.push_back(p.template head<Dim>());
  const int degree = points.size() >= 6 ? 5 : 3;
  return interpolate_points<Dim>(points, chord_parameters<Dim>(points, spec.points_closed),
                                 spec.points_closed, degree);
} catch (const InputError& e) {
  throw InputError("points", e.what());
}

/// The profile's parameter runs over the given range where there is one, else over the whole curve.
void restrict_to_profile(const CurveDomain& profile, const std::optional<Interval>& given, const char* key,
                         Interval& range, bool& closed) {
  range = given.value_or(profile.v);
  closed = profile.closed && range == profile.v;
  if (!profile.v.contains(range.lo) || !profile.v.contains(range.hi))
    throw InputError(key, "is [" + number_text(range.lo, 6) + ", " + number_text(range.hi, 6) +
                              "], must lie within [" + number_text(profile.v.lo, 6) + ", " +
                              number_text(profile.v.hi, 6) + "], the range of a profile through points");
}

/// Number of control values that a flat knot vector stands for.
int count_of(const PrimarySpec& spec, std::size_t direction) {
  const std::vector<double>& knots = spec.knots[direction];
  if (!spec.closed[direction]) return static_cast<int>(knots.size()) - spec.degree[direction] - 1;
  int repeated = 0;  // multiplicity of the last knot, which is the first one again
  for (auto k = knots.rbegin(); k != knots.rend() && *k == knots.back(); ++k) ++repeated;
  return static_cast<int>(knots.size()) - repeated;
}

BSplineBasis basis_of(const PrimarySpec& spec, std::size_t direction, int count) try {
  const int degree = spec.degree[direction];
  std::vector<double> breaks;
  if (spec.knots[direction].empty()) {
    const int spans = spec.closed[direction] ? count : count - degree;
    for (int i = 0; i <= spans; ++i) breaks.push_back(static_cast<double>(i) / spans);
    return spec.closed[direction] ? BSplineBasis::closed(degree, breaks)
                                  : BSplineBasis::clamped(degree, breaks);
  }
  std::vector<int> multiplicities;
  for (const double k : spec.knots[direction]) {
    if (!breaks.empty() && k == breaks.back()) {
      ++multiplicities.back();
    } else {
      breaks.push_back(k);
      multiplicities.push_back(1);
    }
  }
  return BSplineBasis(degree, std::move(breaks), std::move(multiplicities), spec.closed[direction]);
} catch (const InputError& e) {
  throw InputError("knots/" + number_text(static_cast<double>(direction)), e.what());
}

}  // namespace

Surface make_revolution(const PrimarySpec& s) {
  ShapeDomain d = domain_of(s);
  if (s.points.empty()) {
    d.range.u_closed = s.points_closed;
    return RevolvedFormulas({d, {formulas_of(s)}});
  }
  const BSplineCurve<2> profile = profile_through_points<2>(s);
  restrict_to_profile(profile.domain(), s.u, "u", d.range.u, d.range.u_closed);
  return RevolvedSpline({d, {profile}});
}

Surface make_extrusion(const PrimarySpec& s) {
  ShapeDomain d = domain_of(s);
  const Vec3 direction = s.direction.normalized();
  if (s.points.empty()) {
    d.range.v_closed = s.points_closed;
    return ExtrudedFormulas({d, {formulas_of(s)}, direction});
  }
  const BSplineCurve<3> profile = profile_through_points<3>(s);
  restrict_to_profile(profile.domain(), s.v, "v", d.range.v, d.range.v_closed);
  return ExtrudedSpline({d, {profile}, direction});
}

Surface make_formula(const PrimarySpec& s) { return TypedSurface({domain_of(s), formulas_of(s)}); }

Surface make_bspline(const PrimarySpec& s) {
  const int total = static_cast<int>(s.points.size());
  int rows = s.point_rows;
  if (rows == 0 && !s.knots[0].empty()) rows = count_of(s, 0);
  if (rows == 0 && !s.knots[1].empty() && count_of(s, 1) > 0) rows = total / count_of(s, 1);
  if (rows <= 0 || total % rows != 0)
    throw InputError("points", "are " + number_text(total) +
                                   ", must be a whole number of equal rows (of which the knots, or the rows "
                                   "given, make " +
                                   number_text(rows) + ")");
  const std::array<int, 2> counts{rows, total / rows};
  for (std::size_t k = 0; k < 2; ++k) {
    if (!s.knots[k].empty() && count_of(s, k) != counts[k])
      throw InputError("knots/" + number_text(static_cast<double>(k)),
                       "stand for " + number_text(count_of(s, k)) + " control points of degree " +
                           number_text(s.degree[k]) + ", must stand for " + number_text(counts[k]) + " (" +
                           (k == 0 ? "rows" : "columns") + " of points)");
    if (counts[k] < s.degree[k] + 1)
      throw InputError("points", "have " + number_text(counts[k]) + (k == 0 ? " rows" : " columns") +
                                     ", must have at least " + number_text(s.degree[k] + 1) + " for degree " +
                                     number_text(s.degree[k]));
  }
  return BSplineSurface(basis_of(s, 0, counts[0]), basis_of(s, 1, counts[1]), s.points);
}

}  // namespace blendwright
