#pragma once
// The part of JSON Schema 2020-12 that our schemas use, checked by the book; an unknown keyword is an error,
// so that a schema cannot outgrow this validator unseen.
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/json/json_value.hpp"

namespace blendwright::test {

class MiniSchema {
 public:
  explicit MiniSchema(const std::string& text) : root_(parse_json(text)) {}
  [[nodiscard]] const JsonValue& root() const { return root_; }
  /// Every violation, as "pointer: keyword".
  [[nodiscard]] std::vector<std::string> violations(const JsonValue& value) const {
    std::vector<std::string> found;
    check(root_, value, "", found);
    return found;
  }

 private:
  using Found = std::vector<std::string>;

  const JsonValue& resolve(const std::string& ref) const {
    const std::string prefix = "#/$defs/";
    const JsonValue* definitions = root_.find("$defs");
    const JsonValue* target = definitions ? definitions->find(ref.substr(prefix.size())) : nullptr;
    if (ref.rfind(prefix, 0) != 0 || !target) throw std::runtime_error("dangling $ref " + ref);
    return *target;
  }

  static bool same(const JsonValue& a, const JsonValue& b) { return json_text(a) == json_text(b); }

  static bool is_type(const JsonValue& v, const std::string& type) {
    if (type == "null") return v.is_null();
    if (type == "boolean") return v.boolean();
    if (type == "number") return v.number();
    if (type == "integer") return v.number() && *v.number() == std::floor(*v.number());
    if (type == "string") return v.text();
    if (type == "array") return v.items();
    if (type == "object") return v.members();
    throw std::runtime_error("unknown type " + type);
  }

  bool valid(const JsonValue& schema, const JsonValue& v) const {
    Found found;
    check(schema, v, "", found);
    return found.empty();
  }

  std::size_t matches(const JsonValue& schemas, const JsonValue& v) const {
    std::size_t n = 0;
    for (const JsonValue& s : *schemas.items()) n += valid(s, v) ? 1 : 0;
    return n;
  }

  void check(const JsonValue& schema, const JsonValue& v, const std::string& at, Found& found) const {
    for (const JsonMember& m : *schema.members()) {
      const std::string& k = m.key;
      const JsonValue& s = m.value;
      bool good = true;
      if (k == "$schema" || k == "title" || k == "description" || k == "$defs" || k == "then") continue;
      if (k == "$ref")
        check(resolve(*s.text()), v, at, found);
      else if (k == "type")
        good = type_matches(s, v);
      else if (k == "const")
        good = same(s, v);
      else if (k == "enum")
        good = in_list(s, v);
      else if (k == "minimum")
        good = !v.number() || *v.number() >= *s.number();
      else if (k == "maximum")
        good = !v.number() || *v.number() <= *s.number();
      else if (k == "exclusiveMinimum")
        good = !v.number() || *v.number() > *s.number();
      else if (k == "minItems")
        good = !v.items() || static_cast<double>(v.items()->size()) >= *s.number();
      else if (k == "maxItems")
        good = !v.items() || static_cast<double>(v.items()->size()) <= *s.number();
      else if (k == "items")
        check_items(s, v, at, found);
      else if (k == "required")
        good = has_all(s, v);
      else if (k == "properties")
        check_properties(s, v, at, found);
      else if (k == "additionalProperties")
        check_others(schema, s, v, at, found);
      else if (k == "anyOf")
        good = matches(s, v) > 0;
      else if (k == "oneOf")
        good = matches(s, v) == 1;
      else if (k == "allOf")
        check_all(s, v, at, found);
      else if (k == "if")
        check_if(schema, s, v, at, found);
      else
        throw std::runtime_error("keyword not known to the test: " + k);
      if (!good) found.push_back(at + ": " + k);
    }
  }

  static bool type_matches(const JsonValue& s, const JsonValue& v) {
    if (s.text()) return is_type(v, *s.text());
    for (const JsonValue& t : *s.items())
      if (is_type(v, *t.text())) return true;
    return false;
  }
  static bool in_list(const JsonValue& s, const JsonValue& v) {
    for (const JsonValue& option : *s.items())
      if (same(option, v)) return true;
    return false;
  }
  static bool has_all(const JsonValue& s, const JsonValue& v) {
    if (v.members())
      for (const JsonValue& key : *s.items())
        if (!v.find(*key.text())) return false;
    return true;
  }
  void check_items(const JsonValue& s, const JsonValue& v, const std::string& at, Found& found) const {
    if (!v.items()) return;
    for (std::size_t i = 0; i < v.items()->size(); ++i)
      check(s, (*v.items())[i], at + "/" + std::to_string(i), found);
  }
  void check_properties(const JsonValue& s, const JsonValue& v, const std::string& at, Found& found) const {
    if (!v.members()) return;
    for (const JsonMember& p : *v.members())
      if (const JsonValue* property = s.find(p.key)) check(*property, p.value, at + "/" + p.key, found);
  }
  void check_others(const JsonValue& schema, const JsonValue& s, const JsonValue& v, const std::string& at,
                    Found& found) const {
    if (!v.members()) return;
    const JsonValue* properties = schema.find("properties");
    for (const JsonMember& p : *v.members()) {
      if (properties && properties->find(p.key)) continue;
      if (s.boolean()) {
        if (!*s.boolean()) found.push_back(at + "/" + p.key + ": additionalProperties");
      } else {
        check(s, p.value, at + "/" + p.key, found);
      }
    }
  }
  void check_all(const JsonValue& s, const JsonValue& v, const std::string& at, Found& found) const {
    for (const JsonValue& part : *s.items()) check(part, v, at, found);
  }
  void check_if(const JsonValue& schema, const JsonValue& s, const JsonValue& v, const std::string& at,
                Found& found) const {
    if (valid(s, v)) check(*schema.find("then"), v, at, found);
  }

  JsonValue root_;
};

}  // namespace blendwright::test
