// Uses the installed library: a blend between two coaxial cylinders, verified.
#include <iostream>

#include "kernel/primitives/primary.hpp"
#include "parametric/blend.hpp"
#include "verify/continuity/seam.hpp"

using namespace blendwright;

int main() {
  const Surface small =
      make_primary({.kind = "cylinder", .numbers = {{"radius", 1.0}}, .u = Interval{-2.0, 0.0}});
  const Surface large =
      make_primary({.kind = "cylinder", .numbers = {{"radius", 2.0}}, .u = Interval{3.0, 5.0}});
  const Blend blend = make_blend(isoline(small, IsoDirection::constant_u, 0.0),
                                 isoline(large, IsoDirection::constant_u, 3.0), {}, 1e-6);
  for (int side = 0; side < 2; ++side) {
    const Trimline& line = *blend.trimlines[static_cast<std::size_t>(side)];
    const SeamReport r = check_seam({.name = side == 0 ? "from" : "to",
                                     .blend = blend.surface,
                                     .side = side,
                                     .primary = line.primary(),
                                     .pcurve = line.pcurve(),
                                     .kept_left = blend.tangents->kept_left[static_cast<std::size_t>(side)]});
    std::cout << r.name << ": gap " << r.gap.worst << ", angle " << r.angle.worst << " rad\n";
    if (reached(r, {}) < Continuity::G1) return 1;
  }
}
