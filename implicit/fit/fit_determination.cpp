#include "implicit/fit/fit_determination.hpp"

#include <limits>

#include "kernel/math/dense_solve.hpp"

namespace blendwright::detail {

Determination determination(const FitModel& model, const Linearised& at, double noise, double size) {
  const std::vector<std::size_t> free = model.free();
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::VectorXd length = at.J.colwise().norm();
  Eigen::MatrixXd scaled = at.J;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!(length[k] > 0.0)) length[k] = 1.0;
    scaled.col(k) /= length[k];
  }
  const SingularValues s = singular_values(scaled);
  Determination result;
  const double largest = s.values[0], smallest = s.values[n - 1];
  result.condition = smallest > 0.0 ? largest / smallest : std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < n; ++k) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double part = s.V(k, j);
      if (s.values[j] > 1e-9 * largest)
        sum += part * part / (s.values[j] * s.values[j]);
      else if (std::abs(part) > 1e-6)
        sum = std::numeric_limits<double>::infinity();
    }
    const double deviation = noise * std::sqrt(sum) / length[k];
    const FitSlot& slot = model.slots[free[static_cast<std::size_t>(k)]];
    const double most = slot.scale == FitSlot::Scale::turn ? 0.35 : slot.key == "move" ? 0.25 * size : 0.5;
    result.deviation.push_back(std::isnan(deviation) ? std::numeric_limits<double>::infinity() : deviation);
    result.determined.push_back(result.deviation.back() <= most);
  }
  return result;
}

}  // namespace blendwright::detail
