#include "app/pipeline/curve_of_formulas.hpp"

#include "kernel/geometry/formula_surface.hpp"
#include "kernel/geometry/spline_interpolation.hpp"
#include "kernel/math/formula.hpp"

namespace blendwright {
namespace {

template <int Dim>
struct TypedCurve {
  std::vector<Formula> formulas;
  CurveDomain range;
  template <class T>
  std::array<T, static_cast<std::size_t>(Dim)> operator()(const T& v) const {
    const std::vector<T> arguments{v};
    std::array<T, static_cast<std::size_t>(Dim)> x;
    for (std::size_t d = 0; d < static_cast<std::size_t>(Dim); ++d) x[d] = formulas[d](arguments);
    return x;
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};

template <int Dim>
Curve<Dim> through_points(const CurveSpec& spec) {
  std::vector<Eigen::Matrix<double, Dim, 1>> points;
  points.reserve(spec.points.size());
  for (const Vec3& p : spec.points) points.push_back(p.head<Dim>());
  const int degree = points.size() >= 6 ? 5 : 3;
  try {
    return interpolate_points<Dim>(points, chord_parameters<Dim>(points, spec.closed), spec.closed, degree);
  } catch (const InputError& e) {
    throw InputError("points", e.problems().front().message);
  }
}

}  // namespace

template <int Dim>
Curve<Dim> make_curve(const CurveSpec& spec, const std::map<std::string, double>& constants) {
  if (!spec.points.empty()) return through_points<Dim>(spec);
  TypedCurve<Dim> curve{{}, {spec.v, spec.closed}};
  std::vector<Problem> problems;
  if (spec.formulas.size() != static_cast<std::size_t>(Dim))
    throw InputError("curve", "has " + std::to_string(spec.formulas.size()) + " formulas, must have " +
                                  std::to_string(Dim));
  for (std::size_t i = 0; i < spec.formulas.size(); ++i) {
    try {
      curve.formulas.emplace_back(spec.formulas[i], std::vector<std::string>{"v"}, constants);
    } catch (const InputError& e) {
      problems.push_back({"curve/" + std::to_string(i), e.problems().front().message});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return FormulaCurve<TypedCurve<Dim>, Dim>(std::move(curve));
}

template Curve<2> make_curve<2>(const CurveSpec&, const std::map<std::string, double>&);
template Curve<3> make_curve<3>(const CurveSpec&, const std::map<std::string, double>&);

}  // namespace blendwright
