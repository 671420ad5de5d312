#include "app/json/scene_adjust.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "app/json/object_reader.hpp"
#include "app/json/scene_keys.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using Type = NodeParam::Type;

bool is_list(const NodeParam& p) { return p.type == Type::point || p.type == Type::numbers; }
bool is_number(const NodeParam& p) { return p.type == Type::number || p.type == Type::number_or_contour; }

const NodeSpec* find_node(const SceneSpec& spec, const std::string& name) {
  const auto found =
      std::find_if(spec.nodes.begin(), spec.nodes.end(), [&](const NodeSpec& n) { return n.name == name; });
  return found == spec.nodes.end() ? nullptr : &*found;
}

std::optional<std::size_t> whole(const std::string& text) {
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(n) : std::nullopt;
}

/// "node/key" or "node/key/index"; names of nodes may have slashes themselves.
std::optional<SceneAdjust> split(const std::string& name) {
  SceneAdjust adjust;
  adjust.name = name;
  std::string rest = name;
  const auto cut = [&]() -> std::optional<std::string> {
    const std::size_t slash = rest.rfind('/');
    if (slash == std::string::npos || slash == 0) return std::nullopt;
    std::string last = rest.substr(slash + 1);
    rest.resize(slash);
    return last;
  };
  auto last = cut();
  if (last) adjust.index = whole(*last);
  if (adjust.index) last = cut();
  if (!last) return std::nullopt;
  adjust.node = rest;
  adjust.key = *last;
  return adjust;
}

/// Reads one entry; every early return has told why, or another check does.
class EntryReader {
 public:
  EntryReader(const JsonMember& entry, std::string where, const SceneSpec& spec, Reading& reading)
      : entry_(entry), where_(std::move(where)), spec_(spec), reading_(reading) {}

  std::optional<SceneAdjust> read() {
    const auto range = reading_.numbers(entry_.value, where_, 2);
    auto adjust = split(entry_.key);
    if (!adjust) {
      problem("is named " + in_quotes(entry_.key) +
              ", must be named NODE/KEY, or NODE/KEY/INDEX for one number of a list");
      return std::nullopt;
    }
    const auto value = value_of(*adjust);
    if (!range || reading_.faulty(where_)) return std::nullopt;
    adjust->range = {(*range)[0], (*range)[1]};
    const Interval r = adjust->range;
    if (!(r.lo < r.hi)) {
      problem("is " + range_text(r) + ", must be the lowest value, then a higher one");
      return std::nullopt;
    }
    if (!value) return std::nullopt;
    if (*value < r.lo || *value > r.hi) {
      problem("is " + range_text(r) + ", must hold the scene's own value, " + number_text(*value));
      return std::nullopt;
    }
    return adjust;
  }

 private:
  void problem(std::string message) { reading_.problem(where_, std::move(message)); }
  static std::string range_text(Interval r) {
    return std::string("[") + number_text(r.lo) + ", " + number_text(r.hi) + "]";
  }

  std::optional<double> value_of(SceneAdjust& adjust) {
    const NodeSpec* node = find_node(spec_, adjust.node);
    if (!node) {
      std::vector<std::string> names;
      for (const NodeSpec& n : spec_.nodes) names.push_back(n.name);
      problem("is about the node " + in_quotes(adjust.node) + ", must be about a node of the scene" +
              suggestion(adjust.node, names));
      return std::nullopt;
    }
    const NodeKind* kind = find_node_kind(node->kind);
    if (!kind) return std::nullopt;
    const NodeParam* param = nullptr;
    std::vector<std::string> numbers;
    for (const NodeParam& p : kind->params) {
      if (p.info.name == adjust.key) param = &p;
      if (is_number(p) || is_list(p)) numbers.emplace_back(p.info.name);
    }
    if (!param || (!is_number(*param) && !is_list(*param))) {
      problem("is about " + in_quotes(adjust.key) + (param ? ", which is " + type_text(*param) : "") +
              "; a " + std::string(kind->name) +
              (numbers.empty() ? " has no number that can be adjusted"
                               : " can be adjusted in " + listed(numbers)) +
              suggestion(adjust.key, numbers));
      return std::nullopt;
    }
    if (is_list(*param) != adjust.index.has_value()) {
      problem(is_list(*param)
                  ? "is about " + type_text(*param) + ", must say which number, as in " +
                        in_quotes(adjust.node + "/" + adjust.key + "/0")
                  : "is about item " + std::to_string(*adjust.index) + " of " + type_text(*param) +
                        ", must be about " + in_quotes(adjust.node + "/" + adjust.key));
      return std::nullopt;
    }
    return is_list(*param) ? item_of(adjust, *node) : number_of(adjust, *node, *param);
  }

