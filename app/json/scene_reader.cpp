#include "app/json/scene_reader.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "app/json/object_reader.hpp"
#include "app/json/scene_keys.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using Type = NodeParam::Type;

constexpr std::string_view shortest_scene = "the shortest scene has \"solid\"";
constexpr std::size_t longest_name = 100;
const std::vector<std::string> formula_variables{"t"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The formula with the constants' values in their places: a scene's description has no constants.
std::string without_constants(const std::string& formula, const std::map<std::string, double>& constants) {
  if (constants.empty()) return formula;
  std::string text;
  for (std::size_t i = 0; i < formula.size();) {
    std::size_t end = i + 1;
    if (is_letter(formula[i])) {
      while (end < formula.size() && (is_letter(formula[end]) || is_digit(formula[end]))) ++end;
      const std::string name = formula.substr(i, end - i);
      const auto known = constants.find(name);
      if (known == constants.end())
        text += name;
      else
        text.append(1, '(').append(number_text(known->second)).append(1, ')');
    } else {
      if (is_digit(formula[i]) || formula[i] == '.') {  // the e of 2e3 is no name
        double ignored = 0.0;
        const char* first = formula.data() + i;
        const char* last = std::from_chars(first, formula.data() + formula.size(), ignored).ptr;
        end = i + std::max<std::size_t>(1, static_cast<std::size_t>(last - first));
      }
      text.append(formula, i, end - i);
    }
    i = end;
  }
  return text;
}

/// Nodes are named by people; a name that starts with "/" would pass for a pointer.
bool good_name(std::string_view name) {
  return !name.empty() && name.size() <= longest_name && name.front() != '/' &&
         printable(name, longest_name) == name;
}

/// Reads the nodes of one scene; what a node means is build_scene()'s business.
class NodesReader {
 public:
  NodesReader(Reading& reading, SceneSpec& spec) : reading_(reading), spec_(spec) {}

  void read_node(const std::string& name, const JsonValue& value, const std::string& where) {
    // In the order of the file: the node before what it holds.
    const std::size_t index = spec_.nodes.size();
    spec_.nodes.push_back({name, "", {}, where});
    if (!value.members())
      return reading_.problem(where, described(value) + ", must be a node: {\"kind\": ..., ...}");
    const JsonValue* kind = value.find("kind");
    if (!kind || !kind->text()) {
      reading_.problem(where + "/kind", (kind ? described(*kind) : "is missing") +
                                            ", must be a kind of node such as \"soft_object\"; \"blendwright "
                                            "list nodes\" shows all");
      return;
    }
    spec_.nodes[index].kind = *kind->text();
    const NodeKind* row = find_node_kind(*kind->text());
    std::map<std::string, NodeValue> values;
    for (const JsonMember& m : *value.members()) {
      if (m.key == "kind") continue;
      const NodeParam* param = nullptr;
      for (const NodeParam& p : row ? row->params : std::span<const NodeParam>{})
        if (p.info.name == m.key) param = &p;
      if (!param) {
        values[m.key] = 0.0;  // build_scene() refuses the key, whatever its value is
      } else if (auto read = read_value(*param, m.value, where + "/" + pointer_part(m.key))) {
        values[m.key] = std::move(*read);
      }
    }
    spec_.nodes[index].values = std::move(values);
  }

  /// A name, or a node in place.
  std::optional<NodeRef> read_reference(const JsonValue& value, const std::string& where) {
    if (const std::string* name = value.text()) return NodeRef{*name};
    if (value.members()) {
      read_node(where, value, where);
      return NodeRef{where};
    }
    reading_.problem(where,
                     described(value) + ", must be the name of a node or a node: {\"kind\": ..., ...}");
    return std::nullopt;
  }

 private:
  std::optional<NodeValue> read_value(const NodeParam& p, const JsonValue& value, const std::string& where) {
    switch (p.type) {
      case Type::number:
      case Type::integer:
        return as_value(reading_.number(value, where));
      case Type::word:
        if (value.text()) return *value.text();
        break;
      case Type::point:
      case Type::numbers:
        if (value.items()) return as_value(reading_.numbers(value, where));
        break;
      case Type::points:
      case Type::rows:
        if (value.items()) return read_rows(*value.items(), where);
        break;
      case Type::formulas:
        if (value.items()) return read_formulas(*value.items(), where);
        break;
      case Type::node:
        return as_value(read_reference(value, where));
      case Type::nodes:
        if (value.items()) return read_references(*value.items(), where);
        break;
      case Type::number_or_contour:
        if (value.members()) return read_contour(value, where);
        return as_value(reading_.number(value, where));
    }
    reading_.problem(where, described(value) + ", must be " + type_text(p));
    return std::nullopt;
  }

  template <class T>
  static std::optional<NodeValue> as_value(std::optional<T> x) {
    return x ? std::optional<NodeValue>(std::move(*x)) : std::nullopt;
  }

  /// `read(item, where)` of every item; nullopt when one has a problem.
  template <class T, class Read>
  static std::optional<NodeValue> read_list(const JsonValue::Array& items, const std::string& where,
                                            Read read) {
    std::vector<T> all;
    for (std::size_t i = 0; i < items.size(); ++i)
      if (auto item = read(items[i], where + "/" + std::to_string(i))) all.push_back(std::move(*item));
    return all.size() == items.size() ? std::optional<NodeValue>(std::move(all)) : std::nullopt;
  }

  std::optional<NodeValue> read_rows(const JsonValue::Array& items, const std::string& where) {
    return read_list<std::vector<double>>(
        items, where, [&](const JsonValue& row, const std::string& at) { return reading_.numbers(row, at); });
  }

  std::optional<NodeValue> read_formulas(const JsonValue::Array& items, const std::string& where) {
    return read_list<std::string>(items, where, [&](const JsonValue& item, const std::string& at) {
      auto formula = reading_.formula(item, at, formula_variables);
      if (formula) *formula = without_constants(*formula, reading_.constants);
      return formula;
    });
  }

  std::optional<NodeValue> read_references(const JsonValue::Array& items, const std::string& where) {
    return read_list<NodeRef>(
        items, where, [&](const JsonValue& item, const std::string& at) { return read_reference(item, at); });
  }

  std::optional<NodeValue> read_contour(const JsonValue& value, const std::string& where) {
    static const ObjectInfo contour{"contour",
                                    "a parameter that varies in space",
                                    {{"contour", "node", "the node of the contour", true}}};
    const ObjectReader object(value, where, contour, reading_);
    const JsonValue* node = object.find("contour");
    return node ? as_value(read_reference(*node, object.at("contour"))) : std::nullopt;
  }

  Reading& reading_;
  SceneSpec& spec_;
};

/// A scene's text and what one reading of it found.
struct ReadText {
  JsonValue root;
  Reading reading;
  SceneSpec spec;
  std::vector<SceneAdjust> adjust;
};

void read_nodes(ObjectReader& object, NodesReader& nodes, Reading& reading) {
  const JsonValue* all = object.find("nodes");
  if (!all) return;
  if (!all->members())
    return object.problem("nodes", described(*all) + ", must be an object: {\"name\": {...}, ...}");
  for (const JsonMember& m : *all->members()) {
    const std::string where = object.at("nodes") + "/" + pointer_part(m.key);
    if (!good_name(m.key))
      reading.problem(where, "is named " + in_quotes(m.key) + "; a name must have 1 to " +
                                 std::to_string(longest_name) +
                                 " bytes, no control characters, and not start with \"/\"");
    nodes.read_node(m.key, m.value, where);
  }
}

ReadText read_text(std::string_view text, const std::string& solid) {
  ReadText read{parse_json(text, shortest_scene), {}, {}, {}};
  ObjectReader object(read.root, "", scene_object(), read.reading);
  if (!read.root.members()) return read;
  SceneSpec& spec = read.spec;
  spec.unit = object.choice("unit", unit_choices()).value_or(LengthUnit::millimetre);
  spec.strict = object.boolean("strict").value_or(true);
  object.text("$schema");
  object.text("description");
  read_constants(object, formula_variables, read.reading);
  NodesReader nodes(read.reading, spec);
  read_nodes(object, nodes, read.reading);
  if (const JsonValue* value = object.find("solid"))
    if (const auto chosen = nodes.read_reference(*value, object.at("solid"))) spec.solid = chosen->name;
  if (!solid.empty()) spec.solid = solid;
  if (const JsonValue* value = object.find("adjust"))
    read.adjust = read_adjust(*value, object.at("adjust"), spec, read.reading);
  return read;
}

/// Adds what build_scene() says of a scene that has problems already: all are told at once.
void add_scene_problems(ReadText& read) {
  // Without nodes every name would be unknown.
  if (read.spec.nodes.empty() || read.reading.told("/nodes")) return;
  try {
    static_cast<void>(build_scene(read.spec));
  } catch (const InputError& e) {
    read.reading.add(e);
  }
}

SceneSpec finished(ReadText& read) {
  if (!read.reading.empty()) add_scene_problems(read);
  read.reading.finish(read.root);
  return std::move(read.spec);
}

void require_node(const SceneSpec& spec, const std::string& name) {
  std::vector<std::string> names;
  for (const NodeSpec& node : spec.nodes) {
    if (node.name == name) return;
    if (node.name.front() != '/') names.push_back(node.name);
  }
  throw InputError("--solid", "is " + in_quotes(name) + ", must be the name of a node of the scene" +
                                  suggestion(name, names));
}

}  // namespace

SceneSpec read_scene(std::string_view text) {
  ReadText read = read_text(text, "");
  return finished(read);
}

SceneSpec read_scene_file(const std::filesystem::path& file) { return read_scene(read_json_text(file)); }

SceneFile build_scene_text(std::string_view text, const std::filesystem::path& file,
                           const std::string& solid) {
  ReadText read = read_text(text, solid);
  SceneSpec spec = finished(read);
  if (!solid.empty()) require_node(spec, solid);
  try {
    Scene scene = build_scene(spec);
    return {file == "-" ? "scene" : file.stem().string(), hash_text(text), std::move(spec), std::move(scene),
            std::move(read.adjust)};
  } catch (const InputError& e) {
    read.reading.add(e);
    read.reading.finish(read.root);
    throw;
  }
}

SceneFile build_scene_file(const std::filesystem::path& file, const std::string& solid) {
  return build_scene_text(read_json_text(file), file, solid);
}

}  // namespace blendwright
