#include "implicit/operators/function_r.hpp"

#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/function_r.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/operators/function_saturate-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// f1 = c p and f2 = c q, c the power of two below the larger: nothing over- or underflows.
template <class L>
struct ScaledPair {
  L largest, c, inverse, p, q;
  HWY_INLINE ScaledPair(L f1, L f2) {
    largest = lane::max(lane::abs(f1), lane::abs(f2));
    c = lane::power_of_two_below(lane::min(lane::max(largest, L(0x1p-1022)), L(0x1p1022)));
    inverse = lane::inverse_power_of_two(c);
    p = f1 * inverse;
    q = f2 * inverse;
  }
};

/// (1) of numbers with finite values.
template <class T>
HWY_INLINE T r_intersection(double alpha, const T& f1, const T& f2) {
  using L = LaneOf<T>;
  const ScaledPair<L> at(value_of(f1), value_of(f2));
  const L p = at.p, q = at.q, product = p * q, sum = p + q;
  const double less = 1.0 - alpha, more = 1.0 + alpha;
  const bool upper = alpha >= 0.0;
  const L gap = upper ? p - q : sum;
  const L s =
      lane::sqrt(lane::max(L(0.0), gap * gap + L(upper ? 2.0 * less : -2.0 * more) * product));  // (4)
  const auto far = sum > L(0.0);
  const L above = (product + product) / select(far, sum + s, L(1.0)), below = (sum - s) / L(more);
  const L value = at.c * select(far, above, below);  // (3), (1)
  if constexpr (NumberTraits<T>::order == 0) {
    return value;
  } else {
    const auto regular = at.largest > L(negligible);
    const L safe = select(regular, s, L(1.0)), zero = 0.0;
    const L u = upper ? gap + L(less) * q : gap - L(more) * q,
            v = upper ? L(less) * p - gap : gap - L(more) * p;
    const L i1 = select(u > zero, L(less) * q * q / (safe * (safe + lane::max(u, zero))),
                        (s - u) / (safe * L(more)));  // (5)
    const L i2 =
        select(v > zero, L(less) * p * p / (safe * (safe + lane::max(v, zero))), (s - v) / (safe * L(more)));
    const double tie = 1.0 / (2.0 + std::sqrt(2.0 * less));
    const L bend = select(regular, L(less) / (safe * safe * safe) * at.inverse, zero);  // (6)
    return chain(f1, f2, value, select(regular, i1, L(tie)), select(regular, i2, L(tie)), -(bend * (q * q)),
                 bend * product, -(bend * (p * p)));
  }
}

template <class T>
HWY_INLINE T evaluate(const RFunction& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T f1 = in.arg(0) * argument_sign(b.join, 0), f2 = in.arg(1) * argument_sign(b.join, 1);
  const L most = std::numeric_limits<double>::max();
  const auto finite = lane::abs(value_of(f1)) <= most && lane::abs(value_of(f2)) <= most;
  // Next to an infinite argument it is the lower one, as its limit is.
  return choose<T>(finite, r_intersection(b.alpha, f1, f2), smaller(f1, f2)) * result_sign(b.join);
}

/// rho^m, at most 1e200 and constant from there on.
template <class T>
HWY_INLINE T rho_power(int m, const T& f1, const T& f2) {
  using L = LaneOf<T>;
  const ScaledPair<L> at(value_of(f1), value_of(f2));
  const L unit = lane::sqrt(at.p * at.p + at.q * at.q), rho = at.c * unit, most = 1e200;
  const L power = lane::min(integer_power(rho, m), most);
  if constexpr (NumberTraits<T>::order == 0) {
    return power;
  } else {
    const auto regular = at.largest > L(negligible) && power < most;
    const L length = select(regular, rho, L(1.0)), i = L(1.0) / select(regular, unit, L(1.0));
    const L n1 = at.p * i, n2 = at.q * i;
    const L first = select(regular, L(m) * (power / length), L(0.0)), second = first / length;
    const double rest = m - 2.0;
    return chain(f1, f2, power, first * n1, first * n2, second * (L(1.0) + L(rest) * (n1 * n1)),
                 second * (L(rest) * (n1 * n2)), second * (L(1.0) + L(rest) * (n2 * n2)));
  }
}

template <class T>
HWY_INLINE T evaluate(const RFunctionM& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T f1 = saturated(in.arg(0)) * argument_sign(b.join, 0);
  const T f2 = saturated(in.arg(1)) * argument_sign(b.join, 1);
  const T value = saturated(r_intersection(0.0, f1, f2) * rho_power(b.m, f1, f2));
  const L largest = lane::max(lane::abs(value_of(f1)), lane::abs(value_of(f2)));
  return choose<T>(largest > L(negligible), value, constant<T>(value_of(value))) * result_sign(b.join);
}

