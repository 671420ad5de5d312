// Kernels from bodies. A body type B needs, in this namespace and before its kernels are taken,
//   template <class T> T evaluate(const B& body, const Inputs<T>& in);
#if defined(BLENDWRIGHT_KERNEL_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_KERNEL_INL_HPP
#undef BLENDWRIGHT_KERNEL_INL_HPP
#else
#define BLENDWRIGHT_KERNEL_INL_HPP
#endif

#include <type_traits>

#include "implicit/eval/op.hpp"
#include "implicit/number/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class L>
struct LaneIo;
template <>
struct LaneIo<double> {
  static constexpr std::size_t width() { return 1; }
  static HWY_INLINE double load(const double* p) { return *p; }
  static HWY_INLINE void store(double x, double* p) { *p = x; }
};
template <>
struct LaneIo<Simd> {
  static HWY_INLINE std::size_t width() { return hn::Lanes(SimdTag()); }
  static HWY_INLINE Simd load(const double* p) { return Simd(hn::LoadU(SimdTag(), p)); }
  static HWY_INLINE void store(Simd x, double* p) { hn::StoreU(x.v, SimdTag(), p); }
};

template <class T>
HWY_INLINE T load_number(const double* p) {
  using L = LaneOf<T>;
  if constexpr (NumberTraits<T>::order == 0) {
    return LaneIo<L>::load(p);
  } else {
    T x;
    x.v = LaneIo<L>::load(p);
    for (std::size_t i = 0; i < 3; ++i) x.d[i] = LaneIo<L>::load(p + (1 + i) * batch_size);
    if constexpr (NumberTraits<T>::order == 2)
      for (std::size_t k = 0; k < 6; ++k) x.h[k] = LaneIo<L>::load(p + (4 + k) * batch_size);
    return x;
  }
}
template <class T>
HWY_INLINE void store_number(const T& x, double* p) {
  using L = LaneOf<T>;
  if constexpr (NumberTraits<T>::order == 0) {
    LaneIo<L>::store(x, p);
  } else {
    LaneIo<L>::store(x.v, p);
    for (std::size_t i = 0; i < 3; ++i) LaneIo<L>::store(x.d[i], p + (1 + i) * batch_size);
    if constexpr (NumberTraits<T>::order == 2)
      for (std::size_t k = 0; k < 6; ++k) LaneIo<L>::store(x.h[k], p + (4 + k) * batch_size);
  }
}

/// Local coordinates with their derivatives with respect to the scene's.
template <class T>
struct Point {
  T x, y, z;
};

/// What a body may read at one vector of points.
template <class T>
class Inputs {
 public:
  HWY_INLINE Inputs(const KernelInput& in, const double* frame, std::size_t at)
      : in_(in), frame_(frame), at_(at) {}
  [[nodiscard]] HWY_INLINE Point<T> local() const {
    using L = LaneOf<T>;
    const L x[3] = {LaneIo<L>::load(in_.x + at_), LaneIo<L>::load(in_.y + at_), LaneIo<L>::load(in_.z + at_)};
    T y[3];
    for (int j = 0; j < 3; ++j) {
      if (in_.frame == nullptr) {
        y[j] = constant<T>(x[j]);
        if constexpr (NumberTraits<T>::order > 0) y[j].d[j] = L(1.0);
      } else {
        const double* column = frame_ + 4 * j;
        const L v =
            multiply_add(x[0], L(column[0]),
                         multiply_add(x[1], L(column[1]), multiply_add(x[2], L(column[2]), L(column[3]))));
        y[j] = constant<T>(v);
        if constexpr (NumberTraits<T>::order > 0)
          for (int i = 0; i < 3; ++i) y[j].d[i] = L(column[i]);
      }
    }
    return {y[0], y[1], y[2]};
  }
  [[nodiscard]] HWY_INLINE T arg(std::size_t i) const { return load_number<T>(in_.args[i] + at_); }
  [[nodiscard]] HWY_INLINE std::size_t args() const { return in_.arg_count; }

 private:
  const KernelInput& in_;
  const double* frame_;  ///< three columns of four numbers: y_j = x * column + its last number
  std::size_t at_;
};

template <class T, class Body>
void run_kernel(const void* body, const KernelInput& in, double* out) {
  // Copies, so that the compiler sees that `out` does not change them and reads them once; of bodies when
  // they are small and plain.
  constexpr bool small = std::is_trivially_copyable_v<Body> && sizeof(Body) <= 256;
  const std::conditional_t<small, Body, const Body&> b = *static_cast<const Body*>(body);
  const KernelInput mine = in;
  double frame[12] = {};
  if (in.frame != nullptr)
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) frame[4 * j + i] = in.frame->matrix(i, j);
      frame[4 * j + 3] = in.frame->offset[j];
    }
  const std::size_t step = LaneIo<LaneOf<T>>::width();
  for (std::size_t i = 0; i < mine.count; i += step)
    store_number<T>(evaluate(b, Inputs<T>(mine, frame, i)), out + i);
}

/// The kernels of a body for lanes of type L (double or Simd).
template <class Body, class L>
[[nodiscard]] KernelSet kernel_set() {
  return {{run_kernel<L, Body>, run_kernel<Dual<L>, Body>, run_kernel<Dual2<L>, Body>}};
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
