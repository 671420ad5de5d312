// Derivatives that a body found by hand, in its local coordinates, as those of a number.
#if defined(BLENDWRIGHT_LOCAL_DERIVATIVES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_LOCAL_DERIVATIVES_INL_HPP
#undef BLENDWRIGHT_LOCAL_DERIVATIVES_INL_HPP
#else
#define BLENDWRIGHT_LOCAL_DERIVATIVES_INL_HPP
#endif

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// f(p), from its value, gradient g and second derivatives h (xx, yy, zz, xy, xz, yz) with respect to the
/// coordinates of p, which are linear in the scene's. h is not read by numbers without second derivatives.
template <class T>
HWY_INLINE T of_local(const Point<T>& p, LaneOf<T> f, [[maybe_unused]] const LaneOf<T> (&g)[3],
                      [[maybe_unused]] const LaneOf<T> (&h)[6]) {
  using L = LaneOf<T>;
  if constexpr (NumberTraits<T>::order == 0) {
    return f;
  } else {
    T r;
    r.v = f;
    for (int i = 0; i < 3; ++i)
      r.d[i] = multiply_add(g[0], p.x.d[i], multiply_add(g[1], p.y.d[i], g[2] * p.z.d[i]));
    if constexpr (NumberTraits<T>::order == 2) {
      L rows[3][3];  // J H, row i: of the scene's coordinate i
      for (int i = 0; i < 3; ++i) {
        const L x = p.x.d[i], y = p.y.d[i], z = p.z.d[i];
        rows[i][0] = multiply_add(h[0], x, multiply_add(h[3], y, h[4] * z));
        rows[i][1] = multiply_add(h[3], x, multiply_add(h[1], y, h[5] * z));
        rows[i][2] = multiply_add(h[4], x, multiply_add(h[5], y, h[2] * z));
      }
      for (int k = 0; k < 6; ++k) {
        const int a = hessian_row[k], b = hessian_column[k];
        r.h[k] =
            multiply_add(rows[a][0], p.x.d[b], multiply_add(rows[a][1], p.y.d[b], rows[a][2] * p.z.d[b]));
      }
    }
    return r;
  }
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
