#include "parametric/fit/boundary_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/spline_interpolation.hpp"
#include "parametric/fit/span_plan.hpp"
#include "parametric/fit/trimline_defect.hpp"

namespace blendwright::detail {
namespace {

using Eigen::Index;
constexpr int degree = 5;

BSplineBasis basis_on(const std::vector<double>& breaks, bool closed) {
  return closed ? BSplineBasis::closed(degree, breaks) : BSplineBasis::clamped(degree, breaks);
}

BoundaryFit::Control control_of(const BSplineBasis& basis, const BoundarySampler& sample) {
  const std::vector<double>& t = basis.breaks();
  const Index nodes = static_cast<Index>(t.size()) - (basis.periodic() ? 1 : 0);
  const Index channels = 3 * static_cast<Index>(sample.count());
  Eigen::MatrixXd values(nodes, channels), start(2, channels), end(2, channels);
  for (Index i = 0; i < nodes; ++i) {
    const BoundaryData E = sample(t[static_cast<std::size_t>(i)]);
    for (Index c = 0; c < channels; ++c) {
      const auto k = static_cast<std::size_t>(c / 3);
      values(i, c) = E.d[0][k][c % 3];
      if (i == 0) start.col(c) << E.d[1][k][c % 3], E.d[2][k][c % 3];
      if (i == nodes - 1) end.col(c) << E.d[1][k][c % 3], E.d[2][k][c % 3];
    }
  }
  if (basis.periodic()) return periodic_control(basis, values);
  return complete_control(basis, values, start, end);
}

BoundaryData evaluate(const BSplineBasis& basis, const BoundaryFit::Control& beta, double v) {
  const BSplineBasis::Local N = basis.evaluate(v, 2);
  const auto count = static_cast<std::size_t>(beta.cols() / 3);
  BoundaryData E;
  for (std::size_t l = 0; l < 3; ++l)
    for (std::size_t k = 0; k < count; ++k) E.d[l][k].setZero();
  for (int i = 0; i <= degree; ++i) {
    const double* const row =
        beta.data() + static_cast<std::ptrdiff_t>(basis.index(N.first + i)) * beta.cols();
    for (std::size_t l = 0; l < 3; ++l)
      for (std::size_t k = 0; k < count; ++k)
        E.d[l][k] += N.value[l][static_cast<std::size_t>(i)] * Eigen::Map<const Vec3>(row + 3 * k);
  }
  return E;
}

// The jet at u = side of the surface that E describes. D is missing in fourth order; it enters nothing then.
SurfaceJet trimline_jet(const BoundaryData& E, std::size_t side, std::size_t count) {
  const std::size_t k = side * count / 2;
  const Vec3 D = count == 6 ? E.d[0][k + 2] : Vec3::Zero();
  return {E.d[0][k], E.d[0][k + 1], E.d[1][k], D, E.d[1][k + 1], E.d[2][k]};
}

// What is measured on one span.
struct SpanDefect {
  std::vector<PerFunction> error;
  double position = 0.0, angle = 0.0, curvature = 0.0;
};

class Meter {
 public:
  Meter(const OdeBlend& blend, const std::vector<ComponentGroup>& groups,
        const std::vector<PerFunction>& size, const BoundarySampler& sample)
      : groups_(groups), size_(size), sample_(sample) {
    for (int side : {0, 1})
      smooth_[static_cast<std::size_t>(side)] = blend.end(side).continuity == Continuity::G2;
  }

  [[nodiscard]] SpanDefect on(const BSplineBasis& basis, const BoundaryFit::Control& beta,
                              Interval span) const {
    SpanDefect defect;
    defect.error.resize(groups_.size());
    for (double f : span_samples) {
      const double v = span.at(f);
      const BoundaryData exact = sample_(v), spline = evaluate(basis, beta, v);
      for (std::size_t g = 0; g < groups_.size(); ++g)
        for (std::size_t k = 0; k < sample_.count(); ++k) {
          const Vec3 e = exact.d[0][k] - spline.d[0][k];
          defect.error[g][k] = std::max(defect.error[g][k], sample_factor * groups_[g].norm(e));
        }
      for (std::size_t side = 0; side < 2; ++side) {
        const TrimlineDefect d = trimline_defect(trimline_jet(exact, side, sample_.count()),
                                                 trimline_jet(spline, side, sample_.count()));
        defect.angle = std::max(defect.angle, d.angle);
        if (smooth_[side]) defect.curvature = std::max(defect.curvature, d.curvature);
      }
    }
    double squares = 0.0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      double sum = 0.0;
      for (std::size_t k = 0; k < sample_.count(); ++k) sum += size_[g][k] * defect.error[g][k];
      squares += sum * sum;
    }
    defect.position = std::sqrt(squares);
    return defect;
  }

