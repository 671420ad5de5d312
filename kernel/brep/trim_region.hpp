#pragma once
// Private: which part of a parameter rectangle stays when lines cut it. Plane geometry only; nothing here
// knows surfaces.
//
// Lines are oriented so that the kept part is on their left. Each is split where it crosses the seam of a
// closed direction and moved by periods into the rectangle, so that a line around a cylinder becomes a line
// from the left border to the right one. Lines that end on the border are joined along the border,
// counter-clockwise (region walk); the others form loops: counter-clockwise ones bound the kept part,
// clockwise ones are holes.
#include <functional>
#include <string>
#include <vector>

#include "kernel/geometry/surface.hpp"

namespace blendwright::detail {

struct RegionBox {
  SurfaceDomain box;
  Vec2 scale = Vec2::Ones();  ///< length in space of a unit of each parameter, roughly
  double slack = 1e-7;        ///< points this near (in space) are one point
};

struct RegionCut {
  std::string name;                ///< for messages
  std::function<Vec2(double)> at;  ///< continuous, not wrapped
  Interval v;
  bool kept_left = true;
};

/// A stretch of a cut that lies in the rectangle once `shift` is added.
struct CutPiece {
  std::size_t cut = 0;
  Interval v;
  Vec2 shift = Vec2::Zero();
  std::vector<Vec2> points;  ///< samples from v.lo to v.hi, shifted
  bool lo_on_border = false, hi_on_border = false;
};

struct RegionSegment {
  enum class Kind { cut, border, extension } kind = Kind::border;
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  std::size_t piece = 0;  ///< cut: index of the piece
  bool backward = false;  ///< cut: run from v.hi to v.lo
  int side = 0;           ///< border: 0 v = lo, 1 u = hi, 2 v = hi, 3 u = lo
};
using RegionWire = std::vector<RegionSegment>;

struct RegionFace {
  RegionWire outer;
  std::vector<RegionWire> holes;
};

struct TrimRegion {
  std::vector<CutPiece> pieces;
  std::vector<RegionFace> faces;
  std::vector<std::string> warnings;
};

[[nodiscard]] TrimRegion trim_region(const RegionBox& box, const std::vector<RegionCut>& cuts);

/// Whether a point, moved by periods into the rectangle, lies in one of the faces.
[[nodiscard]] bool region_contains(const SurfaceDomain& box, const TrimRegion& region, Vec2 p);

/// Places for the seams of the closed directions, to be tried with trim_region: the start of a line that
/// winds around the direction, the middles of the gaps between lines that do not, the present place.
[[nodiscard]] std::array<std::vector<double>, 2> seam_candidates(const SurfaceDomain& box,
                                                                 const std::vector<RegionCut>& cuts);

}  // namespace blendwright::detail
