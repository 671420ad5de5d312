#pragma once
// Laws that every surface and curve obeys, as matchers: derivatives agree with differences of values.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright::test {

/// f'(0) by the central difference of fourth order: error h^4 f^(5) / 30 + 3 eps |f| / (2 h).
template <class F>
auto difference(F f, double h) {
  return ((8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h)).eval();
}

/// Steps of 1/500 of the range, and the relative error that differences over them may show: with derivatives
/// that grow by a factor g per order over the range (g <= 30 for the surfaces here: (g / 500)^4 / 30 = 4e-7
/// at worst, for the order that is wrong by that much of its own size), and 500 * 1.5 eps = 2e-13 of
/// rounding.
inline constexpr double step_share = 1.0 / 500.0;
inline constexpr double difference_error = 1e-6;

/// Largest error of the jet at p against differences of positions and of first derivatives, relative to the
/// size of the derivatives there, all measured per parameter range.
inline double jet_error(const Surface& surface, UV p) {
  const SurfaceDomain d = surface.domain();
  const double lu = d.u.length(), lv = d.v.length();
  const SurfaceJet j = surface.jet(p);
  const auto at_u = [&](double t) { return surface.jet(UV{p.u + t * lu, p.v}); };
  const auto at_v = [&](double t) { return surface.jet(UV{p.u, p.v + t * lv}); };
  const double h = step_share;
  const double scale = j.Su.norm() * lu + j.Sv.norm() * lv + j.Suu.norm() * lu * lu + j.Suv.norm() * lu * lv +
                       j.Svv.norm() * lv * lv + 1e-3 * j.S.norm();
  const auto Su = difference([&](double t) { return at_u(t).S; }, h);
  const auto Sv = difference([&](double t) { return at_v(t).S; }, h);
  const auto Suu = difference([&](double t) { return at_u(t).Su; }, h);
  const auto Suv = difference([&](double t) { return at_v(t).Su; }, h);
  const auto Svu = difference([&](double t) { return at_u(t).Sv; }, h);
  const auto Svv = difference([&](double t) { return at_v(t).Sv; }, h);
  return std::max({(Su - j.Su * lu).norm(), (Sv - j.Sv * lv).norm(), (Suu - j.Suu * lu).norm() * lu,
                   (Suv - j.Suv * lv).norm() * lu, (Svu - j.Suv * lu).norm() * lv,
                   (Svv - j.Svv * lv).norm() * lv}) /
         scale;
}

/// The same for all partials up to order 4: those of order <= 2 must be the jet's, the others agree with
/// differences of the next lower order.
inline double partials_error(const Surface& surface, UV p) {
  const SurfaceDomain d = surface.domain();
  const double lu = d.u.length(), lv = d.v.length();
  const SurfacePartials P = surface.partials(p);
  const SurfaceJet j = surface.jet(p);
  const auto size = [&](int i, int k) { return std::pow(lu, i) * std::pow(lv, k); };
  double scale = 1e-3 * j.S.norm();
  for (int n = 1; n <= 4; ++n)
    for (int k = 0; k <= n; ++k) scale += P(n - k, k).norm() * size(n - k, k);
  double error = std::max({(P(0, 0) - j.S).norm(), (P(1, 0) - j.Su).norm() * lu, (P(0, 1) - j.Sv).norm() * lv,
                           (P(2, 0) - j.Suu).norm() * lu * lu, (P(1, 1) - j.Suv).norm() * lu * lv,
                           (P(0, 2) - j.Svv).norm() * lv * lv});
  for (int n = 3; n <= 4; ++n)
    for (int k = 0; k <= n; ++k) {
      const bool along_u = n - k > 0;
      const auto lower = [&](double t) {
        return along_u ? surface.partials(UV{p.u + t * lu, p.v})(n - k - 1, k)
                       : surface.partials(UV{p.u, p.v + t * lv})(n - k, k - 1);
      };
      const Vec3 expected = difference(lower, step_share) / (along_u ? lu : lv);
      error = std::max(error, (expected - P(n - k, k)).norm() * size(n - k, k));
    }
  return error / scale;
}

/// Largest error of C', C'', C''' against differences of the next lower order.
template <int Dim>
double curve_jet_error(const Curve<Dim>& curve, double v) {
  const double l = curve.domain().v.length();
  const CurveJet<Dim> j = curve.jet(v);
  double scale = 1e-3 * j.C().norm(), error = 0.0;
  for (std::size_t k = 1; k < 4; ++k) scale += j.D[k].norm() * std::pow(l, static_cast<double>(k));
  for (std::size_t k = 1; k < 4; ++k) {
    const auto expected = difference([&](double t) { return curve.jet(v + t * l).D[k - 1]; }, step_share);
    error = std::max(error, (expected - j.D[k] * l).norm() * std::pow(l, static_cast<double>(k - 1)));
  }
  return error / scale;
}

MATCHER_P(HasConsistentJetAt, p, "derivatives agree with central differences") {
  const double error = jet_error(arg, p);
  *result_listener << "relative error " << error << " at u = " << p.u << ", v = " << p.v;
  return error <= difference_error;
}
MATCHER_P(HasConsistentPartialsAt, p, "partials to order 4 agree with the jet and with central differences") {
  const double error = partials_error(arg, p);
  *result_listener << "relative error " << error << " at u = " << p.u << ", v = " << p.v;
  return error <= difference_error;
}
MATCHER_P(HasConsistentCurveJetAt, v, "derivatives agree with central differences") {
  const double error = curve_jet_error(arg, v);
  *result_listener << "relative error " << error << " at v = " << v;
  return error <= difference_error;
}

}  // namespace blendwright::test
