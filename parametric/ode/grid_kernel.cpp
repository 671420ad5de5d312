#include "parametric/ode/grid_kernel.hpp"

#include <algorithm>
#include <cstdint>

// Vectors without a compile-time size cannot be kept in arrays; the others add nothing to SSE2 and AVX-512
// for sums and products of doubles, but the time to compile them.
#define HWY_DISABLED_TARGETS \
  (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "parametric/ode/grid_kernel.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::ScalableTag<double>;

// Doubles of each row at a time, a multiple of three vectors of any width: 4 to 6 rows stay in the first
// cache.
constexpr std::size_t block = 768;

/// Elements before the first one of `p` that starts a vector.
std::size_t head_length(const double* p, std::size_t lanes) {
  const std::size_t offset = reinterpret_cast<std::uintptr_t>(p) / sizeof(double) % lanes;
  return offset == 0 ? 0 : lanes - offset;
}

/// (1) for one element.
double combined_element(const RowCombination& task, std::size_t i, std::size_t j) {
  const double* c = task.coefficients + i * task.count * 3 + j % 3;
  double sum = c[0] * task.rows[j];
  for (std::size_t k = 1; k < task.count; ++k) sum += c[3 * k] * task.rows[k * task.stride + j];
  return sum;
}

/// (1) element by element, for what lies before the first and after the last whole vector.
void combine_scalars(const RowCombination& task, std::size_t i, std::size_t j0, std::size_t j1) {
  for (std::size_t j = j0; j < j1; ++j) task.out[i * task.length + j] = combined_element(task, i, j);
}

template <bool kStream, class V>
HWY_INLINE void put(V x, double* out) {
  if constexpr (kStream)
    hn::Stream(x, Lanes(), out);
  else
    hn::Store(x, Lanes(), out);
}

/// (1) for whole vectors, out aligned at j0. The coefficients of the K rows stay in registers.
template <std::size_t K, bool kUniform, bool kStream>
HWY_INLINE void combine_few(const RowCombination& task, std::size_t i, std::size_t j0, std::size_t j1) {
  const Lanes d;
  const std::size_t N = hn::Lanes(d), stride = task.stride;
  const double* c = task.coefficients + i * K * 3;
  hn::Vec<Lanes> cx[K], cy[K], cz[K];  // three vectors of the pattern c0 c1 c2 c0 c1 .., which then repeats
  for (std::size_t k = 0; k < K; ++k, c += 3) {
    if constexpr (kUniform) {
      cx[k] = cy[k] = cz[k] = hn::Set(d, c[0]);
    } else {
      HWY_ALIGN double pattern[3 * HWY_MAX_BYTES / sizeof(double)];
      const double first = c[j0 % 3], second = c[(j0 + 1) % 3], third = c[(j0 + 2) % 3];
      for (std::size_t l = 0; l < 3 * N; l += 3) {
        pattern[l] = first;
        pattern[l + 1] = second;
        pattern[l + 2] = third;
      }
      cx[k] = hn::Load(d, pattern);
      cy[k] = hn::Load(d, pattern + N);
      cz[k] = hn::Load(d, pattern + 2 * N);
    }
  }
  const double* rows = task.rows;
  double* out = task.out + i * task.length;
  const auto combined = [&](const hn::Vec<Lanes>* coefficients, std::size_t j) HWY_ATTR {
    auto sum = hn::Mul(coefficients[0], hn::LoadU(d, rows + j));
    for (std::size_t k = 1; k < K; ++k)
      sum = hn::Add(sum, hn::Mul(coefficients[k], hn::LoadU(d, rows + k * stride + j)));
    return sum;
  };
  std::size_t j = j0;
  for (; j + 3 * N <= j1; j += 3 * N) {
    put<kStream>(combined(cx, j), out + j);
    put<kStream>(combined(cy, j + N), out + j + N);
    put<kStream>(combined(cz, j + 2 * N), out + j + 2 * N);
  }
  if (j + N <= j1) put<kStream>(combined(cx, j), out + j);
  if (j + 2 * N <= j1) put<kStream>(combined(cy, j + N), out + j + N);
}

template <std::size_t K>
HWY_NOINLINE void combine_segment(const RowCombination& task, std::size_t i, std::size_t j0, std::size_t j1) {
  if (task.uniform)
    task.stream ? combine_few<K, true, true>(task, i, j0, j1) : combine_few<K, true, false>(task, i, j0, j1);
  else
    task.stream ? combine_few<K, false, true>(task, i, j0, j1)
                : combine_few<K, false, false>(task, i, j0, j1);
}

/// The numbers of rows that blends have: 4 or 6, with a constant or with a fixed frame more.
void combine_vectors(const RowCombination& task, std::size_t i, std::size_t j0, std::size_t j1) {
  switch (task.count) {
    case 4:
      return combine_segment<4>(task, i, j0, j1);
    case 6:
      return combine_segment<6>(task, i, j0, j1);
    case 8:
      return combine_segment<8>(task, i, j0, j1);
    case 12:
      return combine_segment<12>(task, i, j0, j1);
    case 14:
      return combine_segment<14>(task, i, j0, j1);
    default:
      return combine_scalars(task, i, j0, j1);
  }
}

/// The vector of `out` that starts at (i, j) and ends in the next row.
void combine_joint(const RowCombination& task, std::size_t i, std::size_t j) {
  const Lanes d;
  HWY_ALIGN double joint[HWY_MAX_BYTES / sizeof(double)];
  for (std::size_t l = 0; l < hn::Lanes(d); ++l) {
    const std::size_t over = j + l < task.length ? 0 : 1;
    joint[l] = combined_element(task, i + over, j + l - over * task.length);
  }
  double* out = task.out + i * task.length + j;
  if (task.stream)
    put<true>(hn::Load(d, joint), out);
  else
    put<false>(hn::Load(d, joint), out);
}

void combine(const RowCombination& task, std::size_t i0, std::size_t i1, std::size_t j0, std::size_t j1) {
  const std::size_t N = hn::Lanes(Lanes());
  // Where whole rows follow each other, the vector across their joint is written with the earlier row: a
  // cache line that is streamed in two parts costs as much as many.
  const bool joined = j0 == 0 && j1 == task.length && task.length >= 2 * N;
  for (std::size_t b0 = j0; b0 < j1; b0 += block)
    for (std::size_t i = i0; i < i1; ++i) {
      // Segments of a row meet at vector boundaries of `out`.
      const std::size_t head = head_length(task.out + i * task.length + j0, N);
      const std::size_t first = std::min(b0 + head, j1);
      const std::size_t last = b0 + block >= j1 ? j1 : std::min(b0 + block + head, j1);
      if (b0 == j0 && (!joined || i == i0)) combine_scalars(task, i, j0, first);
      if (first >= last) continue;
      const std::size_t vectors_end = first + (last - first) / N * N;
      combine_vectors(task, i, first, vectors_end);
      if (joined && i + 1 < i1 && vectors_end < last)
        combine_joint(task, i, vectors_end);
      else
        combine_scalars(task, i, vectors_end, last);
    }
  if (task.stream) hwy::FlushStream();
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright::detail {

HWY_EXPORT(combine);

void combine_rows(const RowCombination& task, std::size_t i0, std::size_t i1, std::size_t j0,
                  std::size_t j1) {
  HWY_DYNAMIC_DISPATCH(combine)(task, i0, i1, j0, j1);
}

}  // namespace blendwright::detail
#endif
