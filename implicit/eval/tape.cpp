#include "implicit/eval/tape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "implicit/eval/nested.hpp"

namespace blendwright {
namespace {

/// Vectors are never wider than this many doubles; counts of points are rounded up to it.
constexpr std::size_t widest = 8;
static_assert(batch_size % widest == 0);
constexpr std::align_val_t cache_line{64};

/// Room for the numbers of a walk over a tape: kept per thread from call to call while it is small.
class Workspace {
 public:
  double* numbers(std::size_t count) {
    if (count > size_) {
      data_.reset();  // first, so that never both are there
      size_ = 0;
      data_.reset(static_cast<double*>(::operator new(count * sizeof(double), cache_line)));
      size_ = count;
    }
    return data_.get();
  }
  std::vector<const double*>& args() { return args_; }
  /// Gives back what is too much to keep.
  void tidy() {
    constexpr std::size_t keep = std::size_t{1} << 20;
    if (size_ <= keep) return;
    data_.reset();
    size_ = 0;
  }

 private:
  struct Free {
    void operator()(double* p) const { ::operator delete(p, cache_line); }
  };
  std::unique_ptr<double, Free> data_;
  std::size_t size_ = 0;
  std::vector<const double*> args_;
};

/// One batch of points, padded with the last one, and the slots of a tape.
struct Batch {
  double *x, *y, *z, *slots;
  std::size_t count = 0;   ///< points
  std::size_t padded = 0;  ///< points that kernels are asked for

  explicit Batch(double* room) : x(room), y(x + batch_size), z(y + batch_size), slots(z + batch_size) {}
  [[nodiscard]] static std::size_t size(std::size_t slot_count, Order order) {
    return batch_size * (3 + slot_count * components(order));
  }

  void load(PointArrays points, std::size_t first, std::size_t lanes) {
    count = std::min(batch_size, points.size() - first);
    padded = (count + lanes - 1) / lanes * lanes;
    const auto copy = [&](std::span<const double> from, double* to) {
      std::copy_n(from.data() + first, count, to);
      std::fill(to + count, to + padded, to[count - 1]);
    };
    copy(points.x, x);
    copy(points.y, y);
    copy(points.z, z);
  }

  /// Runs one step; returns where its results are.
  const double* run(const Tape::Step& step, const Frame* frame, std::span<const StepIndex> args,
                    std::span<const Tape::Step> steps, Kernel kernel, std::size_t stride,
                    std::vector<const double*>& places) const {
    if (places.size() < args.size()) places.resize(args.size());
    for (std::size_t k = 0; k < args.size(); ++k) places[k] = slots + steps[args[k]].slot * stride;
    double* to = slots + step.slot * stride;
    kernel(step.body ? step.body : &step.constant, {x, y, z, frame, places.data(), args.size(), padded}, to);
    return to;
  }
};

}  // namespace

void Tape::run(Order order, PointArrays points, KernelSet Op::*kernels, std::size_t lanes,
               std::span<double> out) const {
  const auto o = static_cast<std::size_t>(order);
  const std::size_t n = points.size(), stride = batch_size * components(order);
  const Nested<Workspace> nested;
  Workspace& work = *nested;
  Batch batch(work.numbers(Batch::size(slots_, order)));
  for (std::size_t first = 0; first < n; first += batch_size) {
    batch.load(points, first, lanes);
    const double* result = nullptr;
    for (const Step& step : steps_)
      result = batch.run(step, frame_of(step), args_of(step), steps_, (step.op->*kernels).run[o], stride,
                         work.args());
    for (std::size_t c = 0; c < components(order); ++c)
      std::copy_n(result + c * batch_size, batch.count, out.data() + c * n + first);
  }
  work.tidy();
}

void Tape::evaluate(Order order, PointArrays points, std::span<double> out) const {
  run(order, points, &Op::simd, widest, out);
}

void Tape::evaluate_scalar(Order order, PointArrays points, std::span<double> out) const {
  run(order, points, &Op::scalar, 1, out);
}

namespace {

/// The nearest member of each point of a batch so far.
struct Nearest {
  double distance[batch_size];
  std::span<std::uint32_t> index;

  explicit Nearest(std::span<std::uint32_t> out) : index(out) {
    std::fill_n(distance, out.size(), std::numeric_limits<double>::infinity());
    std::fill(out.begin(), out.end(), 0u);
  }
  /// f: values and gradients of the member.
  void take(const TapeMember& member, const double* f) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < index.size(); ++i) {
      const double gx = f[batch_size + i], gy = f[2 * batch_size + i], gz = f[3 * batch_size + i];
      const double slope = std::sqrt(gx * gx + gy * gy + gz * gz);
      const double d = slope > 0.0 ? std::abs(f[i] - surface_value(member.level)) / slope : infinity;
      if (d < distance[i] || (d == distance[i] && d < infinity && member.index < index[i])) {
        distance[i] = d;
        index[i] = member.index;
      }
    }
  }
};

}  // namespace

void Tape::nearest_member(PointArrays points, std::span<std::uint32_t> out) const {
  if (members_.empty() || (members_.size() == 1 && members_.front().at.index == 0)) {
    std::fill(out.begin(), out.end(), 0u);
    return;
  }
  constexpr auto order = static_cast<std::size_t>(Order::gradient);
  const std::size_t stride = batch_size * components(Order::gradient);
  StepIndex end = 0;  // of the steps that are members
  for (const Member& m : members_)
    if (!m.merged()) end = m.at.step + 1;
  const Nested<Workspace> nested;
  Workspace& work = *nested;
  Batch batch(work.numbers(Batch::size(slots_ + 1, Order::gradient)));
  for (std::size_t first = 0; first < points.size(); first += batch_size) {
    batch.load(points, first, widest);
    Nearest nearest(out.subspan(first, batch.count));
    for (Member m : members_)
      if (m.merged()) {
        m.leaf.slot = static_cast<std::uint32_t>(slots_);
        nearest.take(m.at, batch.run(m.leaf, frame_of(m.leaf), {}, steps_, m.leaf.op->simd.run[order], stride,
                                     work.args()));
      }
    auto member = members_.begin();
    for (StepIndex s = 0; s < end; ++s) {
      const Step& step = steps_[s];
      const double* f = batch.run(step, frame_of(step), args_of(step), steps_, step.op->simd.run[order],
                                  stride, work.args());
      for (; member != members_.end() && member->at.step == s; ++member)
        if (!member->merged()) nearest.take(member->at, f);
    }
  }
  work.tidy();
}

}  // namespace blendwright
