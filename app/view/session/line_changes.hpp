#pragma once
// What handles on a trimline change in its description. Private to this folder.
#include "app/view/session/blend_session.hpp"

namespace blendwright {

/// Fractions of the line at which its handles sit: the places of a shift of two points or more, else equal
/// ones.
[[nodiscard]] std::vector<double> line_handle_places(const TrimlineSpec& spec, bool closed);

/// `spec` with handle `index` of `line`, which it describes, at the place of the primary nearest to `target`;
/// a direction in which the primary closes is counted on from where the handle is. Reach here: the handles
/// nearby follow in part, as a B-spline falls off; the ends of an open line only follow a handle of their
/// own. An end that lies on the border of the primary and does not run along it stays on it.
[[nodiscard]] TrimlineSpec moved_line(TrimlineSpec spec, const Trimline& line, std::size_t index,
                                      SessionHandle::Reach reach, const Vec3& target);

}  // namespace blendwright
