#include "app/json/json_places.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr std::size_t column_limit = 110;

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// One past the comment that starts at `at`, or `at` itself when none does. A comment to the end of its line
/// ends before the line break.
std::size_t after_comment(std::string_view text, std::size_t at) {
  if (text.substr(at, 2) == "//") return std::min(text.find_first_of("\r\n", at), text.size());
  if (text.substr(at, 2) != "/*") return at;
  const std::size_t end = text.find("*/", at + 2);
  return end == std::string_view::npos ? text.size() : end + 2;
}

std::size_t after_blanks(std::string_view text, std::size_t at) {
  for (;;) {
    while (at < text.size() && blank(text[at])) ++at;
    const std::size_t next = after_comment(text, at);
    if (next == at) return at;
    at = next;
  }
}

std::size_t after_text(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

std::size_t after_word(std::string_view text, std::size_t at) {
  while (at < text.size() && !blank(text[at]) && text[at] != ',' && text[at] != ']' && text[at] != '}' &&
         text[at] != '/')
    ++at;
  return at;
}

std::size_t line_start(std::string_view text, std::size_t at) {
  return at == 0 ? 0 : text.rfind('\n', at - 1) + 1;  // npos + 1 is 0
}

/// Whether nothing but blanks stands before `at` on its line.
bool first_on_line(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(line_start(text, at), at - line_start(text, at));
  return std::all_of(before.begin(), before.end(), blank);
}

std::size_t column(std::string_view text, std::size_t at) { return at - line_start(text, at); }

// --- layout of new values ------------------------------------------------------------------------------

std::string one_line(const JsonValue& v) {
  std::string out;
  if (const double* x = v.number(); x && *x == 0.0 && std::signbit(*x)) return "-0.0";  // "-0" would be 0
  if (const auto* items = v.items()) {
    for (const JsonValue& item : *items) out += (out.empty() ? "" : ", ") + one_line(item);
    return "[" + out + "]";
  }
  if (const auto* members = v.members()) {
    for (const JsonMember& m : *members) {
      out += out.empty() ? "{ " : ", ";
      out += one_line(JsonValue(m.key)) + ": " + one_line(m.value);
    }
    return out.empty() ? "{}" : out + " }";
  }
  out = json_text(v);
  out.pop_back();  // its line break
  return out;
}

/// The value as text that starts in column `at`: on one line if it fits, else lists filled line by line and
/// members one below the other.
std::string laid_out(const JsonValue& v, std::size_t at) {
  std::string flat = one_line(v);
  if (at + flat.size() <= column_limit || (!v.items() && !v.members())) return flat;
  const bool list = v.items() != nullptr;
  const std::size_t count = list ? v.items()->size() : v.members()->size();
  const std::size_t margin = at + (list ? 1 : 2);
  std::string out = list ? "[" : "{ ";
  std::size_t used = margin;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string head = list ? "" : one_line(JsonValue((*v.members())[i].key)) + ": ";
    const std::string item =
        head + laid_out(list ? (*v.items())[i] : (*v.members())[i].value, margin + head.size());
    const bool breaks = i > 0 && (!list || used + item.size() + 2 > column_limit);
    if (i > 0) out += breaks ? ",\n" + std::string(margin, ' ') : std::string(", ");
    used = (breaks || i == 0 ? margin : used + 2) + item.size();
    out += item;
  }
  return out + (list ? "]" : " }");
}

/// Whether a value of the text stands for `wanted` already. Formulas may be typed as numbers.
bool same(const JsonValue& old, const JsonValue& wanted, const JsonEdit::Meaning& meaning) {
  if (wanted.number()) return one_line(meaning(old)) == one_line(wanted);
  if (wanted.text() && old.number()) return number_text(*old.number()) == *wanted.text();
  const auto *a = old.items(), *b = wanted.items();
  if (!a || !b) return one_line(old) == one_line(wanted);
  return std::equal(a->begin(), a->end(), b->begin(), b->end(),
                    [&](const JsonValue& x, const JsonValue& y) { return same(x, y, meaning); });
}

}  // namespace

const JsonPlace* JsonPlace::find(std::string_view name) const {
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const JsonPlace& p = inside[i];
    const bool member = p.key_begin < p.begin;
    if (member ? p.key == name : std::to_string(i) == name) return &p;
  }
  return nullptr;
}

JsonPlace json_place(std::string_view text, std::size_t from) {
  if (from == 0 && text.substr(0, 3) == "\xEF\xBB\xBF") from = 3;
  JsonPlace place;
  place.begin = place.key_begin = after_blanks(text, from);
  std::size_t at = place.begin;
  const char open = at < text.size() ? text[at] : '\0';
  if (open == '"') {
    place.end = after_text(text, at);
    return place;
  }
  if (open != '{' && open != '[') {
    place.end = after_word(text, at);
    return place;
  }
  at = after_blanks(text, at + 1);
  while (at < text.size() && text[at] != '}' && text[at] != ']') {
    const std::size_t key_begin = at;
    std::string key;
    if (open == '{') {
      const std::size_t key_end = after_text(text, at);
      key = *parse_json(text.substr(at, key_end - at)).text();
      at = after_blanks(text, key_end) + 1;  // the colon
    }
    place.inside.push_back(json_place(text, at));
    if (open == '{') {
      place.inside.back().key = std::move(key);
      place.inside.back().key_begin = key_begin;
    }
    at = after_blanks(text, place.inside.back().end);
    if (at < text.size() && text[at] == ',') at = after_blanks(text, at + 1);
  }
  place.end = std::min(at + 1, text.size());
  return place;
}

JsonEdit::JsonEdit(std::string text, std::size_t object, Meaning meaning)
    : text_(std::move(text)), object_(object), meaning_(std::move(meaning)) {
  root_ = json_place(text_, object_);
}

