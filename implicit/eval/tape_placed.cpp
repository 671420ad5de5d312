// The tape of a moved solid.
#include "implicit/eval/constant.hpp"
#include "implicit/eval/tape.hpp"
#include "kernel/field/rigid_motion.hpp"

namespace blendwright {

std::shared_ptr<const ScalarField::Model> Tape::placed(const RigidMotion& motion) const {
  // As row vectors: Y = (X - t) R.
  Frame back;
  back.matrix = motion.R;
  back.offset = -(motion.R.transpose() * motion.t);
  back.identity = motion.is_identity();
  const auto owned = std::make_shared<Owned>();
  owned->bodies.push_back(owned_);
  owned->frames.reserve(frames_.size() + 1);
  for (const Frame* frame : frames_) owned->frames.push_back(frame->after(back));
  owned->frames.push_back(back);  // of what stood in the scene's own coordinates

  const std::shared_ptr<Tape> tape(new Tape(*this));
  const auto own = static_cast<std::int32_t>(frames_.size());
  bool used = false;
  const auto moved = [&](Step& step) {
    if (step.frame >= 0 || step.op == &detail::constant_op()) return;
    step.frame = own;
    used = true;
  };
  for (Step& step : tape->steps_) moved(step);
  for (Member& member : tape->members_)
    if (member.merged()) moved(member.leaf);
  tape->frames_.clear();
  for (std::size_t f = 0; f < frames_.size() + (used ? 1 : 0); ++f)
    tape->frames_.push_back(&owned->frames[f]);
  tape->owned_ = owned;
  return tape;
}

}  // namespace blendwright
