#pragma once
// Range maps T(d): they move the edge of a soft object's influence from d = 1 to (1 + w1)/2 and its core from
// d = 0 to (1 - w2)/2, so that the field P(T(d)) has the outer radius w1 and the inner radius w2 (in units of
// half the influence radius). T rises with d, from exactly 0 to exactly 1. t = d - 1/2.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// T = 0                          for d <= (1 - w2)/2
///     1/2 + t/w1 + A t^2         for d < 1/2,  A = 2 (1/w1 - 1/w2)/w2
///     1/2 + t/w1                 for d < (1 + w1)/2
///     1                          beyond.
/// w1 > 0, 0 < w2 <= 1, w2 <= 2 w1 (else T is not monotone and P(T(d)) has a hole). C1 but for the two outer
/// corners, where P' = 0. Argument: d. Hsu and Lee 2003.
struct RangeMap {
  double w1 = 1.0, w2 = 1.0;
};

/// w1 varies so that the influence ends at the contour f_c = 1: w1 = w(a), a = 2 d/f_c - 1 (constant on rays
/// when d and f_c are ray-linear), with the floor w0 = w_floor > 0:
///   w(a) = w0 for a <= 0;  w0 + a^2/(4 w0) for a < 2 w0;  a beyond.
/// Outside, d >= 1/2: T = min(1, 1/2 + t/w). Inside, 0 < w2 <= 1:
///   decoupled  T = max(0, 1/2 + t/w2): T has another slope on either side of d = 1/2
///   coupled    T = max(0, 1/2 + t/w + A t^2) with A as above, w1 = w: C1 across d = 1/2; w2 <= 2 min w
/// Arguments: d and f_c. T rises with d, and with f_c outside; inside it falls with f_c when coupled.
struct VirMap {
  double w2 = 1.0, w_floor = 0.02;
  bool coupled = false;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::RangeMap>();
template <>
const Op& op_for<detail::VirMap>();
}  // namespace blendwright
