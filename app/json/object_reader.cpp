#include "app/json/object_reader.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "kernel/base/number_text.hpp"
#include "kernel/math/formula.hpp"

namespace blendwright {
namespace {

constexpr std::size_t longest_formula = 10'000;
constexpr std::size_t most_problems = 100;

/// Numbers every value in the order of the file, by pointer.
void place_all(const JsonValue& value, const std::string& where, std::map<std::string, std::size_t>& places) {
  places.emplace(where, places.size());
  if (const auto* members = value.members())
    for (const JsonMember& m : *members) place_all(m.value, where + "/" + pointer_part(m.key), places);
  if (const auto* items = value.items())
    for (std::size_t i = 0; i < items->size(); ++i)
      place_all((*items)[i], where + "/" + std::to_string(i), places);
}

/// The place of a pointer, or of the nearest value around it.
std::size_t place_of(std::string where, const std::map<std::string, std::size_t>& places) {
  for (;;) {
    const auto at = places.find(where);
    if (at != places.end()) return at->second;
    const std::size_t slash = where.rfind('/');
    if (slash == std::string::npos) return 0;
    where.resize(slash);
  }
}

std::string first_message(const InputError& e) {
  return e.problems().empty() ? e.what() : e.problems()[0].message;
}

std::string limits(const KeyInfo& key) {
  const bool below = std::isfinite(key.max) && key.max < std::numeric_limits<double>::max();
  std::string text;
  if (std::isfinite(key.min)) text += (key.min_allowed ? ">= " : "> ") + number_text(key.min);
  if (below) text += (text.empty() ? "<= " : " and <= ") + number_text(key.max);
  return text;
}

}  // namespace

bool Reading::told(const std::string& where) const {
  return std::any_of(problems_.begin(), problems_.end(), [&](const Problem& p) { return p.where == where; });
}

bool Reading::faulty(const std::string& where) const {
  return std::any_of(problems_.begin(), problems_.end(), [&](const Problem& p) {
    return p.where == where || p.where.rfind(where + "/", 0) == 0;
  });
}

void Reading::add(const InputError& later) {
  std::set<std::string> places, around;  // that have a problem; that enclose one
  for (const Problem& p : problems_) {
    places.insert(p.where);
    for (std::string at = p.where; !at.empty();
         at.resize(at.rfind('/') == std::string::npos ? 0 : at.rfind('/')))
      around.insert(at);
  }
  const auto known = [&](std::string at) {
    if (around.count(at) > 0) return true;
    for (; !at.empty(); at.resize(at.rfind('/') == std::string::npos ? 0 : at.rfind('/')))
      if (places.count(at) > 0) return true;
    return false;
  };
  for (const Problem& p : later.problems())
    if (!known(p.where)) problems_.push_back(p);
}

void Reading::finish(const JsonValue& root) const {
  if (problems_.empty()) return;
  std::map<std::string, std::size_t> places;
  place_all(root, "", places);
  std::vector<std::pair<std::size_t, Problem>> sorted;
  for (const Problem& p : problems_) sorted.emplace_back(place_of(p.where, places), p);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Problem> problems;
  for (auto& [place, problem] : sorted) {
    if (problems.size() == most_problems) {
      problems.push_back({"", std::to_string(sorted.size() - most_problems) + " more problems"});
      break;
    }
    problems.push_back(std::move(problem));
  }
  throw InputError(std::move(problems));
}

std::optional<double> Reading::number(const JsonValue& value, const std::string& where) {
  double x = 0.0;
  if (const double* n = value.number()) {
    x = *n;
  } else if (const std::string* text = value.text()) {
    if (text->size() > longest_formula) {
      problem(where, "is a formula of " + std::to_string(text->size()) + " characters, must have at most " +
                         std::to_string(longest_formula));
      return std::nullopt;
    }
    try {
      x = constant_value(*text, constants);
    } catch (const InputError& e) {
      problem(where, described(value) + ": " + first_message(e));
      return std::nullopt;
    }
  } else {
    problem(where, described(value) + ", must be a number or a constant formula such as \"2*pi\"");
    return std::nullopt;
  }
  if (std::isfinite(x)) return x;
  problem(where, described(value) + ", must be a finite number");
  return std::nullopt;
}

std::optional<std::string> Reading::formula(const JsonValue& value, const std::string& where,
                                            const std::vector<std::string>& variables) {
  if (value.number()) {
    const auto x = number(value, where);
    return x ? std::optional(number_text(*x)) : std::nullopt;
  }
  const std::string* text = value.text();
  if (!text) {
    problem(where, described(value) + ", must be a formula of " + listed(variables));
    return std::nullopt;
  }
  if (text->size() > longest_formula) {
    problem(where, "is a formula of " + std::to_string(text->size()) + " characters, must have at most " +
                       std::to_string(longest_formula));
    return std::nullopt;
  }
  try {
    [[maybe_unused]] const Formula parsed(*text, variables, constants);
    return *text;
  } catch (const InputError& e) {
    problem(where, described(value) + ": " + first_message(e));
    return std::nullopt;
  }
}

std::optional<std::vector<double>> Reading::numbers(const JsonValue& value, const std::string& where,
                                                    std::optional<std::size_t> count) {
  const auto* items = value.items();
  if (!items || (count && items->size() != *count)) {
    problem(where, described(value) + ", must be a list of " + (count ? std::to_string(*count) + " " : "") +
                       "numbers");
    return std::nullopt;
  }
  std::vector<double> all;
  bool good = true;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const auto x = number((*items)[i], where + "/" + std::to_string(i));
    good = good && x;
    all.push_back(x.value_or(0.0));
  }
  return good ? std::optional(std::move(all)) : std::nullopt;
}

