#include "implicit/primitives/skeleton.hpp"

#include <array>

#include "implicit/eval/linear_rules.hpp"
#include "implicit/eval/linear_shapes.hpp"
#include "implicit/eval/op.hpp"
#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/skeleton.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/number/p_norm-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const SegmentSkeleton& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  const T x = p.x - b.start[0], y = p.y - b.start[1], z = p.z - b.start[2];
  const Vec3& e = b.direction;
  const T s = smaller(larger(T(0.0), x * e[0] + y * e[1] + z * e[2]), T(b.length));
  const T w[3] = {x - s * e[0], y - s * e[1], z - s * e[2]};
  return length(w) * b.inverse_radius;
}

/// In units of R and of the largest coordinate: lengths l stand for l/R.
template <class T>
HWY_INLINE T evaluate(const CapsuleGauge& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  const L m =
      lane::max(lane::max(lane::abs(value_of(p.x)), lane::abs(value_of(p.y))), lane::abs(value_of(p.z)));
  const L scale = norm_scale(m), inverse = L(1.0) / scale;
  const T rho2 = square(scaled(p.x, inverse)) + square(scaled(p.y, inverse));
  const T z = scaled(absolute(p.z), inverse);
  const L l = select(value_of(p.z) < L(0.0), L(b.below), L(b.above));
  const T z2 = square(z);
  const T beyond = z2 - scaled(rho2, l * l);
  const auto cap = value_of(beyond) > L(0.0) && m >= L(1e-60);  // nearer to 0 the squares underflow
  const T denominator = choose<T>(cap, scaled(z, l) + root(rho2 + beyond), T(1.0));
  const T t = choose<T>(cap, (rho2 + z2) / denominator, root(rho2));
  return scaled(t, scale) * b.inverse_radius;
}

KernelSet segment_skeleton_simd() { return kernel_set<SegmentSkeleton, Simd>(); }
KernelSet capsule_gauge_simd() { return kernel_set<CapsuleGauge, Simd>(); }
#if HWY_ONCE
KernelSet segment_skeleton_scalar() { return kernel_set<SegmentSkeleton, double>(); }
KernelSet capsule_gauge_scalar() { return kernel_set<CapsuleGauge, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(segment_skeleton_simd);
HWY_EXPORT(capsule_gauge_simd);

/// The corners of a box.
static std::array<Vec3, 8> corners(const Box& b) {
  std::array<Vec3, 8> all;
  for (unsigned i = 0; i < 8; ++i)
    all[i] = {(i & 1) ? b.hi.x() : b.lo.x(), (i & 2) ? b.hi.y() : b.lo.y(), (i & 4) ? b.hi.z() : b.lo.z()};
  return all;
}

/// The point of the box nearest to p.
static Vec3 nearest_in(const Box& box, const Vec3& p) { return p.cwiseMax(box.lo).cwiseMin(box.hi); }

/// The s in [0, length] for which start + s e is nearest to the box. The square of that distance is convex
/// and, between the s where a coordinate enters or leaves the box's interval, a parabola: its derivative h(s)
/// = (p(s) - nearest point).e rises and is linear from one such s to the next.
static double nearest_parameter(const SegmentSkeleton& b, const Box& box) {
  const auto h = [&](double s) {
    const Vec3 p = b.start + s * b.direction;
    return (p - nearest_in(box, p)).dot(b.direction);
  };
  double from = 0.0, h_from = h(0.0), to = b.length, h_to = h(b.length);
  if (h_from >= 0.0) return from;
  if (h_to <= 0.0) return to;
  for (int i = 0; i < 3; ++i)
    for (const double wall : {box.lo[i], box.hi[i]}) {
      const double s = (wall - b.start[i]) / b.direction[i];
      if (!(s > from && s < to)) continue;
      const double h_s = h(s);
      (h_s < 0.0 ? from : to) = s;
      (h_s < 0.0 ? h_from : h_to) = h_s;
    }
  return from + (to - from) * (-h_from / (h_to - h_from));
}

static Range segment_range(const void* body, const Box& local, std::span<const Range>) {
  const auto& b = *static_cast<const SegmentSkeleton*>(body);
  const Op& op = op_for<SegmentSkeleton>();
  const Vec3 foot = b.start + nearest_parameter(b, local) * b.direction;
  Range r{scalar_value(op, body, nearest_in(local, foot)), 0.0};
  for (const Vec3& corner : corners(local)) r.hi = std::max(r.hi, scalar_value(op, body, corner));
  // Besides its own relative error r has that of the differences of coordinates, of size |X| + |p0| + length.
  const double size = local.lo.cwiseAbs().cwiseMax(local.hi.cwiseAbs()).sum() + b.start.cwiseAbs().sum();
  const double slack = 8.0 * std::numeric_limits<double>::epsilon() * (size + b.length) * b.inverse_radius +
                       range_slack * r.hi;
  return {std::max(0.0, r.lo - slack), r.hi + slack};
}

/// For every g of length 1/I: d >= g.X - max(g.p0, g.p1).
static LinearBound segment_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const SegmentSkeleton*>(body);
  const Vec3 direction = scalar_gradient(op_for<SegmentSkeleton>(), body, in.centre).gradient;
  const double size = direction.norm();
  const Vec3 g = size > 0.0 ? Vec3(direction * (b.inverse_radius / size)) : Vec3::Zero();
  const Vec3 end = b.start + b.length * b.direction;
  const double offset = -std::max(g.dot(b.start), g.dot(end));
  const double slack = 2.0 * range_slack * b.inverse_radius * (b.start.lpNorm<1>() + b.length);
  return supported_bound(op_for<SegmentSkeleton>(), body, in, Curve::convex, {offset, g},
                         Vec3::Constant(b.inverse_radius), slack);
}

