#include "parametric/fit/span_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace blendwright::detail {
namespace {

constexpr double largest_ratio = 4.0;  // neighbouring spans: very uneven knots upset some STEP receivers
constexpr double even_enough = 1.6;    // largest over mean need up to which the pattern of the breaks is kept
constexpr double reserve = 1.02;       // the estimated order is reached only in the limit
constexpr double most_per_round = 4.0;  // early errors are not yet asymptotic
constexpr double least_per_round = 0.4;

// Splits the longer of two neighbouring spans until no pair exceeds the ratio; ends because spans only get
// shorter and none gets below half of the shortest.
std::vector<double> with_limited_ratio(std::vector<double> t, bool periodic) {
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<double> next{t.front()};
    const std::size_t n = t.size() - 1;
    for (std::size_t i = 0; i < n; ++i) {
      const double h = t[i + 1] - t[i];
      const double before = i > 0 ? t[i] - t[i - 1] : (periodic ? t[n] - t[n - 1] : h);
      const double after = i + 1 < n ? t[i + 2] - t[i + 1] : (periodic ? t[1] - t[0] : h);
      if (h > largest_ratio * std::min(before, after)) {
        next.push_back(t[i] + 0.5 * h);
        changed = true;
      }
      next.push_back(t[i + 1]);
    }
    t = std::move(next);
  }
  return t;
}

// Integral of the density from 0 to u.
double graded_amount(double q, double u) {
  const double a = q / 6.0;
  if (a < 1e-8) return 2.0 * (q + 1.0) * u + 0.5 * u;
  // No power of e grows, so that no q overflows.
  return (q + 1.0) / a * -std::expm1(-a * u) * (1.0 + std::exp(-a * (1.0 - u))) + 0.5 * u;
}

}  // namespace

std::vector<double> graded_breaks(double q, int spans) {
  std::vector<double> t(static_cast<std::size_t>(spans) + 1, 0.0);
  t.back() = 1.0;
  const double total = graded_amount(q, 1.0);
  for (std::size_t i = 1; 2 * i < t.size(); ++i) {
    const double wanted = total * static_cast<double>(i) / spans;
    double lo = t[i - 1], hi = 0.5;
    for (int step = 0; step < 50; ++step) {
      const double mid = 0.5 * (lo + hi);
      (graded_amount(q, mid) < wanted ? lo : hi) = mid;
    }
    t[i] = 2 * i + 1 == t.size() ? 0.5 : 0.5 * (lo + hi);
    t[t.size() - 1 - i] = 1.0 - t[i];
  }
  return with_limited_ratio(std::move(t), false);
}

std::vector<double> refined_breaks(const std::vector<double>& breaks, std::vector<double> wanted,
                                   bool periodic) {
  const std::size_t n = wanted.size();
  for (double& w : wanted)
    w = std::isnan(w) ? most_per_round : std::clamp(reserve * w, least_per_round, most_per_round);
  const double most = *std::max_element(wanted.begin(), wanted.end());
  const double mean = std::accumulate(wanted.begin(), wanted.end(), 0.0) / static_cast<double>(n);
  if (most <= even_enough * mean) {
    std::fill(wanted.begin(), wanted.end(), most);
  } else {
    // A need spreads to the neighbours, since the spline couples them.
    const std::vector<double> own = wanted;
    for (std::size_t i = 0; i < n; ++i) {
      const double before = i > 0 ? own[i - 1] : (periodic ? own[n - 1] : 0.0);
      const double after = i + 1 < n ? own[i + 1] : (periodic ? own[0] : 0.0);
      wanted[i] = std::max({own[i], 0.5 * before, 0.5 * after});
    }
  }
  const double total = std::accumulate(wanted.begin(), wanted.end(), 0.0);
  const std::size_t spans = std::max(n + 1, static_cast<std::size_t>(std::ceil(total)));
  std::vector<double> t{breaks.front()};
  std::size_t i = 0;
  double done = 0.0;  // sum of wanted[0..i-1]
  for (std::size_t k = 1; k < spans; ++k) {
    const double level = total * static_cast<double>(k) / static_cast<double>(spans);
    while (i + 1 < n && done + wanted[i] <= level) done += wanted[i++];
    t.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * std::min(1.0, (level - done) / wanted[i]));
  }
  t.push_back(breaks.back());
  return with_limited_ratio(std::move(t), periodic);
}

}  // namespace blendwright::detail
