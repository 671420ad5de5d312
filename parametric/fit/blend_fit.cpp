#include "parametric/fit/blend_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "parametric/fit/boundary_fit.hpp"
#include "parametric/fit/cardinal_fit.hpp"
#include "parametric/fit/span_plan.hpp"
#include "parametric/fit/tensor_fit.hpp"

namespace blendwright {
namespace {

using namespace detail;
using Eigen::Index;

constexpr int degree = 5;
// The part of the tolerance that the direction along may use, and the part of what it leaves that across may
// use: along is often finer than its part for the sake of the angle. The rest covers that sizes are known
// only after the fit.
constexpr double share_v = 0.5, share_u = 0.9;
constexpr double trimline_margin =
    0.5;  // the sampled angle and curvature may miss a little between the samples

void check(const BlendFitOptions& options) {
  std::vector<Problem> problems;
  const auto positive = [&](const char* where, double x) {
    if (!(x > 0.0)) problems.push_back({where, "is " + number_text(x) + ", must be > 0"});
  };
  positive("position", options.position);
  positive("angle", options.angle.value);
  positive("curvature", options.curvature);
  positive("max_control_points", options.max_control_points);
  if (!problems.empty()) throw InputError(std::move(problems));
}

// The rows B_k after the mode is applied (formula sheet 2.4), from the data E_k.
std::array<Vec3, 6> mode_rows(const std::array<Vec3, 6>& E, const OdeBlend& blend) {
  std::array<Vec3, 6> B = E;
  if (blend.shape().mode != BlendMode::chord) return B;
  const std::size_t half = static_cast<std::size_t>(blend.order()) / 2;
  const Vec3 De = E[half] - E[0];
  B[0].setZero();
  B[half].setZero();
  B[1] -= De;
  B[half + 1] -= De;
  return B;
}

void take_larger(std::vector<PerFunction>& size, const std::array<Vec3, 6>& B,
                 const std::vector<ComponentGroup>& groups, std::size_t count) {
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t k = 0; k < count; ++k) size[g][k] = std::max(size[g][k], groups[g].norm(B[k]));
}

// sup |psi_k| (cardinal_fit.hpp (1)) from samples: enough to choose spans by.
std::vector<PerFunction> sampled_function_sizes(const OdeBlend& blend,
                                                const std::vector<ComponentGroup>& groups) {
  std::vector<PerFunction> size(groups.size(), PerFunction{});
  const std::size_t count = static_cast<std::size_t>(blend.order()), half = count / 2;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (double u : graded_breaks(blend.basis(groups[g].first).stiffness(), 32)) {
      PerFunction psi = blend.basis(groups[g].first)(u).value[0];
      if (blend.shape().mode == BlendMode::chord) {
        psi[0] = 1.0 - u + psi[1] + psi[half + 1];
        psi[half] = 1.0 - psi[0];
      }
      for (std::size_t k = 0; k < count; ++k) size[g][k] = std::max(size[g][k], std::abs(psi[k]));
    }
  return size;
}

// sup |B_k| from above: a spline stays in the hull of its control values, and B_k within its error of the
// spline.
std::vector<PerFunction> proven_row_sizes(const OdeBlend& blend, const std::vector<ComponentGroup>& groups,
                                          const BoundaryFit& fit) {
  std::vector<PerFunction> size(groups.size(), PerFunction{});
  const std::size_t count = static_cast<std::size_t>(blend.order()), half = count / 2;
  for (Index j = 0; j < fit.beta.rows(); ++j) {
    std::array<Vec3, 6> E;
    for (std::size_t k = 0; k < count; ++k)
      E[k] = fit.beta.block<1, 3>(j, 3 * static_cast<Index>(k)).transpose();
    take_larger(size, mode_rows(E, blend), groups, count);
  }
  const bool chord = blend.shape().mode == BlendMode::chord;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t k = 0; k < count; ++k) {
      const bool position = k == 0 || k == half, tangent = k == 1 || k == half + 1;
      if (chord && position) continue;  // the row is 0
      size[g][k] += fit.error[g][k] + (chord && tangent ? fit.error[g][0] + fit.error[g][half] : 0.0);
    }
  return size;
}

BSplineSurface net(const OdeBlend& blend, const std::vector<ComponentGroup>& groups,
                   const CardinalFit& across, const BoundaryFit& along) {
  const Index nu = across.basis.count(), nv = along.basis.count(), count = blend.order();
  const bool turned = blend.shape().frame == BlendFrame::fixed;
  const Vec3 anchor = blend.shape().mode == BlendMode::anchor ? blend.shape().anchor : Vec3::Zero();
  std::vector<Vec3> control(static_cast<std::size_t>(nu * nv));
  for (Index i = 0; i < nu; ++i)
    for (Index j = 0; j < nv; ++j) {
      Vec3 P = Vec3::Zero();
      for (std::size_t g = 0; g < groups.size(); ++g)
        for (int x = groups[g].first; x < groups[g].last; ++x)
          for (Index k = 0; k < count; ++k) P[x] += across.alpha[g](i, k) * along.beta(j, 3 * k + x);
      if (turned) P = (blend.shape().axes * P).eval();
      control[static_cast<std::size_t>(i * nv + j)] = P + anchor;
    }
  return {across.basis, along.basis, std::move(control)};
}