 private:
  const std::vector<ComponentGroup>& groups_;
  const std::vector<PerFunction>& size_;
  const BoundarySampler& sample_;
  std::array<bool, 2> smooth_{};
};

// Number of spans this one should become: orders 6, 5 and 4 of values, first and second derivatives.
double wanted_spans(const SpanDefect& d, const BoundaryTarget& target) {
  return std::max({std::pow(d.position / target.position, 1.0 / 6.0),
                   std::pow(d.angle / target.angle, 1.0 / 5.0),
                   std::pow(d.curvature / target.curvature, 1.0 / 4.0)});
}

void add(BoundaryFit& fit, const SpanDefect& d) {
  for (std::size_t g = 0; g < d.error.size(); ++g)
    for (std::size_t k = 0; k < d.error[g].size(); ++k)
      fit.error[g][k] = std::max(fit.error[g][k], d.error[g][k]);
  fit.position = std::max(fit.position, d.position);
  fit.angle = std::max(fit.angle, d.angle);
  fit.curvature = std::max(fit.curvature, d.curvature);
}

[[noreturn]] void throw_too_many(const BoundaryFit& fit, const BoundaryTarget& target, std::size_t spans) {
  throw ConvergenceError(
      "blend fit along the trimlines: " + std::to_string(spans) + " spans in v reach position " +
      scientific_text(fit.position) + ", angle " + scientific_text(Radians(fit.angle).degrees()) +
      " deg, curvature " + scientific_text(fit.curvature) + "; asked for " +
      scientific_text(target.position) + ", " + scientific_text(Radians(target.angle).degrees()) + " deg, " +
      scientific_text(target.curvature) + "; allow more control points or larger tolerances");
}

}  // namespace

BoundarySampler::BoundarySampler(const OdeBlend& blend)
    : blend_(blend),
      count_(static_cast<std::size_t>(blend.order())),
      to_frame_(Eigen::Matrix3d::Identity()),
      anchor_(Vec3::Zero()) {
  if (blend.shape().frame == BlendFrame::fixed) to_frame_ = blend.shape().axes.transpose();
  if (blend.shape().mode == BlendMode::anchor) anchor_ = blend.shape().anchor;
}

BoundaryData BoundarySampler::operator()(double v) const {
  BoundaryData E;
  const std::size_t half = count_ / 2;
  for (std::size_t side = 0; side < 2; ++side) {
    const EndCondition& end = blend_.end(static_cast<int>(side));
    const EndSeries s = end.series(v);
    const std::size_t k = side * half;
    for (int l = 0; l < 3; ++l) {
      auto& d = E.d[static_cast<std::size_t>(l)];
      d[k] = derivative(s.C, l) - (l == 0 ? anchor_ : Vec3::Zero());
      d[k + 1] = derivative(s.T, l);
      if (half == 3) d[k + 2] = derivative(s.D, l);
    }
    if (half == 3 && end.continuity != Continuity::G2) {  // chosen by the blend
      const SurfacePartials P = blend_.partials({static_cast<double>(side), v});
      for (int l = 0; l < 3; ++l) E.d[static_cast<std::size_t>(l)][k + 2] = P(2, l);
    }
  }
  if (blend_.shape().frame == BlendFrame::fixed)
    for (auto& d : E.d)
      for (std::size_t k = 0; k < count_; ++k) d[k] = (to_frame_ * d[k]).eval();
  return E;
}

BoundaryFit fit_boundary(const OdeBlend& blend, const std::vector<ComponentGroup>& groups,
                         const std::vector<PerFunction>& size, const BoundaryTarget& target,
                         const Progress& progress) {
  const BoundarySampler sample(blend);
  const Meter meter(blend, groups, size, sample);
  const SurfaceDomain domain = blend.domain();
  std::vector<double> breaks;
  for (int i = 0; i <= 8; ++i) breaks.push_back(domain.v.at(i / 8.0));
  for (int round = 0;; ++round) {
    progress.at(0.9 - 0.7 * std::pow(0.8, round), "fitting the blend along its trimlines");
    BoundaryFit fit{
        basis_on(breaks, domain.v_closed), {}, std::vector<PerFunction>(groups.size(), PerFunction{})};
    fit.beta = control_of(fit.basis, sample);
    const std::size_t spans = breaks.size() - 1;
    std::vector<SpanDefect> defects(spans);  // the data along v are what a fit spends its time on
    parallel_for(spans, 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        defects[i] = meter.on(fit.basis, fit.beta, {breaks[i], breaks[i + 1]});
    });
    std::vector<double> wanted(spans);
    for (std::size_t i = 0; i < spans; ++i) {
      wanted[i] = wanted_spans(defects[i], target);
      add(fit, defects[i]);
    }
    if (fit.position <= target.position && fit.angle <= target.angle && fit.curvature <= target.curvature)
      return fit;
    if (static_cast<int>(spans) >= target.max_spans) throw_too_many(fit, target, spans);
    breaks = refined_breaks(breaks, wanted, domain.v_closed);
  }
}

}  // namespace blendwright::detail
