#pragma once
// A field as a list of steps, each an operation on results of earlier ones. Steps are coarse (a superquadric,
// a potential, a union), so that a walk over the list costs nothing next to the work in a step. Over a box
// the list gets shorter: what cannot matter there is left out.
#include <cstdint>
#include <memory>
#include <vector>

#include "implicit/eval/op.hpp"

namespace blendwright {

using StepIndex = std::uint32_t;
struct LinearParts;

/// One primitive of a scene: where its own value stands on the tape, for nearest_member.
struct TapeMember {
  StepIndex step = 0;
  Level level = Level::half;
  std::uint32_t index = 0;  ///< into the names of the scene's primitives
};

class Tape final : public ScalarField::Model {
 public:
  struct Step {
    const Op* op;
    const void* body;    ///< null: the body is `constant`
    double constant;     ///< of the operation constant_op()
    std::int32_t frame;  ///< index of frames, -1: the scene's own
    std::uint32_t first_arg, arg_count;
    std::uint32_t slot;  ///< where its results are kept while they are needed
  };

  /// The caller sees to it that coordinates are finite; others give any value, also NaN, at their own point
  /// and change no other point's.
  void evaluate(Order order, PointArrays points, std::span<double> out) const override;
  /// The same through the scalar kernels: an independent reference for tests.
  void evaluate_scalar(Order order, PointArrays points, std::span<double> out) const;
  /// Linear in the number of steps, like within(). Shortcuts are taken here too, so both give one range.
  [[nodiscard]] Range range(const Box& box) const override;
  /// From the operations' linear bounds, each the range where that is narrower; takes shortcuts like range().
  [[nodiscard]] LinearBound linear(const Box& box) const override;
  /// The linear bounds of what minima and maxima at the end of the tape are made of (see LinearParts).
  [[nodiscard]] LinearParts linear_parts(const Box& box, double sign) const;
  /// Takes the shortcuts of the operations: arguments and constants stand in for steps that equal them on the
  /// box, and steps (and members) that no longer matter are left out. An operation on constants is folded
  /// only by its own shortcut: vector and scalar kernels need not agree to the last bit.
  [[nodiscard]] Within within(const Box& box) const override;
  /// First-order distance |f - surface value| / |gradient f| of each member that is still on the tape; the
  /// smallest wins, the lowest index on ties; 0 where no member's gradient is there to tell.
  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override;
  /// The same steps and bodies, all seen through moved frames: costs about as much as one range.
  [[nodiscard]] std::shared_ptr<const Model> placed(const RigidMotion& motion) const override;

  [[nodiscard]] std::size_t size() const { return steps_.size(); }
  [[nodiscard]] std::size_t slots() const { return slots_; }

 private:
  friend class TapeBuilder;
  Tape() = default;

  /// What steps point to; shared with every shortened tape.
  struct Owned {
    std::vector<std::shared_ptr<const void>> bodies;
    std::vector<Frame> frames;
  };

  /// A member's own value is that of `leaf`, a primitive that was merged into step `at.step`, or of that
  /// step.
  struct Member {
    TapeMember at;
    Step leaf{};
    [[nodiscard]] bool merged() const { return leaf.op != nullptr; }
  };

  [[nodiscard]] const Frame* frame_of(const Step& step) const {
    return step.frame < 0 ? nullptr : frames_[static_cast<std::size_t>(step.frame)];
  }
  [[nodiscard]] std::span<const StepIndex> args_of(const Step& step) const {
    return std::span(args_).subspan(step.first_arg, step.arg_count);
  }

  struct Walk;
  struct Parts;
  void run(Order order, PointArrays points, KernelSet Op::*kernels, std::size_t lanes,
           std::span<double> out) const;
  void bound(const Box& box, Walk& walk) const;
  void bound_linearly(const Box& box, Walk& walk) const;
  [[nodiscard]] std::shared_ptr<const Tape> shortened(Walk& walk) const;
  void keep_members(Walk& walk, Tape& shorter) const;

  std::vector<Step> steps_;  ///< arguments before users; the last step is the result
  std::vector<StepIndex> args_;
  std::vector<const Frame*> frames_;  ///< only those that its steps use
  std::vector<Member> members_;       ///< by step
  std::size_t slots_ = 0;
  std::shared_ptr<const Owned> owned_;
};

/// Makes a tape. The same operation with the same body object, frame and arguments is one step, so a scene in
/// which a node is used many times stays as long as it has nodes.
class TapeBuilder {
 public:
  TapeBuilder();
  ~TapeBuilder();
  TapeBuilder(const TapeBuilder&) = delete;
  TapeBuilder& operator=(const TapeBuilder&) = delete;

  /// Adds a step; the body lives as long as the tape and all tapes made from it. Throws InputError ("args")
  /// when an argument is not a step of this builder.
  StepIndex add(const Op& op, std::shared_ptr<const void> body, const Frame& frame,
                std::span<const StepIndex> args = {});
  template <class Body>
  StepIndex add(std::shared_ptr<const Body> body, const Frame& frame, std::initializer_list<StepIndex> args) {
    return add(op_for<Body>(), body, frame, std::span(args.begin(), args.size()));
  }
  /// A step that is c everywhere.
  StepIndex constant(double c);
  void member(TapeMember member);
  /// The tape whose value is that of `result`; steps and members that do not matter for it are left out.
  /// Primitives with one user are merged into it where an operation for both exists. Arguments stand in the
  /// order that keeps the fewest results at a time (for trees: Sethi and Ullman 1970).
  [[nodiscard]] std::shared_ptr<const Tape> finish(StepIndex result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace blendwright
