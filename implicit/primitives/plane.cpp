#include "implicit/primitives/plane.hpp"

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/eval/op.hpp"
#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/plane.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T linear_form(const Vec3& v, const Point<T>& p) {
  return p.x * v[0] + p.y * v[1] + p.z * v[2];
}

template <class T>
HWY_INLINE T evaluate(const Plane& b, const Inputs<T>& in) {
  return linear_form(b.normal, in.local());
}
template <class T>
HWY_INLINE T evaluate(const HalfSpace& b, const Inputs<T>& in) {
  return larger(T(0.0), linear_form(b.normal, in.local()));
}
template <class T>
HWY_INLINE T evaluate(const Slab& b, const Inputs<T>& in) {
  return absolute(linear_form(b.normal, in.local()));
}

KernelSet plane_simd() { return kernel_set<Plane, Simd>(); }
KernelSet half_space_simd() { return kernel_set<HalfSpace, Simd>(); }
KernelSet slab_simd() { return kernel_set<Slab, Simd>(); }
#if HWY_ONCE
KernelSet plane_scalar() { return kernel_set<Plane, double>(); }
KernelSet half_space_scalar() { return kernel_set<HalfSpace, double>(); }
KernelSet slab_scalar() { return kernel_set<Slab, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(plane_simd);
HWY_EXPORT(half_space_simd);
HWY_EXPORT(slab_simd);

Range linear_range(const Vec3& v, const Box& box) {
  Range r;
  double size = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (v[i] == 0.0) continue;  // also when the box is infinite
    const double a = v[i] * box.lo[i], b = v[i] * box.hi[i];
    r.lo += std::min(a, b);
    r.hi += std::max(a, b);
    size += std::max(std::abs(a), std::abs(b));
  }
  // Three products and two sums err by less than 3 eps of the terms' size, here and in a kernel.
  const double slack = 6.0 * std::numeric_limits<double>::epsilon() * size;
  return {r.lo - slack, r.hi + slack};
}

static Range plane_range(const void* body, const Box& local, std::span<const Range>) {
  return linear_range(static_cast<const Plane*>(body)->normal, local);
}
/// Exact; the kernel and the frame round.
static LinearBound plane_linear(const void* body, const LinearInput& in) {
  return linear_form(static_cast<const Plane*>(body)->normal, in);
}
static Range half_space_range(const void* body, const Box& local, std::span<const Range>) {
  const Range f = linear_range(static_cast<const HalfSpace*>(body)->normal, local);
  return {std::max(0.0, f.lo), std::max(0.0, f.hi)};
}
static Range slab_range(const void* body, const Box& local, std::span<const Range>) {
  return magnitude(linear_range(static_cast<const Slab*>(body)->normal, local));
}

static LinearBound half_space_linear(const void* body, const LinearInput& in) {
  const Vec3& n = static_cast<const HalfSpace*>(body)->normal;
  return positive_part(linear_form(n, in), linear_range(n, in.local));
}
static LinearBound slab_linear(const void* body, const LinearInput& in) {
  const Vec3& n = static_cast<const Slab*>(body)->normal;
  return magnitude_bound(linear_form(n, in), linear_range(n, in.local));
}

}  // namespace detail

template <>
const Op& op_for<detail::Plane>() {
  using namespace detail;
  static const Op op{"plane",
                     HWY_DYNAMIC_DISPATCH(plane_simd)(),
                     HWY_STATIC_DISPATCH(plane_scalar)(),
                     plane_range,
                     nullptr,
                     plane_linear};
  return op;
}
template <>
const Op& op_for<detail::HalfSpace>() {
  using namespace detail;
  static const Op op{"half_space",
                     HWY_DYNAMIC_DISPATCH(half_space_simd)(),
                     HWY_STATIC_DISPATCH(half_space_scalar)(),
                     half_space_range,
                     nullptr,
                     half_space_linear};
  return op;
}
template <>
const Op& op_for<detail::Slab>() {
  using namespace detail;
  static const Op op{
      "slab",     HWY_DYNAMIC_DISPATCH(slab_simd)(), HWY_STATIC_DISPATCH(slab_scalar)(), slab_range, nullptr,
      slab_linear};
  return op;
}

}  // namespace blendwright
#endif
