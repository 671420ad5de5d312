#pragma once
// The functions of numbers as rows, so that one test runs them all: for scalars, and for vectors of every
// instruction set that this machine has.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "implicit/number/power.hpp"

namespace blendwright::test {

/// f(a, b) with a = p (1 + q/10) and b = q - p/20: arguments with derivatives of both orders in p and q.
struct NumberFunction {
  std::string name;
  double p_lo, p_hi, q_lo, q_hi;  ///< where it is smooth
};
[[nodiscard]] std::span<const NumberFunction> number_functions();

/// Components of f as in FieldValues, p being the first coordinate and q the second; order 0, 1 or 2.
/// vectors: through the vectors of the chosen instruction set.
[[nodiscard]] std::vector<double> run_function(std::size_t function, int order, bool vectors,
                                               const std::vector<double>& p, const std::vector<double>& q);

/// Functions of lanes, by name: sign, atan2, min, max, select (x < y ? 1 : 2), any_all (1: any x < y of the
/// vector, 2: all, 3: both).
[[nodiscard]] std::vector<double> run_lanes(const std::string& function, bool vectors,
                                            const std::vector<double>& x, const std::vector<double>& y);
[[nodiscard]] std::vector<double> run_power(const detail::Power& n, bool vectors,
                                            const std::vector<double>& x);
/// Components of the norm of three terms, which are the coordinates.
[[nodiscard]] std::vector<double> run_norm(const detail::Power& n, const detail::Power& inverse_n,
                                           bool vectors, const std::vector<double>& x,
                                           const std::vector<double>& y, const std::vector<double>& z);

/// The instruction sets that can be chosen, and choosing one.
[[nodiscard]] std::vector<std::string> instruction_sets();
void choose_instruction_set(const std::string& name);

}  // namespace blendwright::test
