#include "implicit/operators/function_local.hpp"

#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/function_local.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/operators/function_saturate-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const EdgeMaterial& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T q = square(saturated(in.arg(0)) / b.a1) + square(saturated(in.arg(1)) / b.a2);
  const L e = L(1.0) / (L(1.0) + value_of(q)), scaled = L(b.a0) * e;
  return chain(q, scaled, -(scaled * e), L(2.0) * scaled * (e * e));
}

template <class T>
HWY_INLINE T evaluate(const BoundedMaterial& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T n1 = saturated(in.arg(0)) / b.a1, n2 = saturated(in.arg(1)) / b.a2;
  const T n3 = saturated(in.arg(2)) / b.a3;
  const auto inside = value_of(n3) > L(0.0);
  const L largest = lane::max(lane::max(lane::abs(value_of(n1)), lane::abs(value_of(n2))), value_of(n3));
  // (3) depends on ratios only: nothing over- or underflows.
  const L inverse = lane::inverse_power_of_two(
      lane::power_of_two_below(lane::min(lane::max(largest, L(0x1p-1022)), L(0x1p1022))));
  const T r1 = square(scaled(n1, inverse)) + square(scaled(n2, inverse)), r3 = square(scaled(n3, inverse));
  const T both = choose<T>(inside, r1 + r3, T(1.0)), more = both + choose<T>(inside, r1, T(0.0));
  const T share = r3 / both, material = square(share) * (r3 / more) * b.a0;
  const T value = choose<T>(largest > L(negligible), material, constant<T>(value_of(material)));
  return choose<T>(inside, value, T(0.0));
}

KernelSet edge_material_simd() { return kernel_set<EdgeMaterial, Simd>(); }
KernelSet bounded_material_simd() { return kernel_set<BoundedMaterial, Simd>(); }
#if HWY_ONCE
KernelSet edge_material_scalar() { return kernel_set<EdgeMaterial, double>(); }
KernelSet bounded_material_scalar() { return kernel_set<BoundedMaterial, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(edge_material_simd);
HWY_EXPORT(bounded_material_simd);

static Range between(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

/// Largest in magnitude where |f1| and |f2| are smallest.
static Range edge_range(const void* body, const Box&, std::span<const Range> args) {
  const Range m1 = magnitude(args[0]), m2 = magnitude(args[1]);
  const double near[] = {m1.lo, m2.lo}, far[] = {m1.hi, m2.hi};
  const auto at = [&](const double(&f)[2]) {
    return scalar_value(op_for<EdgeMaterial>(), body, Vec3::Zero(), f);
  };
  return spread(between(at(far), at(near)), range_slack, 1e-300);
}

/// The partials are -2 a0 f_i/a_i^2/(1 + q)^2.
static LinearBound edge_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const EdgeMaterial*>(body);
  const Middle middle(in);
  if (!middle.usable || !(size_of(in.ranges) <= 1e90)) return constant_bound(Range::everything());
  const Range q = squared((1.0 / b.a1) * in.ranges[0]) + squared((1.0 / b.a2) * in.ranges[1]);
  const Range e{1.0 / (1.0 + q.hi), 1.0 / (1.0 + q.lo)};
  const Range steep = -2.0 * b.a0 * Range{e.lo * e.lo, e.hi * e.hi};
  const Range partials[] = {spread((1.0 / b.a1 / b.a1) * (in.ranges[0] * steep), range_slack),
                            spread((1.0 / b.a2 / b.a2) * (in.ranges[1] * steep), range_slack)};
  const double value = scalar_value(op_for<EdgeMaterial>(), body, Vec3::Zero(), {middle.at, 2});
  return mean_value_bound(in, middle, value, partials, range_slack * std::abs(b.a0));
}

/// Falls in magnitude with |f1| and |f2|, rises with f3.
static Range bounded_range(const void* body, const Box&, std::span<const Range> args) {
  const Range m1 = magnitude(args[0]), m2 = magnitude(args[1]);
  const double most[] = {m1.lo, m2.lo, args[2].hi}, least[] = {m1.hi, m2.hi, args[2].lo};
  const auto at = [&](const double(&f)[3]) {
    return scalar_value(op_for<BoundedMaterial>(), body, Vec3::Zero(), f);
  };
  return spread(between(at(least), at(most)), range_slack, 1e-300);
}
static Shortcut bounded_shortcut(const void*, const Box&, std::span<const Range> args) {
  return args[2].hi <= 0.0 ? Shortcut::to_constant(0.0) : Shortcut{};
}

/// With A = r1 + r3, B = 2 r1 + r3: D = a0 r3^3/(A^2 B),
///   dD/dr1 = -2 a0 r3^3 (A + B)/(A^3 B^2),  dD/dr3 = 2 a0 r1 r3^2 (A + B)/(A^3 B^2).
/// All factors are >= 0, so products of their ends bound them.
static LinearBound bounded_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const BoundedMaterial*>(body);
  const Middle middle(in);
  const Range n[] = {(1.0 / b.a1) * in.ranges[0], (1.0 / b.a2) * in.ranges[1], (1.0 / b.a3) * in.ranges[2]};
  const Range n3{std::max(n[2].lo, 0.0), std::max(n[2].hi, 0.0)};
  const Range r1 = squared(n[0]) + squared(n[1]), r3 = squared(n3);
  const Range A = r1 + r3, B = A + r1;
  if (!middle.usable || !(A.lo > 1e-40) || !(B.hi < 1e40)) return constant_bound(Range::everything());
  const auto ratio = [&](double num, double a, double big) {
    return num * (a + big) / (a * a * a * big * big);
  };
  const auto cube = [](double x) { return x * x * x; };
  const Range by_r1 = (-2.0 * b.a0) * Range{ratio(cube(r3.lo), A.hi, B.hi), ratio(cube(r3.hi), A.lo, B.lo)};
  const Range by_r3 = (2.0 * b.a0) * Range{ratio(r1.lo * r3.lo * r3.lo, A.hi, B.hi),
                                           ratio(r1.hi * r3.hi * r3.hi, A.lo, B.lo)};
  const Range partials[] = {spread((2.0 / b.a1) * (n[0] * by_r1), range_slack),
                            spread((2.0 / b.a2) * (n[1] * by_r1), range_slack),
                            spread((2.0 / b.a3) * (n3 * by_r3), range_slack)};
  const double value = scalar_value(op_for<BoundedMaterial>(), body, Vec3::Zero(), {middle.at, 3});
  return mean_value_bound(in, middle, value, partials, range_slack * std::abs(b.a0));
}

}  // namespace detail

template <>
const Op& op_for<detail::EdgeMaterial>() {
  using namespace detail;
  static const Op op{"edge_material",
                     HWY_DYNAMIC_DISPATCH(edge_material_simd)(),
                     HWY_STATIC_DISPATCH(edge_material_scalar)(),
                     edge_range,
                     nullptr,
                     edge_linear};
  return op;
}
template <>
const Op& op_for<detail::BoundedMaterial>() {
  using namespace detail;
  static const Op op{"bounded_material",
                     HWY_DYNAMIC_DISPATCH(bounded_material_simd)(),
                     HWY_STATIC_DISPATCH(bounded_material_scalar)(),
                     bounded_range,
                     bounded_shortcut,
                     bounded_linear};
  return op;
}

}  // namespace blendwright
#endif
