#include "tests/implicit/bounds/narrow_ops.hpp"

#include "implicit/primitives/quadric.hpp"
#include "implicit/primitives/quadric_linear.hpp"

namespace blendwright::test {
namespace {

constexpr double short_by = 1e-9;

Range narrow_range(const void* body, const Box& box, std::span<const Range> args) {
  const Range r = op_for<detail::Quadric>().range(body, box, args);
  return {r.lo, r.hi - short_by * (r.hi - r.lo)};
}
LinearBound narrow_rest(const void* body, const LinearInput& in) {
  LinearBound b = detail::quadric_linear(body, in);
  b.rest.hi -= short_by * (b.rest.hi - b.rest.lo);
  return b;
}
LinearBound narrow_slope(const void* body, const LinearInput& in) {
  LinearBound b = detail::quadric_linear(body, in);
  b.slope *= 1.0 + short_by;
  return b;
}
Shortcut narrow_shortcut(const void*, const Box& box, std::span<const Range>) {
  return box.lo.norm() > 2.0 && box.hi.norm() > 2.0 ? Shortcut::to_constant(3.0) : Shortcut{};
}

Op op_of(Narrow which) {
  Op op = op_for<detail::Quadric>();
  op.name = "narrow";
  if (which == Narrow::range) op.range = narrow_range;
  if (which == Narrow::rest) op.linear = narrow_rest;
  if (which == Narrow::slope) op.linear = narrow_slope;
  if (which == Narrow::shortcut) op.shortcut = narrow_shortcut;
  return op;
}

}  // namespace

std::shared_ptr<const Tape> narrow_tape(Narrow which) {
  static const Op ops[] = {op_of(Narrow::none), op_of(Narrow::range), op_of(Narrow::rest),
                           op_of(Narrow::slope), op_of(Narrow::shortcut)};
  TapeBuilder builder;
  const auto body = std::make_shared<const detail::Quadric>(
      detail::Quadric({1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0}));
  const StepIndex step = builder.add(ops[static_cast<std::size_t>(which)], body, Frame());
  return builder.finish(step);
}

}  // namespace blendwright::test
