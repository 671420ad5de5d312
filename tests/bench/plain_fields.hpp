#pragma once
// The models of field_models.hpp as plain loops.
#include <numbers>

#include "tests/bench/field_models.hpp"

namespace blendwright::bench {

[[nodiscard]] PlainLoop plain_blend();
[[nodiscard]] PlainLoop plain_vir(double contour_exponent);
[[nodiscard]] PlainLoop plain_ring();
[[nodiscard]] PlainLoop plain_sixball();
[[nodiscard]] PlainLoop plain_soft_sum(const std::vector<Ellipsoid>& ellipsoids);
[[nodiscard]] PlainLoop plain_freeform(const Freeform& freeform);

}  // namespace blendwright::bench