  std::optional<double> item_of(const SceneAdjust& adjust, const NodeSpec& node) {
    const auto known = node.values.find(adjust.key);
    const auto* list =
        known == node.values.end() ? nullptr : std::get_if<std::vector<double>>(&known->second);
    if (!list) {  // a list that cannot be read is told where it stands
      if (known == node.values.end() && !reading_.faulty(place_of(node) + "/" + adjust.key))
        problem("is about " + in_quotes(adjust.key) + ", which the node leaves out; write it there first");
      return std::nullopt;
    }
    if (*adjust.index < list->size()) return (*list)[*adjust.index];
    problem("is about item " + std::to_string(*adjust.index) + " of a list of " +
            std::to_string(list->size()) + " numbers; the first is 0");
    return std::nullopt;
  }

  std::optional<double> number_of(SceneAdjust& adjust, const NodeSpec& node, const NodeParam& param) {
    const auto known = node.values.find(adjust.key);
    if (known == node.values.end()) {
      if (std::isnan(param.info.fallback)) return std::nullopt;  // is missing, or could not be read
      if (reading_.faulty(place_of(node) + "/" + adjust.key)) return std::nullopt;
      adjust.fallback = param.info.fallback;
    }
    const double* number =
        known == node.values.end() ? &adjust.fallback : std::get_if<double>(&known->second);
    if (!number) {
      problem("is about " + in_quotes(adjust.key) + ", which varies in space here, must be about a number");
      return std::nullopt;
    }
    limits(param);
    return *number;
  }

  /// What the slider reaches must be what the key may be.
  void limits(const NodeParam& param) {
    const auto* items = entry_.value.items();
    if (!items || items->size() != 2) return;
    for (std::size_t i = 0; i < 2; ++i) {
      if (reading_.faulty(where_)) return;
      const auto end = reading_.number((*items)[i], where_ + "/" + std::to_string(i));
      const bool low = end && (*end < param.info.min || (*end == param.info.min && !param.info.min_allowed));
      if (low || (end && *end > param.info.max))
        reading_.problem(
            where_ + "/" + std::to_string(i),
            "is " + number_text(*end) + ", must be " +
                (low ? std::string(param.info.min_allowed ? ">= " : "> ") + number_text(param.info.min)
                     : std::string("<= ") + number_text(param.info.max)) +
                " as " + in_quotes(std::string(param.info.name)) + " must");
    }
  }

  static std::string place_of(const NodeSpec& node) {
    return node.where.empty() ? "/nodes/" + pointer_part(node.name) : node.where;
  }

  const JsonMember& entry_;
  std::string where_;
  const SceneSpec& spec_;
  Reading& reading_;
};

}  // namespace

std::vector<SceneAdjust> read_adjust(const JsonValue& value, const std::string& where, const SceneSpec& spec,
                                     Reading& reading) {
  std::vector<SceneAdjust> all;
  if (!value.members()) {
    reading.problem(where, described(value) + ", must be an object: {\"NODE/KEY\": [lowest, highest], ...}");
    return all;
  }
  for (const JsonMember& m : *value.members())
    if (auto adjust = EntryReader(m, where + "/" + pointer_part(m.key), spec, reading).read())
      all.push_back(std::move(*adjust));
  return all;
}

double adjusted_number(const SceneSpec& spec, const SceneAdjust& adjust) {
  const NodeSpec* node = find_node(spec, adjust.node);
  if (!node) throw std::logic_error("adjust: no node " + adjust.node);
  const auto known = node->values.find(adjust.key);
  if (known == node->values.end()) return adjust.fallback;
  if (adjust.index) return std::get<std::vector<double>>(known->second).at(*adjust.index);
  return std::get<double>(known->second);
}

SceneSpec with_number(SceneSpec spec, const SceneAdjust& adjust, double value) {
  for (NodeSpec& node : spec.nodes) {
    if (node.name != adjust.node) continue;
    if (adjust.index)
      std::get<std::vector<double>>(node.values.at(adjust.key)).at(*adjust.index) = value;
    else
      node.values[adjust.key] = value;
  }
  return spec;
}

}  // namespace blendwright
