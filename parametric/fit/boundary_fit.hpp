#pragma once
// Quintic splines along v of the boundary data of a blend: periodic when it is closed, complete when it is
// open.
//
// The error on a span is bounded by sample_factor times its largest value at the five inner samples
// (span_plan.hpp). This is proven when the error is a polynomial of degree 6 there, which it is to leading
// order for data with six continuous derivatives; for data of lower smoothness it is an estimate.
#include <Eigen/Core>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/geometry/bspline.hpp"
#include "parametric/fit/fit_groups.hpp"

namespace blendwright::detail {

/// E_k = C0, T0[, D0], C1, T1[, D1] at one v, in frame components, positions relative to the anchor: d[l][k]
/// is the derivative of order l with respect to v, l = 0..2.
struct BoundaryData {
  std::array<std::array<Vec3, 6>, 3> d;
};

class BoundarySampler {
 public:
  explicit BoundarySampler(const OdeBlend& blend);
  [[nodiscard]] BoundaryData operator()(double v) const;
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  const OdeBlend& blend_;
  std::size_t count_;
  Eigen::Matrix3d to_frame_;
  Vec3 anchor_;
};

struct BoundaryTarget {
  double position = 0.0;   ///< of sum_k size_k |E_k - E~_k|
  double angle = 0.0;      ///< at both trimlines, radians
  double curvature = 0.0;  ///< at the trimlines of ends that ask G2
  int max_spans = 0;
};

struct BoundaryFit {
  using Control = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  BSplineBasis basis;
  Control beta;  ///< basis.count() x 3 order: control values of E_k, component x in column 3 k + x
  std::vector<PerFunction> error;       ///< per group: bound of |E_k - E~_k|
  double position = 0.0;                ///< bound of sum_k size_k |E_k - E~_k|
  double angle = 0.0, curvature = 0.0;  ///< largest sampled
};

/// Spans grow, and move to where they are needed, until the targets hold. Throws ConvergenceError beyond
/// max_spans.
/// @param size  per group: sup |psi_k|
[[nodiscard]] BoundaryFit fit_boundary(const OdeBlend& blend, const std::vector<ComponentGroup>& groups,
                                       const std::vector<PerFunction>& size, const BoundaryTarget& target,
                                       const Progress& progress);

}  // namespace blendwright::detail
