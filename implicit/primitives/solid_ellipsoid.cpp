#include "implicit/number/targets.hpp"
#include "implicit/primitives/solid_distance.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/solid_ellipsoid.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/primitives/local_derivatives-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// V_i = c_i / (tau + e_i), c_i = s_i x_i, tau = t + s_min^2; 0/0 is 0. (1) is |V| = 1.
template <class L>
struct FootTerms {
  L v[3], squares, slope;  ///< sum V^2, and the sum of V_i^2 / (tau + e_i)
  HWY_INLINE FootTerms(const L (&c)[3], const Vec3& e, L tau) {
    squares = 0.0;
    slope = 0.0;
    for (int i = 0; i < 3; ++i) {
      const L d = tau + L(e[i]);
      const auto regular = d > L(0.0);
      const L inverse = L(1.0) / select(regular, d, L(1.0));
      v[i] = select(regular, c[i] * inverse, L(0.0));
      squares = multiply_add(v[i], v[i], squares);
      slope = multiply_add(v[i] * v[i], inverse, slope);
    }
  }
};

/// The largest root tau of (1). 1/|V| is concave and rises with tau, so a Newton step for 1/|V| = 1 from
/// anywhere ends at or below the root (More and Sorensen 1983), and rises from there to it. When that is
/// slow, beside a pole whose term is tiny, every other step is the geometric mean of the bracket. A lane that
/// has arrived stays where it is, so that its bits do not depend on its neighbours.
template <class L>
HWY_INLINE L foot_parameter(const L (&c)[3], const Vec3& e) {
  constexpr double round_off = std::numeric_limits<double>::epsilon();
  constexpr int most_steps = 64, patience = 8;
  const L a[3] = {lane::abs(c[0]), lane::abs(c[1]), lane::abs(c[2])};
  // One term alone is 1 at |c_i| - e_i, all of them are less at the sum of |c_i|.
  L lo = 0.0, hi = a[0] + a[1] + a[2];
  for (int i = 0; i < 3; ++i) lo = lane::max(lo, a[i] - L(e[i]));
  L tau = lo;
  auto arrived = hi <= lo;
  for (int step = 0; step < most_steps && !all(arrived); ++step) {
    const FootTerms<L> at(c, e, tau);
    const auto below = at.squares > L(1.0);
    lo = select(!arrived && below, lane::max(lo, tau), lo);
    hi = select(!arrived && !below, lane::min(hi, tau), hi);
    const L root = lane::sqrt(at.squares);
    const auto steep = at.slope > L(0.0);
    const L newton = at.squares * (at.squares - L(1.0)) / ((root + L(1.0)) * select(steep, at.slope, L(1.0)));
    const L target = lane::min(lane::max(tau + select(steep, newton, L(0.0)), lo), hi);
    const auto close = lane::abs(at.squares - L(1.0)) <= L(4.0 * round_off);
    arrived = arrived || close || (below && target <= tau) || hi - lo <= L(2.0 * round_off) * lo;
    lo = select(arrived, lo, lane::max(lo, target));
    const bool middle = step >= patience && step % 2 == 0;
    const L mean = lane::sqrt(lane::max(lo, L(1e-200) * hi)) * lane::sqrt(hi);
    const L next = middle ? select(hi > L(2.0) * lo, mean, target) : target;
    tau = select(arrived, tau, next);
  }
  return tau;
}

