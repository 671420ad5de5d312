#include "implicit/operators/norms.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/norms.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T not_negative(const T& u) {
  return choose<T>(value_of(u) >= LaneOf<T>(0.0), u, T(0.0));
}

/// The argument that the others are compared with: the first of the largest, or of the smallest.
enum class Lead { largest, smallest };
template <class T>
struct Survey {
  T lead;
  LaneOf<T> next;  ///< the largest, or smallest, of the others
};
template <class T>
HWY_INLINE Survey<T> survey(const Inputs<T>& in, Lead lead) {
  const bool largest = lead == Lead::largest;
  Survey<T> s{not_negative(in.arg(0)), largest ? 0.0 : std::numeric_limits<double>::infinity()};
  for (std::size_t i = 1; i < in.args(); ++i) {
    const T u = not_negative(in.arg(i));
    const LaneOf<T> v = value_of(u), first = value_of(s.lead);
    s.next = largest ? lane::max(s.next, lane::min(first, v)) : lane::min(s.next, lane::max(first, v));
    s.lead = largest ? larger(s.lead, u) : smaller(s.lead, u);
  }
  return s;
}

// S = sum (u_i/m)^n or sum (m/u_i)^n with m the lead, whose own term is the constant 1: so nothing overflows,
// and where it alone matters no derivatives cancel.
template <class T>
HWY_INLINE T power_sum(const Inputs<T>& in, const Power& n, const T& m, Lead lead) {
  using L = LaneOf<T>;
  T sum = T(1.0);
  auto found = L(0.0) > L(0.0);
  for (std::size_t i = 0; i < in.args(); ++i) {
    const T u = not_negative(in.arg(i));
    const auto is_lead = value_of(u) == value_of(m) && !found;
    found = found || is_lead;
    const T ratio = lead == Lead::largest ? u / m : m / choose<T>(value_of(u) > L(0.0), u, T(1.0));
    sum = sum + choose<T>(is_lead, T(0.0), power(ratio, n));
  }
  return sum;
}

template <class T>
HWY_INLINE T evaluate(const Norm& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const L most = std::numeric_limits<double>::max(), nothing = negligible;
  const Survey<T> s = survey(in, Lead::largest);
  const auto ordinary = value_of(s.lead) > nothing && value_of(s.lead) <= most;
  T sum = not_negative(in.arg(0));
  for (std::size_t i = 1; i < in.args(); ++i) sum = sum + not_negative(in.arg(i));
  const T infinite = T(std::numeric_limits<double>::infinity());
  if (b.n.exponent == 1.0) return choose<T>(value_of(s.lead) <= most, sum, infinite);
  const T m = choose<T>(ordinary, s.lead, T(1.0));
  const T norm = m * power(power_sum(in, b.n, m, Lead::largest), b.inverse_n);
  const T finite = choose<T>(s.next <= L(0.0) || value_of(s.lead) <= nothing, sum, norm);
  return choose<T>(value_of(s.lead) <= most, finite, infinite);
}

template <class T>
HWY_INLINE T evaluate(const InverseNorm& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const L most = std::numeric_limits<double>::max(), nothing = negligible;
  const Survey<T> s = survey(in, Lead::smallest);
  const auto alone = value_of(s.lead) <= nothing || s.next > most;
  const T m = choose<T>(alone, T(1.0), s.lead);
  const T norm = m / power(power_sum(in, b.n, m, Lead::smallest), b.inverse_n);
  return choose<T>(s.next <= nothing, T(0.0), choose<T>(alone, s.lead, norm));
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
/// Both are convex or concave where no argument is negative. They are associative: many arguments are taken
/// in halves, each half's bound being an argument of the rest.
template <class Body>
static LinearBound norm_linear(const void* body, const LinearInput& in) {
  const double n = static_cast<const Body*>(body)->n.exponent;
  const bool convex = std::is_same_v<Body, Norm> && n >= 1.0;
  const std::size_t k = in.args.size();
  LinearInput part = in;
  if (k > 4) {
    const LinearInput* const all = &in;
    LinearBound bounds[2];
    Range ranges[2];
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t first = half * (k / 2), count = half == 0 ? k / 2 : k - k / 2;
      part.args = all->args.subspan(first, count);
      part.ranges = all->ranges.subspan(first, count);
      bounds[half] = norm_linear<Body>(body, part);
      ranges[half] = norm_range<Body>(body, in.local, part.ranges);
    }
    part.args = bounds;
    part.ranges = ranges;
    return norm_linear<Body>(body, part);
  }
  // At 0 the kernels' slopes are those of no plane below or above.
  std::array<LinearBound, 4> inner;
  for (std::size_t i = 0; i < k; ++i) inner[i] = recentred(in.args[i], in.ranges[i]);
  part.args = std::span(inner).first(k);
  // Where a concave one has infinite slopes the kernels' do not belong to a plane above it.
  const bool steep = std::is_same_v<Body, Norm> && n < 1.0;
  const Middle middle(part);
  if (!middle.usable) return constant_bound(Range::everything());
  const double size = size_of(in.ranges);
  for (std::size_t i = 0; i < k; ++i)
    if (middle.at[i] <= negligible || (!convex && in.ranges[i].lo < (steep ? 1e-30 * size : 0.0)))
      return constant_bound(Range::everything());
  const double slack =
      range_slack * (1.0 + 1.0 / n) * (10.0 * negligible + norm_range<Body>(body, in.local, in.ranges).hi);
  return tangent_bound(op_for<Body>(), body, part, convex ? Bend::convex : Bend::concave, slack);
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
  static const Op op{"norm",
                     HWY_DYNAMIC_DISPATCH(norm_simd)(),
                     HWY_STATIC_DISPATCH(norm_scalar)(),
                     norm_range<Norm>,
                     norm_shortcut,
                     norm_linear<Norm>};
  return op;
}
template <>
const Op& op_for<detail::InverseNorm>() {
  using namespace detail;
  static const Op op{"inverse_norm",
                     HWY_DYNAMIC_DISPATCH(inverse_norm_simd)(),
                     HWY_STATIC_DISPATCH(inverse_norm_scalar)(),
                     norm_range<InverseNorm>,
                     inverse_norm_shortcut,
                     norm_linear<InverseNorm>};
  return op;
}

}  // namespace blendwright
#endif
