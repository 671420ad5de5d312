#include "parametric/fit/cardinal_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "kernel/base/number_text.hpp"
#include "kernel/geometry/spline_interpolation.hpp"
#include "parametric/fit/span_plan.hpp"

namespace blendwright::detail {
namespace {

using Eigen::Index;
constexpr int degree = 5;
constexpr std::size_t per_span = 4;  // samples per span
constexpr double closing = 0.5;      // of the 1 in (4), so that the bound stays sharp
constexpr double infinite = std::numeric_limits<double>::infinity();

// phi'''' = p phi'' - s phi.
struct Equation {
  double p = 0.0, s = 0.0;
};

// The smaller root L2 of L^2 - p L + s when both are real and not negative.
std::optional<double> smaller_real_root(const Equation& eq) {
  const double D = eq.p * eq.p - 4.0 * eq.s;
  if (eq.p < 0.0 || eq.s < 0.0 || D < -1e-12 * eq.p * eq.p) return std::nullopt;
  return eq.s == 0.0 ? 0.0 : 2.0 * eq.s / (eq.p + std::sqrt(std::max(D, 0.0)));
}

// sup |phi| and sup |phi''| on a span.
struct Sizes {
  double S0 = 0.0, S2 = 0.0;
};

Equation equation_of(const BlendShape& shape, int component) {
  if (shape.repeated_root) {
    const double q2 = *shape.repeated_root * *shape.repeated_root;
    return {2.0 * q2, q2 * q2};
  }
  const SweepOde& ode = shape.ode[static_cast<std::size_t>(component)];
  return {-ode.c / ode.b, ode.d / ode.b};
}

// Everything known at one sample: derivatives 0..3 of phi and 0, 2, 3, 4 of the error.
struct Sample {
  CardinalValues phi;
  std::array<PerFunction, 5> error{};
  double u = 0.0;
};

struct Bounds {
  PerFunction error{}, size{};  // sup |e|, sup |psi| on one span
  double coarse = 0.0;          // left side of the condition of (4)
};

class Fitter {
 public:
  Fitter(const OdeBlend& blend, const std::vector<ComponentGroup>& groups)
      : blend_(blend), groups_(groups), count_(static_cast<std::size_t>(blend.order())) {
    for (const ComponentGroup& g : groups_) {
      equations_.push_back(equation_of(blend.shape(), g.first));
      roots_.push_back(smaller_real_root(equations_.back()));
    }
  }

  [[nodiscard]] Eigen::MatrixXd control(const BSplineBasis& basis) const {
    const std::vector<double>& t = basis.breaks();
    const auto n = static_cast<Index>(t.size()), K = static_cast<Index>(count_);
    const Index channels = K * static_cast<Index>(groups_.size());
    Eigen::MatrixXd values(n, channels), start(2, channels), end(2, channels);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (Index i = 0; i < n; ++i) {
        const CardinalValues phi = blend_.basis(groups_[g].first)(t[static_cast<std::size_t>(i)]);
        for (Index k = 0; k < K; ++k) {
          const Index c = static_cast<Index>(g) * K + k;
          const auto at = static_cast<std::size_t>(k);
          values(i, c) = phi.value[0][at];
          if (i == 0) start.col(c) << phi.value[1][at], phi.value[2][at];
          if (i == n - 1) end.col(c) << phi.value[1][at], phi.value[2][at];
        }
      }
    return complete_control(basis, values, start, end);
  }

  [[nodiscard]] std::vector<Sample> samples(const BSplineBasis& basis, const Eigen::MatrixXd& control,
                                            std::size_t group) const {
    const std::vector<double>& t = basis.breaks();
    std::vector<Sample> samples(per_span * (t.size() - 1) + 1);
    const Index column = static_cast<Index>(group * count_);
    const Equation& eq = equations_[group];
    for (std::size_t i = 0; i < samples.size(); ++i) {
      Sample& s = samples[i];
      const std::size_t span = i / per_span, part = i % per_span;
      s.u = part == 0 ? t[span] : t[span] + (t[span + 1] - t[span]) * static_cast<double>(part) / per_span;
      s.phi = blend_.basis(groups_[group].first)(s.u);
      const BSplineBasis::Local N = basis.evaluate(s.u, 4);
      for (std::size_t k = 0; k < count_; ++k)
        for (std::size_t j : {0u, 2u, 3u, 4u}) {
          double spline = 0.0;
          for (int r = 0; r <= degree; ++r)
            spline += N.value[j][static_cast<std::size_t>(r)] *
                      control(N.first + r, column + static_cast<Index>(k));
          const double exact =
              j < 4 ? s.phi.value[j][k] : eq.p * s.phi.value[2][k] - eq.s * s.phi.value[0][k];
          s.error[j][k] = exact - spline;
        }
    }
    return samples;
  }

