#pragma once
// The residuals of (1) in shape_fit.hpp with their analytic Jacobian. Private to this module.
//
// Integrals over the surface are sums over Gauss points across and places along v (equal steps on closed
// lines, where they converge fastest). Everything at one place shares the section there.
#include <functional>
#include <memory>

#include "parametric/shape_fit/foot_point.hpp"
#include "parametric/shape_fit/shape_fit.hpp"

namespace blendwright::detail {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class FitResiduals {
 public:
  /// x0: where the priors pull to, and what the scales of the objectives are taken from.
  FitResiduals(const BlendModel& model, const ShapeFitOptions& options, std::vector<double> x0);

  [[nodiscard]] int count() const { return total_rows_; }
  [[nodiscard]] int unknowns() const { return static_cast<int>(model_.unknowns()); }
  /// Rows of the objectives; the others belong to the map's slope and to the priors.
  [[nodiscard]] int objective_rows() const { return slope_row_; }

  /// False where x is no blend: a law that is not positive, a map that runs back, a turn of 170 deg or more
  /// with circle_like, a residual that is not finite. J may be null.
  [[nodiscard]] bool evaluate(const double* x, double* residuals, RowMatrix* J) const;

  /// Searches all foot points anew. Returns whether one is nearer than before by more than 1e-9 of the size.
  bool find_feet(const double* x);

  /// Whether every residual is linear in the values of the factor laws.
  [[nodiscard]] bool linear_in_laws() const { return linear_in_laws_; }
  /// Lengths that the thin-plate energy scales its parameters by: mean |Su|, and mean |Sv| per unit of t.
  [[nodiscard]] const Vec2& lengths() const { return lengths_; }
  [[nodiscard]] double curvature_sign() const { return curvature_sign_; }

 private:
  struct Place {
    double t = 0.0, weight = 0.0;
    int row = 0;
    std::array<Vec3, 2> end_normal{Vec3::Zero(), Vec3::Zero()};
  };
  struct Column {
    double u = 0.0, weight = 0.0;
  };
  /// Points of an objective and where their feet were last.
  struct Points {
    std::size_t objective = 0;
    const std::vector<Vec3>* points = nullptr;
    std::optional<double> robust_scale{};
    mutable std::vector<FootPoint> feet{};
    int row = 0;
  };
  class Sink;

  void measure_start(const BlendModel::At& start);
  void place_rows();
  void set_scales();
  [[nodiscard]] bool allowed(const double* x) const;
  [[nodiscard]] bool allowed(const Section& section) const;
  bool at_place(const BlendModel::At& blend, const std::vector<WeightsAt>& weights, const Place& place,
                double* residuals, RowMatrix* J) const;
  bool at_points(const BlendModel::At& blend, const Points& points, double* residuals, RowMatrix* J) const;
  void slopes_and_priors(const double* x, double* residuals, RowMatrix* J) const;
  [[nodiscard]] double radius(const RollingBall& ball, double t) const;

  const BlendModel& model_;
  const ShapeFitOptions& options_;
  std::vector<double> x0_;
  std::vector<Column> grid_;                       ///< across, of the surface integrals
  std::vector<std::vector<double>> ball_columns_;  ///< across, of each objective (rolling balls only)
  std::vector<Place> places_;
  std::vector<Points> point_sets_;
  std::vector<double> scale_;  ///< of each objective, weight included
  std::vector<std::optional<ScalarSpline>> radius_laws_;
  Vec2 lengths_{1.0, 1.0};
  double size_ = 1.0, curvature_sign_ = 1.0;
  bool linear_in_laws_ = false;
  int slope_row_ = 0, prior_row_ = 0, total_rows_ = 0;
};

/// Rows that an objective has at one point of the grid (rolling ball: at each of its columns).
[[nodiscard]] int rows_per_point(const FitObjective& objective);
[[nodiscard]] bool on_grid(const FitObjective& objective);
[[nodiscard]] double weight(const FitObjective& objective);

}  // namespace blendwright::detail
