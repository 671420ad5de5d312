#include "implicit/primitives/sweep_line.hpp"

#include <algorithm>

#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/sweep_line.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/primitives/sweep_section-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const SweepLine& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  const T x = p.x - b.start[0], y = p.y - b.start[1], z = p.z - b.start[2];
  const T u = x * b.U[0] + y * b.U[1] + z * b.U[2];
  const T v = x * b.V[0] + y * b.V[1] + z * b.V[2];
  const T h = x * b.W[0] + y * b.W[1] + z * b.W[2];
  const auto before = value_of(h)<L(0.0), after = value_of(h)> L(b.length);
  const T k = choose<T>(before, T(0.0), choose<T>(after, T(1.0), h * (1.0 / b.length)));
  const T alpha = choose<T>(before, h, h - b.length);
  return section_distance(b.section, u, v, k, alpha, before || after);
}

KernelSet sweep_line_simd() { return kernel_set<SweepLine, Simd>(); }
#if HWY_ONCE
KernelSet sweep_line_scalar() { return kernel_set<SweepLine, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(sweep_line_simd);

/// Encloses (X - start).direction over the box, with what rounding can add.
static Range component(const SweepLine& b, const Box& box, const Vec3& direction) {
  const Vec3 half = 0.5 * box.size();
  const double middle = (box.centre() - b.start).dot(direction), reach = half.dot(direction.cwiseAbs());
  const double slack = 8.0 * std::numeric_limits<double>::epsilon() *
                       direction.cwiseAbs().dot((box.centre().cwiseAbs() + half + b.start.cwiseAbs()).eval());
  return {middle - reach - slack, middle + reach + slack};
}

static Range sweep_line_range(const void* body, const Box& local, std::span<const Range>) {
  const SweepLine& b = *static_cast<const SweepLine*>(body);
  const Range h = component(b, local, b.W);
  const Range k{std::clamp(h.lo / b.length, 0.0, 1.0), std::clamp(h.hi / b.length, 0.0, 1.0)};
  const Range alpha{std::max({0.0, -h.hi, h.lo - b.length}), std::max({0.0, -h.lo, h.hi - b.length})};
  return section_range(b.section, plane_box(component(b, local, b.U), component(b, local, b.V)),
                       Range{k.lo, k.hi}, alpha);
}

Box sweep_line_region(const SweepLine& b, double value) {
  return hull(end_box(b.section, 0.0, b.start, b.W, value),
              end_box(b.section, 1.0, b.start + b.length * b.W, b.W, value));
}

static Op sweep_line_op() {
  return {"sweep_line", HWY_DYNAMIC_DISPATCH(sweep_line_simd)(), HWY_STATIC_DISPATCH(sweep_line_scalar)(),
          sweep_line_range};
}

}  // namespace detail

template <>
const Op& op_for<detail::SweepLine>() {
  static const Op op = detail::sweep_line_op();
  return op;
}

}  // namespace blendwright
#endif
