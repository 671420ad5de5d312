#include "app/json/json_value.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

void write_string(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\r':
        out += "\\r";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) {
          const char hex[] = "0123456789abcdef";
          out += "\\u00";
          out += hex[(c >> 4) & 15];
          out += hex[c & 15];
        } else {
          out += c;
        }
    }
  }
  out += '"';
}

/// Bytes of the UTF-8 character that the text starts with; 0 when it starts with none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  // Overlong forms, surrogates, and beyond the last code point.
  const bool none = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) >= 0xA0) ||
                    (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) >= 0x90);
  return none ? 0 : length;
}

bool plain(const JsonValue& v) { return !v.items() && !v.members(); }

void write(std::string& out, const JsonValue& v, std::size_t level);

void new_line(std::string& out, std::size_t level) {
  out += '\n';
  out.append(2 * level, ' ');
}

void write_array(std::string& out, const JsonValue::Array& items, std::size_t level) {
  const bool one_line = std::all_of(items.begin(), items.end(), plain);
  out += '[';
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out += one_line ? ", " : ",";
    if (!one_line) new_line(out, level + 1);
    write(out, items[i], level + 1);
  }
  if (!one_line) new_line(out, level);
  out += ']';
}

void write_object(std::string& out, const JsonValue::Object& members, std::size_t level) {
  out += '{';
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (i > 0) out += ',';
    new_line(out, level + 1);
    write_string(out, members[i].key);
    out += ": ";
    write(out, members[i].value, level + 1);
  }
  if (!members.empty()) new_line(out, level);
  out += '}';
}

void write(std::string& out, const JsonValue& v, std::size_t level) {
  if (const auto* b = v.boolean()) {
    out += *b ? "true" : "false";
  } else if (const auto* x = v.number()) {
    out += std::isfinite(*x) ? number_text(*x) : "null";
  } else if (const auto* t = v.text()) {
    write_string(out, *t);
  } else if (const auto* items = v.items()) {
    write_array(out, *items, level);
  } else if (const auto* members = v.members()) {
    write_object(out, *members, level);
  } else {
    out += "null";
  }
}

}  // namespace

JsonValue::JsonValue(Array items) : value(std::move(items)) {}
JsonValue::JsonValue(Object members) : value(std::move(members)) {}
JsonValue JsonValue::array(std::initializer_list<JsonValue> items) { return JsonValue(Array(items)); }
JsonValue JsonValue::object(std::initializer_list<JsonMember> members) { return JsonValue(Object(members)); }

const JsonValue* JsonValue::find(std::string_view key) const {
  if (const Object* all = members())
    for (const JsonMember& m : *all)
      if (m.key == key) return &m.value;
  return nullptr;
}

JsonValue& JsonValue::add(std::string key, JsonValue member) {
  if (is_null()) value = Object();
  auto& all = std::get<Object>(value);
  all.push_back({std::move(key), std::move(member)});
  return all.back().value;
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string shown;
  std::size_t at = 0;
  for (std::size_t count = 0; at < text.size() && count < limit; ++count) {
    const std::size_t length = character_length(text.substr(at));
    const auto first = static_cast<unsigned char>(text[at]);
    const bool control = first < 0x20 || first == 0x7f ||
                         (length == 2 && first == 0xC2 && static_cast<unsigned char>(text[at + 1]) < 0xA0);
    if (length == 0 || control)
      shown += '?';
    else
      shown += text.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  if (at < text.size()) shown += "...";
  return shown;
}

std::string in_quotes(std::string_view text, std::size_t limit) {
  std::string quoted(1, '"');
  quoted += printable(text, limit);
  return quoted += '"';
}

std::string described(const JsonValue& value) {
  if (const auto* b = value.boolean()) return *b ? "is true" : "is false";
  if (const auto* x = value.number()) return "is " + number_text(*x);
  if (const auto* t = value.text()) return "is " + in_quotes(*t);
  if (const auto* items = value.items())
    return "is a list of " + std::to_string(items->size()) + (items->size() == 1 ? " value" : " values");
  return value.members() ? "is an object" : "is null";
}

std::string pointer_part(std::string_view key) {
  std::string part;
  for (const char c : printable(key, 100)) {
    if (c == '~')
      part += "~0";
    else if (c == '/')
      part += "~1";
    else
      part += c;
  }
  return part;
}

std::string json_text(const JsonValue& value) {
  std::string out;
  write(out, value, 0);
  out += '\n';
  return out;
}

}  // namespace blendwright
