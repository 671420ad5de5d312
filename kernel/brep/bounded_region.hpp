#pragma once
// Private: how trimlines, and the edges of the face they run on, divide a primary.
#include <optional>
#include <vector>

#include "kernel/brep/cut_pcurve.hpp"
#include "kernel/brep/face_boundary.hpp"
#include "kernel/brep/primary_geometry.hpp"
#include "kernel/brep/trim_region.hpp"

namespace blendwright::detail {

/// The parameter curve of a stretch of an edge of the face.
[[nodiscard]] CutPcurve boundary_pcurve(const BoundaryLine& line, const PrimaryGeometry& g, const Vec2& shift,
                                        const Interval& range, double tolerance);

/// Cuts of a primary in the parameters of a geometry, which depend on where its seams are.
using CutsOn = std::function<std::vector<RegionCut>(const PrimaryGeometry&)>;

struct DividedPrimary {
  PrimaryGeometry geometry;
  TrimRegion region;
  std::vector<BoundaryLine> lines;  ///< cuts behind the trimlines
  bool bounded = false;             ///< the face's own edges bound the region
  bool loses = false;               ///< edges of the face inside its parameter box are lost
};

/// Tries the possible places of the seams; the simplest division wins. Where the primary is a face of a part,
/// its edges bound the kept part too: those along a trimline are replaced by it, those that a trimline
/// removes go. Where a trimline crosses an edge inside the box, or edges do not close within `tolerance`, the
/// primary is its parameter box, and `loses` says so.
[[nodiscard]] DividedPrimary divide_primary(const PrimaryGeometry& plain, const CutsOn& trimlines,
                                            double tolerance);

}  // namespace blendwright::detail
