#include "tests/bench/plain_write.hpp"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/plain_write.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace blendwright::bench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void write(double* out, std::size_t count) {
  const hn::ScalableTag<double> d;
  const std::size_t N = hn::Lanes(d);
  const auto x = hn::Set(d, 1.0);
  double* const end = out + count;
  while (out < end && reinterpret_cast<std::uintptr_t>(out) % (N * sizeof(double)) != 0) *out++ = 1.0;
  for (; out + N <= end; out += N) hn::Stream(x, d, out);
  while (out < end) *out++ = 1.0;
  hwy::FlushStream();
}

}  // namespace blendwright::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright::bench {

HWY_EXPORT(write);

void plain_write(double* out, std::size_t count) { HWY_DYNAMIC_DISPATCH(write)(out, count); }

}  // namespace blendwright::bench
#endif
