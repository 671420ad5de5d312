#pragma once
// Spline interpolation: own cyclic solver (the library function of the CAD kernel is only C1 at the seam),
// complete interpolation with end derivatives, and the tensor product of the two.
#include <Eigen/Core>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/geometry/bspline.hpp"

namespace blendwright {

/// Control values of the periodic spline of odd degree p (C^{p-1} across the seam too) with breaks t_0..t_n
/// and value row i at t_i. Error for smooth data: O(h^{p+1}).
/// @param values  n x channels (row n would repeat row 0 and is not given)
/// @return        n x channels; throws GeometryError when n < p + 1, InputError when the basis is not
/// periodic, of odd
///                degree with simple breaks, or the number of rows is not n
[[nodiscard]] Eigen::MatrixXd periodic_control(const BSplineBasis& basis,
                                               const Eigen::Ref<const Eigen::MatrixXd>& values);

/// Control values of the clamped spline of odd degree p <= 9 that takes value row i at break t_i and the
/// given end derivatives of orders 1..(p-1)/2 ("complete" interpolation). Reproduces polynomials of degree p.
/// @param values  (n + 1) x channels
/// @param start, end  (p-1)/2 x channels, row k-1 = k-th derivative with respect to t
/// @return        (n + p) x channels; throws InputError when the basis is not clamped, of odd degree with
/// simple
///                interior breaks, or a number of rows is wrong
[[nodiscard]] Eigen::MatrixXd complete_control(const BSplineBasis& basis,
                                               const Eigen::Ref<const Eigen::MatrixXd>& values,
                                               const Eigen::Ref<const Eigen::MatrixXd>& start,
                                               const Eigen::Ref<const Eigen::MatrixXd>& end);

/// Curve through points at parameters, of odd degree <= 9: periodic (last point must not repeat the first) or
/// clamped, complete with the end derivatives of the polynomial through the degree + 1 nearest points (keeps
/// the order of convergence, degree + 1). Throws InputError: fewer than degree + 1 points, parameters not
/// increasing, two equal neighbours.
/// @param parameters  one per point; for closed curves one more, where the curve returns to the first point
template <int Dim>
[[nodiscard]] BSplineCurve<Dim> interpolate_points(const std::vector<Eigen::Matrix<double, Dim, 1>>& points,
                                                   const std::vector<double>& parameters, bool closed,
                                                   int degree = 5);
/// Chord-length parameters on [0, 1] for the above; n for open, n + 1 for closed curves (the last closes the
/// loop). Throws InputError: fewer than 2 points, two equal neighbours.
template <int Dim>
[[nodiscard]] std::vector<double> chord_parameters(const std::vector<Eigen::Matrix<double, Dim, 1>>& points,
                                                   bool closed);

/// The spline surface that agrees with `surface` at the breaks of both bases, and along open directions in
/// the end derivatives of orders 1..(p-1)/2 as well (complete in both directions, exact mixed derivatives at
/// the corners). Degrees 1, 3 or 5; a periodic basis needs a direction that is closed. Throws InputError
/// otherwise.
[[nodiscard]] BSplineSurface interpolate_surface(const Surface& surface, const BSplineBasis& basis_u,
                                                 const BSplineBasis& basis_v);

struct SurfaceFitOptions {
  double tolerance = 1e-8;  ///< largest distance at equal parameters, model units
  int degree = 5;           ///< 3 or 5
  int max_spans = 512;      ///< per direction
};
struct SurfaceFit {
  BSplineSurface surface;
  double error = 0.0;  ///< largest measured distance at equal parameters, on 3 samples per span and direction
  UV at;
};
/// interpolate_surface of any surface over its domain (periodic where it is closed), spans doubled in the
/// direction that needs it until the tolerance is met. Used for primaries that STEP has no own entity for.
/// Throws ConvergenceError at max_spans.
[[nodiscard]] SurfaceFit fit_surface(const Surface& surface, const SurfaceFitOptions& options,
                                     const Progress& progress = {});

}  // namespace blendwright
