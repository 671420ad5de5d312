#include "parametric/cross_tangent/magnitude.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/math/quadrature.hpp"
#include "parametric/trimline/along_curve.hpp"

namespace blendwright {
namespace {

using blendwright::inverse_sqrt;  // of series, beside the one of numbers

double inverse_sqrt(double x) { return 1.0 / std::sqrt(x); }
ModelJet inverse_sqrt(const ModelJet& x) { return pow(x, -0.5); }

template <class T>
T circle_ratio(const T& cos_theta) {
  const T square = 0.5 * (1.0 + cos_theta);
  return 2.0 / (1.0 + square * inverse_sqrt(square));  // (3)
}

bool solved_by_samples(MagnitudeRule rule) {
  return rule == MagnitudeRule::arc_length || rule == MagnitudeRule::minimum_bending;
}

/// Length of the cubic from 0 to De with end tangents T0, T1.
double cubic_length(const Vec3& De, const Vec3& T0, const Vec3& T1) {
  const QuadratureRule& rule = gauss_legendre(16);
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.x.size(); ++i) {
    const double u = rule.x[i], w = 1.0 - u;
    sum += rule.w[i] * (6.0 * u * w * De + w * (1.0 - 3.0 * u) * T0 + u * (3.0 * u - 2.0) * T1).norm();
  }
  return sum;
}

/// The rules' magnitudes at one v, as ratios m / (f |De|).
class PairSolution {
 public:
  PairSolution(const PairSample& s, const std::array<MagnitudeRule, 2>& rules,
               const std::array<double, 2>& factors)
      : s_(s),
        rules_(rules),
        factors_(factors),
        chord_(s.De.norm()),
        cosine_(s.direction[0].dot(s.direction[1])) {
    for (std::size_t i = 0; i < 2; ++i) {
      ratio_[i] =
          rules[i] == MagnitudeRule::chord || solved_by_samples(rules[i]) ? 1.0 : circle_ratio(cosine_);
      if (rules[i] == MagnitudeRule::constant) ratio_[i] = 1.0 / chord_;
    }
    for (int pass = 0; pass < 5; ++pass) iterate();
  }
  [[nodiscard]] double ratio(std::size_t side) const { return ratio_[side]; }

 private:
  [[nodiscard]] double m(std::size_t side) const { return factors_[side] * ratio_[side] * chord_; }
  void iterate() {
    const double length = cubic_length(s_.De, m(0) * s_.direction[0], m(1) * s_.direction[1]) / chord_;
    const auto set = [this](std::size_t i, double ratio) { ratio_[i] = std::clamp(ratio, 0.1, 4.0); };
    // (4) per chord; a magnitude by another rule is taken as it is. Alternating descent reaches the least
    // value within the bounds too; it gains a factor 4 per pass at least.
    for (int descent = 0; descent < 8; ++descent)
      for (std::size_t i = 0; i < 2; ++i) {
        if (rules_[i] != MagnitudeRule::minimum_bending) continue;
        const std::size_t k = 1 - i;
        const double other = rules_[k] == MagnitudeRule::minimum_bending ? ratio_[k] : m(k) / chord_;
        set(i, 1.5 * s_.De.dot(s_.direction[i]) / chord_ - 0.5 * cosine_ * other);
      }
    for (std::size_t i = 0; i < 2; ++i)
      if (rules_[i] == MagnitudeRule::arc_length) set(i, length);
  }

  const PairSample& s_;
  std::array<MagnitudeRule, 2> rules_;
  std::array<double, 2> factors_;
  double chord_, cosine_;
  std::array<double, 2> ratio_{};
};

ScalarSpline spline_of(std::vector<double> v, std::vector<double> values, bool closed) {
  if (!closed) return ScalarSpline::open(std::move(v), values);
  values.pop_back();
  return ScalarSpline::closed(std::move(v), values);
}

}  // namespace

Magnitudes::Magnitudes(const std::array<SideSpec, 2>& sides, CurveDomain domain,
                       const std::vector<PairSample>& samples)
    : rules_{sides[0].rule, sides[1].rule},
      factors_{FactorLaw(sides[0].factor, domain), FactorLaw(sides[1].factor, domain)} {
  if (!solved_by_samples(rules_[0]) && !solved_by_samples(rules_[1])) return;
  std::vector<double> v;
  std::array<std::vector<double>, 2> ratios;
  for (const PairSample& s : samples) {
    v.push_back(s.v);
    const PairSolution solution(s, rules_, {factors_[0](s.v), factors_[1](s.v)});
    for (std::size_t i = 0; i < 2; ++i) ratios[i].push_back(solution.ratio(i));
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (solved_by_samples(rules_[i])) ratios_[i] = spline_of(v, std::move(ratios[i]), domain.closed);
}

template <class T>
T Magnitudes::evaluated(std::size_t side, const T& v, const T& chord, const T& cos_theta) const {
  const T f = factors_[side](v);
  switch (rules_[side]) {
    case MagnitudeRule::chord:
      return f * chord;
    case MagnitudeRule::circle_like:
      return f * circle_ratio(cos_theta) * chord;
    case MagnitudeRule::constant:
      return f;
    case MagnitudeRule::arc_length:
    case MagnitudeRule::minimum_bending:
      break;
  }
  return f * (*ratios_[side])(v)*chord;
}

Series Magnitudes::at(int side, double v, const Series& chord, const Series& cos_theta) const {
  return evaluated(static_cast<std::size_t>(side), Series::variable(v), chord, cos_theta);
}

double Magnitudes::at(int side, const PairSample& s) const {
  return evaluated(static_cast<std::size_t>(side), s.v, s.De.norm(), s.direction[0].dot(s.direction[1]));
}

ModelJet Magnitudes::at(int side, const ModelJet& v, const ModelJet& chord, const ModelJet& cos_theta) const {
  return evaluated(static_cast<std::size_t>(side), v, chord, cos_theta);
}

}  // namespace blendwright
