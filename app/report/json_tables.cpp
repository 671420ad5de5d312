#include "app/report/json_tables.hpp"

#include <algorithm>
#include <cmath>

#include "app/json/report_objects.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

std::string figure_text(double x) {
  if (std::abs(x) < 1e15 && x == std::round(x)) return number_text(x);
  return number_text(x, 6);
}

bool nested(const JsonValue& value) {
  if (value.members()) return true;
  const JsonValue::Array* items = value.items();
  return items && std::any_of(items->begin(), items->end(), [](const JsonValue& v) { return nested(v); });
}

const ObjectInfo* object_named(std::string_view name) {
  const auto& all = report_objects();
  const auto at = std::find_if(all.begin(), all.end(), [&](const ObjectInfo& o) { return o.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::string meaning(const ObjectInfo* info, const std::string& key) {
  if (!info) return "";
  for (const auto& k : info->keys)
    if (k.name == key) return std::string(k.description);
  return "";
}

}  // namespace

std::string cell_text(const JsonValue& value) {
  if (const bool* yes = value.boolean()) return *yes ? "yes" : "no";
  if (const double* x = value.number()) return figure_text(*x);
  if (const std::string* text = value.text()) return *text;
  if (const JsonValue::Array* items = value.items()) {
    std::string text;
    for (const JsonValue& item : *items) {
      if (!text.empty()) text += ", ";
      if (item.items())
        text.append("(").append(cell_text(item)).append(")");
      else
        text += cell_text(item);
    }
    return text.empty() ? "none" : text;
  }
  return "none";
}

const JsonValue& member(const JsonValue& object, std::string_view key) {
  static const JsonValue none;
  const JsonValue* found = object.find(key);
  return found ? *found : none;
}

PageTable member_table(std::string caption, const JsonValue& object, std::string_view object_name) {
  const ObjectInfo* info = object_named(object_name);
  PageTable table{std::move(caption), {{"what", "value"}}};
  if (info) table.rows[0].push_back("meaning");
  if (!object.members()) return table;
  for (const JsonMember& m : *object.members()) {
    if (nested(m.value)) continue;
    std::string words = m.key;
    std::replace(words.begin(), words.end(), '_', ' ');
    std::vector<std::string> row{words, cell_text(m.value)};
    if (info) row.push_back(meaning(info, m.key));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace blendwright::detail
