#include "app/json/job_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include "app/json/choices.hpp"
#include "app/json/job_keys.hpp"
#include "app/json/job_reader.hpp"
#include "app/json/json_places.hpp"
#include "app/json/object_reader.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using Path = JsonEdit::Path;
constexpr std::array<const char*, 2> side_keys{"from", "to"};

Path operator/(Path path, const std::string& key) {
  path.push_back(key);
  return path;
}

JsonValue list(const Vec3& p, Eigen::Index dimension = 3) {
  JsonValue::Array all;
  for (Eigen::Index i = 0; i < dimension; ++i) all.emplace_back(p[i]);
  return all;
}
JsonValue list(Interval range) { return JsonValue::array({range.lo, range.hi}); }
JsonValue list(const std::vector<LawPoint>& law) {
  JsonValue::Array all;
  for (const LawPoint& p : law) all.push_back(JsonValue::array({p.t, p.value}));
  return all;
}
JsonValue list(const std::vector<ShiftPoint>& law) {
  JsonValue::Array all;
  for (const ShiftPoint& p : law) all.push_back(JsonValue::array({p.t, p.by[0], p.by[1]}));
  return all;
}
JsonValue list(const std::vector<std::string>& texts) { return JsonValue::Array(texts.begin(), texts.end()); }

/// The shortest number of degrees that is read as exactly these radians. Not every angle has one: degrees are
/// multiplied by pi / 180, which leaves some doubles out.
std::optional<double> exact_degrees(double radians) {
  const double about = Radians(radians).degrees();
  for (int digits = 1; digits <= 17; ++digits) {
    const double d = std::strtod(number_text(about, digits).c_str(), nullptr);
    if (degrees(d).value == radians) return d;
  }
  for (const double to : {-HUGE_VAL, HUGE_VAL}) {
    double d = about;
    for (int i = 0; i < 3; ++i) {
      d = std::nextafter(d, to);
      if (degrees(d).value == radians) return d;
    }
  }
  return std::nullopt;
}

/// The changes of one blend. A key whose value stands for the new one already is never touched.
class BlendEdit {
 public:
  BlendEdit(JsonEdit& edit, const JobSpec& job, const BlendEntry& was, const BlendEntry& now)
      : edit_(edit), job_(job), was_(was), now_(now) {}

  void write() {
    for (std::size_t i = 0; i < 2; ++i) side(i);
    shape();
    correspondence();
    if (now_.v)
      edit_.set({"v"}, list(now_.v->v));
    else
      forget({"v"}), forget({"closed"});
  }

 private:
  void forget(const Path& path) { edit_.remove(path); }
  /// The value; left out where it is the default and is not there.
  void put(const Path& path, const JsonValue& value, bool is_default = false) {
    if (!is_default || edit_.has(path)) edit_.set(path, value);
  }
  /// In degrees where they say it exactly, else in radians; `key` is the name without its unit.
  void angles(const Path& object, const std::string& key, const std::vector<double>& radians) {
    JsonValue::Array in_degrees, in_radians;
    for (const double r : radians) {
      if (const auto d = exact_degrees(r)) in_degrees.emplace_back(*d);
      in_radians.emplace_back(r);
    }
    const bool exact = in_degrees.size() == in_radians.size();
    const JsonValue::Array& all = exact ? in_degrees : in_radians;
    forget(object / (key + (exact ? "_rad" : "_deg")));
    edit_.set(object / (key + (exact ? "_deg" : "_rad")), all.size() == 1 ? all[0] : JsonValue(all));
  }

  void side(std::size_t i) {
    const BlendSideEntry &was = was_.sides[i], &now = now_.sides[i];
    const Path at{side_keys[i]};
    if (now.primary.empty())
      forget(at / "primary");
    else
      edit_.set(at / "primary", now.primary);
    if (now.trimline)
      trimline(at / "trimline", was.trimline, *now.trimline, was.primary != now.primary, now.primary);
    else
      forget(at / "trimline");
    literal(at, now);
    const Continuity usual = now.literal && !now.literal->D.empty() ? Continuity::G2 : Continuity::G1;
    put(at / "continuity", word_for(continuity_choices(), now.side.continuity), now.side.continuity == usual);
    if (now.literal) return;  // it says where the tangent points and how long it is
    magnitude(at / "magnitude", now.side);
    if (now.side.tangent_angle != was.side.tangent_angle)
      angles(at, "tangent_angle", {now.side.tangent_angle.value});
    put(at / "keep", word_for(keep_choices(), now.side.keep), now.side.keep == SideSpec::Keep::automatic);
  }

