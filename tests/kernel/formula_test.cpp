#include "kernel/math/formula.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "kernel/base/error.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

constexpr double u0 = 0.7, v0 = -1.3;
const std::vector<std::string> uv{"u", "v"};

struct Good {
  const char* text;
  double value;  ///< at u0, v0
};

TEST(Formula, HasTheValueThatItSays) {
  const double pi = std::numbers::pi, e = std::numbers::e, u = u0, v = v0;
  const std::vector<Good> cases{
      {"1", 1},
      {" 1.5e-3 ", 1.5e-3},
      {".5", 0.5},
      {"5.", 5},
      {"u", u},
      {"v", v},
      {"u+v*2", u + v * 2},
      {"(u+v)*2", (u + v) * 2},
      {"1-2-3", -4},
      {"12/3/2", 2},
      {"2^3^2", 512},
      {"-2^2", -4},
      {"2^-1", 0.5},
      {"-u^2", -u * u},
      {"(-u)^2", u * u},
      {"--u", u},
      {"+-+u", -u},
      {"2*-u", -2 * u},
      {"v^3", v * v * v},
      {"v^-3", 1 / (v * v * v)},
      {"u^0.5", std::sqrt(u)},
      {"u^v", std::pow(u, v)},
      {"0^0", 1},
      {"pi", pi},
      {"e^u", std::pow(e, u)},
      {"2*pi*u", 2 * pi * u},
      {"sin(u)", std::sin(u)},
      {"cos ( u ) ", std::cos(u)},
      {"tan(u)", std::tan(u)},
      {"asin(u)", std::asin(u)},
      {"acos(u)", std::acos(u)},
      {"atan(v)", std::atan(v)},
      {"atan2(u, v)", std::atan2(u, v)},
      {"sinh(v)", std::sinh(v)},
      {"cosh(v)", std::cosh(v)},
      {"tanh(v)", std::tanh(v)},
      {"exp(v)", std::exp(v)},
      {"log(u)", std::log(u)},
      {"sqrt(u)", std::sqrt(u)},
      {"abs(v)", -v},
      {"pow(v, 2)", v * v},
      {"min(u, v)", v},
      {"max(u, v)", u},
      {"1/(1+u^2)", 1 / (1 + u * u)},
      {"\tu\n+\r1", u + 1},
      {"r*u + r2", 3.0 * u + 5.0},
      {"e1*u", 7.0 * u},
  };
  for (const Good& c : cases) {
    SCOPED_TRACE(c.text);
    const Formula f(c.text, uv, {{"r", 3.0}, {"r2", 5.0}, {"e1", 7.0}});
    EXPECT_DOUBLE_EQ(f(std::vector<double>{u0, v0}), c.value);
    EXPECT_EQ(f.text(), c.text);
  }
}

struct Bad {
  const char* text;
  const char* message;
};

TEST(Formula, SaysWhereItIsWrongAndWhatWasExpected) {
  const std::vector<Bad> cases{
      {"", "is empty, must be an expression in u, v"},
      {"  \t", "is empty, must be an expression in u, v"},
      {"u+", "column 3: the formula ends, must be a number, a name or \"(\""},
      {"u*/v", "column 3: found \"/\", must be a number, a name or \"(\""},
      {"u**2", "column 3: found \"**\"; powers are written with ^"},
      {"2u",
       "column 2: found \"u\" after a complete expression; an operator (+ - * / ^) is missing before it, or "
       "it does not "
       "belong here"},
      {"u v",
       "column 3: found \"v\" after a complete expression; an operator (+ - * / ^) is missing before it, or "
       "it does "
       "not belong here"},
      {"(u", "column 3: the formula ends, must be an operator or the \")\" for the \"(\" of column 1"},
      {"sin((u)", "column 8: the formula ends, must be an operator or the \")\" for the \"(\" of column 4"},
      {"u)",
       "column 2: found \")\" after a complete expression; an operator (+ - * / ^) is missing before it, or "
       "it does not "
       "belong here"},
      {"()", "column 2: found \")\", must be a number, a name or \"(\""},
      {"sin u", "column 5: found \"u\", must be \"(\" after the function \"sin\""},
      {"sin", "column 4: the formula ends, must be \"(\" after the function \"sin\""},
      {"sin()", "column 5: found \")\", must be a number, a name or \"(\""},
      {"atan2(u)", "column 1: \"atan2\" has 1 argument, must have 2"},
      {"1+sin(u,v)", "column 3: \"sin\" has 2 arguments, must have 1"},
      {"u+sqt(v)", "column 3: \"sqt\" is not known in a formula in u, v; did you mean \"sqrt\"?"},
      {"radus*u", "column 1: \"radus\" is not known in a formula in u, v; did you mean \"radius\"?"},
      {"x", "column 1: \"x\" is not known in a formula in u, v"},
      {"1e400", "column 1: found \"1e400\", too large or too small for a number"},
      {"1.2.3",
       "column 4: found \".\" after a complete expression; an operator (+ - * / ^) is missing before it, or "
       "it does "
       "not belong here"},
      {".", "column 1: found \".\", must be a number such as 0.5"},
      {"u @ v",
       "column 3: found \"@\" after a complete expression; an operator (+ - * / ^) is missing before it, or "
       "it does "
       "not belong here"},
      {"u\xC2\xB2",
       "column 2: found \"\xC2\xB2\" after a complete expression; an operator (+ - * / ^) is missing before "
       "it, "
       "or it does not belong here"},
      {"u+\x01", "column 3: found a control character, must be a number, a name or \"(\""},
      {"u + 1/0", "column 6: this part is infinite"},
      {"log(-1)*u", "column 1: this part is not a number (outside a function's domain)"},
  };
  for (const Bad& c : cases) {
    SCOPED_TRACE(c.text);
    try {
      const Formula f(c.text, uv, {{"radius", 3.0}});
      ADD_FAILURE() << "was accepted";
    } catch (const InputError& e) {
      EXPECT_STREQ(e.what(), c.message);
      EXPECT_EQ(e.problems().at(0).where, "");
    }
  }
}

