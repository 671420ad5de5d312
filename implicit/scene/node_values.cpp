#include "implicit/scene/node_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

using Type = NodeParam::Type;

std::string count_text(std::size_t n) { return std::to_string(n); }
std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + quoted(names[i]);
  return text;
}

/// "> 0", ">= 0 and <= 1", "<= 5"; empty: every number.
std::string bounds_text(const ParamInfo& p) {
  const double huge = std::numeric_limits<double>::max();
  const std::string low =
      p.min > -huge ? std::string(p.min_allowed ? ">= " : "> ") + number_text(p.min) : std::string();
  const std::string high = p.max < huge ? "<= " + number_text(p.max) : std::string();
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

std::string number_requirement(const NodeParam& p) {
  const std::string bounds = bounds_text(p.info);
  const std::string whole = p.type == Type::integer ? "a whole number" : "";
  if (bounds.empty()) return whole.empty() ? "a number" : whole;
  return whole.empty() ? bounds : whole + ' ' + bounds;
}

/// What a value of the parameter must be.
std::string requirement(const NodeParam& p) {
  const std::string n = count_text(p.count);
  switch (p.type) {
    case Type::number:
    case Type::integer:
      return number_requirement(p);
    case Type::word:
      return listed({p.words.begin(), p.words.end()});
    case Type::point:
      return "a point [x, y, z]";
    case Type::points:
      return "a list of at least one point [x, y, z]";
    case Type::numbers:
      return p.count == 0 ? "a list of at least one number" : "a list of " + n + " numbers";
    case Type::rows:
      return n + " rows of " + count_text(p.columns) + " numbers";
    case Type::formulas:
      return "a list of " + n + " formulas of t";
    case Type::node:
      return "a node";
    case Type::nodes:
      return "a list of at least " + count_text(std::max<std::size_t>(p.count, 1)) +
             (p.count > 1 ? " nodes" : " node");
    case Type::number_or_contour:
      return number_requirement(p) + ", or {\"contour\": a node}";
  }
  throw std::logic_error("type of a node's parameter");
}

/// What a value is, for messages.
std::string described(const NodeValue& value) {
  struct {
    std::string operator()(double x) const { return "is " + number_text(x); }
    std::string operator()(const std::string& s) const { return "is " + quoted(s); }
    std::string operator()(const std::vector<double>& v) const {
      return "is a list of " + count_text(v.size()) + (v.size() == 1 ? " number" : " numbers");
    }
    std::string operator()(const std::vector<std::vector<double>>& v) const {
      return "is a list of " + count_text(v.size()) + (v.size() == 1 ? " row" : " rows");
    }
    std::string operator()(const std::vector<std::string>& v) const {
      return "is a list of " + count_text(v.size()) + (v.size() == 1 ? " text" : " texts");
    }
    std::string operator()(const NodeRef& r) const { return "is the node " + quoted(r.name); }
    std::string operator()(const std::vector<NodeRef>& v) const {
      return "is a list of " + count_text(v.size()) + (v.size() == 1 ? " node" : " nodes");
    }
  } text;
  return std::visit(text, value);
}

/// Checks the values of one node.
class Checker {
 public:
  Checker(const NodeSpec& spec, const NodeKind& kind) : spec_(spec), kind_(kind) {}

  ValueCheck run() {
    check_keys();
    for (const NodeParam& p : kind_.params) {
      const auto at = spec_.values.find(std::string(p.info.name));
      if (at != spec_.values.end())
        check(p, at->second);
      else if (required(p))
        problem(p, "is missing, must be " + requirement(p));
    }
    return std::move(result_);
  }

 private:
  static bool required(const NodeParam& p) {
    const bool numeric =
        p.type == Type::number || p.type == Type::integer || p.type == Type::number_or_contour;
    return numeric ? std::isnan(p.info.fallback) : p.required;
  }

  void problem(const NodeParam& p, std::string message, const std::string& below = {}) {
    result_.problems.push_back({std::string(p.info.name) + below, std::move(message)});
  }
  void wrong(const NodeParam& p, const NodeValue& value) {
    problem(p, described(value) + ", must be " + requirement(p));
  }
  static std::string invalid(const std::string& message) {
    return std::string(scene_error::invalid_parameter) + ": " + message;
  }

  void check_keys() {
    std::vector<std::string> known;
    for (const NodeParam& p : kind_.params) known.emplace_back(p.info.name);
    for (const auto& [key, value] : spec_.values) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      const std::string near = suggestion(key, known);
      result_.problems.push_back(
          {pointer_token(key), "unknown key" + (near.empty() ? "; may be " + listed(known) : near)});
    }
  }

  void check(const NodeParam& p, const NodeValue& value) {
    switch (p.type) {
      case Type::number:
      case Type::integer:
        return check_number(p, value);
      case Type::word:
        return check_word(p, value);
      case Type::point:
        return check_list(p, value, 3);
      case Type::numbers:
        return check_list(p, value, p.count);
      case Type::points:
        return check_rows(p, value, 0, 3);
      case Type::rows:
        return check_rows(p, value, p.count, p.columns);
      case Type::formulas:
        return check_formulas(p, value);
      case Type::node:
        return check_node(p, value, "");
      case Type::nodes:
        return check_nodes(p, value);
      case Type::number_or_contour:
        if (std::holds_alternative<NodeRef>(value)) return check_node(p, value, "/contour");
        return check_number(p, value);
    }
  }

  void check_number(const NodeParam& p, const NodeValue& value) {
    const double* x = std::get_if<double>(&value);
    if (!x) return wrong(p, value);
    const bool in_bounds =
        std::isfinite(*x) && (p.info.min_allowed ? *x >= p.info.min : *x > p.info.min) && *x <= p.info.max;
    if (!in_bounds || (p.type == Type::integer && *x != std::floor(*x)))
      problem(p, invalid("is " + number_text(*x) + ", must be " + requirement(p)));
  }

  void check_word(const NodeParam& p, const NodeValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    if (!text) return wrong(p, value);
    if (std::find(p.words.begin(), p.words.end(), *text) != p.words.end()) return;
    problem(p, described(value) + ", must be " + requirement(p) +
                   suggestion(*text, {p.words.begin(), p.words.end()}));
  }

  void check_finite(const NodeParam& p, const std::vector<double>& v, const std::string& below) {
    for (std::size_t i = 0; i < v.size(); ++i)
      if (!std::isfinite(v[i]))
        problem(p, invalid("is " + number_text(v[i]) + ", must be a finite number"),
                below + '/' + count_text(i));
  }

  void check_list(const NodeParam& p, const NodeValue& value, std::size_t count) {
    const auto* v = std::get_if<std::vector<double>>(&value);
    if (!v || v->empty() || (count != 0 && v->size() != count)) return wrong(p, value);
    check_finite(p, *v, "");
  }

  void check_rows(const NodeParam& p, const NodeValue& value, std::size_t count, std::size_t columns) {
    const auto* v = std::get_if<std::vector<std::vector<double>>>(&value);
    if (!v || v->empty() || (count != 0 && v->size() != count)) return wrong(p, value);
    for (std::size_t i = 0; i < v->size(); ++i) {
      const std::string below = '/' + count_text(i);
      if ((*v)[i].size() != columns)
        problem(p, "has " + count_text((*v)[i].size()) + " numbers, must have " + count_text(columns), below);
      else
        check_finite(p, (*v)[i], below);
    }
  }

  void check_formulas(const NodeParam& p, const NodeValue& value) {
    const auto* v = std::get_if<std::vector<std::string>>(&value);
    if (!v || v->size() != p.count) wrong(p, value);
  }

  void link(const NodeParam& p, const std::string& below, const std::string& name) {
    result_.links.push_back({p.info.name, std::string(p.info.name) + below, name});
  }
  void check_node(const NodeParam& p, const NodeValue& value, const std::string& below) {
    if (const auto* ref = std::get_if<NodeRef>(&value)) return link(p, below, ref->name);
    if (const auto* name = std::get_if<std::string>(&value)) return link(p, below, *name);
    wrong(p, value);
  }
  void check_nodes(const NodeParam& p, const NodeValue& value) {
    std::vector<std::string> names;
    if (const auto* refs = std::get_if<std::vector<NodeRef>>(&value))
      for (const NodeRef& r : *refs) names.push_back(r.name);
    else if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
      names = *texts;
    if (names.size() < std::max<std::size_t>(p.count, 1)) return wrong(p, value);
    for (std::size_t i = 0; i < names.size(); ++i) link(p, '/' + count_text(i), names[i]);
  }

  const NodeSpec& spec_;
  const NodeKind& kind_;
  ValueCheck result_;
};

}  // namespace

