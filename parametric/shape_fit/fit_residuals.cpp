#include "parametric/shape_fit/fit_residuals.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "kernel/base/parallel_for.hpp"
#include "kernel/math/quadrature.hpp"
#include "parametric/shape_fit/surface_measures.hpp"
#include "parametric/trimline/law_spline.hpp"

namespace blendwright::detail {
namespace {

constexpr int slope_samples = 128;
/// Limits (curvature, clearance, folds) count this much more than wishes, so that the compromise between the
/// two stays within a per cent of the limit.
constexpr double limit_factor = 10.0;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

}  // namespace

double weight(const FitObjective& objective) {
  return std::visit([](const auto& o) { return o.weight; }, objective);
}

bool on_grid(const FitObjective& objective) {
  return std::holds_alternative<ThinPlate>(objective) ||
         std::holds_alternative<CurvatureVariation>(objective) ||
         std::holds_alternative<LargestCurvature>(objective) ||
         std::holds_alternative<Clearance>(objective) || std::holds_alternative<NoFold>(objective);
}

int rows_per_point(const FitObjective& objective) {
  if (std::holds_alternative<ThinPlate>(objective)) return 9;
  return std::holds_alternative<LargestCurvature>(objective) ? 2 : 1;
}

/// Where residuals of one place go.
class FitResiduals::Sink {
 public:
  Sink(double* residuals, RowMatrix* J, int row) : residuals_(residuals), J_(J), row_(row) {}
  [[nodiscard]] bool with_derivatives() const { return J_ != nullptr; }
  void add(double value, const JetVector& by, const JetAt& jet, double factor) {
    residuals_[row_] = factor * value;
    if (J_) J_->row(row_).noalias() = factor * by.transpose() * jet.by;
    ++row_;
  }
  /// max(0, value).
  void add_above(double value, const JetVector& by, const JetAt& jet, double factor) {
    if (value > 0.0) return add(value, by, jet, factor);
    residuals_[row_] = 0.0;
    if (J_) J_->row(row_).setZero();
    ++row_;
  }
  void add_vector(const JetAt& jet, JetPlace place, double factor) {
    for (Eigen::Index i = 0; i < 3; ++i, ++row_) {
      residuals_[row_] = factor * jet.value[place + i];
      if (J_) J_->row(row_) = factor * jet.by.row(place + i);
    }
  }

