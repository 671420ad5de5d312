#include "implicit/operators/norms.hpp"

#include <algorithm>

#include "implicit/number/targets.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/norms.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/number/p_norm-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T not_negative(const T& u) {
  return choose<T>(value_of(u) >= LaneOf<T>(0.0), u, T(0.0));
}

/// The sum of all arguments, the largest value, and the largest but one.
template <class T>
struct Survey {
  T sum;
  LaneOf<T> first, second;
};
template <class T>
HWY_INLINE Survey<T> survey(const Inputs<T>& in) {
  Survey<T> s{not_negative(in.arg(0)), LaneOf<T>(0.0), LaneOf<T>(0.0)};
  s.first = value_of(s.sum);
  for (std::size_t i = 1; i < in.args(); ++i) {
    const T u = not_negative(in.arg(i));
    s.sum = s.sum + u;
    s.second = lane::max(s.second, lane::min(s.first, value_of(u)));
    s.first = lane::max(s.first, value_of(u));
  }
  return s;
}

template <class T>
HWY_INLINE T evaluate(const Norm& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Survey<T> s = survey(in);
  const L most = std::numeric_limits<double>::max();
  if (b.n.exponent == 1.0)
    return choose<T>(s.first <= most, s.sum, T(std::numeric_limits<double>::infinity()));
  const L scale = norm_scale(s.first), inverse = L(1.0) / scale;
  T powers = power(scaled(not_negative(in.arg(0)), inverse), b.n);
  for (std::size_t i = 1; i < in.args(); ++i)
    powers = powers + power(scaled(not_negative(in.arg(i)), inverse), b.n);
  const T norm = scaled(power(powers, b.inverse_n), scale);
  const T finite = choose<T>(s.second == L(0.0), s.sum, norm);
  return choose<T>(s.first <= most, finite, T(std::numeric_limits<double>::infinity()));
}

/// (m/u)^n as a number; m counts as constant.
template <class T>
HWY_INLINE T inverse_power(const T& u, LaneOf<T> m, const Power& n) {
  using L = LaneOf<T>;
  const L i = L(1.0) / lane::max(value_of(u), L(negligible)), q = m * i, q1 = -(q * i);
  return power(chain(u, q, q1, L(-2.0) * (q1 * i)), n);
}

template <class T>
HWY_INLINE T evaluate(const InverseNorm& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  T least = not_negative(in.arg(0));
  L second = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < in.args(); ++i) {
    const T u = not_negative(in.arg(i));
    second = lane::min(second, lane::max(value_of(least), value_of(u)));
    least = smaller(least, u);
  }
  const L m = lane::max(value_of(least), L(negligible)), inverse_exponent = b.inverse_n.exponent;
  T powers = inverse_power(in.arg(0), m, b.n);
  for (std::size_t i = 1; i < in.args(); ++i) powers = powers + inverse_power(in.arg(i), m, b.n);
  // m S^(-1/n), 1 <= S
  const L s = value_of(powers), is = L(1.0) / s, f = m / lane_power(s, b.inverse_n);
  const L f1 = -(inverse_exponent * f) * is;
  const T norm = chain(powers, f, f1, -((inverse_exponent + L(1.0)) * f1) * is);
  const L nothing = negligible;
  const auto alone = value_of(least) <= nothing || second > L(std::numeric_limits<double>::max());
  return choose<T>(second <= nothing, T(0.0), choose<T>(alone, least, norm));
}

KernelSet norm_simd() { return kernel_set<Norm, Simd>(); }
KernelSet inverse_norm_simd() { return kernel_set<InverseNorm, Simd>(); }
#if HWY_ONCE
KernelSet norm_scalar() { return kernel_set<Norm, double>(); }
KernelSet inverse_norm_scalar() { return kernel_set<InverseNorm, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(norm_simd);
HWY_EXPORT(inverse_norm_simd);

/// The argument that is left when those that are this number drop out, if it is only one.
static Shortcut the_only_other(std::span<const Range> args, double number) {
  std::size_t one = 0, others = 0;
  for (std::size_t i = 0; i < args.size(); ++i) {
    if (is(args[i], number)) continue;
    one = i;
    ++others;
  }
  return others <= 1 && args[one].lo >= 0.0 ? Shortcut::to_argument(one) : Shortcut{};
}

// The root S^(1/n) of a sum of k terms has the relative error of ln S/n <= ln k/n.
template <class Body>
static Range norm_range(const void* body, const Box&, std::span<const Range> args) {
  const Range r = ends(op_for<Body>(), body, args, {true});
  const double n = static_cast<const Body*>(body)->n.exponent;
  return spread_positive(r, range_slack * (1.0 + 1.0 / n));
}
static Shortcut norm_shortcut(const void*, const Box&, std::span<const Range> args) {
  return the_only_other(args, 0.0);
}
static Shortcut inverse_norm_shortcut(const void*, const Box&, std::span<const Range> args) {
  for (const Range& r : args)
    if (is(r, 0.0)) return Shortcut::to_constant(0.0);
  return the_only_other(args, std::numeric_limits<double>::infinity());
}

}  // namespace detail

template <>
const Op& op_for<detail::Norm>() {
  using namespace detail;
  static const Op op{"norm", HWY_DYNAMIC_DISPATCH(norm_simd)(), HWY_STATIC_DISPATCH(norm_scalar)(),
                     norm_range<Norm>, norm_shortcut};
  return op;
}
template <>
const Op& op_for<detail::InverseNorm>() {
  using namespace detail;
  static const Op op{"inverse_norm", HWY_DYNAMIC_DISPATCH(inverse_norm_simd)(),
                     HWY_STATIC_DISPATCH(inverse_norm_scalar)(), norm_range<InverseNorm>,
                     inverse_norm_shortcut};
  return op;
}

}  // namespace blendwright
#endif
