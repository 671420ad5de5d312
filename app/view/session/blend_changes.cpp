#include "app/view/session/blend_changes.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr double least_tension = 0.01, most_tension = 100.0, magnitude_reach = 10.0;

enum Control : std::size_t { tension, mode, magnitude_from, magnitude_to, continuity_from, continuity_to };

bool sixth(const BlendEntry& e) {
  return e.sides[0].side.continuity == Continuity::G2 || e.sides[1].side.continuity == Continuity::G2;
}

double mean_factor(const SideSpec& side) {
  double sum = 0.0;
  for (const LawPoint& p : side.factor) sum += p.value;
  return sum / static_cast<double>(side.factor.size());
}

SessionControl number(const BlendEntry& entry, const std::string& label, std::size_t blend, double value,
                      Interval range) {
  return {.name = entry.name + ": " + label,
          .label = label,
          .blend = blend,
          .kind = SessionControl::Kind::number,
          .value = std::clamp(value, range.lo, range.hi),
          .low = range.lo,
          .high = range.hi,
          .logarithmic = true};
}

SessionControl choice(const BlendEntry& entry, const std::string& label, std::size_t blend, int value,
                      std::vector<std::string> choices) {
  return {.name = entry.name + ": " + label,
          .label = label,
          .blend = blend,
          .kind = SessionControl::Kind::choice,
          .value = static_cast<double>(value),
          .low = 0.0,
          .high = static_cast<double>(choices.size() - 1),
          .choices = std::move(choices)};
}

std::string set_tension(BlendEntry& entry, double value) {
  BlendShape& s = entry.shape;
  if (s.repeated_root) {
    s.repeated_root = value;
    return {};
  }
  if (sixth(entry) && s.family == SixthOrderFamily::quintic)
    throw InputError("/blends/" + entry.name + "/shape/family", "quintic has no tension");
  const bool typed = !sixth(entry) && !std::all_of(s.ode.begin(), s.ode.end(), [&](const SweepOde& o) {
    return o == SweepOde::tension(s.tension);
  });
  // The low end of a logarithmic slider stands for none.
  s.tension = value <= least_tension ? 0.0 : value;
  s.ode.fill(SweepOde::tension(s.tension));
  return typed ? "the tension takes the place of the coefficients b, c, d" : std::string();
}

std::string set_mode(BlendEntry& entry, double value, const Vec3& middle) {
  constexpr std::array<BlendMode, 3> modes{BlendMode::chord, BlendMode::anchor, BlendMode::origin};
  const BlendMode wanted = modes[static_cast<std::size_t>(value)];
  if (wanted == entry.shape.mode) return {};
  entry.shape.mode = wanted;
  if (wanted != BlendMode::anchor) return {};
  entry.shape.anchor = middle;
  return "the anchor is in the middle of the blend";
}

/// A blend with G2 is of sixth order: it has a tension, and no roots or frame of its own.
std::string to_sixth_order(BlendShape& s) {
  std::string lost;
  if (s.repeated_root) {
    s.tension = *s.repeated_root;
    lost = "q = " + number_text(*s.repeated_root, 4) + " becomes the tension";
  } else if (!std::all_of(s.ode.begin(), s.ode.end(),
                          [&](const SweepOde& o) { return o == SweepOde::tension(s.tension); })) {
    lost = "the coefficients b, c, d are dropped";
  }
  if (s.frame != BlendFrame::global) lost += std::string(lost.empty() ? "" : "; ") + "the frame is dropped";
  s.repeated_root.reset();
  s.ode.fill(SweepOde::tension(s.tension));
  s.frame = BlendFrame::global;
  s.axes = Eigen::Matrix3d::Identity();
  return lost.empty() ? lost : "G2 makes the blend of sixth order: " + lost;
}

std::string set_continuity(BlendEntry& entry, std::size_t side, double value) {
  const bool was = sixth(entry);
  entry.sides[side].side.continuity = static_cast<Continuity>(static_cast<int>(value));
  if (!was && sixth(entry)) return to_sixth_order(entry.shape);
  if (was && !sixth(entry)) {
    entry.shape.family = SixthOrderFamily::tension1;
    entry.shape.ode.fill(SweepOde::tension(entry.shape.tension));
  }
  return {};
}

}  // namespace

double handle_place(std::size_t index, bool closed) {
  return static_cast<double>(index) / static_cast<double>(closed ? handles_per_line : handles_per_line - 1);
}

std::vector<SessionControl> controls_of(const BlendEntry& entry, const BlendEntry& first, std::size_t blend) {
  const bool root = entry.shape.repeated_root.has_value();
  const double pull = root ? *entry.shape.repeated_root : entry.shape.tension;
  std::vector<SessionControl> all{
      number(entry, root ? "q" : "tension", blend, pull, {least_tension, most_tension}),
      choice(entry, "mode", blend,
             entry.shape.mode == BlendMode::chord    ? 0
             : entry.shape.mode == BlendMode::anchor ? 1
                                                     : 2,
             {"chord", "anchor", "origin"})};
  if (entry.literal()) return all;
  constexpr std::array<const char*, 2> sides{"from", "to"};
  for (std::size_t i = 0; i < 2; ++i) {
    const double usual = mean_factor(first.sides[i].side);
    all.push_back(number(entry, std::string("magnitude ") + sides[i], blend, mean_factor(entry.sides[i].side),
                         {usual / magnitude_reach, usual * magnitude_reach}));
  }
  for (std::size_t i = 0; i < 2; ++i)
    all.push_back(choice(entry, std::string("continuity ") + sides[i], blend,
                         static_cast<int>(entry.sides[i].side.continuity), {"G0", "G1", "G2"}));
  return all;
}

ChangedEntry changed_entry(BlendEntry entry, std::size_t index, double value, const Vec3& middle) {
  std::string message;
  switch (index) {
    case tension:
      message = set_tension(entry, value);
      break;
    case mode:
      message = set_mode(entry, value, middle);
      break;
    case magnitude_from:
    case magnitude_to: {
      SideSpec& side = entry.sides[index - magnitude_from].side;
      const double scale = value / mean_factor(side);
      if (side.factor.size() == 1)
        side.factor[0].value = value;
      else
        for (LawPoint& p : side.factor) p.value *= scale;
      break;
    }
    default:
      message = set_continuity(entry, index - continuity_from, value);
  }
  return {std::move(entry), std::move(message)};
}

std::vector<LawPoint> reshaped_law(std::vector<LawPoint> law, double t, bool closed, double ratio) {
  if (law.size() == 1) {
    const double value = law[0].value;
    law.clear();
    for (std::size_t i = 0; i < handles_per_line; ++i) law.push_back({handle_place(i, closed), value});
  }
  const auto distance = [&](const LawPoint& p) {
    const double d = std::abs(p.t - t);
    return closed ? std::min(d, 1.0 - d) : d;
  };
  const auto nearest = std::min_element(law.begin(), law.end(), [&](const LawPoint& a, const LawPoint& b) {
    return distance(a) < distance(b);
  });
  nearest->value *= ratio;
  return law;
}

}  // namespace blendwright
