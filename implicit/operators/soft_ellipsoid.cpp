#include "implicit/operators/soft_ellipsoid.hpp"

#include <algorithm>

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/soft_ellipsoid.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// P of u = |y|^2. Where s = 0 the inner branch is 1 - 2 u, also at u = 0 = D.
template <class T>
HWY_INLINE T blanc_of_square(double s, const T& u) {
  using L = LaneOf<T>;
  const L v = lane::min(value_of(u), L(4.0)), rest = L(1.0) - v;
  const auto inner = v <= L(0.25), inside = v < L(1.0);
  L f, f1, f2;
  if (s == 0.0) {
    const L i = L(1.0) / (L(0.75) + L(1.5) * v), w = rest * i, k = L(2.25) * i;
    f = select(inner, L(1.0) - (v + v), rest * w);
    f1 = select(inner, L(-2.0), -(w * (L(1.0) + k)));
    f2 = select(inner, L(0.0), L(2.0) * ((k * k) * i));
  } else {
    const L bend = L(s) * (L(1.0) - L(4.0) * v);
    const L i = L(1.0) / select(inner, bend + L(4.5) * v, (L(0.75) + L(1.5) * v) - bend);
    const L w = select(inner, v, rest) * i, k = select(inner, L(s), L(2.25 + 3.0 * s)) * i;
    const L quotient = select(inner, L(9.0) * v, rest) * w;
    f = select(inner, L(1.0) - quotient, quotient);
    f1 = select(inner, L(-9.0), L(-1.0)) * (w * (L(1.0) + k));
    f2 = select(inner, L(-18.0), L(2.0)) * ((k * k) * i);
  }
  return choose<T>(inside, chain(u, f, f1, f2), T(0.0));
}

/// |y|^2 without derivatives: enough to see that a whole vector is outside.
template <class T>
HWY_INLINE LaneOf<T> square_of_value(const Point<T>& p) {
  const auto x = value_of(p.x), y = value_of(p.y), z = value_of(p.z);
  return multiply_add(z, z, multiply_add(y, y, x * x));
}
/// The same number with them.
template <class T>
HWY_INLINE T square_of(const Point<T>& p, LaneOf<T> value) {
  if constexpr (NumberTraits<T>::order == 0) {
    return value;
  } else {
    T u = square(p.x) + square(p.y) + square(p.z);
    u.v = value;
    return u;
  }
}

template <class T>
HWY_INLINE T evaluate(const SoftEllipsoid& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  const L v = square_of_value(p);
  if (!any(v < L(1.0))) return T(0.0);  // what all lanes would be
  return blanc_of_square<T>(b.softness, square_of(p, v));
}
template <class T>
HWY_INLINE T evaluate(const AddedSoftEllipsoid& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  const L v = square_of_value(p);
  if (!any(v < L(1.0))) return in.arg(0);
  return in.arg(0) + blanc_of_square<T>(b.softness, square_of(p, v));
}

KernelSet soft_ellipsoid_simd() { return kernel_set<SoftEllipsoid, Simd>(); }
KernelSet added_soft_ellipsoid_simd() { return kernel_set<AddedSoftEllipsoid, Simd>(); }
#if HWY_ONCE
KernelSet soft_ellipsoid_scalar() { return kernel_set<SoftEllipsoid, double>(); }
KernelSet added_soft_ellipsoid_scalar() { return kernel_set<AddedSoftEllipsoid, double>(); }
/// P and its slope at u.
static Knot blanc_knot(double softness, double u) {
  Dual<double> x;
  x.v = u;
  x.d[0] = 1.0;
  const Dual<double> p = blanc_of_square(softness, x);
  return {u, p.v, p.d[0], p.d[0]};
}
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(soft_ellipsoid_simd);
HWY_EXPORT(added_soft_ellipsoid_simd);

/// How far (relative) |y| may be off by rounding.
constexpr double radius_slack = 1e-13;

