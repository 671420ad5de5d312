// Bounds of a tape over a box, and the tape that is left of it there.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "implicit/eval/constant.hpp"
#include "implicit/eval/slots.hpp"
#include "implicit/eval/tape_walk.hpp"

namespace blendwright {
namespace {

constexpr StepIndex none = std::numeric_limits<StepIndex>::max();

/// Values that rounding makes equal, as 1 - f for tiny f, are not those of a constant: derivatives are left.
Range not_constant(Range r) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!r.constant() || std::isinf(r.lo)) return r;
  return {std::nextafter(r.lo, -infinity), std::nextafter(r.hi, infinity)};
}

}  // namespace

/// Ranges and stand-ins of all steps, arguments first.
void Tape::bound(const Box& box, Walk& walk) const {
  walk.boxes.resize(frames_.size());
  for (std::size_t f = 0; f < frames_.size(); ++f) walk.boxes[f] = frames_[f]->local(box);
  walk.ranges.resize(steps_.size());
  walk.stand_in.resize(steps_.size());
  walk.constant.assign(steps_.size(), false);
  walk.shorter = false;
  for (StepIndex i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const void* body = step.body ? step.body : &step.constant;
    const Box& local = step.frame < 0 ? box : walk.boxes[static_cast<std::size_t>(step.frame)];
    walk.args.resize(step.arg_count);
    for (std::uint32_t k = 0; k < step.arg_count; ++k) walk.args[k] = walk.ranges[args_[step.first_arg + k]];
    walk.stand_in[i] = i;
    Shortcut shortcut;
    if (step.op->shortcut) shortcut = step.op->shortcut(body, local, walk.args);
    switch (shortcut.kind) {
      case Shortcut::Kind::argument: {
        const StepIndex a = walk.stand_in[args_[step.first_arg + shortcut.argument]];
        walk.stand_in[i] = a;
        walk.ranges[i] = walk.ranges[a];
        walk.shorter = true;
        break;
      }
      case Shortcut::Kind::constant:
        walk.ranges[i] = {shortcut.constant, shortcut.constant};
        walk.constant[i] = true;
        walk.shorter = true;
        break;
      case Shortcut::Kind::none:
        walk.ranges[i] = step.op->range(body, local, walk.args);
        if (step.op != &detail::constant_op()) walk.ranges[i] = not_constant(walk.ranges[i]);
        break;
    }
  }
}

std::shared_ptr<const Tape> Tape::shortened(Walk& walk) const {
  // Backwards: what is needed. place: 0 when it is, else none.
  walk.place.assign(steps_.size(), none);
  walk.place[walk.stand_in.back()] = 0;
  std::size_t step_count = 0, arg_count = 0;
  for (std::size_t i = steps_.size(); i-- > 0;) {
    if (walk.place[i] == none) continue;
    ++step_count;
    if (walk.constant[i]) continue;
    arg_count += steps_[i].arg_count;
    for (std::uint32_t k = 0; k < steps_[i].arg_count; ++k)
      walk.place[walk.stand_in[args_[steps_[i].first_arg + k]]] = 0;
  }
  // Forwards: the steps that stay, with new places.
  const std::shared_ptr<Tape> tape(new Tape);
  tape->steps_.reserve(step_count);
  tape->args_.reserve(arg_count);
  walk.frame_place.assign(frames_.size(), -1);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (walk.place[i] == none) continue;
    walk.place[i] = static_cast<StepIndex>(tape->steps_.size());
    Step step = steps_[i];
    step.first_arg = static_cast<std::uint32_t>(tape->args_.size());
    if (walk.constant[i]) {
      step = {&detail::constant_op(), nullptr, walk.ranges[i].lo, -1, step.first_arg, 0, 0};
    } else {
      for (std::uint32_t k = 0; k < step.arg_count; ++k)
        tape->args_.push_back(walk.place[walk.stand_in[args_[steps_[i].first_arg + k]]]);
    }
    step.frame = walk.kept_frame(step.frame, frames_, tape->frames_);
    tape->steps_.push_back(step);
  }
  keep_members(walk, *tape);
  tape->owned_ = owned_;
  tape->slots_ = detail::assign_slots(tape->steps_, tape->args_, walk.last_use, walk.free);
  return tape;
}

/// The members whose value is still computed, or would be: merged ones stay with the step they are part of.
void Tape::keep_members(Walk& walk, Tape& shorter) const {
  for (Member m : members_) {
    const StepIndex s = walk.stand_in[m.at.step];
    if (walk.place[s] == none || walk.constant[s] || (m.merged() && s != m.at.step)) continue;
    m.at.step = walk.place[s];
    m.leaf.frame = m.merged() ? walk.kept_frame(m.leaf.frame, frames_, shorter.frames_) : -1;
    shorter.members_.push_back(m);
  }
  std::ranges::sort(shorter.members_, {}, [](const Member& m) { return std::pair(m.at.step, m.at.index); });
}

Range Tape::range(const Box& box) const {
  const Nested<Walk> nested;
  Walk& walk = *nested;
  bound(box, walk);
  return walk.ranges.back();
}

ScalarField::Model::Within Tape::within(const Box& box) const {
  const Nested<Walk> nested;
  Walk& walk = *nested;
  bound(box, walk);
  return {walk.ranges.back(), walk.shorter ? shortened(walk) : nullptr};
}

}  // namespace blendwright