 private:
  double* residuals_;
  RowMatrix* J_;
  int row_;
};

FitResiduals::FitResiduals(const BlendModel& model, const ShapeFitOptions& options, std::vector<double> x0)
    : model_(model), options_(options), x0_(std::move(x0)) {
  const QuadratureRule& across = gauss_legendre(options.samples_u);
  for (std::size_t i = 0; i < across.x.size(); ++i) grid_.push_back({across.x[i], across.w[i]});
  const int n = options.samples_v;
  if (model.closed()) {
    for (int i = 0; i < n; ++i) places_.push_back({(i + 0.5) / n, 1.0 / n});
  } else {
    const QuadratureRule& cell = gauss_legendre(4);
    const int cells = (n + 3) / 4;
    for (int k = 0; k < cells; ++k)
      for (std::size_t i = 0; i < 4; ++i) places_.push_back({(k + cell.x[i]) / cells, cell.w[i] / cells});
  }
  bool linear = model.order() == 4;
  for (const FitObjective& o : options.objectives) {
    if (!std::holds_alternative<ThinPlate>(o) && weight(o) > 0.0) linear = false;
    std::vector<double> columns;
    std::optional<ScalarSpline> law;
    if (const auto* ball = std::get_if<RollingBall>(&o)) {
      for (const double f : {0.0, 0.5, 1.0}) columns.push_back(ball->across.at(f));
      law = law_spline(ball->radius, model.closed());
    }
    ball_columns_.push_back(std::move(columns));
    radius_laws_.push_back(std::move(law));
  }
  linear_in_laws_ = linear;
  place_rows();
  const BlendModel::At start(model_, x0_.data());
  measure_start(start);
  find_feet(x0_.data());
  set_scales();
}

void FitResiduals::place_rows() {
  int row = 0;
  for (Place& place : places_) {
    place.row = row;
    for (std::size_t k = 0; k < options_.objectives.size(); ++k) {
      const FitObjective& o = options_.objectives[k];
      if (on_grid(o)) row += rows_per_point(o) * static_cast<int>(grid_.size());
      row += static_cast<int>(ball_columns_[k].size());
    }
  }
  for (std::size_t k = 0; k < options_.objectives.size(); ++k) {
    Points set;
    set.objective = k;
    if (const auto* through = std::get_if<PassThrough>(&options_.objectives[k])) {
      set.points = &through->points;
    } else if (const auto* scan = std::get_if<ScannedPoints>(&options_.objectives[k])) {
      set.points = &scan->points;
      set.robust_scale = scan->robust_scale;
    } else {
      continue;
    }
    set.feet.resize(set.points->size());
    set.row = row;
    row += static_cast<int>(set.points->size());
    point_sets_.push_back(std::move(set));
  }
  slope_row_ = row;
  prior_row_ = row + (model_.layout().mapped ? slope_samples : 0);
  total_rows_ = prior_row_ + unknowns();
}

void FitResiduals::measure_start(const BlendModel::At& start) {
  std::vector<WeightsAt> weights;
  for (const Column& c : grid_) weights.push_back(start.weights(c.u, false));
  const WeightsAt middle = start.weights(0.5, false);
  double turning = 0.0, chord = 0.0;
  lengths_.setZero();
  for (Place& place : places_) {
    const Section s = start.section(place.t, false);
    place.end_normal = {s.R[0][T0].cross(s.R[1][C0]).normalized(), s.R[0][T1].cross(s.R[1][C1]).normalized()};
    for (std::size_t j = 0; j < grid_.size(); ++j) {
      const JetAt jet = start.jet(s, weights[j], false);
      lengths_ += place.weight * grid_[j].weight * Vec2(jet.part(at_Su).norm(), jet.part(at_Sv).norm());
    }
    const JetAt jet = start.jet(s, middle, false);
    const Vec3 n = jet.part(at_Su).cross(jet.part(at_Sv)).normalized();
    turning += place.weight * (s.R[0][T1].normalized() - s.R[0][T0].normalized()).dot(n);
    chord += place.weight * (s.R[0][C1] - s.R[0][C0]).norm();
  }
  size_ = chord;
  curvature_sign_ = turning < 0.0 ? -1.0 : 1.0;
}

/// An objective's residuals at the start have the size 1 where there is no target.
void FitResiduals::set_scales() {
  scale_.assign(options_.objectives.size(), 1.0);
  Eigen::VectorXd residuals(count());
  (void)evaluate(x0_.data(), residuals.data(), nullptr);
  std::vector<double> squares(scale_.size(), 0.0);
  for (const Place& place : places_) {
    int row = place.row;
    for (std::size_t k = 0; k < scale_.size(); ++k) {
      int rows = static_cast<int>(ball_columns_[k].size());
      if (on_grid(options_.objectives[k]))
        rows = rows_per_point(options_.objectives[k]) * static_cast<int>(grid_.size());
      squares[k] += residuals.segment(row, rows).squaredNorm();
      row += rows;
    }
  }
  for (const Points& set : point_sets_)
    squares[set.objective] =
        residuals.segment(set.row, static_cast<Eigen::Index>(set.points->size())).squaredNorm();
  for (std::size_t k = 0; k < scale_.size(); ++k) {
    const FitObjective& o = options_.objectives[k];
    double unit = 1.0;  // of the square
    if (std::holds_alternative<ThinPlate>(o)) unit = std::max(squares[k], 1e-20);
    if (std::holds_alternative<CurvatureVariation>(o)) unit = std::max(squares[k], 1e-6 / (size_ * size_));
    if (std::holds_alternative<PassThrough>(o) || std::holds_alternative<ScannedPoints>(o))
      unit = std::max(squares[k], 1e-6 * size_ * size_);
    scale_[k] = std::sqrt(weight(o) / unit);
  }
}

double FitResiduals::radius(const RollingBall& ball, double t) const {
  for (std::size_t k = 0; k < options_.objectives.size(); ++k)
    if (std::get_if<RollingBall>(&options_.objectives[k]) == &ball && radius_laws_[k])
      return (*radius_laws_[k])(t);
  return ball.radius.front().value;
}

bool FitResiduals::allowed(const Section& s) const {
  if (!(s.least_law > 0.0) || !(s.map_slope > 0.2 * options_.bounds.least_speed)) return false;
  return s.cos_theta > std::cos(degrees(170.0).value);
}

bool FitResiduals::allowed(const double* x) const {
  const Layout& layout = model_.layout();
  constexpr int samples = 256;
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    for (std::size_t side = 0; side < 2; ++side)
      if (layout.law[side].unknowns() > 1 && !(layout.law[side](t, x + layout.law_start(side)).value() > 0.0))
        return false;
    if (layout.mapped &&
        !(1.0 + layout.map(t, x + layout.map_start()).derivative(1) > 0.2 * options_.bounds.least_speed))
      return false;
  }
  return true;
}

