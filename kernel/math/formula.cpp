#include "kernel/math/formula.hpp"

#include <array>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/math/formula_program.hpp"
#include "kernel/math/model_jet.hpp"

namespace blendwright {
namespace {

double smaller(double a, double b) { return b < a ? b : a; }
double larger(double a, double b) { return b > a ? b : a; }
template <TaylorSeries T>
T smaller(const T& a, const T& b) {
  return b.value() < a.value() ? b : a;
}
template <TaylorSeries T>
T larger(const T& a, const T& b) {
  return b.value() > a.value() ? b : a;
}
ModelJet smaller(const ModelJet& a, const ModelJet& b) { return min(a, b); }
ModelJet larger(const ModelJet& a, const ModelJet& b) { return max(a, b); }

/// a^n by squaring: exact zeros of the derivatives at a = 0.
template <class T>
T whole_power(T a, double exponent) {
  T result(1.0);
  for (unsigned n = static_cast<unsigned>(std::abs(exponent)); n > 0; n /= 2) {
    if (n % 2 == 1) result = result * a;
    if (n > 1) a = a * a;
  }
  return exponent < 0 ? 1.0 / result : result;
}

}  // namespace

template <class T>
T apply(const FormulaInstruction& instruction, const T& a, const T& b) {
  using std::sin, std::cos, std::tan, std::asin, std::acos, std::atan, std::sinh, std::cosh, std::tanh,
      std::exp, std::log, std::sqrt, std::abs, std::pow, std::atan2;
  switch (instruction.op) {
    case FormulaOp::constant:
    case FormulaOp::variable:
      return a;
    case FormulaOp::negate:
      return -a;
    case FormulaOp::power_whole:
      return whole_power(a, instruction.number);
    case FormulaOp::power_real:
      return pow(a, instruction.number);
    case FormulaOp::sin:
      return sin(a);
    case FormulaOp::cos:
      return cos(a);
    case FormulaOp::tan:
      return tan(a);
    case FormulaOp::asin:
      return asin(a);
    case FormulaOp::acos:
      return acos(a);
    case FormulaOp::atan:
      return atan(a);
    case FormulaOp::sinh:
      return sinh(a);
    case FormulaOp::cosh:
      return cosh(a);
    case FormulaOp::tanh:
      return tanh(a);
    case FormulaOp::exp:
      return exp(a);
    case FormulaOp::log:
      return log(a);
    case FormulaOp::sqrt:
      return sqrt(a);
    case FormulaOp::abs:
      return abs(a);
    case FormulaOp::add:
      return a + b;
    case FormulaOp::subtract:
      return a - b;
    case FormulaOp::multiply:
      return a * b;
    case FormulaOp::divide:
      return a / b;
    case FormulaOp::power:
      return pow(a, b);
    case FormulaOp::atan2:
      return atan2(a, b);
    case FormulaOp::min:
      return smaller(a, b);
    case FormulaOp::max:
      return larger(a, b);
  }
  return a;
}
template double apply(const FormulaInstruction&, const double&, const double&);

Formula::Formula(std::string text, std::vector<std::string> variables,
                 const std::map<std::string, double>& constants)
    : text_(std::move(text)),
      program_(std::make_shared<const Program>(parse_formula(text_, variables, constants))) {}

template <class T>
T Formula::operator()(std::span<const T> arguments) const {
  if (arguments.size() != program_->variables)
    throw InputError("", "\"" + text_ + "\" takes " + number_text(static_cast<double>(program_->variables)) +
                             " arguments, has " + number_text(static_cast<double>(arguments.size())));
  std::array<T, 12> small{};  // no allocation for formulas that people type
  std::vector<T> large;
  if (program_->stack > small.size()) large.resize(program_->stack);
  T* const stack = large.empty() ? small.data() : large.data();
  std::size_t n = 0;
  for (const FormulaInstruction& i : program_->code) {
    switch (operand_count(i.op)) {
      case 0:
        stack[n++] = i.op == FormulaOp::constant ? T(i.number) : arguments[i.index];
        break;
      case 1:
        stack[n - 1] = apply(i, stack[n - 1], stack[n - 1]);
        break;
      default:
        stack[n - 2] = apply(i, stack[n - 2], stack[n - 1]);
        --n;
    }
  }
  return stack[0];
}
template double Formula::operator()(std::span<const double>) const;
template Taylor<3> Formula::operator()(std::span<const Taylor<3>>) const;
template Taylor2<2> Formula::operator()(std::span<const Taylor2<2>>) const;
template Taylor2<4> Formula::operator()(std::span<const Taylor2<4>>) const;
template ModelJet Formula::operator()(std::span<const ModelJet>) const;

double constant_value(const std::string& text, const std::map<std::string, double>& constants) {
  return Formula(text, {}, constants)(std::span<const double>());
}

}  // namespace blendwright