/// For every g: t >= g.X / h(g), h(g) = R (|g| + max(g_z l1/R, -g_z l0/R)) its largest value on the capsule.
static LinearBound capsule_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const CapsuleGauge*>(body);
  Vec3 g = scalar_gradient(op_for<CapsuleGauge>(), body, in.centre).gradient;
  const double most = (g.stableNorm() + std::max(g.z() * b.above, -g.z() * b.below)) / b.inverse_radius;
  if (most > 0.0) g /= most;
  return supported_bound(op_for<CapsuleGauge>(), body, in, Curve::convex, {0.0, g},
                         Vec3::Constant(b.inverse_radius), 0.0);
}

static Range capsule_range(const void* body, const Box& local, std::span<const Range>) {
  const Op& op = op_for<CapsuleGauge>();
  const Vec3 far = local.lo.cwiseAbs().cwiseMax(local.hi.cwiseAbs());
  const double low = scalar_value(op, body, nearest_in(local, Vec3::Zero()));
  const double high = std::max(scalar_value(op, body, {far.x(), far.y(), local.lo.z()}),
                               scalar_value(op, body, {far.x(), far.y(), local.hi.z()}));
  return Range{low, high}.widened(range_slack);
}

}  // namespace detail

template <>
const Op& op_for<detail::SegmentSkeleton>() {
  using namespace detail;
  static const Op op{"segment_skeleton",
                     HWY_DYNAMIC_DISPATCH(segment_skeleton_simd)(),
                     HWY_STATIC_DISPATCH(segment_skeleton_scalar)(),
                     segment_range,
                     nullptr,
                     segment_linear};
  return op;
}
template <>
const Op& op_for<detail::CapsuleGauge>() {
  using namespace detail;
  static const Op op{"capsule_gauge",
                     HWY_DYNAMIC_DISPATCH(capsule_gauge_simd)(),
                     HWY_STATIC_DISPATCH(capsule_gauge_scalar)(),
                     capsule_range,
                     nullptr,
                     capsule_linear};
  return op;
}

}  // namespace blendwright
#endif
