#include "implicit/primitives/quadric.hpp"

#include "implicit/eval/op.hpp"
#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/quadric.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/primitives/local_derivatives-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// (1) as x lx + y ly + z lz + A44, lx = A11 x + A12 y + A13 z + A14, ly = A22 y + A23 z + A24, lz = A33 z +
/// A34.
template <class L>
struct QuadricForms {
  L lx, ly, lz, value;
  HWY_INLINE QuadricForms(const Quadric& b, L x, L y, L z) {
    const auto& a = b.a;
    lx = multiply_add(L(a[0]), x, L(a[6]));
    ly = multiply_add(L(a[1]), y, L(a[7]));
    lz = multiply_add(L(a[2]), z, L(a[8]));
    if (b.crossed) {
      lx = multiply_add(L(a[3]), y, multiply_add(L(a[4]), z, lx));
      ly = multiply_add(L(a[5]), z, ly);
    }
    value = multiply_add(x, lx, multiply_add(y, ly, multiply_add(z, lz, L(a[9]))));
  }
};

/// (1), with its derivatives taken by hand: they are linear forms of the same products.
template <class T>
HWY_INLINE T quadric_at(const QuadricCoefficients& a, const Point<T>& p, const QuadricForms<LaneOf<T>>& at) {
  using L = LaneOf<T>;
  const L x = value_of(p.x), y = value_of(p.y), z = value_of(p.z);
  const L g[3] = {multiply_add(L(a[0]), x, at.lx), multiply_add(L(a[1]), y, multiply_add(L(a[3]), x, at.ly)),
                  multiply_add(L(a[2]), z, multiply_add(L(a[4]), x, multiply_add(L(a[5]), y, at.lz)))};
  const L h[6] = {2.0 * a[0], 2.0 * a[1], 2.0 * a[2], a[3], a[4], a[5]};
  return of_local(p, at.value, g, h);
}
template <class T>
HWY_INLINE QuadricForms<LaneOf<T>> forms_at(const Quadric& b, const Point<T>& p) {
  return {b, value_of(p.x), value_of(p.y), value_of(p.z)};
}

template <class T>
HWY_INLINE T evaluate(const Quadric& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  return quadric_at(b.a, p, forms_at(b, p));
}

/// t = max(q + c, 0).
template <class L>
HWY_INLINE L depth_in_support(const Perturbation& b, L q) {
  return lane::max(q + L(b.free_term), L(0.0));
}
/// w t^(k-2).
template <class L>
HWY_INLINE L second_factor(const Perturbation& b, L t) {
  const L w = b.weight;
  return b.power == 2 ? w : b.power == 3 ? w * t : w * integer_power(t, b.power - 2);
}
/// (2), with its derivatives by q: k w t^(k-1), k (k-1) w t^(k-2), and 0 outside of the support.
template <class T>
HWY_INLINE T perturbation_of(const Perturbation& b, const T& q) {
  using L = LaneOf<T>;
  const L t = depth_in_support(b, value_of(q)), factor = second_factor(b, t);
  const L second = select(t > L(0.0), factor, L(0.0));
  return chain(q, t * t * factor, L(b.power) * (t * factor), L(b.power * (b.power - 1)) * second);
}

template <class T>
HWY_INLINE T evaluate(const Perturbation& b, const Inputs<T>& in) {
  return perturbation_of(b, in.arg(0));
}
template <class T>
HWY_INLINE T evaluate(const AddedPerturbation& b, const Inputs<T>& in) {
  return in.arg(0) + perturbation_of(b.added, in.arg(1));
}
/// Outside the support the derivatives of the sum are left as they are, to the sign of a zero, whether a
/// vector has points inside or not.
template <class T>
HWY_INLINE T evaluate(const AddedQuadric& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  const QuadricForms<L> q = forms_at(b.q, p);
  const T sum = in.arg(0);
  if constexpr (NumberTraits<T>::order == 0) {
    const L t = depth_in_support(b.added, q.value);
    return multiply_add(t * t, second_factor(b.added, t), sum);
  } else {
    const auto inside = q.value > L(-b.added.free_term);
    if (!any(inside)) return sum;
    return choose<T>(inside, sum + perturbation_of(b.added, quadric_at(b.q.a, p, q)), sum);
  }
}
template <class T>
HWY_INLINE T evaluate(const Sum&, const Inputs<T>& in) {
  return in.arg(0) + in.arg(1);
}

