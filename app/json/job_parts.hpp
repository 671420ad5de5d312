#pragma once
// The parts of a job that have a reader of their own.
#include <array>
#include <map>
#include <string>

#include "app/json/object_reader.hpp"
#include "app/pipeline/job.hpp"

namespace blendwright {

/// One entry of "primaries". Every problem goes to `reading`; the result is only meaningful when there is
/// none.
[[nodiscard]] PrimaryEntry read_primary(const std::string& name, const JsonValue& value,
                                        const std::string& where, Reading& reading);

/// What trimlines need to know of a primary: its kind (empty: not known), and the period of each parameter in
/// which it closes (0: it does not).
struct KnownPrimary {
  std::string kind;
  std::array<double, 2> periods{0.0, 0.0};
};
using KnownPrimaries = std::map<std::string, KnownPrimary>;
[[nodiscard]] KnownPrimary known_primary(const PrimaryEntry& entry);

/// A positive number, or a law [[t, value], ...] of positive values with t in [0, 1] increasing.
[[nodiscard]] std::vector<LawPoint> read_law(const JsonValue& value, const std::string& where,
                                             Reading& reading);
/// One entry of "blends".
[[nodiscard]] BlendEntry read_blend(const std::string& name, const JsonValue& value, const std::string& where,
                                    const KnownPrimaries& primaries, Reading& reading);
/// "shape" of a blend; `asks_g2`: pointers of the sides that ask for G2.
[[nodiscard]] BlendShape read_shape(const JsonValue& value, const std::string& where,
                                    const std::vector<std::string>& asks_g2, Reading& reading);
/// "trimline" of a side on the primary of this name.
[[nodiscard]] TrimlineSpec read_trimline(const JsonValue& value, const std::string& where,
                                         const std::string& name, const KnownPrimary& primary,
                                         Reading& reading);

}  // namespace blendwright
