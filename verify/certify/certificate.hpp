#pragma once
// Proven bounds of a joint: no point of the trimline, between the samples or on them, deviates by more.
//
// The parameter v of the trimline is cut into pieces. On each, the blend's edge S(u_side, v), the primary
// P(u(v), v(v)) and their first and second derivatives are enclosed in Taylor models with outward rounding
// (kernel/geometry/enclosure.hpp), and from them
//   gap(v)       = |S - P| (1) angle(v)     = atan2(|nS x nP|, |nS.nP|),   nS = Su x Sv,  nP = Pu x Pv (2)
//   curvature(v) = |kS(t) - kP(t)|,   t = nP x C',   nS turned to the side of nP (3)
// the same figures as in seam.hpp, as intervals [lo, hi] that contain every value on the piece. Pieces are
// halved until the largest hi is at most `ratio` times the largest value known to occur (the larger of the
// sampled worst and the largest lo) plus a floor for rounding, or until there are `max_pieces`: then the
// figure is not agreed and says why. A largest lo above the sampled worst is a defect that the samples
// missed.
//
// The bounds hold for the surfaces as their enclosures define them: formulas and splines in exact arithmetic
// on the doubles that they are made of. What rounding does to an enclosure is measured: over a piece of no
// width at all, an interval contains nothing but the roundings of its own evaluation, so that
//   floor = 4 max over places of (hi - lo) (4)
// 4, because it is looked at in some 64 places only; places 64 times wider than the middle one are left out,
// where a pole and not rounding widens them; for angles another 2^-52, a rounding of a unit normal.
// Evaluation in plain doubles rounds less often, so that at the same places what is sampled must lie within
//   [lo - floor, hi + floor] (5)
// or the surface is not evaluated as it is defined, and nothing is agreed.
//
// Where the trimline stops (|C'| = 0 at an end of a piece) neither surface has a normal, but their angle has
// a limit, which is bounded through the means of the normals' derivatives (verify/certify/seam_piece.hpp).
// As for samples, angles at places with next to no normal are those a millionth of the domain further inside.
#include <cstddef>
#include <string>

#include "verify/continuity/seam.hpp"

namespace blendwright {

/// One figure as the pair (sampled, proven).
struct ProvenFigure {
  double sampled = 0.0;    ///< worst sample, refined to a local maximum
  double found = 0.0;      ///< a value proven to occur somewhere: at least this bad
  double proven = 0.0;     ///< no value exceeds this; infinite when nothing is proven
  double floor = 0.0;      ///< (4)
  double v = 0.0;          ///< middle of the piece with the largest bound
  std::string unproven{};  ///< why the pair does not agree, or nothing is proven; empty: it agrees
  [[nodiscard]] bool agreed() const { return unproven.empty(); }
};

struct SeamCertificate {
  std::string name;
  bool measured = true;                ///< false: the seam has no primary
  ProvenFigure gap, angle, curvature;  ///< model units, radians, 1/model unit
  std::size_t pieces = 0;              ///< enclosures that were evaluated
};

struct CertifyOptions {
  double ratio = 1.1;
  std::size_t max_pieces = 20000;  ///< half of it for one figure at most
};

/// `sampled`: the report of the same seam. Never throws because the geometry is bad: then nothing is proven.
/// The same certificate for any number of threads.
[[nodiscard]] SeamCertificate certify_seam(const Seam& seam, const SeamReport& sampled,
                                           const CertifyOptions& options = {});

/// "gap 3.4e-08 mm proven at most; the samples show 1.1e-08" for a person: what of the figures that `asked`
/// needs does not hold: unproven, or proven to miss the tolerance. Empty: all proven within the tolerance.
[[nodiscard]] std::string shortfall(const SeamCertificate& certificate, Continuity asked,
                                    const Tolerance& tolerance, LengthUnit unit = LengthUnit::millimetre);

}  // namespace blendwright
