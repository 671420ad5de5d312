#include "implicit/relations/linear_refutation.hpp"

#include <array>
#include <vector>

namespace blendwright::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_pivots = 40;
/// The largest term is about 1: what underflow loses of the others is far less than this.
constexpr double no_underflow = 1e-290;

/// The simplex tableau: columns are mu_1 ... mu_m, p_1..3, q_1..3 and the right side; rows are the four basic
/// variables and the reduced costs.
class Tableau {
 public:
  struct Row {
    Vec3 slope;
    double cost;
  };

  /// Starts from the single bound `first`.
  Tableau(std::span<const Row> rows, std::size_t first) : m_(rows.size()), width_(m_ + 7) {
    data_.assign(5 * width_, 0.0);
    const Row& r = rows[first];
    Vec3 sign;
    for (int j = 0; j < 3; ++j) sign[j] = r.slope[j] >= 0.0 ? 1.0 : -1.0;
    // Row 0: mu_first. Row 1 + j: p_j (slope >= 0) or q_j, so that it is not negative.
    basis_ = {first, 0, 0, 0};
    for (std::size_t i = 0; i < m_; ++i) {
      at(0, i) = 1.0;
      double cost = rows[i].cost - r.cost;
      for (int j = 0; j < 3; ++j) {
        const double step = sign[j] * (r.slope[j] - rows[i].slope[j]);
        at(1 + static_cast<std::size_t>(j), i) = step;
        cost -= step;
      }
      at(4, i) = cost;
    }
    at(0, width_ - 1) = 1.0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double s = sign[static_cast<Eigen::Index>(j)];
      basis_[1 + j] = s > 0.0 ? m_ + j : m_ + 3 + j;
      at(1 + j, m_ + j) = s;
      at(1 + j, m_ + 3 + j) = -s;
      at(1 + j, width_ - 1) = std::abs(r.slope[static_cast<Eigen::Index>(j)]);
      at(4, m_ + j) = 1.0 - s;
      at(4, m_ + 3 + j) = 1.0 + s;
    }
  }

  void minimise() {
    for (int step = 0; step < most_pivots; ++step) {
      std::size_t enter = width_ - 1;
      double least = -1e-14;
      for (std::size_t i = 0; i + 1 < width_; ++i)
        if (at(4, i) < least) least = at(4, enter = i);
      if (enter == width_ - 1) return;
      std::size_t leave = 4;
      double ratio = infinity;
      for (std::size_t r = 0; r < 4; ++r) {
        if (!(at(r, enter) > 1e-14)) continue;
        const double q = at(r, width_ - 1) / at(r, enter);
        if (q < ratio) {
          ratio = q;
          leave = r;
        }
      }
      if (leave == 4) return;
      pivot(leave, enter);
    }
  }

  /// Of bound i in the combination.
  [[nodiscard]] double weight(std::size_t i) const {
    for (std::size_t r = 0; r < 4; ++r)
      if (basis_[r] == i) return std::max(0.0, data_[r * width_ + width_ - 1]);
    return 0.0;
  }
  /// The dual variables: the reduced cost of p_j is 1 - t_j.
  [[nodiscard]] Vec3 point() const {
    Vec3 t;
    for (std::size_t j = 0; j < 3; ++j)
      t[static_cast<Eigen::Index>(j)] = std::clamp(1.0 - data_[4 * width_ + m_ + j], -1.0, 1.0);
    return t;
  }

 private:
  double& at(std::size_t row, std::size_t column) { return data_[row * width_ + column]; }

  void pivot(std::size_t row, std::size_t column) {
    const double inverse = 1.0 / at(row, column);
    for (std::size_t i = 0; i < width_; ++i) at(row, i) *= inverse;
    for (std::size_t r = 0; r < 5; ++r) {
      const double factor = at(r, column);
      if (r == row || factor == 0.0) continue;
      for (std::size_t i = 0; i < width_; ++i) at(r, i) -= factor * at(row, i);
      at(r, column) = 0.0;
    }
    basis_[row] = column;
  }

  std::size_t m_, width_;
  std::vector<double> data_;
  std::array<std::size_t, 4> basis_{};
};

}  // namespace

LinearPoint highest_point(std::span<const LinearBound> bounds, double length) {
  thread_local std::vector<const LinearBound*> finite;
  thread_local std::vector<Tableau::Row> rows;
  thread_local std::vector<double> scales;
  finite.clear();
  rows.clear();
  scales.clear();
  std::size_t first = 0;
  double least = infinity;
  for (const LinearBound& b : bounds) {
    const double top = b.value + b.rest.hi, reach = b.slope.lpNorm<1>();
    if (!std::isfinite(top) || !std::isfinite(reach)) continue;
    const double size = reach + std::abs(top), scale = size > 0.0 ? 1.0 / size : 1.0;
    if ((top + reach) * scale < least) {
      least = (top + reach) * scale;
      first = rows.size();
    }
    finite.push_back(&b);
    rows.push_back({scale * b.slope, scale * top});
    scales.push_back(scale);
  }
  if (rows.empty()) return {infinity, Vec3::Zero(), infinity};

  Tableau tableau(rows, first);
  tableau.minimise();
  LinearPoint best{infinity, tableau.point(), infinity};
  LinearBound sum;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (const double mu = tableau.weight(i); mu > 0.0) sum = sum + (mu * scales[i]) * *finite[i];
    best.height = std::min(best.height, rows[i].cost + rows[i].slope.dot(best.t));
  }
  best.upper = sum.range().hi;
  if (best.upper > -no_underflow && best.upper < 0.0) best.upper = 0.0;
  best.height *= length;
  return best;
}

}  // namespace blendwright::detail
