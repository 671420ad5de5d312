#include "implicit/eval/op.hpp"

#include <array>
#include <vector>

namespace blendwright {

double scalar_value(const Op& op, const void* body, const Vec3& local, std::span<const double> args) {
  std::vector<const double*> places(args.size());
  for (std::size_t i = 0; i < args.size(); ++i) places[i] = &args[i];
  const KernelInput in{&local.x(), &local.y(), &local.z(), nullptr, places.data(), args.size(), 1};
  double out = 0.0;
  op.scalar.run[0](body, in, &out);
  return out;
}

Range range_by_magnitudes(const Op& op, const void* body, const Box& local) {
  Vec3 lo, hi;
  for (int i = 0; i < 3; ++i) {
    const Range m = magnitude(local.axis(i));
    lo[i] = m.lo;
    hi[i] = m.hi;
  }
  return Range{scalar_value(op, body, lo), scalar_value(op, body, hi)}.widened(range_slack);
}

Range range_by_arguments(const Op& op, const void* body, std::span<const Range> args,
                         std::initializer_list<bool> rises) {
  std::vector<double> lo, hi;
  for (std::size_t i = 0; i < args.size(); ++i) {
    const bool up = rises.begin()[std::min(i, rises.size() - 1)];
    lo.push_back(up ? args[i].lo : args[i].hi);
    hi.push_back(up ? args[i].hi : args[i].lo);
  }
  return Range{scalar_value(op, body, Vec3::Zero(), lo), scalar_value(op, body, Vec3::Zero(), hi)}.widened(
      range_slack);
}

}  // namespace blendwright