bool FitResiduals::evaluate(const double* x, double* residuals, RowMatrix* J) const {
  if (!allowed(x)) return false;
  if (J) J->resize(count(), unknowns());
  const BlendModel::At blend(model_, x);
  const bool derivatives = J != nullptr;
  std::vector<WeightsAt> weights;
  for (const Column& c : grid_) weights.push_back(blend.weights(c.u, derivatives));
  for (const std::vector<double>& columns : ball_columns_)
    for (const double u : columns) weights.push_back(blend.weights(u, derivatives));
  std::atomic<bool> good{true};
  parallel_for(places_.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && good; ++i)
      if (!at_place(blend, weights, places_[i], residuals, J)) good = false;
  });
  for (const Points& set : point_sets_)
    if (good && !at_points(blend, set, residuals, J)) good = false;
  if (!good) return false;
  slopes_and_priors(x, residuals, J);
  return Eigen::Map<const Eigen::VectorXd>(residuals, count()).allFinite() && (!J || J->allFinite());
}

bool FitResiduals::at_place(const BlendModel::At& blend, const std::vector<WeightsAt>& weights,
                            const Place& place, double* residuals, RowMatrix* J) const {
  const bool derivatives = J != nullptr;
  const Section section = blend.section(place.t, derivatives);
  if (!allowed(section)) return false;
  std::vector<JetAt> jets;
  for (const WeightsAt& w : weights) jets.push_back(blend.jet(section, w, derivatives));
  Sink sink(residuals, J, place.row);
  std::size_t ball_jet = grid_.size();
  for (std::size_t k = 0; k < options_.objectives.size(); ++k) {
    const FitObjective& objective = options_.objectives[k];
    if (const auto* ball = std::get_if<RollingBall>(&objective)) {
      const double R = radius(*ball, place.t);
      const double factor =
          scale_[k] * std::sqrt(place.weight / static_cast<double>(ball_columns_[k].size()));
      for (std::size_t i = 0; i < ball_columns_[k].size(); ++i, ++ball_jet) {
        const Measure m = line_curvature(jets[ball_jet].value);
        sink.add(curvature_sign_ * R * m.value - 1.0, curvature_sign_ * R * m.by, jets[ball_jet], factor);
      }
      continue;
    }
    if (!on_grid(objective)) continue;
    for (std::size_t j = 0; j < grid_.size(); ++j) {
      const JetAt& jet = jets[j];
      const double factor = scale_[k] * std::sqrt(place.weight * grid_[j].weight);
      std::visit(
          Overloaded{[&](const ThinPlate&) {
                       const double a = 1.0 / lengths_[0], b = 1.0 / lengths_[1];
                       const double area = factor * std::sqrt(lengths_[0] * lengths_[1]);
                       sink.add_vector(jet, at_Suu, area * a * a);
                       sink.add_vector(jet, at_Suv, area * std::sqrt(2.0) * a * b);
                       sink.add_vector(jet, at_Svv, area * b * b);
                     },
                     [&](const CurvatureVariation&) {
                       const Measure m = curvature_change(jet.value);
                       sink.add(m.value, m.by, jet, factor);
                     },
                     [&](const LargestCurvature& o) {
                       for (const Measure& m : principal_curvatures(jet.value)) {
                         const double sign = m.value < 0.0 ? -o.least_radius : o.least_radius;
                         sink.add_above(sign * m.value - 0.99, sign * m.by, jet, limit_factor * factor);
                       }
                     },
                     [&](const Clearance& o) {
                       const ObstacleSample s = o.obstacle(jet.part(at_S));
                       JetVector by = JetVector::Zero();
                       by.segment<3>(at_S) = -s.gradient / o.distance;
                       sink.add_above(1.0 + 0.01 - s.distance / o.distance, by, jet, limit_factor * factor);
                     },
                     [&](const NoFold& o) {
                       const double u = grid_[j].u;
                       const Vec3 n =
                           ((1.0 - u) * place.end_normal[0] + u * place.end_normal[1]).normalized();
                       const Measure m = normal_along(jet.value, n);
                       const double unit = std::max(o.margin, 0.01);
                       sink.add_above((o.margin - m.value) / unit, -m.by / unit, jet, limit_factor * factor);
                     },
                     [](const auto&) {}},
          objective);
    }
  }
  return true;
}

