#pragma once
// Fills the grid of a session from a blend. Private to this folder.
//
//   S - L = sum_k phi_k(u) (row_k(v) - L_k),  Sv - L' = sum_k phi_k(u) (row_k'(v) - L_k'),  L = (1 - u) C0 +
//   u C1 (1)
// row_k: S, Su and, of sixth order, Suu at u = 0 and 1, exact; row_k' their derivatives along v. L is the
// chord in mode chord, the anchor in mode anchor, 0 in mode origin; L_k are its rows. The sum is (1) of
// ode_blend.hpp, which a frame that does not move turns with both sides. Blends with a moving frame are
// evaluated point by point.
#include "app/view/session/blend_session.hpp"
#include "verify/continuity/seam.hpp"

namespace blendwright {

/// Points, normals and errors of `blend`; `seams` are its joints, measured at the grid's places along v.
void fill_grid(const OdeBlend& blend, const std::array<Seam, 2>& seams, SessionGrid& grid);

}  // namespace blendwright
