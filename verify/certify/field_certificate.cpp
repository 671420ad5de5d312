#include "verify/certify/field_certificate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/field/field_enclosure.hpp"
#include "kernel/geometry/curvature.hpp"
#include "verify/certify/model_figures.hpp"
#include "verify/certify/piece_search.hpp"
#include "verify/continuity/local_maximum.hpp"

namespace blendwright {
namespace {

using detail::SeamPiece;
using detail::SeamSample;

double edge(const FieldSeam& seam) {
  const Interval u = seam.blend.domain().u;
  return seam.side == 0 ? u.lo : u.hi;
}

/// (1)-(3) in plain doubles.
SeamSample sample(const FieldSeam& seam, double v) {
  const SurfaceJet S = seam.blend.jet({edge(seam), v});
  const std::array<Vec3, 1> at{S.S};
  const FieldValues f = seam.field.evaluate(Order::hessian, at);
  const Vec3 g = f.gradient(0);
  const std::array<double, 6> h = f.hessian(0);
  Eigen::Matrix3d H;
  H << h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2];
  Vec3 nS = unit_normal(S);
  SeamSample s;
  s.v = v;
  s.point = S.S;
  s.gap = std::abs(f.value(0) - surface_value(seam.field.level())) / g.norm();
  s.angle = plane_angle(nS, g).value;
  if (nS.dot(g) < 0.0) nS = -nS;
  const Vec3 t = g.cross(S.Sv);
  s.curvature = std::abs(normal_curvature(S, t, nS) + t.dot(H * t) / (t.squaredNorm() * g.norm()));
  return s;
}

double worst(const FieldSeam& seam, const std::vector<SeamSample>& samples, double SeamSample::*value) {
  std::size_t top = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (std::isnan(samples[i].*value)) return samples[i].*value;
    if (samples[i].*value > samples[top].*value) top = i;
  }
  const double lo = samples[top == 0 ? 0 : top - 1].v, hi = samples[std::min(top + 1, samples.size() - 1)].v;
  const auto f = [&](double v) { return sample(seam, v).*value; };
  const detail::Peak start{samples[top].v, samples[top].*value};
  return detail::polished_maximum(f, lo, hi, detail::local_maximum(f, lo, hi, start)).value;
}

/// Along the edge, of a field that encloses its derivatives.
void follow(const EnclosedField& field, double c, const SurfaceEnclosure& S, SeamPiece& piece) {
  FieldEnclosure f;
  field.enclose(S.S, f);
  const ModelVector& g = f.gradient;
  const TaylorModel squared = dot(g, g);
  const Bounds gap = ((f.value - TaylorModel(c)) * pow(squared, -0.5)).range();
  piece.gap = {gap.mignitude(), gap.magnitude()};
  const ModelVector nS = cross(S.Su, S.Sv);
  piece.angle = detail::angle_between(nS, g);
  const Bounds cosine = dot(nS, g).range();
  if (!(cosine.mignitude() > 0.0)) return;
  const ModelVector t = cross(g, S.Sv);
  const std::array<TaylorModel, 6>& h = f.hessian;
  const ModelVector Ht{h[0] * t[0] + h[3] * t[1] + h[4] * t[2], h[3] * t[0] + h[1] * t[1] + h[5] * t[2],
                       h[4] * t[0] + h[5] * t[1] + h[2] * t[2]};
  const TaylorModel kS = detail::curvature_along(S, nS, t);
  const TaylorModel kF = -(dot(t, Ht) * inverse(dot(t, t)) * pow(squared, -0.5));
  const Bounds jump = (cosine.lo > 0.0 ? kS - kF : kS + kF).range();
  piece.curvature = {jump.mignitude(), jump.magnitude()};
}

