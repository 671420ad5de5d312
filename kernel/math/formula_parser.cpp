#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/math/formula_program.hpp"

namespace blendwright {
namespace {

constexpr int max_levels = 200;
constexpr double max_whole_power = 64.0;

struct FunctionRow {
  std::string_view name;
  FormulaOp op;
};
constexpr std::array<FunctionRow, 17> functions{{
    {"sin", FormulaOp::sin},
    {"cos", FormulaOp::cos},
    {"tan", FormulaOp::tan},
    {"asin", FormulaOp::asin},
    {"acos", FormulaOp::acos},
    {"atan", FormulaOp::atan},
    {"atan2", FormulaOp::atan2},
    {"sinh", FormulaOp::sinh},
    {"cosh", FormulaOp::cosh},
    {"tanh", FormulaOp::tanh},
    {"exp", FormulaOp::exp},
    {"log", FormulaOp::log},
    {"sqrt", FormulaOp::sqrt},
    {"abs", FormulaOp::abs},
    {"pow", FormulaOp::power},
    {"min", FormulaOp::min},
    {"max", FormulaOp::max},
}};

// The locale must not decide what a letter is.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
constexpr bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string quoted(std::string_view word) {
  std::string text(1, '"');
  return text.append(word.substr(0, 40)).append(1, '"');  // long words are cut
}
std::string count_text(std::size_t n) { return number_text(static_cast<double>(n)); }

/// Recursive descent:  sum = product {(+|-) product},  product = signed {(*|/) signed},
/// signed = (+|-) signed | power,  power = atom [^ signed],  atom = number | name | function(sum, ...) |
/// (sum).
class Parser {
 public:
  Parser(const std::string& text, const std::vector<std::string>& variables,
         const std::map<std::string, double>& constants)
      : text_(text), variables_(variables), constants_(constants) {
    program_.variables = variables.size();
  }

  Formula::Program run() {
    for (const auto& [name, value] : constants_) {
      if (std::find(variables_.begin(), variables_.end(), name) != variables_.end())
        throw InputError("", "the constant " + quoted(name) + " has the name of a variable; rename it");
      if (!std::isfinite(value))
        throw InputError("",
                         "the constant " + quoted(name) + " is " + number_text(value) + ", must be finite");
    }
    skip_space();
    if (at_end()) throw InputError("", "is empty, must be an expression" + variables_text());
    sum();
    if (!at_end())
      fail(at_, found() +
                    " after a complete expression; an operator (+ - * / ^) is missing before it, or it does "
                    "not belong here");
    return std::move(program_);
  }

