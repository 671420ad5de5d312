#include <algorithm>

#include "app/json/fit_reader.hpp"
#include "app/json/job_parts.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr std::array<const char*, 2> side_keys{"from", "to"};

void read_magnitude(const JsonValue& value, const std::string& where, SideSpec& side, Reading& reading) {
  ObjectReader object(value, where, job_object("magnitude"), reading);
  side.rule = object.choice("rule", magnitude_choices()).value_or(MagnitudeRule::circle_like);
  if (const JsonValue* factor = object.find("factor"))
    side.factor = read_law(*factor, object.at("factor"), reading);
  else if (side.rule == MagnitudeRule::constant)
    object.problem("factor",
                   "is missing; rule \"constant\" needs the length of the cross tangent, model units");
}

/// C, T and D typed as formulas; nullopt when the side has none of them.
std::optional<LiteralEnd> read_literal(ObjectReader& side, BlendSideEntry& entry) {
  if (!side.has("C") && !side.has("T") && !side.has("D")) return std::nullopt;
  LiteralEnd end;
  for (const char* key : {"C", "T"})
    if (!side.has(key)) side.problem(key, "is missing; literal boundary data must give \"C\" and \"T\"");
  end.C = side.formulas("C", 3, {"v"}).value_or(std::vector<std::string>());
  end.T = side.formulas("T", 3, {"v"}).value_or(std::vector<std::string>());
  end.D = side.formulas("D", 3, {"v"}).value_or(std::vector<std::string>());
  for (const char* key : {"magnitude", "tangent_angle_deg", "tangent_angle_rad", "keep"})
    side.exclude(key, "C", "literal boundary data say where the tangent points and how long it is");
  if (side.has("D") && !side.has("continuity")) entry.side.continuity = Continuity::G2;
  if (!side.has("D") && entry.side.continuity == Continuity::G2)
    side.problem("continuity",
                 "is G2, but literal boundary data without \"D\" reach G1; give " + side.at("D"));
  return end;
}

void read_primary_and_trimline(ObjectReader& side, BlendSideEntry& entry, const KnownPrimaries& primaries,
                               Reading& reading) {
  KnownPrimary target;
  if (const auto name = side.text("primary")) {
    entry.primary = *name;
    const auto known = primaries.find(*name);
    std::vector<std::string> names;
    for (const auto& p : primaries) names.push_back(p.first);
    if (known != primaries.end())
      target = known->second;
    else if (names.empty())
      side.problem("primary", "is " + in_quotes(*name) + ", but the job has no primaries");
    else
      side.problem("primary",
                   "is " + in_quotes(*name) + ", must be " + listed(names) + suggestion(*name, names));
  }
  if (const JsonValue* trimline = side.find("trimline"))
    entry.trimline = read_trimline(*trimline, side.at("trimline"), entry.primary, target, reading);
}

BlendSideEntry read_side(const JsonValue& value, const std::string& where, const KnownPrimaries& primaries,
                         Reading& reading) {
  ObjectReader side(value, where, job_object("side"), reading);
  BlendSideEntry entry;
  if (!value.members()) return entry;
  entry.side.continuity = side.choice("continuity", continuity_choices()).value_or(Continuity::G1);
  if (const JsonValue* magnitude = side.find("magnitude"))
    read_magnitude(*magnitude, side.at("magnitude"), entry.side, reading);
  if (const auto angle = side.number("tangent_angle_deg")) entry.side.tangent_angle = degrees(*angle);
  if (const auto angle = side.number("tangent_angle_rad")) entry.side.tangent_angle = Radians(*angle);
  side.exclude("tangent_angle_rad", "tangent_angle_deg", "both turn the cross tangent");
  entry.side.keep = side.choice("keep", keep_choices()).value_or(SideSpec::Keep::automatic);
  read_primary_and_trimline(side, entry, primaries, reading);
  entry.literal = read_literal(side, entry);
  const char* why =
      entry.literal ? "literal boundary data need both or neither" : "a side needs both, or \"C\" and \"T\"";
  for (const char* key : {"primary", "trimline"})
    if (!side.has(key) && (!entry.literal || side.has("primary") || side.has("trimline")))
      side.problem(key, std::string("is missing; ") + why);
  return entry;
}

std::vector<LawPoint> read_map(const JsonValue& value, const std::string& where, Reading& reading) {
  if (!value.items() || value.items()->empty()) {
    reading.problem(where, described(value) + ", must be a list of [t, fraction], such as [[0.5, 0.4]]");
    return {};
  }
  std::vector<LawPoint> map;
  for (std::size_t i = 0; i < value.items()->size(); ++i) {
    const std::string at = where + "/" + std::to_string(i);
    const auto pair = reading.numbers((*value.items())[i], at, 2);
    if (!pair) continue;
    const LawPoint p{(*pair)[0], (*pair)[1]};
    if (!(p.t >= 0.0 && p.t <= 1.0))
      reading.problem(at + "/0", "is " + number_text(p.t) + ", must be in [0, 1]");
    if (!map.empty() && !(p.t > map.back().t && p.value > map.back().value))
      reading.problem(at, "must be above the point before in both numbers: the map must increase");
    map.push_back(p);
  }
  return map;
}

