#pragma once
// Cuts a trimline into pieces until the bounds of its figures agree with what is known to occur; the rules of
// certificate.hpp.
#include <functional>
#include <string>
#include <vector>

#include "verify/certify/certificate.hpp"
#include "verify/certify/seam_piece.hpp"
#include "verify/continuity/seam_probe.hpp"

namespace blendwright::detail {

struct PieceSource {
  std::function<SeamPiece(const Interval& v)> enclosed;  ///< called from several threads
  std::function<SeamSample(double v)> sample;            ///< gap, angle and curvature in plain doubles
  Interval domain;
  std::vector<Interval> first;  ///< pieces to begin with
  std::string unbounded{};      ///< why a figure may be unbounded everywhere
};

/// Fills in what is proven; `sampled` of each figure is there already.
void prove(const PieceSource& source, const CertifyOptions& options, SeamCertificate& certificate);
/// Nothing is proven.
void refuse(SeamCertificate& certificate, const std::string& why);
/// Pieces of v on which the blend is one polynomial; equal steps where it is none.
[[nodiscard]] std::vector<Interval> first_pieces(const Surface& blend);

}  // namespace blendwright::detail
