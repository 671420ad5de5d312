#include "implicit/offset/ball_offset.hpp"

#include <algorithm>
#include <cmath>

#include "implicit/offset/ball_search.hpp"

namespace blendwright {
namespace detail {
namespace {

BallSearch search_of(const BallOffset& b) { return {b.field.get(), b.radius, b.sign, b.tolerance}; }

/// Batches are filled up with their last point: what repeats is not looked for again.
template <Order order>
void run(const void* body, const KernelInput& in, double* out) {
  const auto& b = *static_cast<const BallOffset*>(body);
  const LocalPoints points(in);
  PointJet f;
  for (std::size_t i = 0; i < points.count; ++i) {
    if (i == 0 || points.at(i) != points.at(i - 1)) f = search_ball(search_of(b), points.at(i), order).f;
    store(f, order, in, i, out);
  }
}

/// For the largest value: at most f in the box around all balls, and at least f at each start of the search.
Range ball_offset_range(const void* body, const Box& local, std::span<const Range>) {
  const auto& b = *static_cast<const BallOffset*>(body);
  const Range around = range_around(*b.field, local, b.radius);
  Range own = b.field->range(local);
  if (local.finite())
    for (std::size_t k = 1; k < start_count; ++k) {
      const Vec3 shift = b.radius * search_start(k);
      const Range there = b.field->range(inflated({local.lo + shift, local.hi + shift}, 0.0));
      own = {std::max(own.lo, there.lo), std::min(own.hi, there.hi)};
    }
  return b.sign > 0.0 ? Range{own.lo, around.hi} : Range{around.lo, own.hi};
}

}  // namespace
}  // namespace detail

template <>
const Op& op_for<detail::BallOffset>() {
  using namespace detail;
  static constexpr KernelSet kernels{{run<Order::value>, run<Order::gradient>, run<Order::hessian>}};
  static const Op op{"ball_offset", kernels, kernels, ball_offset_range};
  return op;
}

}  // namespace blendwright
