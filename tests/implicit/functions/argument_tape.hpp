#pragma once
// Operations of any number of arguments: their values and partials, and tapes whose arguments are
// coordinates.
#include <memory>
#include <vector>

#include "implicit/operators/combination.hpp"
#include "implicit/operators/function_join.hpp"
#include "tests/implicit/operators/op_tape.hpp"

namespace blendwright::test {

using detail::Combination;
using detail::Join;

/// A combination of one step.
template <class Body>
[[nodiscard]] Combination step(Body body) {
  return detail::of_all(std::move(body));
}

struct Partials {
  double value = 0.0;
  std::vector<double> partials{};
};
enum class By { vector_kernels, scalar_kernels };
/// By the kernels of derivatives.
[[nodiscard]] Partials partials(const Combination& combine, const std::vector<double>& at,
                                By by = By::vector_kernels);
/// By the kernels of values.
[[nodiscard]] double value(const Combination& combine, const std::vector<double>& at,
                           By by = By::vector_kernels);

// The bodies, in short.
[[nodiscard]] Combination r_alpha(double alpha, Join join);
[[nodiscard]] Combination r_m(int m, Join join);
[[nodiscard]] Combination rockwood(std::vector<double> r, double w, Join join);
[[nodiscard]] Combination ricci(double n, Join join);  ///< level function
inline constexpr Join joins[] = {Join::unite, Join::intersect, Join::subtract};

}  // namespace blendwright::test
