#include "implicit/eval/op.hpp"

#include <array>
#include <vector>

namespace blendwright {
namespace {

/// An array that needs no allocation while it is short: ranges are asked for at every box.
template <class T>
class FewOrMany {
 public:
  explicit FewOrMany(std::size_t n) {
    if (n > few_.size()) many_.resize(n);
    data_ = n > few_.size() ? many_.data() : few_.data();
  }
  FewOrMany(const FewOrMany&) = delete;
  FewOrMany& operator=(const FewOrMany&) = delete;
  T& operator[](std::size_t i) { return data_[i]; }
  [[nodiscard]] const T* data() const { return data_; }

 private:
  std::array<T, 16> few_;
  std::vector<T> many_;
  T* data_;
};

}  // namespace

double scalar_value(const Op& op, const void* body, const Vec3& local, std::span<const double> args) {
  FewOrMany<const double*> places(args.size());
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
  FewOrMany<double> lo(args.size()), hi(args.size());
  for (std::size_t i = 0; i < args.size(); ++i) {
    const bool up = rises.begin()[std::min(i, rises.size() - 1)];
    lo[i] = up ? args[i].lo : args[i].hi;
    hi[i] = up ? args[i].hi : args[i].lo;
  }
  const Vec3 origin = Vec3::Zero();
  return Range{scalar_value(op, body, origin, {lo.data(), args.size()}),
               scalar_value(op, body, origin, {hi.data(), args.size()})}
      .widened(range_slack);
}

}  // namespace blendwright