std::optional<Vec3> Reading::point(const JsonValue& value, const std::string& where) {
  const auto x = numbers(value, where, 3);
  return x ? std::optional(Vec3((*x)[0], (*x)[1], (*x)[2])) : std::nullopt;
}

std::optional<std::vector<Vec3>> Reading::points(const JsonValue& value, const std::string& where,
                                                 std::size_t dimension) {
  const auto* items = value.items();
  if (!items || items->size() < 2) {
    problem(where, described(value) + ", must be a list of at least 2 points");
    return std::nullopt;
  }
  std::vector<Vec3> all;
  bool good = true;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const auto x = numbers((*items)[i], where + "/" + std::to_string(i), dimension);
    good = good && x;
    if (x) all.emplace_back((*x)[0], (*x)[1], dimension > 2 ? (*x)[2] : 0.0);
  }
  return good ? std::optional(std::move(all)) : std::nullopt;
}

std::optional<std::size_t> Reading::word(const JsonValue& value, const std::string& where,
                                         const std::vector<std::string>& names) {
  const std::string* text = value.text();
  if (text) {
    const auto at = std::find(names.begin(), names.end(), *text);
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
  }
  problem(where, described(value) + ", must be " + listed(names) +
                     (text && text->size() > 3 ? suggestion(*text, names) : ""));
  return std::nullopt;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  if (word.size() > 100) return "";
  const auto near = nearest_word(word, names.data(), names.size());
  return near ? "; did you mean \"" + *near + "\"?" : "";
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "\"" : i + 1 == names.size() ? " or \"" : ", \"") + names[i] + "\"";
  return text;
}

ObjectReader::ObjectReader(const JsonValue& value, std::string where, const ObjectInfo& info,
                           Reading& reading)
    : value_(value), where_(std::move(where)), info_(info), reading_(reading) {
  const auto* members = value.members();
  if (!members) {
    reading.problem(where_, described(value) + ", must be an object: " + info.description);
    return;
  }
  std::vector<std::string> known;
  for (const KeyInfo& k : info.keys) known.push_back(k.name);
  for (const JsonMember& m : *members)
    if (!info.find(m.key)) {
      const std::string near = suggestion(m.key, known);
      reading.problem(at(m.key), "unknown key" + (near.empty() ? "; may be " + listed(known) : near));
    }
  for (const KeyInfo& k : info.keys)
    if (k.required && !value.find(k.name))
      reading.problem(at(k.name), "is missing; must be given: " + k.description);
}

const JsonValue* ObjectReader::find(std::string_view key) const {
  if (!info_.find(key))
    throw std::logic_error("key \"" + std::string(key) + "\" is not in the table \"" + info_.name + "\"");
  return value_.find(key);
}

