#pragma once
// The parsed form of a formula: instructions of a stack machine in postfix order. Private to kernel/math.
#include <cstddef>
#include <vector>

#include "kernel/math/formula.hpp"

namespace blendwright {

enum class FormulaOp {
  constant,
  variable,  // push
  negate,
  power_whole,
  power_real,  // of the top, by a constant exponent
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  exp,
  log,
  sqrt,
  abs,  // of the top
  add,
  subtract,
  multiply,
  divide,
  power,
  atan2,
  min,
  max  // of the two at the top
};
[[nodiscard]] constexpr int operand_count(FormulaOp op) {
  if (op <= FormulaOp::variable) return 0;
  return op < FormulaOp::add ? 1 : 2;
}

struct FormulaInstruction {
  FormulaOp op = FormulaOp::constant;
  double number = 0.0;    ///< constant: its value; power_whole, power_real: the exponent
  std::size_t index = 0;  ///< variable
};

struct Formula::Program {
  std::vector<FormulaInstruction> code;
  std::size_t variables = 0;  ///< how many arguments it takes
  std::size_t stack = 0;      ///< most values on the stack at a time
};

/// Runs an instruction that takes operands: `a`, and `b` where there are two.
template <class T>
[[nodiscard]] T apply(const FormulaInstruction& instruction, const T& a, const T& b);

/// Parses; see Formula's constructor.
[[nodiscard]] Formula::Program parse_formula(const std::string& text,
                                             const std::vector<std::string>& variables,
                                             const std::map<std::string, double>& constants);

}  // namespace blendwright
