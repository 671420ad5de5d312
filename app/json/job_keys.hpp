#pragma once
// Every object of a job file and its keys, as data: the reader accepts exactly these and the schema lists
// exactly these.
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/primitives/primary.hpp"

namespace blendwright {

struct KeyInfo {
  std::string name;
  std::string
      type;  ///< an object of this table, a family of words, or a basic type ("number", "point", "formulas3")
  std::string description;
  bool required = false;
  double min = -std::numeric_limits<double>::infinity();  ///< numbers only
  bool min_allowed = true;
  double max = std::numeric_limits<double>::infinity();
};

struct ObjectInfo {
  std::string name;
  std::string description;
  std::vector<KeyInfo> keys;
  [[nodiscard]] const KeyInfo* find(std::string_view key) const;
};

/// All objects; those of primaries and trimlines are named "primary <kind>" and "trimline <kind>".
[[nodiscard]] const std::vector<ObjectInfo>& job_objects();
/// Throws std::out_of_range for an unknown name.
[[nodiscard]] const ObjectInfo& job_object(std::string_view name);

inline constexpr std::string_view step_face_kind = "step_face";
/// The kinds a primary may have: the rows of the primaries table, then step_face.
[[nodiscard]] const std::vector<std::string>& primary_kinds();

/// Whether the user says of each direction if it is periodic: "closed": [u, v].
[[nodiscard]] bool closed_by_direction(const PrimaryInfo& row);

/// The job key of parameter u (0) or v (1): its name in the row, with the unit when it is an angle.
[[nodiscard]] std::string parameter_key(const PrimaryInfo& row, std::size_t direction,
                                        const char* unit = "_deg");

}  // namespace blendwright
