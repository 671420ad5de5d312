#include "app/json/scene_writer.hpp"

#include "app/json/json_places.hpp"
#include "app/json/object_reader.hpp"
#include "app/json/scene_adjust.hpp"
#include "app/json/scene_keys.hpp"
#include "app/json/scene_reader.hpp"

namespace blendwright {
namespace {

/// Keys and list indices of a JSON pointer.
JsonEdit::Path path_of(const std::string& pointer) {
  JsonEdit::Path path;
  std::string part;
  for (std::size_t i = 1; i <= pointer.size(); ++i) {
    if (i == pointer.size() || pointer[i] == '/') {
      path.push_back(std::move(part));
      part.clear();
    } else if (pointer[i] == '~' && i + 1 < pointer.size()) {
      part += pointer[++i] == '1' ? '/' : '~';
    } else {
      part += pointer[i];
    }
  }
  return path;
}

JsonValue json_of(const NodeValue& value) {
  if (const double* x = std::get_if<double>(&value)) return *x;
  JsonValue::Array items;
  for (const double x : std::get<std::vector<double>>(value)) items.emplace_back(x);
  return items;
}

void write_nodes(JsonEdit& edit, const SceneSpec& before, const SceneSpec& after) {
  for (std::size_t i = 0; i < after.nodes.size(); ++i) {
    const NodeSpec &old = before.nodes.at(i), &node = after.nodes[i];
    const JsonEdit::Path at = path_of(node.where.empty() ? "/nodes/" + pointer_part(node.name) : node.where);
    const auto below = [&](const std::string& key) {
      JsonEdit::Path path = at;
      path.push_back(key);
      return path;
    };
    for (const auto& [key, value] : node.values)
      if (const auto known = old.values.find(key); known == old.values.end() || known->second != value)
        edit.set(below(key), json_of(value));
    for (const auto& [key, value] : old.values)
      if (!node.values.contains(key)) edit.remove(below(key));
  }
}

void widen_ranges(JsonEdit& edit, const std::vector<SceneAdjust>& adjust, const SceneSpec& after) {
  for (const SceneAdjust& a : adjust) {
    const double value = adjusted_number(after, a);
    if (value < a.range.lo) edit.set({"adjust", a.name, "0"}, value);
    if (value > a.range.hi) edit.set({"adjust", a.name, "1"}, value);
  }
}

}  // namespace

std::string scene_text(const std::string& text, const SceneSpec& changed) {
  const SceneSpec before = read_scene(text);
  if (before == changed) return text;
  const JsonValue root = parse_json(text);
  Reading reading;
  ObjectReader object(root, "", scene_object(), reading);
  read_constants(object, {"t"}, reading);
  JsonEdit edit(text, json_place(text).begin, [&](const JsonValue& value) {
    Reading formula;
    formula.constants = reading.constants;
    const auto x = value.text() ? formula.number(value, "") : std::nullopt;
    return x ? JsonValue(*x) : value;
  });
  write_nodes(edit, before, changed);
  if (const JsonValue* adjust = object.find("adjust"))
    widen_ranges(edit, read_adjust(*adjust, "/adjust", before, reading), changed);
  if (read_scene(edit.text()) != changed)
    throw InputError("", "cannot be written: the changed text would read as another scene");
  return edit.text();
}

}  // namespace blendwright
