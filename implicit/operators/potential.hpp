#pragma once
// Potential functions P(d): from a distance d >= 0 to the half-level field of a soft object. All fall with d,
// P(0) = 1, P(1/2) = 1/2; all but `gaussian` are exactly 0 for d >= 1, with derivatives 0. u = d^2.
//   blanc              1 - 9 u^2 / (s + (4.5 - 4 s) u)                for d <= 1/2,
//                      (1 - u)^2 / (0.75 - s + (1.5 + 4 s) u)         for 1/2 < d < 1
//   wyvill             1 - (22 u - 17 u^2 + 4 u^3) / 9 = (1 - u)^2 (9 - 4 u) / 9
//   gaussian           2^(-4 u), P(1) = 1/16; taken as 0 for d >= 15, where it is below 1e-270
//   gaussian_windowed  (1 - u)^2 exp(-k u), k = 4 ln(9/8)
// A negative d counts as 0. C1 on [0, infinity); softness s >= 0 (any: the denominators are positive inside), |P'| <= 2 + 16 s / 9.
// Blanc and Schlick 1995; Wyvill, McPheeters and Wyvill 1986; Blinn 1982. Range: end points.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

struct Blanc {
  double softness = 0.0;
};
struct Wyvill {};
struct Gaussian {};
struct GaussianWindowed {};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::Blanc>();
template <>
const Op& op_for<detail::Wyvill>();
template <>
const Op& op_for<detail::Gaussian>();
template <>
const Op& op_for<detail::GaussianWindowed>();
}  // namespace blendwright
