#pragma once
// A JSON document as a plain value, so that only the parser's .cpp sees a JSON library.
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace blendwright {

struct JsonMember;

/// null, true or false, a number, a text, an array, or an object whose members keep the order of the file.
struct JsonValue {
  using Array = std::vector<JsonValue>;
  using Object = std::vector<JsonMember>;
  std::variant<std::monostate, bool, double, std::string, Array, Object> value;

  JsonValue() = default;
  JsonValue(bool b) : value(b) {}                                 // NOLINT: literals of a report
  JsonValue(double x) : value(x) {}                               // NOLINT
  JsonValue(int n) : value(static_cast<double>(n)) {}             // NOLINT
  JsonValue(std::size_t n) : value(static_cast<double>(n)) {}     // NOLINT
  JsonValue(std::string text) : value(std::move(text)) {}         // NOLINT
  JsonValue(std::string_view text) : value(std::string(text)) {}  // NOLINT
  JsonValue(const char* text) : value(std::string(text)) {}       // NOLINT
  JsonValue(Array items);                                         // NOLINT
  JsonValue(Object members);                                      // NOLINT
  [[nodiscard]] static JsonValue array(std::initializer_list<JsonValue> items);
  [[nodiscard]] static JsonValue object(std::initializer_list<JsonMember> members);

  [[nodiscard]] bool is_null() const { return value.index() == 0; }
  [[nodiscard]] const bool* boolean() const { return std::get_if<bool>(&value); }
  [[nodiscard]] const double* number() const { return std::get_if<double>(&value); }
  [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&value); }
  [[nodiscard]] const Array* items() const { return std::get_if<Array>(&value); }
  [[nodiscard]] const Object* members() const { return std::get_if<Object>(&value); }
  /// The member's value, or nullptr when this is no object or has no such member.
  [[nodiscard]] const JsonValue* find(std::string_view key) const;
  /// Adds a member to an object (null becomes an object); returns the new value.
  JsonValue& add(std::string key, JsonValue member);
};

struct JsonMember {
  std::string key;
  JsonValue value;
};

/// "is 3", "is "text"", "is an object": how an error message names the value; long texts are cut.
[[nodiscard]] std::string described(const JsonValue& value);
/// At most `limit` characters of UTF-8; control characters and bytes that are no UTF-8 become "?", and "..."
/// stands for the rest.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit);
/// `text` in quotes, as printable() gives it.
[[nodiscard]] std::string in_quotes(std::string_view text, std::size_t limit = 60);
/// A key as a part of a JSON pointer ("/" and "~" escaped).
[[nodiscard]] std::string pointer_part(std::string_view key);

/// The document as text: two blanks per level, short arrays of numbers on one line, shortest round-trip
/// numbers; NaN and infinity become null.
[[nodiscard]] std::string json_text(const JsonValue& value);

inline constexpr std::size_t largest_json_text = std::size_t{64} << 20;
inline constexpr std::size_t deepest_json = 64;
inline constexpr std::size_t most_json_values = 5'000'000;

/// Parses JSON with comments. Throws InputError: text over 64 MB, nesting over 64 levels, more than five
/// million values, a syntax error (line and column), invalid UTF-8, a key that appears twice in an object
/// (JSON pointers, all of them), empty text (`shortest` says what a document has at least).
[[nodiscard]] JsonValue parse_json(std::string_view text, std::string_view shortest = "");

/// The text of a file ("-": standard input). Throws IoError when it cannot be read, InputError when it is
/// larger than 64 MB.
[[nodiscard]] std::string read_json_text(const std::filesystem::path& file);

}  // namespace blendwright