// Largest factor by which a size grew; 1 when none did.
double growth(const std::vector<PerFunction>& before, const std::vector<PerFunction>& after) {
  double factor = 1.0;
  for (std::size_t g = 0; g < before.size(); ++g)
    for (std::size_t k = 0; k < before[g].size(); ++k)
      if (before[g][k] > 0.0) factor = std::max(factor, after[g][k] / before[g][k]);
  return factor;
}

struct TwoFits {
  CardinalFit across;
  BoundaryFit along;
  double bound = 0.0;  // (1)
};

// One pass; sizes that turn out too small leave a bound above the tolerance.
TwoFits fit_both(const OdeBlend& blend, const std::vector<ComponentGroup>& groups,
                 const std::vector<PerFunction>& size, const BlendFitOptions& options, double share,
                 const Progress& progress) {
  const int most = options.max_control_points, ends = blend.domain().v_closed ? 0 : degree;
  const BoundaryTarget target{share_v * options.position, trimline_margin * options.angle.value,
                              trimline_margin * options.curvature, std::max(1, most / (degree + 1) - ends)};
  BoundaryFit along = fit_boundary(blend, groups, size, target, progress);
  progress.at(0.9, "fitting the blend across");
  const std::vector<PerFunction> rows = proven_row_sizes(blend, groups, along);
  const double target_u = share * (options.position - along.position);
  CardinalFit across =
      fit_cardinals(blend, groups, rows, target_u, std::max(1, most / along.basis.count() - degree));
  const double bound = weighted_error(across, rows) + along.position * growth(size, across.size);
  return {std::move(across), std::move(along), bound};
}

BlendFit fit_separable(const OdeBlend& blend, const BlendFitOptions& options, const Progress& progress) {
  const std::vector<ComponentGroup> groups = component_groups(blend);
  TwoFits fits = fit_both(blend, groups, sampled_function_sizes(blend, groups), options, share_u, progress);
  const Progress silent{[](double, std::string_view) {}, progress.stop};
  for (double share = 0.5 * share_u; !(fits.bound <= options.position); share *= 0.5)
    fits = fit_both(blend, groups, std::vector<PerFunction>(fits.across.size), options, share, silent);
  const int controls = fits.across.basis.count() * fits.along.basis.count();
  if (controls > options.max_control_points)
    throw ConvergenceError("blend fit: " + std::to_string(controls) +
                           " control points reach position bound " + scientific_text(fits.bound) +
                           "; at most " + std::to_string(options.max_control_points) + " are allowed");
  progress.at(1.0, "fitting the blend");
  const BlendFitReport report{fits.bound,
                              Radians(fits.along.angle),
                              fits.along.curvature,
                              static_cast<int>(fits.across.basis.breaks().size()) - 1,
                              static_cast<int>(fits.along.basis.breaks().size()) - 1,
                              controls};
  return {net(blend, groups, fits.across, fits.along), report};
}

// A periodic spline has no corner at its seam: data that close in value only must be called open.
void require_smooth_closing(const OdeBlend& blend) {
  const SurfaceDomain domain = blend.domain();
  if (!domain.v_closed) return;
  constexpr double corner = 1e-5;  // relative; typed formulas close to rounding, trimlines to 1e-6
  for (const double u : {0.0, 0.5, 1.0}) {
    const SurfaceJet a = blend.jet({u, domain.v.lo}), b = blend.jet({u, domain.v.hi});
    const double first = (a.Sv - b.Sv).norm(), cross = (a.Suv - b.Suv).norm();
    if (first <= corner * (a.Sv.norm() + b.Sv.norm()) &&
        cross <= corner * (a.Suv.norm() + b.Suv.norm() + a.Sv.norm()))
      continue;
    throw GeometryError("the blend is called closed, but at u = " + number_text(u) + " dS/dv is (" +
                        number_text(a.Sv[0], 4) + ", " + number_text(a.Sv[1], 4) + ", " +
                        number_text(a.Sv[2], 4) + ") at v = " + number_text(domain.v.lo, 6) + " and (" +
                        number_text(b.Sv[0], 4) + ", " + number_text(b.Sv[1], 4) + ", " +
                        number_text(b.Sv[2], 4) + ") at v = " + number_text(domain.v.hi, 6) +
                        "; boundary data must close with their derivatives, or \"closed\" must be false");
  }
}

// The knots of stiff blends lie as close as 0.07/q, those near u = 1 are written to STEP with 13 digits:
// 1e-13 is then 1/700 of the smallest span. From q = 1e12 on knots coincide and readers drop the face.
constexpr double largest_stiffness = 1e9;

void require_visible_layers(const OdeBlend& blend) {
  for (int x = 0; x < 3; ++x) {
    const double q = blend.basis(x).stiffness();
    if (q <= largest_stiffness) continue;
    throw GeometryError(
        "the blend is too stiff for a B-spline surface: its largest root is q = " + number_text(q, 4) +
        " along " + "xyz"[x] + ", so that its boundary layers, 1/q of the way " +
        "across, are thinner than the knots of a STEP file keep; the largest q is " +
        number_text(largest_stiffness));
  }
}

}  // namespace

BlendFit fit_blend(const OdeBlend& blend, const BlendFitOptions& options, const Progress& progress) {
  check(options);
  require_visible_layers(blend);
  require_smooth_closing(blend);
  return blend.separable() ? fit_separable(blend, options, progress) : fit_tensor(blend, options, progress);
}

}  // namespace blendwright