  void literal(const Path& at, const BlendSideEntry& now) {
    if (!now.literal) {
      for (const char* key : {"C", "T", "D"}) forget(at / key);
      return;
    }
    for (const char* key : {"magnitude", "tangent_angle_deg", "tangent_angle_rad", "keep"}) forget(at / key);
    edit_.set(at / "C", list(now.literal->C));
    edit_.set(at / "T", list(now.literal->T));
    if (now.literal->D.empty())
      forget(at / "D");
    else
      edit_.set(at / "D", list(now.literal->D));
  }

  void magnitude(const Path& at, const SideSpec& now) {
    const bool constant = now.factor.size() == 1;
    const bool usual = constant && now.factor[0].value == 1.0 && now.rule != MagnitudeRule::constant;
    put(at / "rule", word_for(magnitude_choices(), now.rule), now.rule == MagnitudeRule::circle_like);
    put(at / "factor", constant ? JsonValue(now.factor[0].value) : list(now.factor), usual);
  }

  // --- trimlines -------------------------------------------------------------------------------------------

  void trimline(const Path& at, const std::optional<TrimlineSpec>& was, const TrimlineSpec& now, bool moved,
                const std::string& primary) {
    if (!was || was->kind != now.kind) {
      edit_.set(at, JsonValue(JsonValue::Object()));
      edit_.set(at / "kind", word_for(trimline_choices(), now.kind));
    }
    using enum TrimlineSpec::Kind;
    switch (now.kind) {
      case isoline:
        line(at, was && was->kind == isoline ? was : std::nullopt, now, moved, primary);
        break;
      case parameters:
        curve(at, was, now.curve, 2);
        break;
      case projected:
        curve(at, was, now.curve, 3);
        optional_point(at / "direction", now.along);
        break;
      case edge:
      case edge_chain:
        optional_point(at / "near", now.edge.near);
        if (now.edge.curve.empty())
          forget(at / "curve");
        else
          edit_.set(at / "curve", now.edge.curve);
        break;
    }
    if (now.shift.empty())
      forget(at / "shift");
    else
      edit_.set(at / "shift", list(now.shift));
  }

  void optional_point(const Path& at, const std::optional<Vec3>& p) {
    if (p)
      edit_.set(at, list(*p));
    else
      forget(at);
  }

  void line(const Path& at, const std::optional<TrimlineSpec>& was, const TrimlineSpec& now, bool moved,
            const std::string& primary) {
    std::array<std::string, 2> names{"u", "v"};
    std::array<bool, 2> angular{false, false};
    for (const PrimaryEntry& p : job_.primaries)
      if (const auto* spec = std::get_if<PrimarySpec>(&p.spec); spec && p.name == primary)
        if (const PrimaryInfo* row = find_primary(spec->kind)) {
          names = {std::string(row->parameters[0]), std::string(row->parameters[1])};
          angular = row->angular;
        }
    const bool other = moved || !was || was->direction != now.direction;
    const std::size_t fixed = now.direction == IsoDirection::constant_u ? 0 : 1;
    if (other)
      for (const KeyInfo& k : job_object("trimline isoline").keys)
        if (k.name != "kind" && k.name != "shift") forget(at / k.name);
    if (other || was->value != now.value) value(at, names[fixed], angular[fixed], {now.value});
    if (!now.range)
      for (const char* key : {"range", "range_deg", "range_rad"}) forget(at / key);
    else if (other || was->range != now.range)
      value(at, "range", angular[1 - fixed], {now.range->lo, now.range->hi});
  }

  void value(const Path& at, const std::string& key, bool angular, const std::vector<double>& x) {
    if (angular)
      angles(at, key, x);
    else
      edit_.set(at / key, x.size() == 1 ? JsonValue(x[0]) : JsonValue(JsonValue::Array(x.begin(), x.end())));
  }