ValueCheck check_values(const NodeSpec& spec, const NodeKind& kind) { return Checker(spec, kind).run(); }

const NodeParam* find_param(const NodeKind& kind, std::string_view key) {
  for (const NodeParam& p : kind.params)
    if (p.info.name == key) return &p;
  return nullptr;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() < 2) return "";  // every letter is near every other
  const auto nearest = nearest_word(word, known.data(), known.size());
  return nearest ? "; did you mean " + quoted(*nearest) + "?" : std::string();
}

std::string pointer_token(std::string_view name) {
  std::string token;
  for (const char c : name) {
    if (c == '~')
      token += "~0";
    else if (c == '/')
      token += "~1";
    else
      token += c;
  }
  return token;
}

std::string pointer_of(const NodeSpec& spec) {
  return spec.where.empty() ? "/nodes/" + pointer_token(spec.name) : spec.where;
}

template <class V>
const V* CheckedInputs::find(std::string_view key) const {
  const auto at = spec_.values.find(std::string(key));
  return at == spec_.values.end() ? nullptr : std::get_if<V>(&at->second);
}

bool CheckedInputs::has(std::string_view key) const { return spec_.values.contains(std::string(key)); }

double CheckedInputs::number(std::string_view key) const {
  if (const double* x = find<double>(key)) return *x;
  const NodeParam* p = find_param(kind_, key);
  if (!p) throw std::logic_error("a kind of node reads a key that it does not have: " + std::string(key));
  return p->info.fallback;
}

