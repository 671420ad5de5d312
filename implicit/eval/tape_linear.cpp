// Linear bounds of a tape over a box.
#include <algorithm>
#include <limits>

#include "implicit/eval/tape_walk.hpp"

namespace blendwright {
namespace {

/// The box in the coordinates of a frame.
LinearInput input_of(const Box& box, const Frame* frame, const Box& local) {
  const Vec3 c = box.centre(), h = 0.5 * box.size();
  if (frame == nullptr) return {local, c, h.asDiagonal(), Vec3::Zero(), {}, {}};
  const Eigen::Matrix3d turned = frame->matrix.transpose();
  const Vec3 slack = 8.0 * std::numeric_limits<double>::epsilon() *
                     (turned.cwiseAbs() * (c.cwiseAbs() + h) + frame->offset.cwiseAbs());
  return {local, frame->local(c), turned * h.asDiagonal(), slack, {}, {}};
}

bool narrower(Range a, Range b) { return a.hi - a.lo < b.hi - b.lo; }

/// What two ranges of the same values have in common.
Range both(Range a, Range b) {
  const Range r{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
  return r.lo <= r.hi ? r : a;
}

}  // namespace

/// Like bound(), and the linear bounds of all steps.
void Tape::bound_linearly(const Box& box, Walk& walk) const {
  bound(box, walk);
  walk.linear.resize(steps_.size());
  for (StepIndex i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    if (walk.stand_in[i] != i) {
      walk.linear[i] = walk.linear[walk.stand_in[i]];
      walk.ranges[i] = walk.ranges[walk.stand_in[i]];
      continue;
    }
    walk.linear[i] = constant_bound(walk.ranges[i]);
    if (walk.constant[i] || !step.op->linear || !box.finite()) continue;
    walk.linear_args.resize(step.arg_count);
    walk.args.resize(step.arg_count);
    for (std::uint32_t k = 0; k < step.arg_count; ++k) {
      walk.linear_args[k] = walk.linear[args_[step.first_arg + k]];
      walk.args[k] = walk.ranges[args_[step.first_arg + k]];
    }
    const auto f = static_cast<std::size_t>(step.frame);
    LinearInput in = step.frame < 0 ? input_of(box, nullptr, box) : input_of(box, frames_[f], walk.boxes[f]);
    in.args = walk.linear_args;
    in.ranges = walk.args;
    const LinearBound found = step.op->linear(step.body ? step.body : &step.constant, in);
    if (!narrower(found.rest, walk.linear[i].rest)) continue;
    walk.linear[i] = found;
    walk.ranges[i] = both(walk.ranges[i], found.range());  // for the bounds of its users
  }
}

LinearBound Tape::linear(const Box& box) const {
  const Nested<Walk> nested;
  bound_linearly(box, *nested);
  return (*nested).linear.back();
}

}  // namespace blendwright