/// What follows from the nearest point. n: outward normal.
template <class T>
HWY_INLINE T evaluate(const EllipsoidDistance& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  const L x[3] = {value_of(p.x), value_of(p.y), value_of(p.z)};
  L c[3];
  for (int i = 0; i < 3; ++i) {
    // Beyond 1e140 products overflow, below 1e-140 they are nothing next to the semi-axes.
    c[i] = L(b.s[i]) * lane::min(lane::max(x[i], L(-1e140)), L(1e140));
    c[i] = select(lane::abs(c[i]) > L(1e-140 * b.s[i]), c[i], L(0.0));
  }
  const L tau = foot_parameter(c, b.e);
  FootTerms<L> foot(c, b.e, tau);
  // On the plane across the shortest axis, near enough to the middle, (1) has the limit tau = 0: there are
  // two nearest points, and the term of that axis is what is missing from 1.
  const L missing = lane::sqrt(lane::max(L(1.0) - foot.squares, L(0.0)));
  for (int i = 0; i < 3; ++i)
    if (i == b.least) foot.v[i] = select(tau > L(0.0), foot.v[i], missing);
  L n[3], size2 = 0.0;
  for (int i = 0; i < 3; ++i) {
    n[i] = foot.v[i] / L(b.s[i]);
    size2 = multiply_add(n[i], n[i], size2);
  }
  const double least = b.s[b.least];
  const L size = lane::sqrt(size2), t = tau - L(least * least), f = -(t * size);
  L g[3], h[6]{};
  for (int i = 0; i < 3; ++i) {
    n[i] = n[i] / size;
    g[i] = -n[i];
  }
  if constexpr (NumberTraits<T>::order == 2) {
    // With M = diag(m), m_i = 1/s_i^2, P = I - n n^T and A = P M P in the plane across n:
    //   H = -(1/|W|) A (I + t A)^-1 = -(A + t det(A) P) / (|W| det(I + t A)),
    //   det(A) = sum n_i^2 m_j m_k, det(I + t A) = sum n_i^2 k_j k_k, k_i = 1 + t m_i = (tau + e_i) m_i.
    double m[3];
    L k[3];
    for (int i = 0; i < 3; ++i) {
      m[i] = 1.0 / (b.s[i] * b.s[i]);
      k[i] = (tau + L(b.e[i])) * L(m[i]);
    }
    L mean = 0.0, det = 0.0, focal = 0.0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, l = (i + 2) % 3;
      const L nn = n[i] * n[i];
      mean = multiply_add(nn, L(m[i]), mean);
      det = multiply_add(nn, L(m[j] * m[l]), det);
      focal = multiply_add(nn, k[j] * k[l], focal);
    }
    const auto regular = focal > L(1e-60) && focal < L(1e140);  // on the focal surface there are none
    const L scale = L(-1.0) / select(regular, size * focal, L(1.0));
    for (int q = 0; q < 6; ++q) {
      const int i = hessian_row[q], j = hessian_column[q];
      const L nn = n[i] * n[j];
      const L one = i == j ? L(1.0) : L(0.0);
      const L a = one * L(m[i]) + nn * (mean - L(m[i] + m[j]));
      h[q] = select(regular, scale * (a + t * det * (one - nn)), L(0.0));
    }
  }
  return of_local(p, f, g, h);
}

KernelSet ellipsoid_distance_simd() { return kernel_set<EllipsoidDistance, Simd>(); }
#if HWY_ONCE
KernelSet ellipsoid_distance_scalar() { return kernel_set<EllipsoidDistance, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "implicit/primitives/solid_linear.hpp"
#include "implicit/primitives/solid_ranges.hpp"

namespace blendwright {
namespace detail {
HWY_EXPORT(ellipsoid_distance_simd);

EllipsoidDistance::EllipsoidDistance(const Vec3& semi_axes) : s(semi_axes), least(0) {
  for (int i = 1; i < 3; ++i)
    if (s[i] < s[least]) least = i;
  for (int i = 0; i < 3; ++i) e[i] = (s[i] - s[least]) * (s[i] + s[least]);
}

static Range ellipsoid_distance_range(const void* body, const Box& local, std::span<const Range>) {
  const double size = static_cast<const EllipsoidDistance*>(body)->s.maxCoeff();
  return falling_distance_range(op_for<EllipsoidDistance>(), body, local, size);
}
}  // namespace detail

template <>
const Op& op_for<detail::EllipsoidDistance>() {
  using namespace detail;
  static const Op op{"ellipsoid_distance",
                     HWY_DYNAMIC_DISPATCH(ellipsoid_distance_simd)(),
                     HWY_STATIC_DISPATCH(ellipsoid_distance_scalar)(),
                     ellipsoid_distance_range,
                     nullptr,
                     ellipsoid_distance_linear};
  return op;
}

}  // namespace blendwright
#endif