/// The nearest and the farthest corner of magnitudes: P falls with |y|. The slack on |y| is far above the few
/// ulp by which |y| is rounded, and covers P also near |y| = 1, where it vanishes and a relative slack is
/// none.
static Range ellipsoid_range(double softness, const Box& local) {
  const SoftEllipsoid body{softness};
  Vec3 near, far;
  for (int i = 0; i < 3; ++i) {
    const Range m = magnitude(local.axis(i));
    near[i] = m.lo * (1.0 - radius_slack);
    far[i] = m.hi * (1.0 + radius_slack);
  }
  const Op& op = op_for<SoftEllipsoid>();
  const Range r = Range{scalar_value(op, &body, far), scalar_value(op, &body, near)}.widened(range_slack);
  return {std::max(0.0, r.lo), std::min(1.0, r.hi)};
}
static bool outside(const Box& local) {
  double square = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double m = magnitude(local.axis(i)).lo;
    square += m * m;
  }
  return square >= 1.0 + 4.0 * radius_slack;
}
/// u = |c|^2 + 2 c.(y - c) + [0, |y - c|^2], and P of u is concave to u = 1/4, then convex, then 0.
static LinearBound ellipsoid_linear(double softness, const LinearInput& in) {
  constexpr double joints[] = {0.25, 1.0};
  constexpr Curve curves[] = {Curve::concave, Curve::convex, Curve::convex};
  const Vec3 c = in.centre, reach = reach_of(in);
  double far = 0.0;
  for (unsigned k = 0; k < 4; ++k) far = std::max(far, (in.corner(k) - c).squaredNorm());
  const double size = reach.squaredNorm();
  const double slack = 16.0 * std::numeric_limits<double>::epsilon() * size + 4.0 * reach.dot(in.slack);
  const LinearBound square = LinearBound{c.squaredNorm(), 2.0 * in.slope(c), {0.0, far}}.widened(slack);
  double near = 0.0;
  for (int i = 0; i < 3; ++i) near += std::pow(magnitude(in.local.axis(i)).lo, 2);
  const Range range{std::max(0.0, near - slack), size + slack};
  return of_curves(
      square, range, joints, curves,
      [](const void* s, double u) {
        return HWY_STATIC_DISPATCH(blanc_knot)(*static_cast<const double*>(s), u);
      },
      &softness, 4.0 * range_slack);
}
static double softness_of(const void* body) { return static_cast<const SoftEllipsoid*>(body)->softness; }

}  // namespace detail

template <>
const Op& op_for<detail::SoftEllipsoid>() {
  using namespace detail;
  static const Op op{
      "soft_ellipsoid",
      HWY_DYNAMIC_DISPATCH(soft_ellipsoid_simd)(),
      HWY_STATIC_DISPATCH(soft_ellipsoid_scalar)(),
      [](const void* body, const Box& local, std::span<const Range>) {
        return ellipsoid_range(softness_of(body), local);
      },
      [](const void*, const Box& local, std::span<const Range>) {
        return outside(local) ? Shortcut::to_constant(0.0) : Shortcut{};
      },
      [](const void* body, const LinearInput& in) { return ellipsoid_linear(softness_of(body), in); }};
  return op;
}
template <>
const Op& op_for<detail::AddedSoftEllipsoid>() {
  using namespace detail;
  static const Op op{"added_soft_ellipsoid",
                     HWY_DYNAMIC_DISPATCH(added_soft_ellipsoid_simd)(),
                     HWY_STATIC_DISPATCH(added_soft_ellipsoid_scalar)(),
                     [](const void* body, const Box& local, std::span<const Range> args) {
                       const Range r =
                           ellipsoid_range(static_cast<const AddedSoftEllipsoid*>(body)->softness, local);
                       return Range{args[0].lo + r.lo, args[0].hi + r.hi};
                     },
                     [](const void*, const Box& local, std::span<const Range>) {
                       return outside(local) ? Shortcut::to_argument(0) : Shortcut{};
                     },
                     [](const void* body, const LinearInput& in) {
                       const double softness = static_cast<const AddedSoftEllipsoid*>(body)->softness;
                       return in.args[0] + ellipsoid_linear(softness, in);
                     }};
  return op;
}

}  // namespace blendwright
#endif