bool FitResiduals::at_points(const BlendModel::At& blend, const Points& set, double* residuals,
                             RowMatrix* J) const {
  const std::size_t n = set.points->size();
  const double factor = scale_[set.objective];
  std::atomic<bool> good{true};
  parallel_for(n, 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& q = (*set.points)[i];
      FootPoint& foot = set.feet[i];
      foot = closest(blend, model_.closed(), q, foot);
      const JetAt jet = blend.jet(foot.u, foot.t, J != nullptr);
      const FootDistance d = signed_distance(jet, q);
      double value = d.value, slope = 1.0;
      if (set.robust_scale) {  // Cauchy: r^2 becomes s^2 log(1 + (r/s)^2)
        const double s = *set.robust_scale, z = d.value / s * (d.value / s);
        const double root = z < 1e-12 ? 1.0 : std::sqrt(std::log1p(z) / z);
        value = d.value * root;
        slope = 1.0 / (root * (1.0 + z));
      }
      const auto row = set.row + static_cast<int>(i);
      residuals[row] = factor * value;
      if (!std::isfinite(residuals[row])) good = false;
      if (J) J->row(row).noalias() = (factor * slope) * d.direction.transpose() * jet.by.topRows<3>();
    }
  });
  return good;
}

void FitResiduals::slopes_and_priors(const double* x, double* residuals, RowMatrix* J) const {
  const Layout& layout = model_.layout();
  if (J) J->bottomRows(count() - slope_row_).setZero();
  if (layout.mapped) {
    // The map is pushed away from its least slope from half as much again on.
    const double least = options_.bounds.least_speed, factor = limit_factor / std::sqrt(slope_samples);
    for (int i = 0; i < slope_samples; ++i) {
      const double t = (i + 0.5) / slope_samples;
      const double below = 1.5 - (1.0 + layout.map(t, x + layout.map_start()).derivative(1)) / least;
      residuals[slope_row_ + i] = factor * std::max(0.0, below);
      if (!J || !(below > 0.0)) continue;
      for (std::size_t j = 0; j < layout.map.unknowns(); ++j)
        (*J)(slope_row_ + i, static_cast<Eigen::Index>(layout.map_start() + j)) =
            -factor / least * layout.map.row(j, t).derivative(1);
    }
  }
  for (int p = 0; p < unknowns(); ++p) {
    residuals[prior_row_ + p] = options_.bounds.prior * (x[p] - x0_[static_cast<std::size_t>(p)]);
    if (J) (*J)(prior_row_ + p, p) = options_.bounds.prior;
  }
}

bool FitResiduals::find_feet(const double* x) {
  if (point_sets_.empty()) return false;
  const BlendModel::At blend(model_, x);
  const FootGrid grid(blend, model_.closed());
  std::atomic<bool> nearer{false};
  for (Points& set : point_sets_)
    parallel_for(set.points->size(), 32, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vec3& q = (*set.points)[i];
        const auto distance = [&](const FootPoint& f) {
          return (blend.jet(f.u, f.t, false).part(at_S) - q).norm();
        };
        const FootPoint found = closest(blend, model_.closed(), q, grid.nearest(q));
        if (!(distance(found) < distance(set.feet[i]) - 1e-9 * size_)) continue;
        set.feet[i] = found;
        nearer = true;
      }
    });
  return nearer;
}

}  // namespace blendwright::detail