TEST(Formula, RefusesConstantsThatHideAVariableOrAreNotFinite) {
  EXPECT_THROW(Formula("u", uv, {{"u", 1.0}}), InputError);
  EXPECT_THROW(Formula("u*a", uv, {{"a", NAN}}), InputError);
  EXPECT_DOUBLE_EQ(Formula("e*u", uv, {{"e", 0.5}})(std::vector<double>{2.0, 0.0}), 1.0);  // may replace e
}

TEST(Formula, NestsToTwoHundredLevelsAndNoDeeper) {
  const auto nested = [](const std::string& open, const std::string& close, int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += open;
    text += "u";
    for (int i = 0; i < levels; ++i) text += close;
    return Formula(text, uv)(std::vector<double>{2.0, 0.0});
  };
  EXPECT_EQ(nested("(", ")", 200), 2.0);
  EXPECT_THROW(nested("(", ")", 201), InputError);
  EXPECT_EQ(nested("1+(", ")", 200), 202.0);  // a deep stack of operands
  EXPECT_EQ(nested("-", "", 200), 2.0);
  EXPECT_THROW(nested("-", "", 201), InputError);
  EXPECT_THROW(nested("(", ")", 100000), InputError);
  EXPECT_THROW(nested("1^", "", 100000), InputError);
}

TEST(Formula, MayBeLong) {
  std::string text = "0";
  for (int i = 0; i < 20000; ++i) text += "+u";
  EXPECT_EQ(Formula(text, uv)(std::vector<double>{1.0, 0.0}), 20000.0);
}

TEST(Formula, TakesAsManyArgumentsAsItHasVariables) {
  EXPECT_THROW(static_cast<void>(Formula("u", uv)(std::vector<double>{1.0})), InputError);
}

TEST(ConstantValue, IsTheValueOfAnExpressionWithoutVariables) {
  EXPECT_DOUBLE_EQ(constant_value("2*pi"), 2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(constant_value("a/2", {{"a", 3.0}}), 1.5);
  EXPECT_THROW(static_cast<void>(constant_value("1/0")), InputError);
  EXPECT_THROW(static_cast<void>(constant_value("10^400")), InputError);
  try {
    static_cast<void>(constant_value("u"));
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "column 1: \"u\" is not known in a formula without variables");
  }
}

/// The same body, typed and compiled.
template <class T>
T compiled(const T& u, const T& v) {
  using std::sqrt, std::exp, std::atan2, std::cosh, std::pow;
  const auto [sin_v, cos_v] = sin_cos(v);
  return sqrt(1.0 + u * u) * sin_v + exp(u * v) / (2.0 + cos_v) - atan2(u, 2.0 + v) +
         cosh(u) * pow(2.0 + u, 1.5);
}
const char* const typed = "sqrt(1+u^2)*sin(v) + exp(u*v)/(2+cos(v)) - atan2(u, 2+v) + cosh(u)*(2+u)^1.5";

template <class T>
void expect_same_series(const T& u, const T& v) {
  const T a = Formula(typed, uv)(std::vector<T>{u, v}), b = compiled(u, v);
  // The two differ by a few roundings of intermediate series whose coefficients are below 100.
  for (std::size_t k = 0; k < a.c.size(); ++k) ASSERT_NEAR(a.c[k], b.c[k], 1e-13) << k;
}

TEST(Formula, HasTheDerivativesOfTheSameFormulaInCode) {
  for_all([](Rng& rng) {
    const double u = uniform(rng, -1.0, 1.0), v = uniform(rng, -1.0, 1.0);
    ASSERT_NEAR(Formula(typed, uv)(std::vector<double>{u, v}), compiled(u, v), 1e-14);
    expect_same_series(Taylor<3>::variable(u), Taylor<3>(v) + 0.5 * Taylor<3>::variable(0.0));
    expect_same_series(Taylor2<2>::u_variable(u), Taylor2<2>::v_variable(v));
    expect_same_series(Taylor2<4>::u_variable(u), Taylor2<4>::v_variable(v));
  });
}

TEST(Formula, WholePowersHaveExactDerivativesAtZero) {
  const auto s = Formula("u^3", {"u"})(std::vector<Taylor<3>>{Taylor<3>::variable(0.0)});
  EXPECT_EQ(s.c, (std::array<double, 4>{0, 0, 0, 1}));
}

}  // namespace
}  // namespace blendwright
