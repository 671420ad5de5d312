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
    const void* body;
    std::int32_t frame;  ///< index of frames, -1: the scene's own
    std::uint32_t first_arg, arg_count;
    std::uint32_t slot;  ///< where its results are kept while they are needed
  };

  void evaluate(Order order, PointArrays points, std::span<double> out) const override;
  /// The same through the scalar kernels: an independent reference for tests, and for single points.
  void evaluate_scalar(Order order, PointArrays points, std::span<double> out) const;
  [[nodiscard]] Range range(const Box& box) const override;
  [[nodiscard]] Within within(const Box& box) const override;
  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override;

  [[nodiscard]] std::size_t size() const { return steps_.size(); }
  [[nodiscard]] std::size_t slots() const { return slots_; }

 private:
  friend class TapeBuilder;
  Tape() = default;

  std::vector<Step> steps_;  ///< arguments before users; the last step is the result
  std::vector<StepIndex> args_;
  std::vector<TapeMember> members_;
  std::size_t slots_ = 0;
  /// What steps point to; shared with every shortened tape.
  struct Owned;
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

  /// Adds a step; the body lives as long as the tape and all tapes made from it.
  StepIndex add(const Op& op, std::shared_ptr<const void> body, const Frame& frame,
                std::span<const StepIndex> args = {});
  template <class Body>
  StepIndex add(std::shared_ptr<const Body> body, const Frame& frame, std::initializer_list<StepIndex> args) {
    return add(op_for<Body>(), body, frame, std::span(args.begin(), args.size()));
  }
  /// A step that is c everywhere.
  StepIndex constant(double c);
  void member(TapeMember member);
  /// The tape whose value is that of `result`; steps that do not matter for it are left out.
  [[nodiscard]] std::shared_ptr<const Tape> finish(StepIndex result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace blendwright