  void curve(const Path& at, const std::optional<TrimlineSpec>& was, const CurveSpec& now,
             Eigen::Index dimension) {
    if (now.points.empty()) {
      forget(at / "points");
      edit_.set(at / "curve", list(now.formulas));
      put(at / "v", list(now.v), now.v == Interval{0.0, 2.0 * std::numbers::pi});
      return;
    }
    forget(at / "curve");
    forget(at / "v");
    JsonValue::Array points;
    for (const Vec3& p : now.points) points.push_back(list(p, dimension));
    const JsonValue typed = edit_.value(at / "points");
    if (was && typed.items() && typed.items()->size() == was->curve.points.size() + 1)
      points.push_back(points.front());  // the line closes by naming its first point again
    edit_.set(at / "points", points);
  }

  // --- shape -----------------------------------------------------------------------------------------------

  enum class Roots { tension, q, coefficients };

  /// How the shape says which roots the sweep equation has: as the text does, where that is exact.
  [[nodiscard]] Roots roots(const BlendShape& s) const {
    if (s.repeated_root) return Roots::q;
    const bool taut = std::all_of(s.ode.begin(), s.ode.end(),
                                  [&](const SweepOde& o) { return o == SweepOde::tension(s.tension); });
    const bool typed = edit_.has({"shape", "b"}) || edit_.has({"shape", "c"}) || edit_.has({"shape", "d"});
    return taut && !(typed && s.tension == 0.0) ? Roots::tension : Roots::coefficients;
  }

  void coefficients(const BlendShape& s) {
    const auto one = [&](const char* key, double SweepOde::*member, double usual) {
      const Path at{"shape", key};
      JsonValue::Array each;
      for (const SweepOde& o : s.ode) each.emplace_back(o.*member);
      const bool common = s.ode[0].*member == s.ode[1].*member && s.ode[1].*member == s.ode[2].*member;
      const bool as_list = !common || edit_.value(at).items();
      put(at, as_list ? JsonValue(each) : each[0], common && s.ode[0].*member == usual);
    };
    one("b", &SweepOde::b, 1.0);
    one("c", &SweepOde::c, 0.0);
    one("d", &SweepOde::d, 0.0);
  }

  void shape() {
    const BlendShape& s = now_.shape;
    const bool sixth =
        now_.sides[0].side.continuity == Continuity::G2 || now_.sides[1].side.continuity == Continuity::G2;
    const Roots form = sixth ? Roots::tension : roots(s);
    if (form != Roots::coefficients)
      for (const char* key : {"b", "c", "d"}) forget({"shape", key});
    if (form != Roots::q) forget({"shape", "q"});
    const bool tense = form == Roots::tension && !(sixth && s.family == SixthOrderFamily::quintic);
    if (!tense) forget({"shape", "tension"});
    if (form == Roots::coefficients) coefficients(s);
    if (form == Roots::q) edit_.set({"shape", "q"}, *s.repeated_root);
    if (tense) put({"shape", "tension"}, s.tension, s.tension == 0.0);
    put({"shape", "mode"}, word_for(mode_choices(), s.mode), s.mode == BlendMode::chord);
    if (s.mode == BlendMode::anchor)
      edit_.set({"shape", "anchor"}, list(s.anchor));
    else
      forget({"shape", "anchor"});
    frame(s, sixth);
    if (sixth)
      put({"shape", "family"}, word_for(family_choices(), s.family), s.family == SixthOrderFamily::tension1);
    else
      forget({"shape", "family"});
  }

  void frame(const BlendShape& s, bool sixth) {
    const Path at{"shape", "frame"};
    if (sixth) return forget(at);
    if (s.frame != BlendFrame::fixed)
      return put(at, word_for(frame_choices(), s.frame), s.frame == BlendFrame::global);
    if (was_.shape.frame == BlendFrame::fixed && was_.shape.axes == s.axes) return;
    JsonValue::Array axes;
    for (Eigen::Index i = 0; i < 3; ++i) axes.push_back(list(Vec3(s.axes.col(i))));
    if (edit_.value(at).members())
      edit_.set(at / "fixed", axes);
    else
      edit_.set(at, JsonValue::object({{"fixed", axes}}));
  }

