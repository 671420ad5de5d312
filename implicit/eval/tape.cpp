#include "implicit/eval/tape.hpp"

#include <stdexcept>

namespace blendwright {

void Tape::evaluate(Order, PointArrays, std::span<double>) const { throw std::logic_error("tape"); }
void Tape::evaluate_scalar(Order, PointArrays, std::span<double>) const { throw std::logic_error("tape"); }
Range Tape::range(const Box&) const { throw std::logic_error("tape"); }
ScalarField::Model::Within Tape::within(const Box&) const { throw std::logic_error("tape"); }
void Tape::nearest_member(PointArrays, std::span<std::uint32_t>) const { throw std::logic_error("tape"); }

}  // namespace blendwright
