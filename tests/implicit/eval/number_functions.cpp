#include "tests/implicit/eval/number_functions.hpp"

#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/implicit/eval/number_functions.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/number/p_norm-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// In the order of number_functions().
template <class T>
HWY_INLINE T number_function(std::size_t f, const T& a, const T& b) {
  using L = LaneOf<T>;
  switch (f) {
    case 0:
      return a + b;
    case 1:
      return a - b;
    case 2:
      return a * b;
    case 3:
      return a / b;
    case 4:
      return -(2.5 - (0.5 + (a - 1.5) * 2.0 / 3.0));
    case 5:
      return scaled(a, L(0.75));
    case 6:
      return absolute(a);
    case 7:
      return root(a);
    case 8:
      return square(a);
    case 9:
      return smaller(a, b);
    case 10:
      return larger(a, b);
    case 11:
      return exponential(a);
    case 12:
      return logarithm(a);
    case 13:
      return cosine(a);
    case 14:
      return sine(a);
    case 15:
      return power(a, Power(3.0));
    case 16:
      return power(a, Power(0.5));
    case 17:
      return power(a, Power(2.7));
    case 18:
      return power(a, Power(0.6));
    case 19:
      return choose<T>(value_of(a) < value_of(b), a * a, b);
    case 20: {
      const T u[2] = {a, b};
      return p_norm(u, Power(1.0), Power(1.0));
    }
    case 21: {
      const T u[2] = {a, b};
      return p_norm(u, Power(1.7), Power(1.0 / 1.7));
    }
    case 22: {
      const T u[3] = {a, b, a * b};
      return p_norm(u, Power(4.0), Power(0.25));
    }
    case 23: {
      const T u[4] = {a, b, a * b, b - a};
      return p_norm(u, Power(2.0), Power(0.5));
    }
    case 24: {
      const T u[3] = {a, b, a * b};
      return p_norm(u, Power(0.6), Power(1.0 / 0.6));
    }
    default: {
      const T u[3] = {a, b, a - b};
      return length(u);
    }
  }
}

template <class T>
HWY_INLINE T seeded(LaneOf<T> x, [[maybe_unused]] int axis) {
  T t = constant<T>(x);
  if constexpr (NumberTraits<T>::order > 0) t.d[axis] = LaneOf<T>(1.0);
  return t;
}

/// n is a multiple of every vector's width; component c of point i at c * n + i.
template <class T>
void store_results(const T& f, std::size_t n, std::size_t i, double* out) {
  using L = LaneOf<T>;
  LaneIo<L>::store(value_of(f), out + i);
  if constexpr (NumberTraits<T>::order > 0)
    for (std::size_t c = 0; c < 3; ++c) LaneIo<L>::store(f.d[c], out + (1 + c) * n + i);
  if constexpr (NumberTraits<T>::order > 1)
    for (std::size_t c = 0; c < 6; ++c) LaneIo<L>::store(f.h[c], out + (4 + c) * n + i);
}
template <class T>
void run_number(std::size_t f, const double* p, const double* q, std::size_t n, double* out) {
  using L = LaneOf<T>;
  for (std::size_t i = 0; i < n; i += LaneIo<L>::width()) {
    const T x = seeded<T>(LaneIo<L>::load(p + i), 0), y = seeded<T>(LaneIo<L>::load(q + i), 1);
    store_results(number_function(f, x * (1.0 + y / 10.0), y - x / 20.0), n, i, out);
  }
}
template <class L>
void run_numbers(std::size_t f, int order, const double* p, const double* q, std::size_t n, double* out) {
  if (order == 0) run_number<L>(f, p, q, n, out);
  if (order == 1) run_number<Dual<L>>(f, p, q, n, out);
  if (order == 2) run_number<Dual2<L>>(f, p, q, n, out);
}

template <class L>
void run_lane(char f, const double* a, const double* b, std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; i += LaneIo<L>::width()) {
    const L x = LaneIo<L>::load(a + i), y = LaneIo<L>::load(b + i);
    L r = 0.0;
    if (f == 's') r = lane::sign(x);
    if (f == 'a') r = lane::atan2(x, y);
    if (f == '<') r = lane::min(x, y);
    if (f == '>') r = lane::max(x, y);
    if (f == '?') r = select(x < y, L(1.0), L(2.0));
    if (f == '&') r = L((any(x < y) ? 1.0 : 0.0) + (all(x < y) ? 2.0 : 0.0));
    LaneIo<L>::store(r, out + i);
  }
}
template <class L>
void run_power_rows(const Power& e, const double* x, std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; i += LaneIo<L>::width())
    LaneIo<L>::store(lane_power(LaneIo<L>::load(x + i), e), out + i);
}
template <class L>
void run_norm_rows(const Power& e, const Power& inverse, const double* const* xyz, std::size_t n,
                   double* out) {
  using T = Dual2<L>;
  for (std::size_t i = 0; i < n; i += LaneIo<L>::width()) {
    const T u[3] = {seeded<T>(LaneIo<L>::load(xyz[0] + i), 0), seeded<T>(LaneIo<L>::load(xyz[1] + i), 1),
                    seeded<T>(LaneIo<L>::load(xyz[2] + i), 2)};
    store_results(p_norm(u, e, inverse), n, i, out);
  }
}