CorrespondenceSpec read_correspondence(const JsonValue& value, const std::string& where, Reading& reading) {
  ObjectReader object(value, where, job_object("correspondence"), reading);
  CorrespondenceSpec spec;
  spec.rule = object.choice("rule", correspondence_choices()).value_or(CorrespondenceRule::arc_length);
  spec.reverse = object.boolean("reverse");
  spec.seam_offset = object.number("seam_offset");
  const bool mapped = spec.rule == CorrespondenceRule::mapped;
  if (const JsonValue* map = object.find("map")) {
    spec.map = read_map(*map, object.at("map"), reading);
    if (!mapped)
      object.problem("map", "has no effect; remove it or set " + object.at("rule") + " to \"mapped\"");
  } else if (mapped) {
    object.problem("map", "is missing; rule \"mapped\" needs it, such as [[0.5, 0.4]]");
  }
  return spec;
}

/// Range and closing of literal boundary data, and what only they or only trimlines may have.
void read_literal_domain(ObjectReader& blend, BlendEntry& entry, Reading& reading) {
  const bool literal = entry.literal();
  if (literal != entry.sides[1].literal.has_value()) {
    blend.problem(side_keys[literal ? 1 : 0],
                  "has a trimline, but " + blend.at(side_keys[literal ? 0 : 1]) +
                      " has literal boundary data; both sides must be of one sort");
    return;
  }
  if (!literal) {
    for (const char* key : {"v", "closed"})
      if (blend.has(key))
        blend.problem(key, "is for literal boundary data; a trimline has its own range, so remove it");
    return;
  }
  if (blend.has("correspondence"))
    blend.problem("correspondence",
                  "contradicts " + blend.at("from") + "/C: literal boundary data share their v");
  const auto v = blend.range("v");
  if (!blend.has("v"))
    blend.problem("v", "is missing; literal boundary data need the range of v, as in [0, \"2*pi\"]");
  if (!v || reading.faulty(blend.at("from")) || reading.faulty(blend.at("to"))) return;
  bool closed = true;
  for (const BlendSideEntry& side : entry.sides)
    for (const auto* formulas : {&side.literal->C, &side.literal->T})
      closed = closed && closes(*formulas, *v, reading.constants);
  entry.v = CurveDomain{*v, blend.boolean("closed").value_or(closed)};
}

}  // namespace

std::vector<LawPoint> read_law(const JsonValue& value, const std::string& where, Reading& reading) {
  if (!value.items()) {
    const auto factor = reading.number(value, where);
    if (factor && !(*factor > 0.0)) reading.problem(where, "is " + number_text(*factor) + ", must be > 0");
    return {{0.0, factor.value_or(1.0)}};
  }
  std::vector<LawPoint> law;
  const auto points = reading.points(value, where, 2);
  if (!points) return {{0.0, 1.0}};
  for (std::size_t i = 0; i < points->size(); ++i) {
    const LawPoint p{(*points)[i][0], (*points)[i][1]};
    const std::string at = where + "/" + std::to_string(i);
    if (!(p.t >= 0.0 && p.t <= 1.0))
      reading.problem(at + "/0", "is " + number_text(p.t) + ", must be in [0, 1]");
    if (!law.empty() && !(p.t > law.back().t))
      reading.problem(at + "/0", "is " + number_text(p.t) + ", must be > " + number_text(law.back().t) +
                                     ", the point before");
    if (!(p.value > 0.0)) reading.problem(at + "/1", "is " + number_text(p.value) + ", must be > 0");
    law.push_back(p);
  }
  return law;
}

BlendEntry read_blend(const std::string& name, const JsonValue& value, const std::string& where,
                      const KnownPrimaries& primaries, Reading& reading) {
  ObjectReader blend(value, where, job_object("blend"), reading);
  BlendEntry entry;
  entry.name = name;
  std::vector<std::string> asks_g2;
  for (std::size_t i = 0; i < 2; ++i) {
    const JsonValue* side = blend.find(side_keys[i]);
    if (!side) continue;
    entry.sides[i] = read_side(*side, blend.at(side_keys[i]), primaries, reading);
    if (entry.sides[i].side.continuity == Continuity::G2)
      asks_g2.push_back(blend.at(side_keys[i]) + "/continuity");
  }
  if (const JsonValue* shape = blend.find("shape"))
    entry.shape = read_shape(*shape, blend.at("shape"), asks_g2, reading);
  if (const JsonValue* rule = blend.find("correspondence"))
    entry.correspondence = read_correspondence(*rule, blend.at("correspondence"), reading);
  if (const JsonValue* fit = blend.find("fit"))
    entry.fit = std::make_shared<const FitSpec>(read_fit(*fit, blend.at("fit"), reading));
  if (blend.has("from") && blend.has("to")) read_literal_domain(blend, entry, reading);
  return entry;
}

}  // namespace blendwright