  [[nodiscard]] double psi(const Sample& s, std::size_t k) const {
    if (blend_.shape().mode != BlendMode::chord || !is_position(k)) return s.phi.value[0][k];
    const double both = s.phi.value[0][first_tangent] + s.phi.value[0][second_tangent()];
    return k == 0 ? 1.0 - s.u + both : s.u - both;
  }

  // (3) or (4) for phi_k on the span that starts at sample `first`; f[j]: largest sampled |phi^(j)|.
  [[nodiscard]] Sizes sizes(const std::vector<Sample>& samples, std::size_t first, std::size_t group,
                            std::size_t k, const std::array<double, 4>& f, double c) const {
    if (const std::optional<double>& L2 = roots_[group]) {
      double Z = 0.0;
      for (std::size_t i = first; i <= first + per_span; ++i)
        Z = std::max(Z, std::abs(samples[i].phi.value[2][k] - *L2 * samples[i].phi.value[0][k]));
      const double S0 = f[0] + (c * *L2 < 1.0 ? c : 1.0 / *L2) * Z;
      return {S0, *L2 * S0 + Z};
    }
    const double p = std::abs(equations_[group].p), s = std::abs(equations_[group].s);
    const double rest = 1.0 - c * p - c * c * s;
    const double S2 = rest > 0.0 ? (f[2] + c * s * f[0]) / rest : infinite;
    return {f[0] + c * S2, S2};
  }

  // (2) on the span that starts at sample `first`.
  [[nodiscard]] Bounds bounds(const std::vector<Sample>& samples, std::size_t first,
                              std::size_t group) const {
    const double delta = (samples[first + per_span].u - samples[first].u) / per_span, c = delta * delta / 8.0;
    Bounds b;
    PerFunction second{};  // sup |phi''|
    for (std::size_t k = 0; k < count_; ++k) {
      PerFunction e{};  // largest |e^(j)| by j; index 5: largest step of e'''
      std::array<double, 4> f{};
      double psi0 = 0.0;
      for (std::size_t i = first; i <= first + per_span; ++i) {
        for (std::size_t j : {0u, 2u, 4u}) e[j] = std::max(e[j], std::abs(samples[i].error[j][k]));
        for (std::size_t j = 0; j < 4; ++j) f[j] = std::max(f[j], std::abs(samples[i].phi.value[j][k]));
        if (i > first) e[5] = std::max(e[5], std::abs(samples[i].error[3][k] - samples[i - 1].error[3][k]));
        psi0 = std::max(psi0, std::abs(psi(samples[i], k)));
      }
      double fourth = 2.0 * e[5] / delta;
      second[k] = f[2] + delta * f[3];
      if (count_ == 4) {
        const Sizes z = sizes(samples, first, group, k, f, c);
        const double p = std::abs(equations_[group].p), s = std::abs(equations_[group].s);
        second[k] = z.S2;
        fourth = e[4] + c * (p * (p * z.S2 + s * z.S0) + s * z.S2);
        if (!roots_[group]) b.coarse = c * p + c * c * s;
      }
      b.error[k] = e[0] + c * (e[2] + c * fourth);
      b.size[k] = psi0;
    }
    for (std::size_t k = 0; k < count_; ++k)  // psi'' of a chord-mode position is +-(phi_T0'' + phi_T1'')
      b.size[k] += c * (chord_position(k) ? second[first_tangent] + second[second_tangent()] : second[k]);
    return b;
  }

  // Control values of psi_k from those of phi_k.
  [[nodiscard]] Eigen::MatrixXd alpha(const BSplineBasis& basis, const Eigen::MatrixXd& control,
                                      std::size_t group) const {
    Eigen::MatrixXd a = control.middleCols(static_cast<Index>(group * count_), static_cast<Index>(count_));
    if (blend_.shape().mode != BlendMode::chord) return a;
    const std::vector<double> g = basis.greville();
    const Index half = static_cast<Index>(count_) / 2;
    for (Index i = 0; i < a.rows(); ++i) {
      const double u = g[static_cast<std::size_t>(i)], both = a(i, 1) + a(i, half + 1);
      a(i, 0) = 1.0 - u + both;
      a(i, half) = u - both;
    }
    return a;
  }

