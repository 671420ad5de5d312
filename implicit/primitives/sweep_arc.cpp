#include "implicit/primitives/sweep_arc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/sweep_arc.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/primitives/sweep_section-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const SweepArc& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  // Turned so that the middle of the arc lies on the first axis.
  const T x = p.x * b.cos_middle + p.y * b.sin_middle, y = p.y * b.cos_middle - p.x * b.sin_middle;
  const L vx = value_of(x), vy = value_of(y);
  T k(0.5);
  if (b.section.varies()) {
    const Polar<L> a = polar(vx, vy);
    const L i = a.inverse, ii = i * i, sc = L(2.0) * a.sine * a.cosine;
    const T t = chain(x, y, lane::atan2(vy, vx), -(a.sine * i), a.cosine * i, sc * ii,
                      (a.sine * a.sine - a.cosine * a.cosine) * ii, -(sc * ii));
    k = (t + b.half) * (0.5 / b.half);
  }
  // alpha = r sin(|t| - half) is positive exactly beyond the ends.
  const T side = absolute(y), alpha = side * b.cos_half - x * b.sin_half;
  const auto beyond = value_of(alpha) > L(b.whole ? std::numeric_limits<double>::max() : 0.0);
  const T u = choose<T>(beyond, x * b.cos_half + side * b.sin_half, hypotenuse(x, y)) - b.radius;
  k = choose<T>(beyond, choose<T>(vy < L(0.0), T(0.0), T(1.0)), k);
  return section_distance(b.section, u, p.z, k, alpha, beyond);
}

KernelSet sweep_arc_simd() { return kernel_set<SweepArc, Simd>(); }
#if HWY_ONCE
KernelSet sweep_arc_scalar() { return kernel_set<SweepArc, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(sweep_arc_simd);

SweepArc::SweepArc(const Section& s, double R, double t0, double t1, bool whole_turn)
    : section(s),
      radius(R),
      middle(0.5 * (t0 + t1)),
      half(whole_turn ? std::numbers::pi : 0.5 * (t1 - t0)),
      cos_middle(std::cos(middle)),
      sin_middle(std::sin(middle)),
      cos_half(std::cos(half)),
      sin_half(std::sin(half)),
      whole(whole_turn) {}

/// Encloses a p + b q over the ranges, with what rounding can add.
static Range combination(double a, Range p, double b, Range q) {
  const Range r{std::min(a * p.lo, a * p.hi) + std::min(b * q.lo, b * q.hi),
                std::max(a * p.lo, a * p.hi) + std::max(b * q.lo, b * q.hi)};
  const double size = std::abs(a) * std::max(-p.lo, p.hi) + std::abs(b) * std::max(-q.lo, q.hi);
  const double slack = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(size);
  return {r.lo - slack, r.hi + slack};
}

/// Encloses k for feet inside the arc.
static Range inner_part(const SweepArc& b, Range x, Range y) {
  const std::optional<Range> t = angles(x, y);
  if (!t || t->lo < -std::numbers::pi || t->hi > std::numbers::pi) return {0.0, 1.0};
  const double slack = 1e-15;
  return {std::clamp((t->lo + b.half) * (0.5 / b.half) - slack, 0.0, 1.0),
          std::clamp((t->hi + b.half) * (0.5 / b.half) + slack, 0.0, 1.0)};
}

static Range sweep_arc_range(const void* body, const Box& local, std::span<const Range>) {
  const SweepArc& b = *static_cast<const SweepArc*>(body);
  const Range x = combination(b.cos_middle, local.axis(0), b.sin_middle, local.axis(1));
  const Range y = combination(b.cos_middle, local.axis(1), -b.sin_middle, local.axis(0));
  const Range z = local.axis(2), side = magnitude(y);
  const auto ring = [&](Range r) {  // r - R, with what rounding can add
    const double slack = 4.0 * std::numeric_limits<double>::epsilon() * (std::abs(r.hi) + b.radius);
    return Range{r.lo - b.radius - slack, r.hi - b.radius + slack};
  };
  const Range alpha = b.whole ? Range{-1.0, 0.0} : combination(b.cos_half, side, -b.sin_half, x);
  // The radius is bounded over the box itself: the turned one is larger.
  const Range u = ring(plane_box(local.axis(0), local.axis(1)).r);
  const Range inside = section_range(b.section, plane_box(u, z), inner_part(b, x, y), {0.0, 0.0});
  if (alpha.hi <= 0.0) return inside;
  const Range k{y.hi < 0.0 || y.lo < 0.0 ? 0.0 : 1.0, y.hi < 0.0 ? 0.0 : 1.0};
  const Range end_u = ring(combination(b.cos_half, x, b.sin_half, side));
  const Range outside = section_range(b.section, plane_box(end_u, z), k, {std::max(0.0, alpha.lo), alpha.hi});
  if (alpha.lo > 0.0) return outside;
  return {std::min(inside.lo, outside.lo), std::max(inside.hi, outside.hi)};
}

Box sweep_arc_region(const SweepArc& b, double value) {
  const double tube = b.section.reach(value, {0.0, 1.0});
  const auto place = [&](double t) { return Vec3(b.radius * Vec3(std::cos(t), std::sin(t), 0.0)); };
  // The arc's own box: its ends and the quarter points that it passes.
  const double t0 = b.middle - b.half, t1 = b.middle + b.half, quarter = 0.5 * std::numbers::pi;
  Box box = hull({place(t0), place(t0)}, {place(t1), place(t1)});
  for (double i = std::ceil(t0 / quarter); i * quarter <= t1; i += 1.0)
    box = hull(box, {place(i * quarter), place(i * quarter)});
  const double reach = tube + 1e-12 * b.radius;
  box = {box.lo.array() - reach, box.hi.array() + reach};
  if (b.whole) return box;
  for (const double k : {0.0, 1.0}) {
    const double t = k == 0.0 ? t0 : t1;
    box = hull(box, end_box(b.section, k, place(t), Vec3(-std::sin(t), std::cos(t), 0.0), value));
  }
  return box;
}

static Op sweep_arc_op() {
  return {"sweep_arc", HWY_DYNAMIC_DISPATCH(sweep_arc_simd)(), HWY_STATIC_DISPATCH(sweep_arc_scalar)(),
          sweep_arc_range};
}

}  // namespace detail

template <>
const Op& op_for<detail::SweepArc>() {
  static const Op op = detail::sweep_arc_op();
  return op;
}

}  // namespace blendwright
#endif