std::size_t CheckedInputs::word(std::string_view key) const {
  const auto* text = find<std::string>(key);
  const NodeParam* p = find_param(kind_, key);
  if (!text || !p) return 0;
  return static_cast<std::size_t>(std::find(p->words.begin(), p->words.end(), *text) - p->words.begin());
}

const std::vector<double>& CheckedInputs::numbers(std::string_view key) const {
  static const std::vector<double> none;
  const auto* v = find<std::vector<double>>(key);
  return v ? *v : none;
}

const std::vector<std::vector<double>>& CheckedInputs::rows(std::string_view key) const {
  static const std::vector<std::vector<double>> none;
  const auto* v = find<std::vector<std::vector<double>>>(key);
  return v ? *v : none;
}

const std::vector<std::string>& CheckedInputs::formulas(std::string_view key) const {
  static const std::vector<std::string> none;
  const auto* v = find<std::vector<std::string>>(key);
  return v ? *v : none;
}

std::shared_ptr<const Node> CheckedInputs::node(std::string_view key) const {
  for (const Link& link : links_)
    if (link.key == key) return link.node;
  return nullptr;
}

std::vector<std::shared_ptr<const Node>> CheckedInputs::nodes(std::string_view key) const {
  std::vector<std::shared_ptr<const Node>> found;
  for (const Link& link : links_)
    if (link.key == key) found.push_back(link.node);
  return found;
}

std::shared_ptr<const Node> CheckedInputs::contour(std::string_view key) const { return node(key); }

void CheckedInputs::problem(std::string_view key, std::string_view name, std::string message, int index) {
  std::string where(key);
  if (index >= 0) where += '/' + number_text(index);
  problems_.push_back(
      {std::move(where), name.empty() ? std::move(message) : std::string(name) + ": " + message});
}

void CheckedInputs::warning(std::string_view key, std::string message) {
  warnings_.push_back({std::string(key), std::move(message)});
}

}  // namespace blendwright::detail
