#pragma once
// Proven bounds of a blend's edge that lies on an implicit surface f = c, X = S(u_side, v) a point of it:
//
//   gap(v)       = |f(X) - c| / |grad f(X)|  (first order; or the distance, see below) (1)
//   angle(v)     = atan2(|nS x g|, |nS.g|),   nS = Su x Sv,  g = grad f(X) (2)
//   curvature(v) = |kS(t) - kF(t)|,   t = g x Sv,   kF = -t.H t / (|t|^2 |g|) about g (3)
// A field whose model encloses its derivatives (kernel/field/field_enclosure.hpp) is followed along the edge
// like a surface. Of any other only its linear bounds over boxes are known, f = L + rest, and with them the
// distance of X to the surface f = c in a ball that fits into the box:
//   min |L + rest| / |grad L| <= distance <= max |L + rest| / |grad L| (4)
// since f changes its sign within that way along grad L, and does not before. No box of values bounds a
// derivative, so that angle and curvature are then unproven, which the certificate says. (1) and (4) differ
// by the square of the gap.
#include "kernel/field/scalar_field.hpp"
#include "verify/certify/certificate.hpp"

namespace blendwright {

struct FieldSeam {
  std::string name{};
  Surface blend;
  int side = 0;  ///< 0: the edge u = lo, 1: the edge u = hi
  ScalarField field;
};

/// `samples`: places along v at which (1)-(3) are sampled; each worst is refined to a local maximum. Never
/// throws because the geometry is bad. The same certificate for any number of threads.
[[nodiscard]] SeamCertificate certify_on_field(const FieldSeam& seam, const CertifyOptions& options = {},
                                               int samples = 2048);

}  // namespace blendwright