const JsonPlace* JsonEdit::find(const Path& path) const {
  const JsonPlace* at = &root_;
  for (const std::string& key : path)
    if (at) at = at->find(key);
  return at;
}

JsonValue JsonEdit::parsed(const JsonPlace& place) const {
  return parse_json(std::string_view(text_).substr(place.begin, place.end - place.begin));
}

bool JsonEdit::has(const Path& path) const { return find(path) != nullptr; }

JsonValue JsonEdit::value(const Path& path) const {
  const JsonPlace* place = find(path);
  return place ? parsed(*place) : JsonValue();
}

/// Line breaks of what is new become those of the text.
void JsonEdit::splice(std::size_t begin, std::size_t end, std::string by) {
  if (text_.find("\r\n") != std::string::npos)
    for (std::size_t at = 0; (at = by.find('\n', at)) != std::string::npos; at += 2) by.insert(at, 1, '\r');
  text_.replace(begin, end - begin, by);
}

/// Changes what differs inside a list of the same shape, from its end so that places stay good; whether the
/// two have the same shape.
bool JsonEdit::set_inside(const JsonPlace& place, const JsonValue& old, const JsonValue& value) {
  const auto* before = old.items();
  const auto* after = value.items();
  if (!before || !after || before->size() != after->size()) return false;
  for (std::size_t i = place.inside.size(); i-- > 0;) {
    const JsonPlace& item = place.inside[i];
    if (same((*before)[i], (*after)[i], meaning_) || set_inside(item, (*before)[i], (*after)[i])) continue;
    splice(item.begin, item.end, laid_out((*after)[i], column(text_, item.begin)));
  }
  return true;
}

void JsonEdit::set(const Path& path, const JsonValue& value) {
  if (const JsonPlace* place = find(path)) {
    const JsonValue old = parsed(*place);
    if (same(old, value, meaning_)) return;
    if (!set_inside(*place, old, value))
      splice(place->begin, place->end, laid_out(value, column(text_, place->begin)));
  } else {
    // The deepest object that exists gets one new member with all that is missing inside it.
    std::size_t known = path.size() - 1;
    while (!find({path.begin(), path.begin() + static_cast<std::ptrdiff_t>(known)})) --known;
    JsonValue member = value;
    for (std::size_t i = path.size(); i-- > known + 1;) {
      JsonValue around{JsonValue::Object()};
      around.add(path[i], std::move(member));
      member = std::move(around);
    }
    add(*find({path.begin(), path.begin() + static_cast<std::ptrdiff_t>(known)}), path[known], member);
  }
  root_ = json_place(text_, object_);
}

void JsonEdit::add(const JsonPlace& object, const std::string& key, const JsonValue& value) {
  const std::string head = one_line(JsonValue(key)) + ": ";
  if (object.inside.empty()) {
    // "{" and what stands in it, which can only be comments, stay.
    const std::size_t at = object.begin + 1;
    const std::string shown = " " + head + laid_out(value, column(text_, at) + head.size() + 1);
    const bool closes_here = text_[at] == '}';
    splice(at, at, closes_here ? shown + " " : shown);
    return;
  }
  const JsonPlace& last = object.inside.back();
  const std::size_t first = object.inside.front().key_begin, margin = column(text_, first);
  const std::string indent =
      first_on_line(text_, first) ? text_.substr(line_start(text_, first), margin) : std::string(margin, ' ');
  // A comment that follows the last member on its line belongs to it: the new member goes behind.
  std::size_t at = last.end;
  for (;;) {
    std::size_t next = at;
    while (next < text_.size() && (text_[next] == ' ' || text_[next] == '\t')) ++next;
    const std::size_t after = after_comment(text_, next);
    if (after == next) break;
    at = after;
  }
  const bool own_line = first_on_line(text_, last.key_begin);
  const bool line_comment = text_.substr(last.end, at - last.end).find("//") != std::string::npos;
  const std::size_t here = column(text_, at) + 2;
  const bool fits = here + head.size() + one_line(value).size() + 2 <= column_limit;
  std::string shown;
  if (own_line || line_comment || !fits) {
    shown = "\n" + indent + head + laid_out(value, margin + head.size());
  } else {
    shown = " " + head + one_line(value);
  }
  splice(at, at, shown);
  splice(last.end, last.end, ",");
}

void JsonEdit::remove(const Path& path) {
  const JsonPlace* place = find(path);
  if (!place) return;
  const JsonPlace& object = *find({path.begin(), path.end() - 1});
  const auto index = static_cast<std::size_t>(place - object.inside.data());
  std::size_t begin = place->key_begin, end = place->end;
  const std::size_t next = after_blanks(text_, end);
  const bool last = text_[next] != ',';
  if (!last && next > end && text_.substr(end, next - end).find('/') != std::string::npos) {
    splice(next, next + 1, "");  // a comment stands before the comma and stays
  } else if (!last) {
    end = next + 1;
  }
  const bool alone = first_on_line(text_, begin);
  std::size_t stop = end;
  while (stop < text_.size() && text_[stop] != '\n' && blank(text_[stop])) ++stop;
  if (alone && stop < text_.size() && text_[stop] == '\n') {
    begin = line_start(text_, begin);
    end = stop + 1;
  } else if (!last || alone) {
    end = stop;  // the blanks up to the next member or comment
  } else {
    while (begin > 0 && blank(text_[begin - 1])) --begin;  // those after the comma before
  }
  splice(begin, end, "");
  if (last && index > 0) {
    const std::size_t comma = after_blanks(text_, object.inside[index - 1].end);
    splice(comma, comma + 1, "");
  }
  root_ = json_place(text_, object_);
}

}  // namespace blendwright