  void correspondence() {
    const Path at{"correspondence"};
    if (now_.literal()) return forget(at);
    const CorrespondenceSpec& c = now_.correspondence;
    put(at / "rule", word_for(correspondence_choices(), c.rule), c.rule == CorrespondenceRule::arc_length);
    if (c.reverse)
      edit_.set(at / "reverse", *c.reverse);
    else
      forget(at / "reverse");
    if (c.seam_offset)
      edit_.set(at / "seam_offset", *c.seam_offset);
    else
      forget(at / "seam_offset");
    if (c.rule != CorrespondenceRule::mapped) return forget(at / "map");
    edit_.set(at / "map", list(c.map));
  }

  JsonEdit& edit_;
  const JobSpec& job_;
  const BlendEntry &was_, &now_;
};

const BlendEntry& entry(const JobSpec& job, const std::string& name) {
  for (const BlendEntry& b : job.blends)
    if (b.name == name) return b;
  throw std::logic_error("the changed job has no blend \"" + name + "\"");
}

std::size_t place_of_blend(const std::string& text, const std::string& name) {
  return json_place(text).find("blends")->find(name)->begin;
}

/// Applies `change` to the text of every blend, the last one first: places before it stay good.
template <class Change>
std::string each_blend(std::string text, const JobSpec& was, const JobSpec& now, Change change) {
  const auto meaning = [&](const JsonValue& value) {
    Reading reading;
    reading.constants = was.constants;
    const auto x = value.text() ? reading.number(value, "") : std::nullopt;
    return x ? JsonValue(*x) : value;
  };
  for (std::size_t i = was.blends.size(); i-- > 0;) {
    const BlendEntry& before = was.blends[i];
    const std::size_t place = place_of_blend(text, before.name);
    JsonEdit edit(std::move(text), place, meaning);
    change(edit, before, entry(now, before.name));
    text = edit.text();
  }
  return text;
}

/// Says whether lines close where the reader would see it differently.
void write_closed(JsonEdit& edit, const BlendEntry& read, const BlendEntry& wanted) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto &a = read.sides[i].trimline, &b = wanted.sides[i].trimline;
    if (a && b && a->curve.closed != b->curve.closed)
      edit.set({side_keys[i], "trimline", "closed"}, b->curve.closed);
  }
  if (read.v && wanted.v && read.v->closed != wanted.v->closed) edit.set({"closed"}, wanted.v->closed);
}

}  // namespace

std::string job_text(const std::string& text, const JobSpec& changed) {
  const std::filesystem::path file = changed.folder / (changed.name + ".json");
  const JobSpec was = read_job(text, file);
  if (was.blends.size() != changed.blends.size())
    throw std::logic_error("the changed job has " + std::to_string(changed.blends.size()) +
                           " blends, its text " + std::to_string(was.blends.size()));
  const std::string written =
      each_blend(text, was, changed, [&](JsonEdit& edit, const BlendEntry& before, const BlendEntry& now) {
        BlendEdit(edit, was, before, now).write();
      });
  if (written == text) return text;
  const JobSpec read = read_job(written, file);
  const std::string closed = each_blend(written, read, changed, write_closed);
  if (closed != written) static_cast<void>(read_job(closed, file));
  return closed;
}

std::string moved_job_text(const std::string& text, const std::filesystem::path& from,
                           const std::filesystem::path& to) {
  namespace fs = std::filesystem;
  const fs::path here = fs::absolute(from / ".").lexically_normal();
  const fs::path there = fs::absolute(to / ".").lexically_normal();
  if (here == there) return text;
  JsonEdit edit(text, 0, [](const JsonValue& value) { return value; });
  const auto move = [&](const Path& path) {
    const JsonValue value = edit.value(path);
    if (!value.text() || fs::path(*value.text()).is_absolute()) return;
    edit.set(path, (here / *value.text()).lexically_normal().lexically_relative(there).string());
  };
  const JsonValue root = parse_json(text);
  if (const JsonValue* primaries = root.find("primaries"))
    for (const JsonMember& m : *primaries->members()) move({"primaries", m.key, "file"});
  for (const JsonMember& m : *root.find("blends")->members()) {
    const JsonValue* fit = m.value.find("fit");
    if (!fit) continue;
    for (std::size_t i = 0; i < fit->find("objectives")->items()->size(); ++i)
      for (const char* key : {"file", "to"})
        move({"blends", m.key, "fit", "objectives", std::to_string(i), key});
  }
  return edit.text();
}

}  // namespace blendwright