std::optional<double> ObjectReader::number(std::string_view key) {
  const JsonValue* v = find(key);
  if (!v) return std::nullopt;
  const auto x = reading_.number(*v, at(key));
  if (!x) return std::nullopt;
  const KeyInfo& k = *info_.find(key);
  if (*x > k.min && *x <= k.max) return x;
  if (k.min_allowed && *x == k.min) return x;
  problem(key, "is " + number_text(*x) + ", must be " + limits(k));
  return std::nullopt;
}

std::optional<std::string> ObjectReader::text(std::string_view key) {
  const JsonValue* v = find(key);
  if (!v) return std::nullopt;
  if (const std::string* t = v->text(); t && !t->empty()) return *t;
  problem(key, described(*v) + ", must be a text in quotes");
  return std::nullopt;
}

std::optional<bool> ObjectReader::boolean(std::string_view key) {
  const JsonValue* v = find(key);
  if (!v) return std::nullopt;
  if (const bool* b = v->boolean()) return *b;
  problem(key, described(*v) + ", must be true or false");
  return std::nullopt;
}

std::optional<Vec3> ObjectReader::point(std::string_view key) {
  const JsonValue* v = find(key);
  return v ? reading_.point(*v, at(key)) : std::nullopt;
}

std::optional<Vec3> ObjectReader::direction(std::string_view key) {
  const auto d = point(key);
  if (!d || d->norm() > 1e-100) return d;
  problem(key, "is zero, must be a direction");
  return std::nullopt;
}

std::optional<Interval> ObjectReader::range(std::string_view key) {
  const JsonValue* v = find(key);
  if (!v) return std::nullopt;
  const auto x = reading_.numbers(*v, at(key), 2);
  if (!x) return std::nullopt;
  if ((*x)[0] < (*x)[1]) return Interval{(*x)[0], (*x)[1]};
  problem(key, "is [" + number_text((*x)[0]) + ", " + number_text((*x)[1]) +
                   "], must be [low, high] with low < high");
  return std::nullopt;
}

std::optional<std::vector<std::string>> ObjectReader::formulas(std::string_view key, std::size_t count,
                                                               const std::vector<std::string>& variables) {
  const JsonValue* v = find(key);
  if (!v) return std::nullopt;
  const auto* items = v->items();
  if (!items || items->size() != count) {
    problem(key, described(*v) + ", must be a list of " + std::to_string(count) + " formulas of " +
                     listed(variables));
    return std::nullopt;
  }
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i)
    if (auto text = reading_.formula((*items)[i], at(key) + "/" + std::to_string(i), variables))
      texts.push_back(std::move(*text));
  return texts.size() == count ? std::optional(std::move(texts)) : std::nullopt;
}

void ObjectReader::exclude(std::string_view key, std::string_view other, const std::string& why) {
  if (has(key) && has(other)) problem(key, "contradicts " + at(other) + ": " + why + "; remove one of them");
}

bool closes(const std::vector<std::string>& formulas, Interval v,
            const std::map<std::string, double>& constants, const std::vector<double>& periods) {
  double size = 0.0, mismatch = 0.0;
  for (std::size_t i = 0; i < formulas.size(); ++i) {
    const Formula f(formulas[i], {"v"}, constants);
    const double start = f(std::vector<double>{v.lo});
    for (int k = 1; k <= 16; ++k)
      size = std::max(size, std::abs(f(std::vector<double>{v.at(k / 16.0)}) - start));
    const auto lo = f(std::vector<Taylor<3>>{Taylor<3>::variable(v.lo)});
    const auto hi = f(std::vector<Taylor<3>>{Taylor<3>::variable(v.hi)});
    for (std::size_t k = 0; k < 4; ++k) {
      double jump = hi.c[k] - lo.c[k];
      if (k == 0 && i < periods.size() && periods[i] > 0.0) jump = std::remainder(jump, periods[i]);
      jump = std::abs(jump) * std::pow(v.length(), static_cast<double>(k));
      if (!(jump <= mismatch)) mismatch = jump;
    }
  }
  return mismatch <= 1e-8 * size;
}

}  // namespace blendwright
