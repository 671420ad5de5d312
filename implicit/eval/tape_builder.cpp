#include <stdexcept>

#include "implicit/eval/tape.hpp"

namespace blendwright {

struct TapeBuilder::State {};
TapeBuilder::TapeBuilder() : state_(std::make_unique<State>()) {}
TapeBuilder::~TapeBuilder() = default;
StepIndex TapeBuilder::add(const Op&, std::shared_ptr<const void>, const Frame&, std::span<const StepIndex>) {
  throw std::logic_error("tape");
}
StepIndex TapeBuilder::constant(double) { throw std::logic_error("tape"); }
void TapeBuilder::member(TapeMember) { throw std::logic_error("tape"); }
std::shared_ptr<const Tape> TapeBuilder::finish(StepIndex) { throw std::logic_error("tape"); }

}  // namespace blendwright
