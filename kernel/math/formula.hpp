#pragma once
// Formulas typed by a user: parsed once, evaluated on numbers and on Taylor series (exact derivatives).
//
// Grammar: numbers, pi, e, the named variables and constants, + - * / ^ (right associative, binds tighter
// than unary minus), parentheses, and the functions sin cos tan asin acos atan atan2 sinh cosh tanh exp log
// sqrt abs pow min max. a^n with a whole-number constant n is repeated multiplication (a may be negative or
// zero); else a > 0, or a >= 0 for a constant exponent (where a = 0, derivatives of an order above the
// exponent are infinite). abs, min and max take the derivatives of the branch they choose; at a tie, the
// first. Angles are radians.
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kernel/math/taylor.hpp"

namespace blendwright {

class Formula {
 public:
  /// Throws InputError whose message names the column, what stands there and what was expected; unknown names
  /// come with a suggestion. Nesting is limited to 200 levels. A constant may replace pi or e, but not a
  /// variable.
  Formula(std::string text, std::vector<std::string> variables,
          const std::map<std::string, double>& constants = {});
  /// `arguments` in the order of the variables; InputError when their number differs. Outside a function's
  /// domain the result is NaN or infinite. T: double, Taylor<3>, Taylor2<2>, Taylor2<4>,
  /// ModelJet.
  template <class T>
  [[nodiscard]] T operator()(std::span<const T> arguments) const;
  template <class T>
  [[nodiscard]] T operator()(const std::vector<T>& arguments) const {
    return (*this)(std::span<const T>(arguments));
  }
  [[nodiscard]] const std::string& text() const { return text_; }

  struct Program;  ///< the parsed form

 private:
  std::string text_;
  std::shared_ptr<const Program> program_;
};

/// A constant expression such as "2*pi" with named constants; InputError when its value is not finite.
[[nodiscard]] double constant_value(const std::string& text,
                                    const std::map<std::string, double>& constants = {});

}  // namespace blendwright
