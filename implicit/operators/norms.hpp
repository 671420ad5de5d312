#pragma once
// Ricci's super-ellipsoidal operators: norms of any number of arguments >= 0, overflow-safe.
//   Norm         N_n(u) = (sum u_i^n)^(1/n)          one-level intersection, half-level union
//   InverseNorm  N_-n(u) = (sum u_i^-n)^(-1/n)       one-level union, half-level intersection
// n > 0. Both rise in every argument, are homogeneous of degree 1 and associative. max u <= N_n <= k^(1/n)
// max u for all n; k^(-1/n) min u <= N_-n <= min u. Infinite arguments make N_n infinite and drop out of
// N_-n. Partials (u_i/N)^(n-1), (N/u_i)^(n+1). A negative argument counts as 0. Ricci 1973. Range: end
// points.
//   N_n    exactly the sum of all where at most one argument is not 0 (or n = 1), which is the other one
//   where
//          all but one are the constant 0
//   N_-n   0 and derivatives 0 where two arguments are 0; exactly the smallest where it alone is 0 or finite
#include "implicit/eval/op.hpp"
#include "implicit/number/power.hpp"

namespace blendwright::detail {

struct Norm {
  Power n, inverse_n;
  explicit Norm(double exponent) : n(exponent), inverse_n(1.0 / exponent) {}
};
struct InverseNorm {
  Power n, inverse_n;
  explicit InverseNorm(double exponent) : n(exponent), inverse_n(1.0 / exponent) {}
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::Norm>();
template <>
const Op& op_for<detail::InverseNorm>();
}  // namespace blendwright
