#include "kernel/primitives/primary.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/base/number_text.hpp"
#include "kernel/primitives/primary_shapes.hpp"

namespace blendwright {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;
constexpr Interval turn{0.0, 2.0 * std::numbers::pi};
constexpr Interval latitudes{-quarter, quarter};
constexpr Interval unit{0.0, 1.0};
constexpr double lowest = std::numeric_limits<double>::lowest();
constexpr double largest = std::numeric_limits<double>::max();

constexpr std::array radius_only{ParamInfo{"radius", "radius r"}};
constexpr std::array ellipse{ParamInfo{"a", "semi-axis a along x"}, ParamInfo{"b", "semi-axis b along y"}};
constexpr std::array cone_numbers{
    ParamInfo{"radius", "radius r at u = 0; 0: the apex is there", 0.0, largest, true},
    ParamInfo{"half_angle_deg", "half angle al between axis and wall, degrees", 0.0, 89.999}};
constexpr std::array elliptic_cone_numbers{ParamInfo{"a", "semi-axis a along x at u = 1"},
                                           ParamInfo{"b", "semi-axis b along y at u = 1"},
                                           ParamInfo{"height", "height h at u = 1, of either sign", lowest}};
constexpr std::array irregular_cone_numbers{
    ParamInfo{"radius", "size R of the curve (cos v, v sin v) at u = 1"},
    ParamInfo{"height", "height h at u = 1, of either sign", lowest}};
constexpr std::array ellipsoid_numbers{ParamInfo{"a", "semi-axis a along x"},
                                       ParamInfo{"b", "semi-axis b along y"},
                                       ParamInfo{"c", "semi-axis c along z"}};
constexpr std::array torus_numbers{ParamInfo{"major_radius", "radius R of the centre circle of the tube"},
                                   ParamInfo{"minor_radius", "radius r of the tube, below R"}};
constexpr std::array paraboloid_numbers{ParamInfo{"a", "semi-axis a along x at u = 1"},
                                        ParamInfo{"b", "semi-axis b along y at u = 1"},
                                        ParamInfo{"c", "height c at u = 1, of either sign", lowest}};
constexpr std::array hyperboloid_numbers{
    ParamInfo{"a", "semi-axis a along x"}, ParamInfo{"b", "semi-axis b along y"},
    ParamInfo{"c", "semi-axis c along z; negative: the other way up", lowest}};

constexpr std::array<std::string_view, 1> only_u{"u"};
constexpr std::array<std::string_view, 1> only_v{"v"};
constexpr std::array<std::string_view, 2> u_and_v{"u", "v"};

std::string range_text(const Interval& range, double unit_value) {
  return std::string("[") + number_text(range.lo / unit_value, 6) + ", " +
         number_text(range.hi / unit_value, 6) + "]";
}

void check_latitude(const PrimarySpec& spec, std::vector<Problem>& problems) {
  const double slack = 1e-12;
  if (spec.u && !(spec.u->lo >= latitudes.lo - slack && spec.u->hi <= latitudes.hi + slack))
    problems.push_back(
        {"latitude_deg", "is " + range_text(*spec.u, degrees(1.0).value) + ", must lie within [-90, 90]"});
}

void check_apex(const PrimarySpec& spec, std::vector<Problem>& problems) {
  const auto radius = spec.numbers.find("radius"), angle = spec.numbers.find("half_angle_deg");
  if (!spec.u || radius == spec.numbers.end() || angle == spec.numbers.end()) return;
  const double apex = -radius->second / std::sin(degrees(angle->second).value);
  if (spec.u->lo < apex - 1e-12 * (1.0 + std::abs(apex)))
    problems.push_back({"length", "is " + range_text(*spec.u, 1.0) + ", must not reach beyond the apex at " +
                                      number_text(apex, 6)});
}

void check_tube(const PrimarySpec& spec, std::vector<Problem>& problems) {
  const auto R = spec.numbers.find("major_radius"), r = spec.numbers.find("minor_radius");
  if (R == spec.numbers.end() || r == spec.numbers.end() || !(r->second >= R->second)) return;
  problems.push_back({"minor_radius", "is " + number_text(r->second) +
                                          ", must be less than the major_radius " + number_text(R->second) +
                                          ", or the tube cuts itself"});
}

void check_direction(const PrimarySpec& spec, std::vector<Problem>& problems) {
  if (!spec.direction.allFinite() || !(spec.direction.norm() > 0.0))
    problems.push_back({"direction", "is zero or not finite, must be a direction"});
}

constexpr std::array<bool, 2> linear{false, false}, second{false, true}, both{true, true};

const std::array<PrimaryInfo, 16>& rows() {
  static const std::array<PrimaryInfo, 16> table{{
      {"plane", "(u, v, 0)", {"x", "y"}, linear, {}, {}, linear, make_plane},
      {"cylinder",
       "(r cos v, r sin v, u)",
       {"length", "angle"},
       second,
       radius_only,
       {std::nullopt, turn},
       second,
       make_cylinder},
      {"elliptic_cylinder",
       "(a cos v, b sin v, u)",
       {"length", "angle"},
       second,
       ellipse,
       {std::nullopt, turn},
       second,
       make_elliptic_cylinder},
      {"cone",
       "((r + u sin al) cos v, (r + u sin al) sin v, u cos al)",
       {"length", "angle"},
       second,
       cone_numbers,
       {std::nullopt, turn},
       second,
       make_cone,
       {},
       {},
       0,
       false,
       check_apex},
      {"elliptic_cone",
       "(a u cos v, b u sin v, h u)",
       {"u", "angle"},
       second,
       elliptic_cone_numbers,
       {std::nullopt, turn},
       second,
       make_elliptic_cone},
      {"irregular_cone",
       "(R u cos v, R u v sin v, h u)",
       {"u", "v"},
       linear,
       irregular_cone_numbers,
       {std::nullopt, turn},
       linear,
       make_irregular_cone},
      {"sphere",
       "(r cos u cos v, r cos u sin v, r sin u)",
       {"latitude", "longitude"},
       both,
       radius_only,
       {latitudes, turn},
       second,
       make_sphere,
       {},
       {},
       0,
       false,
       check_latitude},
      {"ellipsoid",
       "(a cos u cos v, b cos u sin v, c sin u)",
       {"latitude", "longitude"},
       both,
       ellipsoid_numbers,
       {latitudes, turn},
       second,
       make_ellipsoid,
       {},
       {},
       0,
       false,
       check_latitude},
      {"torus",
       "((R + r cos u) cos v, (R + r cos u) sin v, r sin u)",
       {"tube_angle", "angle"},
       both,
       torus_numbers,
       {turn, turn},
       both,
       make_torus,
       {},
       {},
       0,
       false,
       check_tube},
      {"elliptic_paraboloid",
       "(a u cos v, b u sin v, c u^2)",
       {"u", "angle"},
       second,
       paraboloid_numbers,
       {std::nullopt, turn},
       second,
       make_elliptic_paraboloid},
      {"hyperboloid_one_sheet",
       "(a cosh u cos v, b cosh u sin v, c sinh u)",
       {"u", "angle"},
       second,
       hyperboloid_numbers,
       {std::nullopt, turn},
       second,
       make_hyperboloid_one_sheet},
      {"hyperboloid_two_sheets",
       "(a sinh u cos v, b sinh u sin v, c cosh u)",
       {"u", "angle"},
       second,
       hyperboloid_numbers,
       {std::nullopt, turn},
       second,
       make_hyperboloid_two_sheets},
      {"revolution",
       "(r(u) cos v, r(u) sin v, z(u))",
       {"u", "angle"},
       second,
       {},
       {unit, turn},
       second,
       make_revolution,
       "profile",
       only_u,
       2,
       true},
      {"extrusion",
       "c(v) + u d, |d| = 1",
       {"length", "v"},
       linear,
       {},
       {std::nullopt, unit},
       linear,
       make_extrusion,
       "profile",
       only_v,
       3,
       true,
       check_direction},
      {"bspline",
       "sum N_i(u) N_j(v) P_ij",
       {"u", "v"},
       linear,
       {},
       {unit, unit},
       linear,
       make_bspline,
       {},
       {},
       0,
       true},
      {"formula",
       "S(u, v), three formulas",
       {"u", "v"},
       linear,
       {},
       {},
       linear,
       make_formula,
       "S",
       u_and_v,
       3},
  }};
  return table;
}

}  // namespace

std::span<const PrimaryInfo> primaries_table() { return rows(); }

const PrimaryInfo* find_primary(std::string_view kind) {
  for (const PrimaryInfo& row : rows())
    if (row.kind == kind) return &row;
  return nullptr;
}

Surface make_primary(const PrimarySpec& spec) {
  if (std::vector<Problem> problems = check(spec); !problems.empty()) throw InputError(std::move(problems));
  return placed(find_primary(spec.kind)->make(spec), spec.placement);
}

}  // namespace blendwright