/// (4): the box holds the piece and a ball around each of its points, twice as wide as the gap in the middle.
void bound_distance(const ScalarField& field, double c, const ModelVector& X, SeamPiece& piece) {
  Box box;
  std::array<Vec3, 1> middle{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Bounds b = X[i].range();
    if (!b.finite()) return;
    const auto d = static_cast<Eigen::Index>(i);
    box.lo[d] = b.lo;
    box.hi[d] = b.hi;
    middle[0][d] = b.middle();
  }
  const FieldValues f = field.evaluate(Order::gradient, middle);
  const double guess = std::abs(f.value(0) - c) / f.gradient(0).norm(), diagonal = box.size().norm();
  const double ball = 2.0 * guess + 0.05 * diagonal + 1e-12 * (1.0 + box.centre().norm());
  if (!std::isfinite(ball)) return;
  box.lo.array() -= 1.01 * ball;
  box.hi.array() += 1.01 * ball;
  const LinearBound L = field.linear(box);
  const Vec3 centre = box.centre(), half = 0.5 * box.size();
  TaylorModel line(L.value - c);
  Bounds squared;  // |grad L|^2
  for (std::size_t i = 0; i < 3; ++i) {
    const auto d = static_cast<Eigen::Index>(i);
    const Bounds slope = Bounds(L.slope[d]) / Bounds(half[d]);
    line = line + TaylorModel(slope) * (X[i] - TaylorModel(centre[d]));
    squared = squared + square(slope);
  }
  const Bounds steep = sqrt(squared), value = line.range() + Bounds(L.rest.lo, L.rest.hi);
  // Centre and half size are rounded, and so is L.value - c.
  const double rounding = 0x1p-50 * (std::abs(L.value) + std::abs(c) + L.slope.cwiseAbs().sum());
  const Bounds off = value + Bounds(-rounding, rounding);
  if (!(steep.lo > 0.0) || !off.finite()) return;
  const Bounds far = Bounds(off.magnitude()) / steep, near = Bounds(off.mignitude()) / steep;
  if (!(far.hi <= ball)) return;
  piece.gap = {std::max(near.lo, 0.0), far.hi};
}

SeamPiece enclosed(const FieldSeam& seam, const EnclosedField* field, const Interval& v) {
  SeamPiece piece;
  piece.v = v;
  piece.gap = piece.angle = piece.curvature = Bounds{0.0, unbounded().hi};
  SurfaceEnclosure S;
  if (!seam.blend.enclose(edge(seam), TaylorModel::parameter(v.lo, v.hi), S))
    S.unproven = "the blend's surface has no enclosure";
  piece.unproven = S.unproven;
  if (!piece.unproven.empty()) return piece;
  const double c = surface_value(seam.field.level());
  if (field)
    follow(*field, c, S, piece);
  else
    bound_distance(seam.field, c, S.S, piece);
  return piece;
}

}  // namespace

SeamCertificate certify_on_field(const FieldSeam& seam, const CertifyOptions& options, int count) {
  constexpr double golden = 0.6180339887498949;
  const Interval domain = seam.blend.domain().v;
  std::vector<SeamSample> samples{sample(seam, domain.lo)};
  for (int i = 0; i + 2 < count; ++i) samples.push_back(sample(seam, domain.at((i + golden) / (count - 2))));
  samples.push_back(sample(seam, domain.hi));
  SeamCertificate certificate;
  certificate.name = seam.name;
  certificate.gap.sampled = worst(seam, samples, &SeamSample::gap);
  certificate.angle.sampled = worst(seam, samples, &SeamSample::angle);
  certificate.curvature.sampled = worst(seam, samples, &SeamSample::curvature);
  const auto* field = dynamic_cast<const EnclosedField*>(&seam.field.model());
  detail::prove({.enclosed = [&](const Interval& v) { return enclosed(seam, field, v); },
                 .sample = [&](double v) { return sample(seam, v); },
                 .domain = domain,
                 .first = detail::first_pieces(seam.blend),
                 .unbounded = field ? "" : "the field gives no bounds of its derivatives"},
                options, certificate);
  return certificate;
}

}  // namespace blendwright
