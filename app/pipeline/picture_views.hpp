#pragma once
// Where pictures are looked at from.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/exchange/picture.hpp"

namespace blendwright {

struct NamedView {
  std::string_view name;
  Vec3 direction;  ///< from the object to the eye
};
/// iso, front, back, left, right, top, bottom, iso-back, iso-below.
[[nodiscard]] std::span<const NamedView> named_views();
/// "iso,front,top". Throws InputError with a suggestion.
[[nodiscard]] std::vector<PictureView> views_named(const std::vector<std::string>& names);

/// The view of a picture of blends, when it should not be the usual one: from below when one primary is much
/// larger than all others and lies above the blends, since it would hide them.
[[nodiscard]] std::optional<Vec3> view_of_blends(std::span<const TriMesh* const> blends,
                                                 std::span<const TriMesh* const> primaries);

}  // namespace blendwright
