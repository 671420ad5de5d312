#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/function_rockwood.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/function_displacement.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/operators/function_displacement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// Arguments after the first `skip`, with the signs of the join.
template <class T>
struct SignedArguments {
  const Inputs<T>& in;
  Join join;
  std::size_t skip;
  LaneOf<T> least = 0.0;  ///< min a_i, or 0 where that is infinite
  [[nodiscard]] HWY_INLINE T number(std::size_t i) const { return in.arg(skip + i) * argument_sign(join, i); }
  [[nodiscard]] HWY_INLINE LaneOf<T> offset(std::size_t i) const { return value_of(number(i)) - least; }
  [[nodiscard]] HWY_INLINE T smallest() const {
    T a = number(0);
    for (std::size_t i = 1; skip + i < in.args(); ++i) a = smaller(a, number(i));
    return a;
  }
};

template <class T>
HWY_INLINE T evaluate(const Displacement& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  SignedArguments<T> terms{in, b.join, 0};
  const T least = terms.smallest();
  const auto finite = lane::abs(value_of(least)) <= L(std::numeric_limits<double>::max());
  terms.least = select(finite, value_of(least), L(0.0));
  const L t = depth<L>(b.shape, terms);
  const T h = displaced<T>(b.shape, terms, t, terms.least - t);
  return choose<T>(finite, h, least) * result_sign(b.join);
}

/// (a_i - min a)/omega; 0 where it is beyond all reaches, so that it does not count.
template <class T>
struct StretchedArguments {
  const SignedArguments<T>& given;
  const T& least;
  const T& omega;
  double reach;
  [[nodiscard]] HWY_INLINE T number(std::size_t i) const {
    const T d = choose<T>(offset(i) <= LaneOf<T>(reach), given.number(i) - least, T(0.0));
    return d / omega;
  }
  [[nodiscard]] HWY_INLINE LaneOf<T> offset(std::size_t i) const {
    return (value_of(given.number(i)) - value_of(least)) / value_of(omega);
  }
};

template <class T>
HWY_INLINE T evaluate(const LocalDisplacement& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const SignedArguments<T> given{in, b.join, 1};
  const T least = given.smallest(), given_omega = in.arg(0);
  const auto finite = lane::abs(value_of(least)) <= L(std::numeric_limits<double>::max());
  const auto blended = finite && value_of(given_omega) >= L(least_omega);
  const T omega = choose<T>(blended, given_omega, T(1.0)), from = choose<T>(finite, least, T(0.0));
  const StretchedArguments<T> terms{given, from, omega, b.shape.largest_r()};
  const L t = depth<L>(b.shape, terms);
  const T h = from + omega * displaced<T>(b.shape, terms, t, -t);
  return choose<T>(blended, h, least) * result_sign(b.join);
}

KernelSet displacement_simd() { return kernel_set<Displacement, Simd>(); }
KernelSet local_displacement_simd() { return kernel_set<LocalDisplacement, Simd>(); }
#if HWY_ONCE
KernelSet displacement_scalar() { return kernel_set<Displacement, double>(); }
KernelSet local_displacement_scalar() { return kernel_set<LocalDisplacement, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(displacement_simd);
HWY_EXPORT(local_displacement_simd);

static Bend bend_of(Join join) { return join == Join::unite ? Bend::convex : Bend::concave; }

/// The values lie around zero: what rounding adds is measured by the arguments and the reaches.
static double rounding(const SuperEllipse& b, std::span<const Range> args) {
  return range_slack * std::max(size_of(args), b.largest_r());
}

/// Whether argument i is below all others by their reach times `factor`, and by more than nothing: then the
/// power of the others is 0, exactly. A difference has the sign of a subtracted argument turned.
static Shortcut decided(const SuperEllipse& b, Join join, std::span<const Range> args, std::size_t skip,
                        double factor) {
  const std::size_t k = b.r.size(), candidates = join == Join::subtract ? 1 : k;
  for (std::size_t i = 0; i < candidates; ++i) {
    const double top = (argument_sign(join, i) * args[skip + i]).hi;
    bool lowest = true;
    for (std::size_t j = 0; j < k && lowest; ++j)
      lowest = j == i ||
               (argument_sign(join, j) * args[skip + j]).lo - top > b.r[j] * factor * (1.0 + range_slack);
    if (lowest) return Shortcut::to_argument(skip + i);
  }
  return {};
}

static Range displacement_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const Displacement*>(body);
  return spread(ends_of_join(op_for<Displacement>(), body, args, b.join), 0.0, rounding(b.shape, args));
}
static Shortcut displacement_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const Displacement*>(body);
  return decided(b.shape, b.join, args, 0, 1.0);
}
static LinearBound displacement_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const Displacement*>(body);
  const double slack = rounding(b.shape, in.ranges);
  return in.args.size() <= 5 ? tangent_bound(op_for<Displacement>(), body, in, bend_of(b.join), slack)
                             : shift_bound(op_for<Displacement>(), body, in, b.join, slack);
}

/// The larger omega, the deeper: h falls with it.
static Range local_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const LocalDisplacement*>(body);
  Range r;
  switch (b.join) {
    case Join::unite:
      r = ends(op_for<LocalDisplacement>(), body, args, {true, true});
      break;
    case Join::intersect:
      r = ends(op_for<LocalDisplacement>(), body, args, {false, true});
      break;
    case Join::subtract:
      r = ends(op_for<LocalDisplacement>(), body, args, {false, true, false});
      break;
  }
  return spread(r, 0.0, rounding(b.shape, args));
}
static Shortcut local_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const LocalDisplacement*>(body);
  return decided(b.shape, b.join, args, 1, std::max(args[0].hi, 0.0));
}
static LinearBound local_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const LocalDisplacement*>(body);
  // Where omega counts as 0 the field leaves the concave one by less than that.
  const double step = in.ranges[0].lo < least_omega ? least_omega * b.shape.largest_r() : 0.0;
  return tangent_bound(op_for<LocalDisplacement>(), body, in, bend_of(b.join),
                       2.0 * step + rounding(b.shape, in.ranges));
}

}  // namespace detail

template <>
const Op& op_for<detail::Displacement>() {
  using namespace detail;
  static const Op op{"rockwood",
                     HWY_DYNAMIC_DISPATCH(displacement_simd)(),
                     HWY_STATIC_DISPATCH(displacement_scalar)(),
                     displacement_range,
                     displacement_shortcut,
                     displacement_linear};
  return op;
}
template <>
const Op& op_for<detail::LocalDisplacement>() {
  using namespace detail;
  static const Op op{"local_rockwood",
                     HWY_DYNAMIC_DISPATCH(local_displacement_simd)(),
                     HWY_STATIC_DISPATCH(local_displacement_scalar)(),
                     local_range,
                     local_shortcut,
                     local_linear};
  return op;
}

}  // namespace blendwright
#endif
