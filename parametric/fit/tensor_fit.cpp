#include "parametric/fit/tensor_fit.hpp"

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

constexpr int degree = 5;

std::vector<double> inner_samples(const std::vector<double>& breaks) {
  std::vector<double> t;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (double f : span_samples) t.push_back(Interval{breaks[i], breaks[i + 1]}.at(f));
  return t;
}

double distance(const OdeBlend& blend, const BSplineSurface& spline, UV p) {
  return (blend.jet(p).S - spline.jet(p).S).norm();
}

// Largest value of f(i, j) over j, for every i.
template <class F>
std::vector<double> row_maxima(std::size_t rows, std::size_t columns, F f) {
  std::vector<double> most(rows, 0.0);
  parallel_for(rows, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = 0; j < columns; ++j) most[i] = std::max(most[i], f(i, j));
  });
  return most;
}

// Largest of the samples that belong to span i.
std::vector<double> per_span(const std::vector<double>& samples) {
  std::vector<double> most(samples.size() / span_samples.size(), 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i)
    most[i / span_samples.size()] = std::max(most[i / span_samples.size()], samples[i]);
  return most;
}

double largest(const std::vector<double>& x) { return *std::max_element(x.begin(), x.end()); }

struct Trial {
  BSplineSurface surface;
  std::vector<double> in_u, in_v;        // by span, of the error of one direction alone
  std::vector<double> angle, curvature;  // by span of v, at the trimlines
};

Trial make_trial(const OdeBlend& blend, const std::vector<double>& u, const std::vector<double>& v) {
  const bool closed = blend.domain().v_closed;
  Trial trial{
      interpolate_surface(blend, BSplineBasis::clamped(degree, u),
                          closed ? BSplineBasis::closed(degree, v) : BSplineBasis::clamped(degree, v)),
      {},
      {},
      {},
      {}};
  const std::vector<double> su = inner_samples(u), sv = inner_samples(v);
  const BSplineSurface& spline = trial.surface;
  trial.in_u = per_span(row_maxima(su.size(), v.size(), [&](std::size_t i, std::size_t j) {
    return distance(blend, spline, {su[i], v[j]});
  }));
  trial.in_v = per_span(row_maxima(sv.size(), u.size(), [&](std::size_t j, std::size_t i) {
    return distance(blend, spline, {u[i], sv[j]});
  }));
  const auto defect = [&](std::size_t side, double y) {
    const UV p{static_cast<double>(side), y};
    return trimline_defect(blend.jet(p), spline.jet(p));
  };
  trial.angle = per_span(
      row_maxima(sv.size(), 2, [&](std::size_t j, std::size_t side) { return defect(side, sv[j]).angle; }));
  trial.curvature = per_span(row_maxima(sv.size(), 2, [&](std::size_t j, std::size_t side) {
    return blend.end(static_cast<int>(side)).continuity == Continuity::G2 ? defect(side, sv[j]).curvature
                                                                          : 0.0;
  }));
  return trial;
}

double bound_inside(const OdeBlend& blend, const Trial& trial) {
  const std::vector<double> su = inner_samples(trial.surface.basis_u().breaks());
  const std::vector<double> sv = inner_samples(trial.surface.basis_v().breaks());
  return sample_factor * sample_factor *
         largest(row_maxima(su.size(), sv.size(), [&](std::size_t i, std::size_t j) {
           return distance(blend, trial.surface, {su[i], sv[j]});
         }));
}

std::vector<double> roots(std::vector<double> ratio, double scale, double order) {
  for (double& x : ratio) x = std::pow(x / scale, 1.0 / order);
  return ratio;
}

}  // namespace

BlendFit fit_tensor(const OdeBlend& blend, const BlendFitOptions& options, const Progress& progress) {
  std::vector<double> u = graded_breaks(std::min(blend.basis(0).stiffness(), 50.0), 6), v;
  for (int i = 0; i <= 8; ++i) v.push_back(blend.domain().v.at(i / 8.0));
  const double angle = 0.5 * options.angle.value, curvature = 0.5 * options.curvature;
  double each = 0.4 * options.position / (sample_factor * sample_factor);  // sampled, of one direction
  for (int round = 0;; ++round) {
    progress.at(0.95 - 0.9 * std::pow(0.8, round), "fitting the blend");
    Trial trial = make_trial(blend, u, v);
    const int controls = static_cast<int>(trial.surface.control().size());
    const bool enough_u = largest(trial.in_u) <= each;
    const bool enough_v =
        largest(trial.in_v) <= each && largest(trial.angle) <= angle && largest(trial.curvature) <= curvature;
    double bound = sample_factor * sample_factor * (largest(trial.in_u) + largest(trial.in_v));
    if (enough_u && enough_v) {
      bound = bound_inside(blend, trial);
      if (bound <= options.position) {
        const BlendFitReport report{bound,
                                    Radians(largest(trial.angle)),
                                    largest(trial.curvature),
                                    static_cast<int>(u.size()) - 1,
                                    static_cast<int>(v.size()) - 1,
                                    controls};
        return {std::move(trial.surface), report};
      }
      each *= 0.5;
    }
    if (!enough_u) u = refined_breaks(u, roots(trial.in_u, each, 6.0), false);
    if (!enough_v) {
      std::vector<double> wanted = roots(trial.in_v, each, 6.0);
      const std::vector<double> a = roots(trial.angle, angle, 5.0),
                                k = roots(trial.curvature, curvature, 4.0);
      for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = std::max({wanted[i], a[i], k[i]});
      v = refined_breaks(v, wanted, blend.domain().v_closed);
    }
    if ((u.size() + 4) * (v.size() + 4) > static_cast<std::size_t>(options.max_control_points))
      throw ConvergenceError("blend fit: " + std::to_string(controls) + " control points reach position " +
                             scientific_text(bound) + ", angle " +
                             scientific_text(Radians(largest(trial.angle)).degrees()) + " deg, curvature " +
                             scientific_text(largest(trial.curvature)) + "; at most " +
                             std::to_string(options.max_control_points) + " are allowed");
  }
}

}  // namespace blendwright::detail
