#pragma once
// Private: length travelled along a curve, and its inverse.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace blendwright::detail {

/// 5-point Gauss rule on [0, 1].
inline constexpr std::array<double, 5> gauss_x{0.046910077030668004, 0.23076534494715845, 0.5,
                                               0.76923465505284155, 0.953089922969332};
inline constexpr std::array<double, 5> gauss_w{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                               0.23931433524968324, 0.11846344252809454};

/// The integral of a positive speed over [0, 1], and its inverse.
class Travel {
 public:
  /// @param nodes  from 0 to 1; the speed is smooth between them
  Travel(std::function<double(double)> speed, std::vector<double> nodes)
      : speed_(std::move(speed)), nodes_(std::move(nodes)), sum_(nodes_.size(), 0.0) {
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i)
      sum_[i + 1] = sum_[i] + piece(nodes_[i], nodes_[i + 1]);
  }
  [[nodiscard]] double total() const { return sum_.back(); }
  [[nodiscard]] double length_at(double t) const {
    const auto i = cell(nodes_, t);
    return sum_[i] + piece(nodes_[i], t);
  }
  /// t at which the travelled length is s.
  [[nodiscard]] double at(double s) const {
    if (s <= 0.0) return 0.0;
    if (s >= total()) return 1.0;
    const auto i = cell(sum_, s);
    double t = nodes_[i] + (s - sum_[i]) / (sum_[i + 1] - sum_[i]) * (nodes_[i + 1] - nodes_[i]);
    for (int k = 0; k < 8; ++k) {
      const double step = (s - sum_[i] - piece(nodes_[i], t)) / speed_(t);
      t = std::clamp(t + step, nodes_[i], nodes_[i + 1]);
      if (std::abs(step) < 1e-15) break;
    }
    return t;
  }

 private:
  static std::size_t cell(const std::vector<double>& edges, double x) {
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, x);
    return static_cast<std::size_t>(above - edges.begin()) - 1;
  }
  [[nodiscard]] double piece(double a, double b) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < 5; ++k) sum += gauss_w[k] * speed_(a + (b - a) * gauss_x[k]);
    return sum * (b - a);
  }
  std::function<double(double)> speed_;
  std::vector<double> nodes_, sum_;
};

/// Each interval of `breaks` cut in `parts`.
[[nodiscard]] inline std::vector<double> refined(const std::vector<double>& breaks, std::size_t parts) {
  std::vector<double> nodes;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (std::size_t k = 0; k < parts; ++k)
      nodes.push_back(breaks[i] +
                      (breaks[i + 1] - breaks[i]) * static_cast<double>(k) / static_cast<double>(parts));
  nodes.push_back(breaks.back());
  return nodes;
}

}  // namespace blendwright::detail
