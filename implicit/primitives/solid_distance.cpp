#include "implicit/primitives/solid_distance.hpp"

#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/solid_distance.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/number/p_norm-inl.hpp"
#include "implicit/primitives/local_derivatives-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const SphereDistance& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  const T x[3] = {p.x, p.y, p.z};
  return b.radius - length(x);
}

template <class T>
HWY_INLINE T evaluate(const TorusDistance& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  const T across[2] = {p.x, p.y};
  // A length beyond the largest number counts as 1e300.
  const T section[2] = {smaller(length(across), T(1e300)) - b.ring, p.z};
  return b.tube - length(section);
}

/// By hand: the second derivatives beside a face are then exactly 0.
template <class T>
HWY_INLINE T evaluate(const BoxDistance& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  const L x[3] = {value_of(p.x), value_of(p.y), value_of(p.z)};
  L a[3], o[3];
  for (int i = 0; i < 3; ++i) {
    a[i] = lane::abs(x[i]) - L(b.half[i]);
    o[i] = lane::max(a[i], L(0.0));
  }
  const L nearest = lane::max(lane::max(a[0], a[1]), a[2]);
  const auto outside = nearest > L(0.0);
  const L m = select(outside, nearest, L(1.0));
  for (int i = 0; i < 3; ++i) o[i] = o[i] / m;
  const L r = lane::sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]);
  const L f = -select(outside, m * r, nearest);
  const L inverse = L(1.0) / select(outside, r, L(1.0));
  // Inside, the first of the nearest faces.
  const auto face0 = a[0] == nearest, face1 = !face0 && a[1] == nearest;
  const L inner[3] = {select(face0, L(1.0), L(0.0)), select(face1, L(1.0), L(0.0)),
                      select(face0 || face1, L(0.0), L(1.0))};
  L n[3], side[3], g[3], h[6];
  for (int i = 0; i < 3; ++i) {
    side[i] = lane::sign(x[i]);
    n[i] = select(outside, o[i] * inverse, inner[i]);
    g[i] = -(n[i] * side[i]);
  }
  const L bend = select(nearest > L(1e-60), inverse / m, L(0.0));
  for (int k = 0; k < 6; ++k) {
    const int i = hessian_row[k], j = hessian_column[k];
    const L one = i == j ? select(a[i] > L(0.0), L(1.0), L(0.0)) : L(0.0);
    h[k] = bend * (n[i] * n[j] - one) * (side[i] * side[j]);
  }
  return of_local(p, f, g, h);
}

KernelSet sphere_distance_simd() { return kernel_set<SphereDistance, Simd>(); }
KernelSet torus_distance_simd() { return kernel_set<TorusDistance, Simd>(); }
KernelSet box_distance_simd() { return kernel_set<BoxDistance, Simd>(); }
#if HWY_ONCE
KernelSet sphere_distance_scalar() { return kernel_set<SphereDistance, double>(); }
KernelSet torus_distance_scalar() { return kernel_set<TorusDistance, double>(); }
KernelSet box_distance_scalar() { return kernel_set<BoxDistance, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "implicit/primitives/solid_linear.hpp"
#include "implicit/primitives/solid_ranges.hpp"

namespace blendwright {
namespace detail {
HWY_EXPORT(sphere_distance_simd);
HWY_EXPORT(torus_distance_simd);
HWY_EXPORT(box_distance_simd);

static Range sphere_distance_range(const void* body, const Box& local, std::span<const Range>) {
  const double size = static_cast<const SphereDistance*>(body)->radius;
  return falling_distance_range(op_for<SphereDistance>(), body, local, size);
}
static Range box_distance_range(const void* body, const Box& local, std::span<const Range>) {
  const double size = static_cast<const BoxDistance*>(body)->half.norm();
  return falling_distance_range(op_for<BoxDistance>(), body, local, size);
}
/// The distance from the axis, from the ring in it, from the circle: each exact over the box.
static Range torus_distance_range(const void* body, const Box& local, std::span<const Range>) {
  const auto& b = *static_cast<const TorusDistance*>(body);
  const Range x = magnitude(local.axis(0)), y = magnitude(local.axis(1)), z = magnitude(local.axis(2));
  const Range across = magnitude({std::hypot(x.lo, y.lo) - b.ring, std::hypot(x.hi, y.hi) - b.ring});
  const Range r{std::hypot(across.lo, z.lo), std::hypot(across.hi, z.hi)};
  const double slack = distance_slack * (b.ring + b.tube + std::hypot(x.hi, y.hi) + z.hi);
  return {b.tube - r.hi - slack, b.tube - r.lo + slack};
}
}  // namespace detail

template <>
const Op& op_for<detail::SphereDistance>() {
  using namespace detail;
  static const Op op{"sphere_distance",
                     HWY_DYNAMIC_DISPATCH(sphere_distance_simd)(),
                     HWY_STATIC_DISPATCH(sphere_distance_scalar)(),
                     sphere_distance_range,
                     nullptr,
                     sphere_distance_linear};
  return op;
}
template <>
const Op& op_for<detail::TorusDistance>() {
  using namespace detail;
  static const Op op{"torus_distance",
                     HWY_DYNAMIC_DISPATCH(torus_distance_simd)(),
                     HWY_STATIC_DISPATCH(torus_distance_scalar)(),
                     torus_distance_range,
                     nullptr,
                     torus_distance_linear};
  return op;
}
template <>
const Op& op_for<detail::BoxDistance>() {
  using namespace detail;
  static const Op op{"box_distance",
                     HWY_DYNAMIC_DISPATCH(box_distance_simd)(),
                     HWY_STATIC_DISPATCH(box_distance_scalar)(),
                     box_distance_range,
                     nullptr,
                     box_distance_linear};
  return op;
}

}  // namespace blendwright
#endif
