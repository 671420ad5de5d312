#pragma once
// Quintic splines of the cardinal functions with a bound of their error that holds between the samples.
//
// With the data E_k = (C0, T0[, D0], C1, T1[, D1]) every mode reads S = a + sum_k psi_k (E_k - a delta_k) (1)
//   origin, anchor:  psi_k = phi_k                        (a = 0, or the anchor; delta_k = 1 for positions)
//   chord:           psi_C0 = 1 - u + phi_T0 + phi_T1,  psi_C1 = u - phi_T0 - phi_T1,  else psi_k = phi_k
// so that one net of rank 4 (6) serves all of them; 1 - u and u are exact in the spline space.
//
// Error bound on a span with samples at distance delta, e = phi - phi~, c = delta^2/8:
//   |e| <= max|e_i| + c sup|e''|,  sup|e''| <= max|e''_i| + c sup|e''''| (2)
// Fourth order: sup|e''''| <= max|e''''_i| + c sup|phi^(6)|, with phi'''' = p phi'' - s phi and its
// derivatives, which leaves S0 = sup|phi| and S2 = sup|phi''| between two samples. With the roots L1 >= L2 of
// L^2 - p L + s:
//   L2 >= 0:  z = phi'' - L2 phi has z'' = L1 z, so |z| has its maximum Z at a sample, and by the maximum
//   principle
//             S0 <= max|phi_i| + min(c, 1/L2) Z,  S2 <= L2 S0 + Z (3)
//   else      S0 <= max|phi_i| + c S2,  S2 <= max|phi''_i| + c (|p| S2 + |s| S0),  which closes while
//             c |p| + c^2 |s| < 1 (4)
// The bound is proven but for rounding.
// Sixth order: sup|e''''| is estimated as twice the largest divided difference of e''' (phi'''' is not
// evaluated); with delta a quarter of a span this term is below 1 % of the bound.
#include <Eigen/Core>
#include <vector>

#include "kernel/geometry/bspline.hpp"
#include "parametric/fit/fit_groups.hpp"

namespace blendwright::detail {

struct CardinalFit {
  BSplineBasis basis;
  std::vector<Eigen::MatrixXd> alpha;           ///< per group: basis.count() x order, control values of psi_k
  std::vector<std::vector<PerFunction>> error;  ///< per group and span: bound of |phi_k - phi~_k| there
  std::vector<PerFunction> size;                ///< per group: bound of sup |psi~_k|
  std::vector<double> coarse;                   ///< per span: left side of the condition of (4), else 0
};

/// Largest over the spans of the root of the sum of squares over the groups of sum_k |phi_k - phi~_k|
/// weight_k.
/// @param weight  per group: what the error of phi_k is multiplied by, that is sup |B_k|
[[nodiscard]] double weighted_error(const CardinalFit& fit, const std::vector<PerFunction>& weight);

/// Spans grow until weighted_error is at most `target`.
/// Throws ConvergenceError beyond max_spans.
[[nodiscard]] CardinalFit fit_cardinals(const OdeBlend& blend, const std::vector<ComponentGroup>& groups,
                                        const std::vector<PerFunction>& weight, double target, int max_spans);

}  // namespace blendwright::detail