struct TestKernels {
  decltype(&run_numbers<double>) numbers;
  decltype(&run_lane<double>) lanes;
  decltype(&run_power_rows<double>) power;
  decltype(&run_norm_rows<double>) norm;
};
#define BLENDWRIGHT_TEST_KERNELS(L) \
  { run_numbers<L>, run_lane<L>, run_power_rows<L>, run_norm_rows<L> }

void test_kernels(void* out) { *static_cast<TestKernels*>(out) = BLENDWRIGHT_TEST_KERNELS(Simd); }
#if HWY_ONCE
TestKernels scalar_test_kernels() { return BLENDWRIGHT_TEST_KERNELS(double); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <bit>

namespace blendwright {
namespace detail {
HWY_EXPORT(test_kernels);

using Kernels = decltype(HWY_STATIC_DISPATCH(scalar_test_kernels)());
static Kernels kernels(bool vectors) {
  Kernels k = HWY_STATIC_DISPATCH(scalar_test_kernels)();
  if (vectors) HWY_DYNAMIC_DISPATCH(test_kernels)(&k);
  return k;
}

}  // namespace detail

namespace test {
namespace {

/// Filled up with the last element to a multiple of every vector's width.
std::vector<double> padded(std::vector<double> x) {
  x.resize((x.size() + 7) / 8 * 8, x.back());
  return x;
}
/// The first `n` of every component.
std::vector<double> cut(const std::vector<double>& x, std::size_t components, std::size_t n) {
  std::vector<double> r;
  const std::size_t m = x.size() / components;
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t i = 0; i < n; ++i) r.push_back(x[c * m + i]);
  return r;
}

}  // namespace

std::span<const NumberFunction> number_functions() {
  static const std::vector<NumberFunction> list{
      {"a + b", -2, 2, -2, 2},
      {"a - b", -2, 2, -2, 2},
      {"a b", -2, 2, -2, 2},
      {"a / b", -2, 2, 1, 3},
      {"factors and summands", -2, 2, -2, 2},
      {"scaled", -2, 2, -2, 2},
      {"absolute", -2, 2, -2, 2},
      {"root", 0.1, 3, -1, 1},
      {"square", -2, 2, -2, 2},
      {"smaller", -2, 2, -2, 2},
      {"larger", -2, 2, -2, 2},
      {"exponential", -3, 3, -1, 1},
      {"logarithm", 0.1, 4, -1, 1},
      {"cosine", -7, 7, -1, 1},
      {"sine", -7, 7, -1, 1},
      {"a^3", 0.1, 3, -1, 1},
      {"a^(1/2)", 0.1, 3, -1, 1},
      {"a^2.7", 0.1, 3, -1, 1},
      {"a^0.6", 0.1, 3, -1, 1},
      {"choose", -2, 2, -2, 2},
      {"N_1(a, b)", -2, 2, -2, 2},
      {"N_1.7(a, b)", 0.2, 3, 0.4, 3},
      {"N_4(a, b, a b)", -3, 3, -3, 3},
      {"N_2(a, b, a b, b - a)", 0.2, 3, -3, 3},
      {"N_0.6(a, b, a b)", 0.2, 3, 0.4, 3},
      {"length", 0.2, 3, -3, 3},
  };
  return list;
}

std::vector<double> run_function(std::size_t function, int order, bool vectors, const std::vector<double>& p,
                                 const std::vector<double>& q) {
  const std::size_t components = order == 0 ? 1 : order == 1 ? 4 : 10;
  const std::vector<double> x = padded(p), y = padded(q);
  std::vector<double> out(components * x.size());
  detail::kernels(vectors).numbers(function, order, x.data(), y.data(), x.size(), out.data());
  return cut(out, components, p.size());
}
std::vector<double> run_lanes(const std::string& function, bool vectors, const std::vector<double>& x,
                              const std::vector<double>& y) {
  const char code = function == "sign"     ? 's'
                    : function == "atan2"  ? 'a'
                    : function == "min"    ? '<'
                    : function == "max"    ? '>'
                    : function == "select" ? '?'
                                           : '&';
  const std::vector<double> a = padded(x), b = padded(y);
  std::vector<double> out(a.size());
  detail::kernels(vectors).lanes(code, a.data(), b.data(), a.size(), out.data());
  return cut(out, 1, x.size());
}
std::vector<double> run_power(const detail::Power& n, bool vectors, const std::vector<double>& x) {
  const std::vector<double> a = padded(x);
  std::vector<double> out(a.size());
  detail::kernels(vectors).power(n, a.data(), a.size(), out.data());
  return cut(out, 1, x.size());
}
std::vector<double> run_norm(const detail::Power& n, const detail::Power& inverse_n, bool vectors,
                             const std::vector<double>& x, const std::vector<double>& y,
                             const std::vector<double>& z) {
  const std::vector<double> a = padded(x), b = padded(y), c = padded(z);
  const double* xyz[3] = {a.data(), b.data(), c.data()};
  std::vector<double> out(10 * a.size());
  detail::kernels(vectors).norm(n, inverse_n, xyz, a.size(), out.data());
  return cut(out, 10, x.size());
}

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
  return names;
}
void choose_instruction_set(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  if (!name.empty()) {
    for (const auto target : hwy::SupportedAndGeneratedTargets())
      if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace test
}  // namespace blendwright
#endif
