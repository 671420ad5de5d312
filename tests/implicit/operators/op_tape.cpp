#include "tests/implicit/operators/op_tape.hpp"

#include <algorithm>

namespace blendwright {
namespace test {
namespace {

template <std::size_t Components>
void copy(const void* body, const KernelInput& in, double* out) {
  const int axis = static_cast<const Coordinate*>(body)->axis;
  std::copy_n(axis == 0 ? in.x : axis == 1 ? in.y : in.z, in.count, out);
  for (std::size_t c = 1; c < Components; ++c)
    std::fill_n(out + c * batch_size, in.count, c == static_cast<std::size_t>(axis) + 1 ? 1.0 : 0.0);
}
constexpr KernelSet copies{{copy<1>, copy<4>, copy<10>}};

}  // namespace

std::vector<StepIndex> coordinates(TapeBuilder& builder, std::size_t count) {
  std::vector<StepIndex> steps;
  for (std::size_t i = 0; i < count; ++i)
    steps.push_back(builder.add<Coordinate>(
        std::make_shared<const Coordinate>(Coordinate{static_cast<int>(i)}), Frame(), {}));
  return steps;
}

std::shared_ptr<const Tape> combination_tape(const detail::Combination& combine, std::size_t count) {
  TapeBuilder builder;
  const std::vector<StepIndex> args = coordinates(builder, count);
  return builder.finish(combine(builder, args));
}

Sampled sample(const Tape& tape, const Vec3& at) {
  double out[4];
  tape.evaluate(Order::gradient, {{&at.x(), 1}, {&at.y(), 1}, {&at.z(), 1}}, out);
  return {out[0], {out[1], out[2], out[3]}};
}

}  // namespace test

template <>
const Op& op_for<test::Coordinate>() {
  static const Op op{"coordinate",
                     test::copies,
                     test::copies,
                     [](const void* body, const Box& local, std::span<const Range>) {
                       return local.axis(static_cast<const test::Coordinate*>(body)->axis);
                     },
                     nullptr,
                     [](const void* body, const LinearInput& in) {
                       const int axis = static_cast<const test::Coordinate*>(body)->axis;
                       // The box's ends and middle are rounded.
                       return LinearBound{in.centre[axis], in.axes.row(axis).transpose(), {0.0, 0.0}}.widened(
                           1e-15 * (in.local.lo.cwiseAbs() + in.local.hi.cwiseAbs())[axis]);
                     }};
  return op;
}

}  // namespace blendwright
