// The arc of Hoffmann and Hopcroft's conic between its two tangent points, without cancellation.
#if defined(BLENDWRIGHT_ARC_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_ARC_INL_HPP
#undef BLENDWRIGHT_ARC_INL_HPP
#else
#define BLENDWRIGHT_ARC_INL_HPP
#endif

#include "implicit/number/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

// With w = r1 r2 - p > 0 and E = r2 y1 + r1 y2 - r1 r2 the conic is B_H(y1, y2) = E^2 - 2 w y1 y2, and on the
// arc E = -q, q = sqrt(2 w y1 y2) (derived). Both blends look for the t >= 0 with y = (d + t, t) or (t, d +
// t), d >= 0 given, and E = sum t - e, sum and e >= 0 given:
//   (sum t - e)^2 = 2 w t (d + t), sum t <= e.
// Every term below is >= 0, so t, q and all that is made of them keep their digits for any p < r1 r2.
template <class L>
struct Arc {
  L t, q;
};
template <class L>
HWY_INLINE Arc<L> arc(double sum, double w, L d, L e) {
  const L wd = L(w) * d, root = lane::sqrt(wd * wd + L(2.0 * w) * (e * (L(sum) * d + e)));
  const L part = wd + root, share = e / (L(sum) * e + part);
  return {e * share, part * share};
}

/// g_i = -(1/2) dB_H/dy_i on the arc, and k = w (w (r2 y1 - r1 y2)^2 + 2 g1 g2), which is half of the second
/// derivative of B_H along the tangent (g2, -g1).
template <class L>
struct ArcGradient {
  L g1, g2, k;
};
template <class L, class Body>
HWY_INLINE ArcGradient<L> arc_gradient(const Body& b, L y1, L y2, L q) {
  const L w = b.w, r1 = b.r1, r2 = b.r2, g1 = r2 * q + w * y2, g2 = r1 * q + w * y1;
  const L across = r2 * y1 - r1 * y2;
  return {g1, g2, w * (w * (across * across) + L(2.0) * (g1 * g2))};
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
