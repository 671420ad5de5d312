#pragma once
// How fair a surface is: energies, extremes of curvature and where they are, how often curvature turns along
// the lines that cross the blend, draft.
//
//   bending energy      integral of (k1^2 + k2^2) dA                          dimensionless (1) thin plate
//   integral of |Suu|^2 + 2 |Suv|^2 + |Svv|^2 du dv       length^2; of the parametrisation,
//                       over the unit square (2)
//   variation           integral of (dk/ds)^2 dA, k the normal curvature of the lines v = constant and s
//   their
//                       arc length                                            1/length^2 (3)
// k1, k2 principal curvatures. Sources: (1) Lott and Pullin, Method for fairing B-spline surfaces, 1988; (2)
// Hagen and Schulze, Automatic smoothing with geometric surface patches, 1987; (3) after Moreton and Sequin,
// Functional optimization for fair surface design, 1992, with one of its two directions.
#include "verify/surface/surface_checks.hpp"

namespace blendwright {

struct FairnessOptions {
  int nu = 16, nv = 96;  ///< cells of the quadrature, four Gauss points each way
  /// Unit vector along which a mould opens; none: draft is not measured. Throws InputError ("pull")
  /// otherwise.
  std::optional<Vec3> pull{};
};

/// Curvature along the lines v = constant: a fair transition has few places where it turns.
struct CurvatureTurns {
  int most = 0;    ///< places inside a line where curvature has a local extreme; wiggles below 1e-6 of the
                   ///< largest curvature do not count
  double v = 0.0;  ///< the first line with that many
  double average = 0.0;  ///< per line
};

struct FairnessReport {
  double area = 0.0;                                        ///< model units^2
  double bending = 0.0, thin_plate = 0.0, variation = 0.0;  ///< (1)-(3)
  /// Principal curvatures, signed by n = Su x Sv, refined to local extremes; 1/model unit.
  Extreme largest, smallest;
  Extreme minimum_radius;  ///< 1/max(|k1|, |k2|); infinite for a plane
  CurvatureTurns turns;
  /// asin(n.pull) in radians: 0 where the wall stands along the pull, pi/2 where it faces it.
  std::optional<std::array<Extreme, 2>> draft;  ///< least, most
  std::size_t unmeasured = 0;  ///< samples without a normal or that are not finite: energies leave them out
};

/// Never throws because the geometry is bad. The same report for any number of threads.
[[nodiscard]] FairnessReport fairness(const Surface& surface, const FairnessOptions& options = {},
                                      const Progress& progress = {});

}  // namespace blendwright