KernelSet quadric_simd() { return kernel_set<Quadric, Simd>(); }
KernelSet perturbation_simd() { return kernel_set<Perturbation, Simd>(); }
KernelSet added_perturbation_simd() { return kernel_set<AddedPerturbation, Simd>(); }
KernelSet added_quadric_simd() { return kernel_set<AddedQuadric, Simd>(); }
KernelSet sum_simd() { return kernel_set<Sum, Simd>(); }
#if HWY_ONCE
KernelSet quadric_scalar() { return kernel_set<Quadric, double>(); }
KernelSet perturbation_scalar() { return kernel_set<Perturbation, double>(); }
KernelSet added_perturbation_scalar() { return kernel_set<AddedPerturbation, double>(); }
KernelSet added_quadric_scalar() { return kernel_set<AddedQuadric, double>(); }
KernelSet sum_scalar() { return kernel_set<Sum, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "implicit/eval/linear_rules.hpp"
#include "implicit/primitives/quadric_linear.hpp"

namespace blendwright {
namespace detail {
HWY_EXPORT(quadric_simd);
HWY_EXPORT(perturbation_simd);
HWY_EXPORT(added_perturbation_simd);
HWY_EXPORT(added_quadric_simd);
HWY_EXPORT(sum_simd);

static Range quadric_op_range(const void* body, const Box& local, std::span<const Range>) {
  return quadric_range(static_cast<const Quadric*>(body)->a, local);
}
/// Monotone, every step of it rounded alike where there are no fused ones: end points.
static Range range_of(const Perturbation& b, Range q) {
  if (q.hi + b.free_term <= 0.0) return {0.0, 0.0};
  return range_by_arguments(op_for<Perturbation>(), &b, {&q, 1}, {b.weight > 0.0});
}
static Range sum_of(Range a, Range b) {
  return {a.lo + b.lo, a.hi + b.hi};  // addition is rounded alike everywhere and monotone
}

static Range perturbation_range(const void* body, const Box&, std::span<const Range> args) {
  return range_of(*static_cast<const Perturbation*>(body), args[0]);
}
static Shortcut perturbation_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const bool outside = args[0].hi + static_cast<const Perturbation*>(body)->free_term <= 0.0;
  return outside ? Shortcut::to_constant(0.0) : Shortcut{};
}

static Range added_perturbation_range(const void* body, const Box&, std::span<const Range> args) {
  return sum_of(args[0], range_of(static_cast<const AddedPerturbation*>(body)->added, args[1]));
}
/// Outside its support a perturbation adds nothing; drop lists come from here.
static Shortcut added_perturbation_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const bool outside = args[1].hi + static_cast<const AddedPerturbation*>(body)->added.free_term <= 0.0;
  return outside ? Shortcut::to_argument(0) : Shortcut{};
}

static Range added_quadric_range(const void* body, const Box& local, std::span<const Range> args) {
  const auto& b = *static_cast<const AddedQuadric*>(body);
  return sum_of(args[0], range_of(b.added, quadric_range(b.q.a, local)));
}
static Shortcut added_quadric_shortcut(const void* body, const Box& local, std::span<const Range>) {
  const auto& b = *static_cast<const AddedQuadric*>(body);
  const bool outside = quadric_range(b.q.a, local).hi + b.added.free_term <= 0.0;
  return outside ? Shortcut::to_argument(0) : Shortcut{};
}

static Range sum_range(const void*, const Box&, std::span<const Range> args) {
  return sum_of(args[0], args[1]);
}
static Shortcut sum_shortcut(const void*, const Box&, std::span<const Range> args) {
  if (args[1] == Range{0.0, 0.0}) return Shortcut::to_argument(0);
  return args[0] == Range{0.0, 0.0} ? Shortcut::to_argument(1) : Shortcut{};
}

}  // namespace detail

template <>
const Op& op_for<detail::Quadric>() {
  using namespace detail;
  static const Op op{"quadric",
                     HWY_DYNAMIC_DISPATCH(quadric_simd)(),
                     HWY_STATIC_DISPATCH(quadric_scalar)(),
                     quadric_op_range,
                     nullptr,
                     quadric_linear};
  return op;
}
template <>
const Op& op_for<detail::Perturbation>() {
  using namespace detail;
  static const Op op{"perturbation",
                     HWY_DYNAMIC_DISPATCH(perturbation_simd)(),
                     HWY_STATIC_DISPATCH(perturbation_scalar)(),
                     perturbation_range,
                     perturbation_shortcut,
                     perturbation_linear};
  return op;
}
template <>
const Op& op_for<detail::AddedPerturbation>() {
  using namespace detail;
  static const Op op{"added_perturbation",
                     HWY_DYNAMIC_DISPATCH(added_perturbation_simd)(),
                     HWY_STATIC_DISPATCH(added_perturbation_scalar)(),
                     added_perturbation_range,
                     added_perturbation_shortcut,
                     added_perturbation_linear};
  return op;
}
template <>
const Op& op_for<detail::AddedQuadric>() {
  using namespace detail;
  static const Op op{"added_quadric",
                     HWY_DYNAMIC_DISPATCH(added_quadric_simd)(),
                     HWY_STATIC_DISPATCH(added_quadric_scalar)(),
                     added_quadric_range,
                     added_quadric_shortcut,
                     added_quadric_linear};
  return op;
}
template <>
const Op& op_for<detail::Sum>() {
  using namespace detail;
  static const Op op{"sum",
                     HWY_DYNAMIC_DISPATCH(sum_simd)(),
                     HWY_STATIC_DISPATCH(sum_scalar)(),
                     sum_range,
                     sum_shortcut,
                     added_bound};
  return op;
}

}  // namespace blendwright
#endif
