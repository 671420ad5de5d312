#pragma once
// The vector x of all unknowns: shape, factor laws, tangent angles, map. Private to this module.
#include <optional>
#include <vector>

#include "parametric/shape_fit/row_weights.hpp"
#include "parametric/shape_fit/shape_fit.hpp"
#include "parametric/trimline/scalar_spline.hpp"

namespace blendwright::detail {

/// A law that is linear in its values: f(t) = offset(t) + sum_j row_j(t) value_j.
class LinearLaw {
 public:
  LinearLaw() = default;  ///< zero
  /// A law that does not change.
  LinearLaw(const std::vector<LawPoint>& fixed, bool closed);
  /// Values at t_j are unknown; `pinned`: (0, 0) and (1, 0) are added (the ends of an open map).
  [[nodiscard]] static LinearLaw unknown(const std::vector<double>& t, bool closed, bool pinned = false);

  [[nodiscard]] std::size_t unknowns() const { return t_.size(); }
  [[nodiscard]] const std::vector<double>& places() const { return t_; }
  /// row_j as a series about t.
  [[nodiscard]] Series row(std::size_t j, double t) const;
  /// f about t for these values.
  [[nodiscard]] Series operator()(double t, const double* values) const;

 private:
  std::vector<double> t_;                          ///< of the unknown values
  std::vector<std::optional<ScalarSpline>> rows_;  ///< nullopt: the constant 1
  double constant_ = 0.0;
  std::optional<ScalarSpline> fixed_;
};

/// Where each group of unknowns starts in x; groups may be empty.
struct Layout {
  ShapeUnknown shape = ShapeUnknown::none;
  std::array<LinearLaw, 2> law;  ///< factor laws of the sides
  LinearLaw map;                 ///< g(t) - t
  std::array<bool, 2> angle{false, false};
  bool mapped = false;  ///< the map is unknown

  [[nodiscard]] std::size_t law_start(std::size_t side) const;
  [[nodiscard]] std::size_t angle_start(std::size_t side) const;
  [[nodiscard]] std::size_t map_start() const;
  [[nodiscard]] std::size_t size() const;
};

}  // namespace blendwright::detail
