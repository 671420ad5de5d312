#pragma once
// Reads one object of a job or scene file against its table of keys, collecting every problem with its JSON
// pointer.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/json/choices.hpp"
#include "app/json/job_keys.hpp"
#include "app/json/json_value.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/units.hpp"

namespace blendwright {

/// What one reading of a file collects: its problems, and the constants that formulas may use.
class Reading {
 public:
  std::map<std::string, double> constants;

  void problem(std::string where, std::string message) {
    problems_.push_back({std::move(where), std::move(message)});
  }
  /// Adds what a later check found, but nothing at, above or inside a place that has a problem already: one
  /// mistake is told once.
  void add(const InputError& later);
  /// True when exactly `where` already has a problem.
  [[nodiscard]] bool told(const std::string& where) const;
  /// True when `where` or something inside it already has a problem.
  [[nodiscard]] bool faulty(const std::string& where) const;
  [[nodiscard]] bool empty() const { return problems_.empty(); }
  /// Throws InputError with all problems in the order of the file, if there are any.
  void finish(const JsonValue& root) const;

  /// A number or a constant formula; nullopt after reporting a problem.
  std::optional<double> number(const JsonValue& value, const std::string& where);
  /// The text of a formula that parses with these variables.
  std::optional<std::string> formula(const JsonValue& value, const std::string& where,
                                     const std::vector<std::string>& variables);
  /// A list of `count` numbers.
  std::optional<std::vector<double>> numbers(const JsonValue& value, const std::string& where,
                                             std::optional<std::size_t> count = std::nullopt);
  std::optional<Vec3> point(const JsonValue& value, const std::string& where);
  /// Points of `dimension` 2 or 3 coordinates; the third of 2 is 0.
  std::optional<std::vector<Vec3>> points(const JsonValue& value, const std::string& where,
                                          std::size_t dimension);
  /// The name's value in a table; else a problem with the nearest name.
  template <class E>
  std::optional<E> choice(const JsonValue& value, const std::string& where,
                          std::span<const Choice<E>> choices) {
    std::vector<std::string> names;
    for (const Choice<E>& c : choices) names.emplace_back(c.name);
    if (const auto i = word(value, where, names)) return choices[*i].value;
    return std::nullopt;
  }
  /// Index into `names`.
  std::optional<std::size_t> word(const JsonValue& value, const std::string& where,
                                  const std::vector<std::string>& names);

 private:
  std::vector<Problem> problems_;
};

/// "; did you mean "x"?" for the nearest of the names, "" when none is near.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& names);
/// ""a", "b" or "c"".
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

class ObjectReader;
/// The members of an object of named things; reports names that cannot be used (they become parts of file
/// names and STEP names).
[[nodiscard]] const std::vector<JsonMember>& named(ObjectReader& object, const char* key, Reading& reading);
/// "let": constants for formulas of these variables.
void read_constants(ObjectReader& object, const std::vector<std::string>& variables, Reading& reading);

class ObjectReader {
 public:
  /// Reports a value that is no object, unknown keys, and required keys that are missing.
  ObjectReader(const JsonValue& value, std::string where, const ObjectInfo& info, Reading& reading);

  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] std::string at(std::string_view key) const { return where_ + "/" + pointer_part(key); }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  /// The member, or nullptr. Throws std::logic_error for a key that is not in the table.
  [[nodiscard]] const JsonValue* find(std::string_view key) const;

  // Each is nullopt when the key is absent or its value is wrong (a problem is reported then).
  std::optional<double> number(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  std::optional<bool> boolean(std::string_view key);
  std::optional<Vec3> point(std::string_view key);
  /// A direction: a point that is not zero.
  std::optional<Vec3> direction(std::string_view key);
  std::optional<Interval> range(std::string_view key);
  std::optional<std::vector<std::string>> formulas(std::string_view key, std::size_t count,
                                                   const std::vector<std::string>& variables);
  template <class E>
  std::optional<E> choice(std::string_view key, std::span<const Choice<E>> choices) {
    const JsonValue* v = find(key);
    return v ? reading_.choice(*v, at(key), choices) : std::nullopt;
  }

  void problem(std::string_view key, std::string message) { reading_.problem(at(key), std::move(message)); }
  /// When both keys are there: a problem at `key` that names both.
  void exclude(std::string_view key, std::string_view other, const std::string& why);

 private:
  const JsonValue& value_;
  std::string where_;
  const ObjectInfo& info_;
  Reading& reading_;
};

/// Whether formulas of v agree with all their derivatives to third order at both ends of the range, relative
/// to 1e-8 of their size and the range. A formula with a period (not 0) may also advance by whole periods.
[[nodiscard]] bool closes(const std::vector<std::string>& formulas, Interval v,
                          const std::map<std::string, double>& constants,
                          const std::vector<double>& periods = {});

}  // namespace blendwright
