// The only file that sees the JSON library.
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_set>

#include "app/json/json_value.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"

namespace blendwright {
namespace {

std::string place(std::string_view text, std::size_t position) {
  const std::string_view before = text.substr(0, std::min(position, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n');
  const std::size_t column = start == std::string_view::npos ? before.size() : before.size() - start - 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(std::max<std::size_t>(column, 1));
}

/// Calls see(position, character) for everything that is no blank and no comment; a text is its first quote.
template <class See>
void for_each_symbol(std::string_view text, See see) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '/' && i + 1 < text.size() && text[i + 1] == '/') {
      i = std::min(text.find('\n', i), text.size());
    } else if (c == '/' && i + 1 < text.size() && text[i + 1] == '*') {
      const std::size_t end = text.find("*/", i + 2);
      i = end == std::string_view::npos ? text.size() : end + 1;
    } else if (c != ' ' && c != '\t' && c != '\r' && c != '\n') {
      see(i, c);
      if (c != '"') continue;
      for (++i; i < text.size() && text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
    }
  }
}

/// Refuses what would exhaust a parser's stack, before there is one: brackets outside of texts and comments.
void refuse_deep_nesting(std::string_view text) {
  std::size_t depth = 0;
  for_each_symbol(text, [&](std::size_t i, char c) {
    if (c == '[' || c == '{') {
      if (++depth > deepest_json)
        throw InputError("", place(text, i + 1) + ": nested deeper than " + std::to_string(deepest_json) +
                                 " levels, the limit");
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  });
}

/// The comma before the bracket that closes at `end` (one past it), when it has one.
std::optional<std::size_t> comma_before_bracket(std::string_view text, std::size_t end) {
  if (end == 0 || end > text.size() || (text[end - 1] != '}' && text[end - 1] != ']')) return std::nullopt;
  std::optional<std::size_t> comma;
  for_each_symbol(text.substr(0, end - 1),
                  [&](std::size_t i, char c) { comma = c == ',' ? std::optional(i) : std::nullopt; });
  return comma;
}

/// What the library says went wrong, without its preamble.
std::string reason(std::string text) {
  for (const char* mark : {" - ", "] "}) {
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) continue;
    text.erase(0, at + std::string_view(mark).size());
    break;
  }
  return printable(text, 160);
}

/// Builds the value while the library reads; the library's own document (which drops repeated keys) is not
/// made.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Builder(std::string_view text) : text_(text) {}

  bool null() override { return put(JsonValue()); }
  bool boolean(bool b) override { return put(JsonValue(b)); }
  bool number_integer(number_integer_t n) override { return put(JsonValue(static_cast<double>(n))); }
  bool number_unsigned(number_unsigned_t n) override { return put(JsonValue(static_cast<double>(n))); }
  bool number_float(number_float_t x, const string_t&) override { return put(JsonValue(x)); }
  bool string(string_t& s) override { return put(JsonValue(std::move(s))); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(JsonValue(JsonValue::Object())); }
  bool start_array(std::size_t) override { return open(JsonValue(JsonValue::Array())); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& k) override {
    Level& level = levels_.back();
    level.key = k;
    if (!level.seen.insert(k).second && repeated_.size() < 100)
      repeated_.push_back({pointer(), "appears twice in this object; keep one of them"});
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    if (const auto comma = comma_before_bracket(text_, position))
      throw InputError("", place(text_, *comma + 1) + ": a comma before '}' or ']' is one too many");
    std::string why = reason(error.what());
    const auto says = [&](const char* words) { return why.find(words) != std::string::npos; };
    if (says("invalid literal") && token.find_first_of("NI") != std::string::npos)
      why += "; NaN and Infinity are no numbers in JSON";
    else if (says("expected '}'") || says("expected ']'"))
      why += says("end of input") ? "" : "; is a comma missing?";
    throw InputError("", place(text_, position) + ": " + why);
  }

  JsonValue result() {
    if (!repeated_.empty()) throw InputError(std::move(repeated_));
    return std::move(root_);
  }

 private:
  struct Level {
    JsonValue value;
    std::string key;                       // of the member being read
    std::unordered_set<std::string> seen;  // keys of this object
  };

  [[nodiscard]] std::string pointer() const {
    std::string path;
    for (const Level& level : levels_) {
      const auto* items = level.value.items();
      path += '/';
      path += items ? std::to_string(items->size()) : pointer_part(level.key);
    }
    return path;
  }

  bool put(JsonValue value) {
    if (++values_ > most_json_values)
      throw InputError(levels_.empty() ? "" : pointer(),
                       "more than " + std::to_string(most_json_values) + " values in one file, the limit");
    if (levels_.empty()) {
      root_ = std::move(value);
    } else if (auto* items = std::get_if<JsonValue::Array>(&levels_.back().value.value)) {
      items->push_back(std::move(value));
    } else {
      levels_.back().value.add(std::move(levels_.back().key), std::move(value));
    }
    return true;
  }

  bool open(JsonValue container) {
    levels_.push_back({std::move(container), {}, {}});
    return true;
  }

  bool close() {
    JsonValue done = std::move(levels_.back().value);
    levels_.pop_back();
    return put(std::move(done));
  }

  std::string_view text_;
  JsonValue root_;
  std::vector<Level> levels_;
  std::vector<Problem> repeated_;
  std::size_t values_ = 0;
};

[[noreturn]] void refuse_size() {
  throw InputError("", "is larger than " + std::to_string(largest_json_text >> 20) + " MB, the limit");
}

}  // namespace

std::string read_json_text(const std::filesystem::path& file) {
  if (file == "-") {
    std::string text;
    for (char block[65536]; std::cin.read(block, sizeof block), std::cin.gcount() > 0;) {
      text.append(block, static_cast<std::size_t>(std::cin.gcount()));
      if (text.size() > largest_json_text) refuse_size();
    }
    return text;
  }
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  if (!error && bytes > largest_json_text) refuse_size();
  return read_text_file(file, largest_json_text);
}

JsonValue parse_json(std::string_view text, std::string_view shortest) {
  if (text.size() > largest_json_text) refuse_size();
  if (text.find_first_not_of(" \t\r\n\xEF\xBB\xBF") == std::string_view::npos)
    throw InputError("", shortest.empty() ? "is empty" : "is empty; " + std::string(shortest));
  if (text.size() > 1 && (text.substr(0, 2) == "\xFF\xFE" || text.substr(0, 2) == "\xFE\xFF"))
    throw InputError("", "is in UTF-16, must be in UTF-8");
  refuse_deep_nesting(text);
  Builder builder(text);
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder, nlohmann::detail::input_format_t::json, true,
                            true);
  return builder.result();
}

}  // namespace blendwright
