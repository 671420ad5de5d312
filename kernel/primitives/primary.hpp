#pragma once
// The primary surfaces a blend can join, as one table. Every kind runs its profile along u and turns along v,
// so that "v = const" lines of a blend and of its primaries have the same role wherever that is possible.
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/base/error.hpp"
#include "kernel/base/table.hpp"
#include "kernel/geometry/rigid_motion.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// What a user says about one primary, before any checking. Lengths in model units, angles in radians except
/// where a number's name ends in _deg.
struct PrimarySpec {
  std::string kind{};                       ///< a name of the primaries table
  std::map<std::string, double> numbers{};  ///< by ParamInfo name
  std::vector<std::string> formulas{};  ///< formula: S (3 texts in u, v); revolution: profile r, z (2 texts
                                        ///< in u); extrusion: profile (3 texts in v)
  std::vector<Vec3> points{};       ///< profile through points instead of formulas (revolution: (r, z, 0)),
                                    ///< degree 5 from 6 points on, else 3, over chord length on [0, 1];
                                    ///< or the control points of a bspline, row by row of equal u index
  bool points_closed = false;       ///< the profile, through points or by formulas, closes smoothly
  int point_rows = 0;               ///< bspline: number of rows of points; 0: as the knots say
  std::array<int, 2> degree{3, 3};  ///< bspline
  std::array<std::vector<double>, 2> knots{};  ///< bspline: flat knot vectors, one period with both ends
                                               ///< where closed; empty = uniform on [0, 1]
  std::array<bool, 2> closed{false, false};   ///< bspline, formula: periodic directions
  Vec3 direction = Vec3::UnitZ();             ///< extrusion; any length but 0
  std::map<std::string, double> constants{};  ///< named constants of formulas
  std::optional<Interval> u{}, v{};           ///< domain; default: the row's
  RigidMotion placement{};
};

/// One row of the primaries table. Of its numbers, those with a negative `min` may have either sign but not
/// be 0.
struct PrimaryInfo {
  std::string_view kind;
  std::string_view equation;                   ///< S(u, v) in local coordinates
  std::array<std::string_view, 2> parameters;  ///< job keys of u and v ranges, e.g. {"length", "angle"}
  std::array<bool, 2> angular;                 ///< the key gets the suffix _deg and is converted
  std::span<const ParamInfo> numbers;
  std::array<std::optional<Interval>, 2> domain;     ///< default range; nullopt: must be given
  std::array<bool, 2> turns;                         ///< a range of 2 pi in this direction closes the surface
  Surface (*make)(const PrimarySpec&);               ///< after check(); local coordinates
  std::string_view texts = {};                       ///< job key of the formulas; empty: takes none
  std::span<const std::string_view> variables = {};  ///< what the formulas may use
  int text_count = 0;
  bool takes_points = false;
  void (*check)(const PrimarySpec&, std::vector<Problem>&) = nullptr;  ///< what only this kind must fulfil
};

[[nodiscard]] std::span<const PrimaryInfo> primaries_table();
[[nodiscard]] const PrimaryInfo* find_primary(std::string_view kind);

/// Everything wrong with the spec, in the order of the table's columns; empty when make_primary will succeed.
[[nodiscard]] std::vector<Problem> check(const PrimarySpec& spec);
/// Builds and places the surface; throws InputError with all problems.
[[nodiscard]] Surface make_primary(const PrimarySpec& spec);

}  // namespace blendwright
