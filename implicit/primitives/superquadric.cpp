#include "implicit/primitives/superquadric.hpp"

#include "implicit/eval/op.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/primitives/norm_linear.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/superquadric.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/number/p_norm-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const Superquadric& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  const T u[2] = {p.x * b.inverse_axes[0], p.y * b.inverse_axes[1]};
  const T w[2] = {p_norm(u, b.n1, b.inverse_n1), p.z * b.inverse_axes[2]};
  return p_norm(w, b.n2, b.inverse_n2);
}

/// x times the factor of its side; norms take its magnitude.
template <class T>
HWY_INLINE T one_sided(const T& x, double plus, double minus) {
  using L = LaneOf<T>;
  return scaled(x, select(value_of(x) < L(0.0), L(minus), L(plus)));
}

template <class T>
HWY_INLINE T evaluate(const AsymmetricSuperellipsoid& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  const T u[3] = {one_sided(p.x, b.inverse_plus[0], b.inverse_minus[0]),
                  one_sided(p.y, b.inverse_plus[1], b.inverse_minus[1]),
                  one_sided(p.z, b.inverse_plus[2], b.inverse_minus[2])};
  return p_norm(u, b.n, b.inverse_n);
}

KernelSet superquadric_simd() { return kernel_set<Superquadric, Simd>(); }
KernelSet asymmetric_simd() { return kernel_set<AsymmetricSuperellipsoid, Simd>(); }
#if HWY_ONCE
KernelSet superquadric_scalar() { return kernel_set<Superquadric, double>(); }
KernelSet asymmetric_scalar() { return kernel_set<AsymmetricSuperellipsoid, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(superquadric_simd);
HWY_EXPORT(asymmetric_simd);

static Range superquadric_range(const void* body, const Box& local, std::span<const Range>) {
  return range_by_magnitudes(op_for<Superquadric>(), body, local);
}

/// Convex for n1, n2 >= 1, concave on each octant for n1, n2 <= 1, else a norm of a norm.
static LinearBound superquadric_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const Superquadric*>(body);
  const double n1 = b.n1.exponent, n2 = b.n2.exponent;
  const bool convex = n1 >= 1.0 && n2 >= 1.0;
  if (convex || (n1 <= 1.0 && n2 <= 1.0 && in_one_octant(in)))
    return norm_bound(op_for<Superquadric>(), body, in, convex, b.inverse_axes);
  const BoundedNumber q = norm_of_two(n1, coordinate_magnitude(in, 0, b.inverse_axes[0]),
                                      coordinate_magnitude(in, 1, b.inverse_axes[1]));
  return norm_of_two(n2, q, coordinate_magnitude(in, 2, b.inverse_axes[2])).bound;
}

static Range asymmetric_range(const void* body, const Box& local, std::span<const Range>) {
  const auto& b = *static_cast<const AsymmetricSuperellipsoid*>(body);
  const Vec3 nearest = Vec3::Zero().cwiseMax(local.lo).cwiseMin(local.hi);
  Vec3 farthest;
  for (int i = 0; i < 3; ++i) {
    const bool low = -local.lo[i] * b.inverse_minus[i] > local.hi[i] * b.inverse_plus[i];
    farthest[i] = low || local.hi[i] < 0.0 ? local.lo[i] : local.hi[i];
  }
  const Op& op = op_for<AsymmetricSuperellipsoid>();
  return Range{scalar_value(op, body, nearest), scalar_value(op, body, farthest)}.widened(range_slack);
}

static LinearBound asymmetric_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const AsymmetricSuperellipsoid*>(body);
  const double n = b.n.exponent;
  const Vec3 &plus = b.inverse_plus, &minus = b.inverse_minus;
  if (n >= 1.0 || in_one_octant(in))
    return norm_bound(op_for<AsymmetricSuperellipsoid>(), body, in, n >= 1.0, plus.cwiseMax(minus));
  const BoundedNumber q = norm_of_two(n, coordinate_magnitude(in, 0, plus[0], minus[0]),
                                      coordinate_magnitude(in, 1, plus[1], minus[1]));
  return norm_of_two(n, q, coordinate_magnitude(in, 2, plus[2], minus[2])).bound;
}

}  // namespace detail

template <>
const Op& op_for<detail::Superquadric>() {
  using namespace detail;
  static const Op op{"superquadric",
                     HWY_DYNAMIC_DISPATCH(superquadric_simd)(),
                     HWY_STATIC_DISPATCH(superquadric_scalar)(),
                     superquadric_range,
                     nullptr,
                     superquadric_linear};
  return op;
}
template <>
const Op& op_for<detail::AsymmetricSuperellipsoid>() {
  using namespace detail;
  static const Op op{"asymmetric_superellipsoid",
                     HWY_DYNAMIC_DISPATCH(asymmetric_simd)(),
                     HWY_STATIC_DISPATCH(asymmetric_scalar)(),
                     asymmetric_range,
                     nullptr,
                     asymmetric_linear};
  return op;
}

}  // namespace blendwright
#endif
