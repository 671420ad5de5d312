#pragma once
// One blend of a job, built and looked at on its own: what run_job does for every blend, and what shaping by
// hand does again and again.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/build_primaries.hpp"
#include "parametric/blend.hpp"
#include "verify/continuity/seam.hpp"

namespace blendwright {

struct BuiltBlend {
  Blend blend;
  /// Which sides of the trimlines are kept: the job's word, else that of the part an edge was taken from.
  std::array<SideSpec::Keep, 2> keep{};
  /// The trimlines as the job gives them; those of the blend run by the correspondence.
  std::array<std::optional<Trimline>, 2> lines{};
};

/// Throws InputError and GeometryError with the pointer of the blend in front; adds to `warnings`.
[[nodiscard]] BuiltBlend build_blend(const BlendEntry& entry, const JobSpec& job,
                                     const std::vector<BuiltPrimary>& primaries,
                                     std::vector<std::string>& warnings);

/// Throws GeometryError when a trimline of `added` crosses one of `other` on a primary that they share:
/// nothing of the primary would stay between them. Lines from the edges of a part are its own and do not.
void refuse_crossing(const BlendEntry& other, const Blend& other_blend, const BlendEntry& added,
                     const Blend& added_blend);

/// The joint of `surface`, which is this blend or stands for it, with its primary on side 0 or 1; typed
/// boundary data without a primary are their own.
[[nodiscard]] Seam blend_seam(const BlendEntry& entry, const Blend& blend, const Surface& surface,
                              std::size_t side);

}  // namespace blendwright