  [[nodiscard]] CardinalFit fit(const std::vector<double>& breaks) const {
    CardinalFit fit{
        BSplineBasis::clamped(degree, breaks), {}, {}, {}, std::vector<double>(breaks.size() - 1, 0.0)};
    const Eigen::MatrixXd phi = control(fit.basis);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const std::vector<Sample> at = samples(fit.basis, phi, g);
      PerFunction size{};
      std::vector<PerFunction> error;
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const Bounds b = bounds(at, per_span * i, g);
        error.push_back(b.error);
        fit.coarse[i] = std::max(fit.coarse[i], b.coarse);
        for (std::size_t k = 0; k < count_; ++k) {
          const double spline =
              chord_position(k) ? b.error[first_tangent] + b.error[second_tangent()] : b.error[k];
          size[k] = std::max(size[k], b.size[k] + spline);
        }
      }
      fit.alpha.push_back(alpha(fit.basis, phi, g));
      fit.error.push_back(std::move(error));
      fit.size.push_back(size);
    }
    return fit;
  }

 private:
  static constexpr std::size_t first_tangent = 1;
  [[nodiscard]] std::size_t second_tangent() const { return count_ / 2 + 1; }
  [[nodiscard]] bool is_position(std::size_t k) const { return k == 0 || k == count_ / 2; }
  [[nodiscard]] bool chord_position(std::size_t k) const {
    return blend_.shape().mode == BlendMode::chord && is_position(k);
  }

  const OdeBlend& blend_;
  const std::vector<ComponentGroup>& groups_;
  std::size_t count_;
  std::vector<Equation> equations_;
  std::vector<std::optional<double>> roots_;
};

double error_on_span(const CardinalFit& fit, std::size_t span, const std::vector<PerFunction>& weight) {
  double squares = 0.0;
  for (std::size_t g = 0; g < weight.size(); ++g) {
    double sum = 0.0;
    for (std::size_t k = 0; k < weight[g].size(); ++k)
      if (weight[g][k] > 0.0) sum += fit.error[g][span][k] * weight[g][k];
    squares += sum * sum;
  }
  return std::sqrt(squares);
}

// A little below what is likely to be needed: the graded counts of the formula sheet, section 7, for degree 5
// are near tol^(-1/6) 6 q/(q + 15).
int first_spans(double stiffness, double largest_weight, double target) {
  const double relative = target / std::max(largest_weight, target);
  return std::max(1, static_cast<int>(4.2 * stiffness / (stiffness + 13.0) * std::pow(relative, -1.0 / 6.0)));
}

}  // namespace

double weighted_error(const CardinalFit& fit, const std::vector<PerFunction>& weight) {
  double worst = 0.0;
  for (std::size_t i = 0; i < fit.error.front().size(); ++i)
    worst = std::max(worst, error_on_span(fit, i, weight));
  return worst;
}

CardinalFit fit_cardinals(const OdeBlend& blend, const std::vector<ComponentGroup>& groups,
                          const std::vector<PerFunction>& weight, double target, int max_spans) {
  const Fitter fitter(blend, groups);
  double stiffness = 0.0, largest = 0.0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    stiffness = std::max(stiffness, blend.basis(groups[g].first).stiffness());
    largest = std::max(largest, *std::max_element(weight[g].begin(), weight[g].end()));
  }
  std::vector<double> breaks = graded_breaks(stiffness, first_spans(stiffness, largest, target));
  for (;;) {
    CardinalFit fit = fitter.fit(breaks);
    const double error = weighted_error(fit, weight);
    const double coarsest = *std::max_element(fit.coarse.begin(), fit.coarse.end());
    if (coarsest <= closing && error <= target) return fit;
    std::vector<double> wanted(breaks.size() - 1);
    if (static_cast<int>(wanted.size()) >= max_spans)
      throw ConvergenceError("blend fit across the blend: error bound " + scientific_text(error) + " with " +
                             std::to_string(wanted.size()) + " spans in u, asked for " +
                             scientific_text(target) +
                             "; allow more control points or a larger position tolerance");
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const double by_error = std::pow(error_on_span(fit, i, weight) / target, 1.0 / 6.0);
      wanted[i] = std::max(std::isfinite(by_error) ? by_error : 1.0, std::sqrt(fit.coarse[i] / closing));
    }
    breaks = refined_breaks(breaks, wanted, false);
  }
}

}  // namespace blendwright::detail
