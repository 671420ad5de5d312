#include "implicit/eval/tape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

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

Workspace& workspace() {
  thread_local Workspace mine;
  return mine;
}

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
    places.resize(args.size());
    for (std::size_t k = 0; k < args.size(); ++k) places[k] = slots + steps[args[k]].slot * stride;
    double* to = slots + step.slot * stride;
    kernel(step.body ? step.body : &step.constant, {x, y, z, frame, places.data(), places.size(), padded},
           to);
    return to;
  }
};

}  // namespace

void Tape::run(Order order, PointArrays points, KernelSet Op::*kernels, std::size_t lanes,
               std::span<double> out) const {
  const auto o = static_cast<std::size_t>(order);
  const std::size_t n = points.size(), stride = batch_size * components(order);
  Workspace& work = workspace();
  Batch batch(work.numbers(Batch::size(slots_, order)));
  for (std::size_t first = 0; first < n; first += batch_size) {
    batch.load(points, first, lanes);
    const double* result = nullptr;
    for (const Step& step : steps_)
      result = batch.run(step, step.frame < 0 ? nullptr : frames_[static_cast<std::size_t>(step.frame)],
                         std::span(args_).subspan(step.first_arg, step.arg_count), steps_,
                         (step.op->*kernels).run[o], stride, work.args());
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

void Tape::nearest_member(PointArrays points, std::span<std::uint32_t> out) const {
  std::fill(out.begin(), out.end(), 0u);
  if (members_.size() < 2 && (members_.empty() || members_.front().index == 0)) return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr auto order = static_cast<std::size_t>(Order::gradient);
  const std::size_t stride = batch_size * components(Order::gradient);
  Workspace& work = workspace();
  Batch batch(work.numbers(Batch::size(slots_, Order::gradient)));
  double nearest[batch_size];
  for (std::size_t first = 0; first < points.size(); first += batch_size) {
    batch.load(points, first, widest);
    std::fill_n(nearest, batch.count, infinity);
    const auto here = out.subspan(first, batch.count);
    std::size_t m = 0;
    for (StepIndex s = 0; m < members_.size(); ++s) {
      const Step& step = steps_[s];
      const double* f =
          batch.run(step, step.frame < 0 ? nullptr : frames_[static_cast<std::size_t>(step.frame)],
                    std::span(args_).subspan(step.first_arg, step.arg_count), steps_,
                    step.op->simd.run[order], stride, work.args());
      for (; m < members_.size() && members_[m].step == s; ++m)
        for (std::size_t i = 0; i < batch.count; ++i) {
          const double gx = f[batch_size + i], gy = f[2 * batch_size + i], gz = f[3 * batch_size + i];
          const double slope = std::sqrt(gx * gx + gy * gy + gz * gz);
          const double d = slope > 0.0 ? std::abs(f[i] - surface_value(members_[m].level)) / slope : infinity;
          if (d < nearest[i] || (d == nearest[i] && d < infinity && members_[m].index < here[i])) {
            nearest[i] = d;
            here[i] = members_[m].index;
          }
        }
    }
  }
  work.tidy();
}

}  // namespace blendwright
