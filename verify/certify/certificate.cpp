#include "verify/certify/certificate.hpp"

#include <array>
#include <cmath>

#include "kernel/base/number_text.hpp"
#include "verify/certify/piece_search.hpp"

namespace blendwright {
SeamCertificate certify_seam(const Seam& seam, const SeamReport& sampled, const CertifyOptions& options) {
  SeamCertificate c;
  c.name = seam.name;
  c.measured = seam.primary.has_value();
  c.gap.sampled = sampled.gap.worst;
  c.angle.sampled = sampled.angle.worst;
  c.curvature.sampled = sampled.curvature.worst;
  if (!c.measured || !seam.pcurve) {
    detail::refuse(c, c.measured ? "the seam has no trimline of its primary" : "the side has no primary");
    return c;
  }
  const detail::SeamProbe probe(seam);
  const double least_normal = probe.least_normal();
  detail::prove({.enclosed = [&](const Interval& v) { return detail::enclosed_piece(seam, v, least_normal); },
                 .sample = [&](double v) { return probe.measure(v, std::nullopt); },
                 .domain = seam.blend.domain().v,
                 .first = detail::first_pieces(seam.blend)},
                options, c);
  return c;
}

std::string shortfall(const SeamCertificate& c, Continuity asked, const Tolerance& tolerance,
                      LengthUnit unit) {
  if (!c.measured) return {};
  const double degree = Radians(1.0).degrees();
  struct Row {
    const ProvenFigure& figure;
    const char* name;
    double limit, factor;
    std::string unit;
    Continuity least;
  };
  const std::string length = name(unit);
  const std::array<Row, 3> rows{
      {{c.gap, "gap", tolerance.position, 1.0, length, Continuity::G0},
       {c.angle, "angle", tolerance.angle.value, degree, "deg", Continuity::G1},
       {c.curvature, "curvature jump", tolerance.curvature, 1.0, "1/" + length, Continuity::G2}}};
  std::string text;
  for (const Row& r : rows) {
    if (asked < r.least || (r.figure.proven <= r.limit && r.figure.agreed())) continue;
    const std::string bound = std::isfinite(r.figure.proven)
                                  ? " at most " + number_text(r.figure.proven * r.factor, 3) + " " + r.unit
                                  : std::string();
    text += (text.empty() ? "" : "; ") + std::string(r.name);
    text += r.figure.agreed()
                ? " proven" + bound + ", more than " + number_text(r.limit * r.factor, 3) + " " + r.unit
                : " unproven" + (bound.empty() ? bound : "," + bound) + ": " + r.figure.unproven;
  }
  return text;
}

}  // namespace blendwright