 private:
  [[noreturn]] static void fail(std::size_t position, const std::string& message) {
    throw InputError("", "column " + count_text(position + 1) + ": " + message);
  }
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] bool next_is(char c) const { return !at_end() && text_[at_] == c; }
  void skip_space() {
    while (!at_end() && is_space(text_[at_])) ++at_;
  }
  bool take(char c) {
    if (!next_is(c)) return false;
    ++at_;
    skip_space();
    return true;
  }
  [[nodiscard]] std::string_view word_here() const {
    std::size_t end = at_;
    while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
    return std::string_view(text_).substr(at_, end - at_);
  }
  /// What stands here, for messages: a word, or one character with all bytes of its UTF-8 form.
  [[nodiscard]] std::string found() const {
    if (at_end()) return "the formula ends";
    std::string_view word = word_here();
    if (word.empty()) {
      std::size_t end = at_ + 1;
      while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0u) == 0x80u) ++end;
      word = std::string_view(text_).substr(at_, end - at_);
    }
    const bool control = static_cast<unsigned char>(word.front()) < 0x20u;
    return control ? "found a control character" : "found " + quoted(word);
  }
  [[nodiscard]] std::string variables_text() const {
    if (variables_.empty()) return " without variables";
    std::string list = " in ";
    for (const std::string& v : variables_) list += (&v == &variables_.front() ? "" : ", ") + v;
    return list;
  }

  /// Counts nesting while it lives.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) {
      if (++parser_.levels_ > max_levels + 1)
        fail(parser_.at_, "nested deeper than " + count_text(max_levels) + " levels");
    }
    ~Level() { --parser_.levels_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  void push(FormulaInstruction instruction) {
    program_.code.push_back(instruction);
    program_.stack = std::max(program_.stack, ++depth_);
  }
  [[nodiscard]] bool ends_in_constants(std::size_t n) const {
    const auto& code = program_.code;
    return code.size() >= n && std::all_of(code.end() - static_cast<std::ptrdiff_t>(n), code.end(),
                                           [](const auto& i) { return i.op == FormulaOp::constant; });
  }
  /// Emits an instruction on operands; what is constant is computed now.
  void emit(FormulaOp op, std::size_t position) {
    auto& code = program_.code;
    const std::size_t operands = static_cast<std::size_t>(operand_count(op));
    depth_ -= operands - 1;
    if (ends_in_constants(operands)) {
      const double b = code.back().number;
      const double a = code[code.size() - operands].number;
      const double value = apply<double>({op, 0.0, 0}, a, b);
      if (!std::isfinite(value))
        fail(position, std::isnan(value) ? "this part is not a number (outside a function's domain)"
                                         : "this part is infinite");
      code.resize(code.size() - operands);
      code.push_back({FormulaOp::constant, value, 0});
    } else if (op == FormulaOp::power && ends_in_constants(1)) {
      const double exponent = code.back().number;
      const bool whole = exponent == std::trunc(exponent) && std::abs(exponent) <= max_whole_power;
      code.back() = {whole ? FormulaOp::power_whole : FormulaOp::power_real, exponent, 0};
    } else {
      code.push_back({op, 0.0, 0});
    }
  }

  void sum() {
    product();
    while (next_is('+') || next_is('-')) {
      const std::size_t position = at_;
      const FormulaOp op = next_is('+') ? FormulaOp::add : FormulaOp::subtract;
      take(text_[at_]);
      product();
      emit(op, position);
    }
  }
  void product() {
    signed_power();
    while (next_is('*') || next_is('/')) {
      const std::size_t position = at_;
      const FormulaOp op = next_is('*') ? FormulaOp::multiply : FormulaOp::divide;
      take(text_[at_]);
      if (next_is('*')) fail(at_, "found \"**\"; powers are written with ^");
      signed_power();
      emit(op, position);
    }
  }
  void signed_power() {
    const Level level(*this);
    const std::size_t position = at_;
    if (take('-')) {
      signed_power();
      emit(FormulaOp::negate, position);
    } else if (take('+')) {
      signed_power();
    } else {
      power();
    }
  }
  void power() {
    atom();
    const std::size_t position = at_;
    if (take('^')) {
      signed_power();
      emit(FormulaOp::power, position);
    }
  }
  void atom() {
    if (!at_end() && (is_digit(text_[at_]) || text_[at_] == '.')) return number();
    if (!at_end() && is_letter(text_[at_])) return name();
    const std::size_t open = at_;
    if (!take('(')) fail(at_, found() + ", must be a number, a name or \"(\"");
    sum();
    close(open);
  }
  void close(std::size_t open) {
    if (!take(')'))
      fail(at_,
           found() + ", must be an operator or the \")\" for the \"(\" of column " + count_text(open + 1));
  }
  void number() {
    double value = 0.0;
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error == std::errc::invalid_argument) fail(at_, found() + ", must be a number such as 0.5");
    const auto length = static_cast<std::size_t>(end - begin);
    if (error != std::errc() || !std::isfinite(value))
      fail(at_, "found " + quoted(std::string_view(text_).substr(at_, length)) +
                    ", too large or too small for a number");
    at_ += length;
    skip_space();
    push({FormulaOp::constant, value, 0});
  }
  void name() {
    const std::size_t position = at_;
    const std::string word(word_here());
    at_ += word.size();
    skip_space();
    if (const auto v = std::find(variables_.begin(), variables_.end(), word); v != variables_.end())
      return push({FormulaOp::variable, 0.0, static_cast<std::size_t>(v - variables_.begin())});
    if (const auto c = constants_.find(word); c != constants_.end())
      return push({FormulaOp::constant, c->second, 0});
    const auto* f = std::find_if(functions.begin(), functions.end(),
                                 [&](const FunctionRow& row) { return row.name == word; });
    if (f != functions.end()) return call(*f, position);
    if (word == "pi") return push({FormulaOp::constant, std::numbers::pi, 0});
    if (word == "e") return push({FormulaOp::constant, std::numbers::e, 0});
    unknown(word, position);
  }
  void call(const FunctionRow& function, std::size_t position) {
    const std::size_t open = at_;
    if (!take('(')) fail(at_, found() + ", must be \"(\" after the function " + quoted(function.name));
    const auto wanted = static_cast<std::size_t>(operand_count(function.op));
    std::size_t given = 0;
    do {
      sum();
      ++given;
    } while (take(','));
    close(open);
    if (given != wanted)
      fail(position, quoted(function.name) + " has " + count_text(given) +
                         (given == 1 ? " argument" : " arguments") + ", must have " + count_text(wanted));
    emit(function.op, position);
  }
  [[noreturn]] void unknown(const std::string& word, std::size_t position) const {
    std::vector<std::string> known = variables_;
    for (const auto& [constant, value] : constants_) known.push_back(constant);
    for (const FunctionRow& f : functions) known.emplace_back(f.name);
    known.emplace_back("pi");
    const auto nearest = word.size() > 1 ? nearest_word(word, known.data(), known.size()) : std::nullopt;
    fail(position, quoted(word) + " is not known in a formula" + variables_text() +
                       (nearest ? "; did you mean " + quoted(*nearest) + "?" : ""));
  }

  const std::string& text_;
  const std::vector<std::string>& variables_;
  const std::map<std::string, double>& constants_;
  Formula::Program program_;
  std::size_t at_ = 0, depth_ = 0;
  int levels_ = 0;
};

}  // namespace

Formula::Program parse_formula(const std::string& text, const std::vector<std::string>& variables,
                               const std::map<std::string, double>& constants) {
  return Parser(text, variables, constants).run();
}

}  // namespace blendwright