KernelSet r_function_simd() { return kernel_set<RFunction, Simd>(); }
KernelSet r_function_m_simd() { return kernel_set<RFunctionM, Simd>(); }
#if HWY_ONCE
KernelSet r_function_scalar() { return kernel_set<RFunction, double>(); }
KernelSet r_function_m_scalar() { return kernel_set<RFunctionM, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(r_function_simd);
HWY_EXPORT(r_function_m_simd);

static Bend bend_of(Join join) { return join == Join::unite ? Bend::convex : Bend::concave; }

// (3) and (1) have relative errors of a few roundings.
static Range r_function_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const RFunction*>(body);
  return spread(ends_of_join(op_for<RFunction>(), body, args, b.join), range_slack, 1e-300);
}
static LinearBound r_function_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const RFunction*>(body);
  return tangent_bound(op_for<RFunction>(), body, in, bend_of(b.join), 0.0);
}

/// rho^exponent over ranges, as saturated as rho_power.
static Range rho_power_range(int exponent, Range f1, Range f2) {
  const Range m1 = magnitude(f1), m2 = magnitude(f2);
  return {std::min(std::pow(std::hypot(m1.lo, m2.lo), exponent), 1e200),
          std::min(std::pow(std::hypot(m1.hi, m2.hi), exponent), 1e200)};
}
static double slack_of(int m) { return range_slack * (1.0 + 0.25 * m); }

static Range r_function_m_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const RFunctionM*>(body);
  const Range in[] = {saturated(args[0]), saturated(args[1])};
  const RFunction zero{0.0, b.join};
  const Range base = ends_of_join(op_for<RFunction>(), &zero, in, b.join);
  return saturated(spread(base * rho_power_range(b.m, in[0], in[1]), slack_of(b.m), 1e-300));
}

/// f1/rho.
static Range cosine_range(Range f1, Range f2) {
  const Range other = magnitude(f2);
  const auto at = [](double x, double y) {
    const double rho = std::hypot(x, y);
    return rho > 0.0 ? x / rho : 0.0;
  };
  if (f1.lo <= 0.0 && f1.hi >= 0.0 && other.lo == 0.0)
    return {f1.lo < 0.0 ? -1.0 : 0.0, f1.hi > 0.0 ? 1.0 : 0.0};
  return {at(f1.lo, f1.lo < 0.0 ? other.lo : other.hi), at(f1.hi, f1.hi > 0.0 ? other.lo : other.hi)};
}

/// The partials of (2) are (1 - n_i) rho^m + m I_0 rho^(m-1) n_i, n_i = f_i/rho.
static LinearBound r_function_m_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const RFunctionM*>(body);
  const Middle middle(in);
  if (!middle.usable || size_of(in.ranges) > 1e5) return constant_bound(Range::everything());
  const Range f[] = {argument_sign(b.join, 0) * in.ranges[0], argument_sign(b.join, 1) * in.ranges[1]};
  const RFunction zero{0.0, Join::intersect};
  const Range base = ends_of_join(op_for<RFunction>(), &zero, f, Join::intersect);
  const Range power = rho_power_range(b.m, f[0], f[1]), less = rho_power_range(b.m - 1, f[0], f[1]);
  Range partials[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const Range n = cosine_range(f[i], f[1 - i]);
    const Range raw = Range{1.0 - n.hi, 1.0 - n.lo} * power + static_cast<double>(b.m) * (base * (less * n));
    partials[i] = spread(result_sign(b.join) * argument_sign(b.join, i) * raw, slack_of(b.m));
  }
  const double value = scalar_value(op_for<RFunctionM>(), body, Vec3::Zero(), {middle.at, 2});
  return mean_value_bound(in, middle, value, partials, slack_of(b.m) * std::abs(value) + 1e-300);
}

}  // namespace detail

template <>
const Op& op_for<detail::RFunction>() {
  using namespace detail;
  static const Op op{"r_function",
                     HWY_DYNAMIC_DISPATCH(r_function_simd)(),
                     HWY_STATIC_DISPATCH(r_function_scalar)(),
                     r_function_range,
                     nullptr,
                     r_function_linear};
  return op;
}
template <>
const Op& op_for<detail::RFunctionM>() {
  using namespace detail;
  static const Op op{"r_function_m",
                     HWY_DYNAMIC_DISPATCH(r_function_m_simd)(),
                     HWY_STATIC_DISPATCH(r_function_m_scalar)(),
                     r_function_m_range,
                     nullptr,
                     r_function_m_linear};
  return op;
}

}  // namespace blendwright
#endif
