#pragma once
// Formulas typed by a user: parsed once, evaluated on numbers and on Taylor series (exact derivatives).
//
// Grammar: numbers, pi, e, the named variables and constants, + - * / ^ (right associative, binds tighter than unary
// minus), parentheses, and the functions sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs pow min max.
// a^n with a whole-number constant n is repeated multiplication (a may be negative or zero); else a > 0.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kernel/math/taylor.hpp"

namespace blendwright {

class Formula {
 public:
  /// Throws InputError whose message names the column, what stands there and what was expected; unknown names come
  /// with a suggestion. Nesting is limited to 200 levels.
  Formula(std::string text, std::vector<std::string> variables, const std::map<std::string, double>& constants = {});
  /// `arguments` in the order of the variables. T: double, Taylor<3>, Taylor2<2>, Taylor2<4>.
  template <class T>
  [[nodiscard]] T operator()(const std::vector<T>& arguments) const;
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  struct Program;
  std::string text_;
  std::shared_ptr<const Program> program_;
};

/// A constant expression such as "2*pi" with named constants.
[[nodiscard]] double constant_value(const std::string& text, const std::map<std::string, double>& constants = {});

}  // namespace blendwright
