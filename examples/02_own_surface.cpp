// The library without job files: an own surface, a trimline on it, the exact blend, its fit and the proof.
//   ./build/release/examples/02_own_surface  prints the figures of both sides, exact and fitted
#include <cmath>
#include <iostream>

#include "kernel/geometry/formula_surface.hpp"
#include "kernel/primitives/primary.hpp"
#include "parametric/blend.hpp"
#include "parametric/fit/blend_fit.hpp"
#include "verify/report/blend_report.hpp"

using namespace blendwright;

struct Bowl {  // written once for any number type: exact derivatives come for free
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    using std::cos, std::sin;
    return {u * cos(v), u * sin(v), 0.2 * u * u + 0.1 * u * cos(3.0 * v)};
  }
  [[nodiscard]] SurfaceDomain domain() const { return {{1.0, 3.0}, {0.0, 6.283185307179586}, false, true}; }
};

int main() {
  const Surface bowl = FormulaSurface<Bowl>(Bowl{});
  const Surface pipe =
      make_primary({.kind = "cylinder", .numbers = {{"radius", 0.6}}, .u = Interval{-4.0, -1.0}});
  BlendSpec spec;
  spec.sides[0].continuity = spec.sides[1].continuity = Continuity::G2;
  const Blend blend = make_blend(isoline(bowl, IsoDirection::constant_u, 1.0),
                                 isoline(pipe, IsoDirection::constant_u, -1.0), spec, 1e-6);
  const BlendFit fit = fit_blend(blend.surface, {});
  std::cout << fit.report.control_points << " control points, within " << fit.report.position_bound << "\n";
  for (const Surface& surface : {Surface(blend.surface), Surface(fit.surface)})
    for (std::size_t side = 0; side < 2; ++side) {
      const Trimline& line = *blend.trimlines[side];
      const SeamReport r = check_seam({.name = side == 0 ? "from bowl" : "to pipe",
                                       .blend = surface,
                                       .side = static_cast<int>(side),
                                       .primary = line.primary(),
                                       .pcurve = line.pcurve(),
                                       .kept_left = blend.tangents->kept_left[side]});
      std::cout << r.name << ": gap " << r.gap.worst << ", angle " << r.angle.worst << " rad, curvature jump "
                << r.curvature.worst << "\n";
      if (reached(r, {}) != Continuity::G2) return 1;
    }
}
