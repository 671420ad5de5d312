#include "implicit/primitives/sweep_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/primitives/sweep_section-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
struct Space {
  T x, y, z;
};
template <class T>
HWY_INLINE T dot(const Space<T>& a, const Space<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// A vector function of t from its value and first two derivatives.
template <class T>
HWY_INLINE Space<T> along(const T& t, const Vec3& f, const Vec3& f1, const Vec3& f2) {
  return {chain(t, f.x(), f1.x(), f2.x()), chain(t, f.y(), f1.y(), f2.y()), chain(t, f.z(), f1.z(), f2.z())};
}

/// The foot's x with its derivatives: Newton's method for w.C' = 0, one order per step.
template <class T>
HWY_INLINE T moving_foot(const Foot& foot, const PathJet& c, const Space<T>& p) {
  T x = constant<T>(foot.x);
  if (foot.end != 0 || NumberTraits<T>::order == 0) return x;
  const Vec3 w(value_of(p.x) - c[0].x(), value_of(p.y) - c[0].y(), value_of(p.z) - c[0].z());
  const double speed = c[1].squaredNorm(), D = speed - w.dot(c[2]);
  if (!(D > 1e-9 * speed)) return x;
  for (int order = 0; order < NumberTraits<T>::order; ++order) {
    const Space<T> C = along(x, c[0], c[1], c[2]), C1 = along(x, c[1], c[2], c[3]);
    const T F = dot({p.x - C.x, p.y - C.y, p.z - C.z}, C1);
    x = x + scaled(F - value_of(F), 1.0 / D);
  }
  return x;
}

template <class T>
HWY_INLINE T evaluate(const SweepCurve& b, const Inputs<T>& in) {
  const Point<T> local = in.local();
  const Space<T> p{local.x, local.y, local.z};
  const Path& path = *b.path;
  const Foot foot = path.nearest({value_of(p.x), value_of(p.y), value_of(p.z)});
  const PathPiece& piece = path.pieces()[foot.piece];
  const PathJet c = piece.jet(foot.x);
  const PathFrame f = NumberTraits<T>::order == 0 ? piece.frame(foot.x) : piece.frame_jet(foot.x);
  const T x = moving_foot(foot, c, p);
  const Space<T> C = along(x, c[0], c[1], c[2]), w{p.x - C.x, p.y - C.y, p.z - C.z};
  const T u = dot(w, along(x, f.U[0], f.U[1], f.U[2])), v = dot(w, along(x, f.V[0], f.V[1], f.V[2]));
  const T alpha = w.x * f.W.x() + w.y * f.W.y() + w.z * f.W.z();
  const T k = (x * piece.half + (piece.t_middle - path.t0())) * (1.0 / (path.t1() - path.t0()));
  return section_distance(b.section, u, v, k, alpha, foot.end != 0);
}

static KernelSet sweep_curve_kernels() { return kernel_set<SweepCurve, double>(); }

static double largest_at_end(const Section& b, double q, double alpha) {
  const double u[2] = {q, alpha};
  return p_norm(u, b.m, b.inverse_m);
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace blendwright {
namespace detail {

SweepCurve::SweepCurve(const Section& s, std::shared_ptr<const Path> p)
    : section(s), path(std::move(p)), seamless(path->closed() && s.closes()) {
  if (path->closed() && !s.profile.same_after_turn(path->closing_angle()))
    section.twist -= path->closing_angle();
}

namespace {

/// The ball around a box, with what rounding can add to coordinates, foot and frame.
struct Surroundings {
  Vec3 centre;
  double radius;
  Foot foot;
};
Surroundings surroundings(const SweepCurve& b, const Box& local) {
  const Box& path = b.path->bounds();
  const double size = path.lo.cwiseAbs().cwiseMax(path.hi.cwiseAbs()).maxCoeff();
  const Vec3 centre = local.centre();
  const double reach = 0.5 * local.size().norm();
  const double radius = reach + 1e-13 * (size + reach + centre.norm());
  return {centre, radius, b.path->nearest(centre)};
}

/// Where every point has one foot.
Range single_foot_range(const SweepCurve& b, const Surroundings& at, double rate) {
  const Path& path = *b.path;
  const PathPiece& piece = path.pieces()[at.foot.piece];
  const PathFrame frame = piece.frame(at.foot.x);
  const Vec3 w = at.centre - piece.jet(at.foot.x)[0];
  PlanePart part = plane_disk(w.dot(frame.U[0]), w.dot(frame.V[0]), at.radius);
  const double range = path.t1() - path.t0(), t = path.t(at.foot);
  Range k{(t - path.t0() - rate * at.radius) / range - 1e-12,
          (t - path.t0() + rate * at.radius) / range + 1e-12};
  Range alpha{0.0, 0.0};
  if (!path.closed()) {
    if (k.lo <= 0.0 || k.hi >= 1.0) {
      const double offset = at.foot.end == 0 ? 0.0 : std::abs(w.dot(frame.W));
      alpha = {std::max(0.0, offset - at.radius), offset + at.radius};
    }
  }
  if (!b.seamless) k = {std::clamp(k.lo, 0.0, 1.0), std::clamp(k.hi, 0.0, 1.0)};
  return section_range(b.section, part, k, alpha);
}

/// From the distance to the curve alone.
Range distance_range(const SweepCurve& b, const Surroundings& at) {
  const Section& section = b.section;
  const Range r{std::max(0.0, at.foot.distance - at.radius), at.foot.distance + at.radius};
  const PlanePart part{{-r.hi, r.hi}, {-r.hi, r.hi}, r, std::nullopt, 0.0, 0.0, r.hi};
  Range d = section_range(section, part, {0.0, 1.0}, {0.0, 0.0});
  const Path& path = *b.path;
  const Vec3 start = path.pieces().front().jet(-1.0)[0], end = path.pieces().back().jet(1.0)[0];
  const double nearest = std::min((at.centre - start).norm(), (at.centre - end).norm());
  if (path.closed() || nearest > at.foot.distance + 2.0 * at.radius) return d;
  // Beyond an end r^2 = u0^2 + v0^2 + alpha^2, and d >= max(p |(u0, v0)|, q |alpha|) >= r p q/sqrt(p^2 +
  // q^2).
  const double p = 1.0 / (section.profile.radius().hi * std::max(section.s0, section.s0 + section.ds));
  const double q = section.inverse_cap;
  d.hi = HWY_NAMESPACE::largest_at_end(section, d.hi, r.hi * q);
  d.lo = std::min(d.lo, r.lo * p * q / std::hypot(p, q));
  return d.widened(range_slack);
}

Range sweep_curve_range(const void* body, const Box& local, std::span<const Range>) {
  const SweepCurve& b = *static_cast<const SweepCurve*>(body);
  if (!local.finite()) return {0.0, std::numeric_limits<double>::infinity()};
  const Surroundings at = surroundings(b, local);
  const auto stretch = b.path->stretch(at.centre, at.radius, at.foot, b.seamless);
  return stretch ? single_foot_range(b, at, stretch->rate) : distance_range(b, at);
}

Op sweep_curve_op() {
  const KernelSet kernels = HWY_NAMESPACE::sweep_curve_kernels();
  return {"sweep_curve", kernels, kernels, sweep_curve_range};
}

}  // namespace

// A point of the normal plane of W at the distance r differs by r sqrt(1 - W_i^2) at most in coordinate i.
Box sweep_curve_region(const SweepCurve& b, double value) {
  const Path& path = *b.path;
  const double range = path.t1() - path.t0();
  Box box = path.pieces().front().box();
  for (const PathPiece& p : path.pieces()) {
    const double k = (p.t_middle - path.t0()) / range, half = p.half / range;
    const double reach = b.section.reach(value, {k - half, k + half});
    const Vec3 along = p.least_tangent(), across = (1.0 - along.array().square()).sqrt();
    const Box piece = p.box();
    box = hull(box, {piece.lo - reach * across, piece.hi + reach * across});
  }
  if (path.closed()) return box;
  const PathJet first = path.pieces().front().jet(-1.0), last = path.pieces().back().jet(1.0);
  return hull(box, hull(end_box(b.section, 0.0, first[0], first[1].normalized(), value),
                        end_box(b.section, 1.0, last[0], last[1].normalized(), value)));
}

}  // namespace detail

template <>
const Op& op_for<detail::SweepCurve>() {
  static const Op op = detail::sweep_curve_op();
  return op;
}

}  // namespace blendwright
