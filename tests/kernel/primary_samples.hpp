#pragma once
// Specs of every row of the primaries table, with the equations their surfaces fulfil.
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/primitives/primary.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

inline constexpr double pi = std::numbers::pi;

inline PrimarySpec spec_of(std::string kind, std::map<std::string, double> numbers = {},
                           std::optional<Interval> u = {}, std::optional<Interval> v = {}) {
  PrimarySpec spec;
  spec.kind = std::move(kind);
  spec.numbers = std::move(numbers);
  spec.u = u;
  spec.v = v;
  return spec;
}

inline PrimarySpec typed(std::array<const char*, 3> S, Interval u, Interval v) {
  PrimarySpec spec = spec_of("formula", {}, u, v);
  spec.formulas.assign(S.begin(), S.end());
  return spec;
}

inline PrimarySpec bspline_sample() {
  PrimarySpec spec = spec_of("bspline");
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 8; ++j) spec.points.emplace_back(i, j, std::sin(0.7 * i) * std::cos(0.9 * j));
  spec.degree = {4, 5};
  spec.point_rows = 6;
  return spec;
}

/// Equation of the surface in x, y, z, scaled to size 1; 0 on the surface.
using Equation = double (*)(const Vec3&);
struct Sample {
  PrimarySpec spec;
  Equation equation = nullptr;
};

/// One or more samples of each kind; the tests below ask for those of every row of the table.
inline std::vector<Sample> samples_of(std::string_view kind) {
  const Interval u{0.2, 1.3};
  std::vector<Sample> samples;
  const auto add = [&](PrimarySpec spec, Equation equation) {
    if (spec.kind == kind) samples.push_back({std::move(spec), equation});
  };
  add(spec_of("plane", {}, Interval{-1, 2}, Interval{-3, 1}), [](const Vec3& p) { return p[2]; });
  add(spec_of("cylinder", {{"radius", 3}}, u),
      [](const Vec3& p) { return (p[0] * p[0] + p[1] * p[1]) / 9 - 1; });
  add(spec_of("elliptic_cylinder", {{"a", 2}, {"b", 3}}, u),
      [](const Vec3& p) { return p[0] * p[0] / 4 + p[1] * p[1] / 9 - 1; });
  add(spec_of("cone", {{"radius", 1}, {"half_angle_deg", 30}}, u),
      [](const Vec3& p) { return std::hypot(p[0], p[1]) - (1 + p[2] * std::tan(pi / 6)); });
  add(spec_of("elliptic_cone", {{"a", 2}, {"b", 3}, {"height", -4}}, u),
      [](const Vec3& p) { return p[0] * p[0] / 4 + p[1] * p[1] / 9 - p[2] * p[2] / 16; });
  add(spec_of("irregular_cone", {{"radius", 2}, {"height", 3}}, u, Interval{0.1, 3}), [](const Vec3& p) {
    const double t = p[2] / 3, v = std::acos(p[0] / (2 * t));
    return p[1] / (2 * t) - v * std::sin(v);
  });
  add(spec_of("sphere", {{"radius", 2}}), [](const Vec3& p) { return p.squaredNorm() / 4 - 1; });
  add(spec_of("ellipsoid", {{"a", 1}, {"b", 2}, {"c", 3}}),
      [](const Vec3& p) { return p[0] * p[0] + p[1] * p[1] / 4 + p[2] * p[2] / 9 - 1; });
  add(spec_of("torus", {{"major_radius", 3}, {"minor_radius", 1}}),
      [](const Vec3& p) { return std::hypot(std::hypot(p[0], p[1]) - 3, p[2]) - 1; });
  add(spec_of("elliptic_paraboloid", {{"a", 1}, {"b", 2}, {"c", -3}}, u),
      [](const Vec3& p) { return p[2] / -3 - p[0] * p[0] - p[1] * p[1] / 4; });
  add(spec_of("hyperboloid_one_sheet", {{"a", 1}, {"b", 2}, {"c", 3}}, Interval{-1, 1}),
      [](const Vec3& p) { return p[0] * p[0] + p[1] * p[1] / 4 - p[2] * p[2] / 9 - 1; });
  add(spec_of("hyperboloid_two_sheets", {{"a", 1}, {"b", 2}, {"c", -3}}, u), [](const Vec3& p) {
    return p[2] < 0 ? p[2] * p[2] / 9 - p[0] * p[0] - p[1] * p[1] / 4 - 1 : 1.0;  // c < 0: the lower sheet
  });
  PrimarySpec vase = spec_of("revolution", {}, Interval{0, 2});
  vase.formulas = {"1 + 0.2*sin(2*u)", "u"};
  add(vase, [](const Vec3& p) { return std::hypot(p[0], p[1]) - (1 + 0.2 * std::sin(2 * p[2])); });
  PrimarySpec turned = spec_of("revolution");
  for (int i = 0; i < 9; ++i) turned.points.emplace_back(1.0 + 0.1 * std::cos(i), 0.3 * i, 0.0);
  add(turned, nullptr);
  PrimarySpec ring = spec_of("revolution");
  for (int i = 0; i < 12; ++i) ring.points.emplace_back(3 + std::cos(i * pi / 6), std::sin(i * pi / 6), 0.0);
  ring.points_closed = true;
  add(ring, nullptr);
  PrimarySpec wave = spec_of("extrusion", {}, Interval{0, 1}, Interval{0, 3});
  wave.formulas = {"v", "sin(v)", "0"};
  wave.direction = Vec3(0, 0, 5);
  add(wave, [](const Vec3& p) { return p[1] - std::sin(p[0]); });
  PrimarySpec rail = spec_of("extrusion", {}, Interval{0, 1});
  for (int i = 0; i < 7; ++i) rail.points.emplace_back(i, i * i * 0.1, 0.0);
  rail.direction = Vec3(1, 0, 1);
  add(rail, nullptr);
  add(bspline_sample(), nullptr);
  add(typed({"u", "v", "0.2*u^2 - 0.1*v^2"}, {-1, 1}, {-1, 1}),
      [](const Vec3& p) { return p[2] - 0.2 * p[0] * p[0] + 0.1 * p[1] * p[1]; });
  return samples;
}

inline UV random_inside(Rng& rng, const SurfaceDomain& d) {
  // Differences reach 2 / 500 of the range to each side; spline profiles end at their border.
  return {d.u.at(uniform(rng, 0.02, 0.98)), d.v.at(uniform(rng, 0.02, 0.98))};
}

}  // namespace blendwright::test
