#include "tests/implicit/functions/argument_tape.hpp"

#include "implicit/operators/function_node.hpp"
#include "implicit/operators/function_r.hpp"
#include "implicit/operators/log_sum_exp.hpp"
#include "implicit/operators/sharp.hpp"

namespace blendwright::test {
namespace {

/// Up to three of the arguments, from `first` on, are coordinates, the others constants.
std::shared_ptr<const Tape> tape_at(const Combination& combine, const std::vector<double>& at,
                                    std::size_t first) {
  TapeBuilder builder;
  const std::vector<StepIndex> axes = coordinates(builder, 3);
  std::vector<StepIndex> args;
  for (std::size_t i = 0; i < at.size(); ++i)
    args.push_back(i >= first && i < first + 3 ? axes[i - first] : builder.constant(at[i]));
  return builder.finish(combine(builder, args));
}

std::vector<double> evaluated(const Combination& combine, const std::vector<double>& at, std::size_t first,
                              Order order, By by) {
  const std::shared_ptr<const Tape> tape = tape_at(combine, at, first);
  double x[3] = {};
  for (std::size_t c = 0; c < 3 && first + c < at.size(); ++c) x[c] = at[first + c];
  std::vector<double> out(components(order));
  const PointArrays points{{&x[0], 1}, {&x[1], 1}, {&x[2], 1}};
  by == By::vector_kernels ? tape->evaluate(order, points, out) : tape->evaluate_scalar(order, points, out);
  return out;
}

}  // namespace

Partials partials(const Combination& combine, const std::vector<double>& at, By by) {
  Partials result;
  for (std::size_t first = 0; first < at.size(); first += 3) {
    const std::vector<double> out = evaluated(combine, at, first, Order::hessian, by);
    result.value = out[0];
    for (std::size_t c = 0; c < 3 && first + c < at.size(); ++c) result.partials.push_back(out[1 + c]);
  }
  return result;
}

double value(const Combination& combine, const std::vector<double>& at, By by) {
  return evaluated(combine, at, 0, Order::value, by)[0];
}

Combination r_alpha(double alpha, Join join) { return detail::r_combination(join, alpha); }
Combination r_m(int m, Join join) { return detail::of_two(detail::RFunctionM{m, join}); }
Combination rockwood(std::vector<double> r, double w, Join join) {
  return step(detail::Displacement{detail::SuperEllipse(std::move(r), w), join});
}
Combination ricci(double n, Join join) { return detail::ricci_function(join, n); }

}  // namespace blendwright::test
