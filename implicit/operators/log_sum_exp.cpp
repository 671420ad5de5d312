#include "implicit/operators/log_sum_exp.hpp"

#include <algorithm>

#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/log_sum_exp.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T signed_argument(const LogSumExp& b, const Inputs<T>& in, std::size_t i) {
  return in.arg(i) * argument_sign(b.role, i);
}

/// e^(-n (g_i - m)).
template <class T>
HWY_INLINE LaneOf<T> term(const LogSumExp& b, const Inputs<T>& in, std::size_t i, LaneOf<T> m) {
  return lane::exp((value_of(signed_argument(b, in, i)) - m) * LaneOf<T>(-b.n));
}

// With the weights w_i the gradient is the mean of the arguments' gradients, and
//   Hessian = sum w_i H_i - n sum w_i (g_i - mean)(g_i - mean)^T:
// where one argument decides nothing cancels, however steep it is.
template <class T>
HWY_INLINE T evaluate(const LogSumExp& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  T least = signed_argument(b, in, 0);
  for (std::size_t i = 1; i < in.args(); ++i) least = smaller(least, signed_argument(b, in, i));
  const L most = std::numeric_limits<double>::max(), v = value_of(least);
  const auto finite = lane::abs(v) <= most;
  const L m = select(finite, v, L(0.0));
  L sum = term(b, in, 0, m);
  for (std::size_t i = 1; i < in.args(); ++i) sum = sum + term(b, in, i, m);
  sum = select(finite, sum, L(1.0));
  T all = constant<T>(lane::log(sum) * L(-1.0 / b.n) + m);
  if constexpr (NumberTraits<T>::order > 0) {
    for (std::size_t i = 0; i < in.args(); ++i) {
      const L weight = term(b, in, i, m) / sum;
      const T x = signed_argument(b, in, i);
      for (int c = 0; c < 3; ++c) all.d[c] = multiply_add(weight, x.d[c], all.d[c]);
      if constexpr (NumberTraits<T>::order == 2)
        for (int c = 0; c < 6; ++c) all.h[c] = multiply_add(weight, x.h[c], all.h[c]);
    }
    if constexpr (NumberTraits<T>::order == 2)
      for (std::size_t i = 0; i < in.args(); ++i) {
        const L bend = term(b, in, i, m) / sum * L(b.n);
        const T x = signed_argument(b, in, i);
        L off[3];
        for (int c = 0; c < 3; ++c) off[c] = x.d[c] - all.d[c];
        for (int c = 0; c < 6; ++c)
          all.h[c] = all.h[c] - bend * (off[hessian_row[c]] * off[hessian_column[c]]);
      }
  }
  return choose<T>(finite, all, least) * result_sign(b.role);
}

KernelSet log_sum_exp_simd() { return kernel_set<LogSumExp, Simd>(); }
#if HWY_ONCE
KernelSet log_sum_exp_scalar() { return kernel_set<LogSumExp, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(log_sum_exp_simd);

/// The values lie around zero: what rounding adds is measured by the arguments and by ln k/n.
static Range log_sum_exp_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const LogSumExp*>(body);
  const bool first = b.role != ZeroRole::make_difference || args.size() < 2;
  const Range r = first ? ends(op_for<LogSumExp>(), body, args, {true})
                        : ends(op_for<LogSumExp>(), body, args, {true, false});
  double size = std::log(static_cast<double>(args.size())) / b.n;
  for (const double x : {r.lo, r.hi})
    if (std::isfinite(x)) size = std::max(size, std::abs(x));
  return spread(r, 0.0, range_slack * size);
}

/// The union is concave, intersection and difference are convex; all follow the shifts of their arguments.
static LinearBound log_sum_exp_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const LogSumExp*>(body);
  const double slack =
      range_slack * (size_of(in.ranges) + std::log(static_cast<double>(in.args.size())) / b.n);
  const Join join = b.role == ZeroRole::make_difference ? Join::subtract : Join::unite;
  if (in.args.size() > 5) return shift_bound(op_for<LogSumExp>(), body, in, join, slack);
  const Bend bend = b.role == ZeroRole::make_union ? Bend::concave : Bend::convex;
  return tangent_bound(op_for<LogSumExp>(), body, in, bend, slack);
}

}  // namespace detail

template <>
const Op& op_for<detail::LogSumExp>() {
  using namespace detail;
  static const Op op{"log_sum_exp",
                     HWY_DYNAMIC_DISPATCH(log_sum_exp_simd)(),
                     HWY_STATIC_DISPATCH(log_sum_exp_scalar)(),
                     log_sum_exp_range,
                     nullptr,
                     log_sum_exp_linear};
  return op;
}

}  // namespace blendwright
#endif
