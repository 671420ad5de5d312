#pragma once
// The second path: gap and angle of a joint measured again, by code that shares nothing with the first
// (verify/continuity). Two programs that agree are rarely wrong in the same way; where they do not agree, the
// program has a defect, whatever the surfaces are like.
//
// At places v of the trimline, the worst ones of the first report among them:
//   gap(v)      = |S(u_side, v) - P(pcurve(v))|, positions from `point` of the surfaces                   (1)
//   distance(v) = distance of S(u_side, v) to the primary, from `distance` of the primary                 (2)
//   angle(v)    = atan2(|nS x nP|, |nS.nP|) with normals nS = Su x Sv, nP = Pu x Pv made from positions   (3)
// Normals are not taken from the surfaces' own derivatives. B-splines are differentiated by the complex step
// in de Boor's algorithm (spline_step.hpp): as exact as rounding allows, across all knots. Everything else,
// the exact blend above all, is known as a function of doubles only, and dual or complex numbers cannot enter
// it; there, derivatives are extrapolated difference quotients of `point` with an error estimate
// (differences.hpp). Our Taylor series would be more exact, but they are what the first path uses.
//
// Bounds of a disagreement, eps = 2^-52, M = largest coordinate in play:
//   gap:       64 eps (M + |u Pu| + |v Pv|) + what the surfaces are said to be uncertain by               (4)
//              64: a point of a tensor spline of degrees 5 x 5 takes some 60 roundings of parts of M
//   distance:  (4) + what the search left along the surface                                               (5)
//   angle:     sum over both surfaces of (10 (e_u |Sv| + e_v |Su|) + 64 eps |Su| |Sv|) / |Su x Sv|        (6)
//              e: error estimates of the derivatives; 10, since they are estimates
// A joint that is open by more than a millionth of its length is only checked for (2) <= the first path's
// distance, since the first path stays within the primary's borders then. Where a surface has no normal
// nothing is compared: the first path takes a one-sided limit there.
#include <array>
#include <functional>
#include <optional>
#include <string>

#include "verify/continuity/seam.hpp"
#include "verify/surface/surface_checks.hpp"

namespace blendwright {

/// A surface as other code knows it.
struct SecondSurface {
  std::function<Vec3(UV)> point;  ///< position, at the parameters of the surface itself
  /// Distance, the parameters of the closest point, and how far the search may be off.
  struct Closest {
    UV at;
    double distance = 0.0, slack = 0.0;  ///< NaN: not found
  };
  std::function<Closest(const Vec3&)> closest{};  ///< empty: distances are not measured again
  double uncertainty = 0.0;  ///< of `closest`: how far that surface may be from the one that is meant
};

/// One figure at the place where first and second differ most, held against the bound there.
struct SecondFigure {
  std::size_t places = 0;  ///< compared; 0: none, and nothing below counts
  double first = 0.0, second = 0.0;
  double difference = 0.0;  ///< |first - second|, or what second is above first where only that is wrong
  double bound = 0.0;
  double v = 0.0;
  Vec3 point = Vec3::Zero();
  [[nodiscard]] bool agrees() const { return places == 0 || difference <= bound; }
};

struct SecondSeam {
  std::string name;
  SecondFigure gap, surface_gap, angle;  ///< as those of SeamReport
};

/// @param first     the report of the same seam
/// @param surfaces  the blend's and the primary's
/// @param places    along the trimline, besides the three worst places of the first report
[[nodiscard]] SecondSeam second_path(const Seam& seam, const SeamReport& first,
                                     const std::array<SecondSurface, 2>& surfaces, int places = 8);

struct SecondClosing {
  SecondFigure gap, angle;  ///< as those of ClosingReport; `v` is u here
};
[[nodiscard]] SecondClosing second_closing(const Surface& blend, const ClosingReport& first,
                                           const SecondSurface& surface);

}  // namespace blendwright
