// The instruction sets that kernels are compiled for; included before <hwy/foreach_target.h>, in every file
// that uses it. Vectors without a compile-time size cannot be members of a number; the rest adds nothing to
// SSE2, AVX2 and AVX-512 but the time to compile.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
  (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
