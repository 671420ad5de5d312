#include "tests/implicit/eval/small_ops.hpp"

#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/implicit/eval/small_ops.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const test::Ball& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  return root(square(p.x) + square(p.y) + square(p.z)) * b.inverse_radius;
}
template <class T>
HWY_INLINE T evaluate(const test::Window&, const Inputs<T>& in) {
  return square(1.0 - square(smaller(in.arg(0), T(1.0))));
}
template <class T>
HWY_INLINE T evaluate(const test::Sum&, const Inputs<T>& in) {
  T sum = in.arg(0);
  for (std::size_t i = 1; i < in.args(); ++i) sum = sum + in.arg(i);
  return sum;
}
template <class T>
HWY_INLINE T evaluate(const test::Least&, const Inputs<T>& in) {
  return smaller(in.arg(0), in.arg(1));
}

KernelSet small_simd(int op) {
  switch (op) {
    case 0:
      return kernel_set<test::Ball, Simd>();
    case 1:
      return kernel_set<test::Window, Simd>();
    case 2:
      return kernel_set<test::Sum, Simd>();
    default:
      return kernel_set<test::Least, Simd>();
  }
}
#if HWY_ONCE
KernelSet small_scalar(int op) {
  switch (op) {
    case 0:
      return kernel_set<test::Ball, double>();
    case 1:
      return kernel_set<test::Window, double>();
    case 2:
      return kernel_set<test::Sum, double>();
    default:
      return kernel_set<test::Least, double>();
  }
}
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(small_simd);

static Op small_op(int op, std::string_view name, decltype(Op::range) range,
                   decltype(Op::shortcut) shortcut) {
  return {name, HWY_DYNAMIC_DISPATCH(small_simd)(op), HWY_STATIC_DISPATCH(small_scalar)(op), range, shortcut};
}

static Shortcut sum_shortcut(const void*, const Box&, std::span<const Range> args) {
  std::size_t live = 0, last = 0;
  for (std::size_t i = 0; i < args.size(); ++i)
    if (args[i].lo != 0.0 || args[i].hi != 0.0) {
      ++live;
      last = i;
    }
  if (live == 0) return Shortcut::to_constant(0.0);
  return live == 1 ? Shortcut::to_argument(last) : Shortcut{};
}

}  // namespace detail

template <>
const Op& op_for<test::Ball>() {
  static const Op op = detail::small_op(
      0, "ball",
      [](const void* body, const Box& local, std::span<const Range>) {
        return range_by_magnitudes(op_for<test::Ball>(), body, local);
      },
      nullptr);
  return op;
}
template <>
const Op& op_for<test::Window>() {
  static const Op op = detail::small_op(
      1, "window",
      [](const void* body, const Box&, std::span<const Range> args) {
        return range_by_arguments(op_for<test::Window>(), body, args, {false});
      },
      [](const void*, const Box&, std::span<const Range> args) {
        return args[0].lo > 1.0 ? Shortcut::to_constant(0.0) : Shortcut{};
      });
  return op;
}
template <>
const Op& op_for<test::Sum>() {
  static const Op op = detail::small_op(
      2, "sum",
      [](const void* body, const Box&, std::span<const Range> args) {
        return range_by_arguments(op_for<test::Sum>(), body, args, {true});
      },
      detail::sum_shortcut);
  return op;
}
template <>
const Op& op_for<test::Least>() {
  static const Op op = detail::small_op(
      3, "least",
      [](const void* body, const Box&, std::span<const Range> args) {
        return range_by_arguments(op_for<test::Least>(), body, args, {true});
      },
      [](const void*, const Box&, std::span<const Range> args) {
        if (args[0].hi < args[1].lo) return Shortcut::to_argument(0);
        return args[1].hi < args[0].lo ? Shortcut::to_argument(1) : Shortcut{};
      });
  return op;
}

}  // namespace blendwright
#endif
