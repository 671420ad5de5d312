#pragma once
// What sliders and handles change in a blend's entry. Private to this folder.
#include "app/view/session/blend_session.hpp"

namespace blendwright {

inline constexpr std::size_t handles_per_line = 8;

/// Fraction of the line at which handle `index` sits.
[[nodiscard]] double handle_place(std::size_t index, bool closed);

/// The controls of one blend. `first` is the blend as the session was opened with: ranges come from it.
[[nodiscard]] std::vector<SessionControl> controls_of(const BlendEntry& entry, const BlendEntry& first,
                                                      std::size_t blend);

/// `entry` with control `index` of controls_of at `value`; a message where something else had to change too.
struct ChangedEntry {
  BlendEntry entry;
  std::string message{};
};
/// Throws InputError where the value has no meaning in this blend. `middle`: where an anchor is put first.
[[nodiscard]] ChangedEntry changed_entry(BlendEntry entry, std::size_t index, double value,
                                         const Vec3& middle);

/// `law` with the magnitude `ratio` times as long at t: the law's nearest point, a constant law gets one
/// point per handle first.
[[nodiscard]] std::vector<LawPoint> reshaped_law(std::vector<LawPoint> law, double t, bool closed,
                                                 double ratio);

}  // namespace blendwright
