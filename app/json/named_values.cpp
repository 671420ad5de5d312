#include <algorithm>
#include <cctype>

#include "app/json/object_reader.hpp"
#include "kernel/math/formula.hpp"

namespace blendwright {
namespace {

bool good_name(const std::string& name) {
  return !name.empty() && name.size() <= 60 && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
  });
}

bool parses(const std::string& formula, const std::map<std::string, double>& constants) {
  try {
    [[maybe_unused]] const Formula parsed(formula, {}, constants);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// What is wrong with the name of a constant: a formula must read it as this constant and nothing else.
std::string constant_name_problem(const std::string& name, const std::vector<std::string>& variables) {
  const bool variable = std::find(variables.begin(), variables.end(), name) != variables.end();
  if (variable || name == "pi" || parses(name + "(1)", {}) || parses(name + "(1, 1)", {}))
    return ", which formulas use already; choose another name";
  if (parses(name, {{name, 1.5}}) && (name == "e" || !parses(name, {}))) return "";
  return "; the name of a constant must be a letter, then letters, digits or \"_\"";
}

}  // namespace

const JsonValue::Object& named(ObjectReader& object, const char* key, Reading& reading) {
  static const JsonValue::Object none;
  const JsonValue* value = object.find(key);
  if (!value) return none;
  const auto* members = value->members();
  if (!members) {
    object.problem(key, described(*value) + ", must be an object: {\"name\": {...}, ...}");
    return none;
  }
  for (const JsonMember& m : *members)
    if (!good_name(m.key))
      reading.problem(object.at(key) + "/" + pointer_part(m.key),
                      "is named " + in_quotes(m.key) +
                          "; a name must be 1 to 60 of the letters a-z and A-Z, digits, \"_\" and \"-\"");
  return *members;
}

void read_constants(ObjectReader& object, const std::vector<std::string>& variables, Reading& reading) {
  for (const JsonMember& m : named(object, "let", reading)) {
    const std::string where = object.at("let") + "/" + pointer_part(m.key);
    const auto value = reading.number(m.value, where);
    if (!good_name(m.key)) continue;
    const std::string trouble = constant_name_problem(m.key, variables);
    if (!trouble.empty())
      reading.problem(where, "is named " + in_quotes(m.key) + trouble);
    else if (value)
      reading.constants[m.key] = *value;
  }
}

}  // namespace blendwright
