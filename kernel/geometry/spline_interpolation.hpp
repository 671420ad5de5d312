#pragma once
// Spline interpolation: own cyclic solver (the library function of the CAD kernel is only C1 at the seam), complete
// interpolation with end derivatives, and the tensor product of the two.
#include <Eigen/Core>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/geometry/bspline.hpp"

namespace blendwright {

/// Control values of the periodic spline of odd degree p (C^{p-1} across the seam too) with breaks t_0..t_n and value
/// row i at t_i.
/// @param values  n x channels (row n would repeat row 0 and is not given)
/// @return        n x channels; throws GeometryError when n < p + 1
[[nodiscard]] Eigen::MatrixXd periodic_control(const BSplineBasis& basis, const Eigen::Ref<const Eigen::MatrixXd>& values);

/// Control values of the clamped spline of odd degree p that takes value row i at break t_i and the given end
/// derivatives of orders 1..(p-1)/2 ("complete" interpolation).
/// @param values  (n + 1) x channels
/// @param start, end  (p-1)/2 x channels, row k-1 = k-th derivative with respect to t
/// @return        (n + p) x channels
[[nodiscard]] Eigen::MatrixXd complete_control(const BSplineBasis& basis, const Eigen::Ref<const Eigen::MatrixXd>& values,
                                               const Eigen::Ref<const Eigen::MatrixXd>& start,
                                               const Eigen::Ref<const Eigen::MatrixXd>& end);

/// Curve through points at parameters: periodic (last point must not repeat the first) or clamped "not-a-knot-free"
/// interpolation with natural end derivatives estimated from the nearest points. Throws InputError: fewer than
/// degree + 1 points, parameters not increasing, two equal neighbours.
template <int Dim>
[[nodiscard]] BSplineCurve<Dim> interpolate_points(const std::vector<Eigen::Matrix<double, Dim, 1>>& points,
                                                   const std::vector<double>& parameters, bool closed, int degree = 5);
/// Chord-length parameters on [0, 1] for the above; n for open, n + 1 for closed curves (the last closes the loop).
template <int Dim>
[[nodiscard]] std::vector<double> chord_parameters(const std::vector<Eigen::Matrix<double, Dim, 1>>& points, bool closed);

struct SurfaceFitOptions {
  double tolerance = 1e-8;  ///< largest distance at equal parameters, model units
  int degree = 5;
  int max_spans = 512;      ///< per direction
};
struct SurfaceFit {
  BSplineSurface surface;
  double error = 0.0;       ///< largest measured distance at equal parameters, on 3 samples per span and direction
  UV at;
};
/// Degree-5 interpolation of any surface over its domain (periodic where it is closed), spans doubled in the direction
/// that needs it until the tolerance is met. Used for primaries that STEP has no own entity for. Throws
/// ConvergenceError at max_spans.
[[nodiscard]] SurfaceFit fit_surface(const Surface& surface, const SurfaceFitOptions& options, const Progress& progress = {});

}  // namespace blendwright
