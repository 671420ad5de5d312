#include "parametric/ode/ode_blend.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

std::string text(const Interval& i) { return "[" + number_text(i.lo) + ", " + number_text(i.hi) + "]"; }

void check_shape(const BlendShape& shape) {
  std::vector<Problem> problems;
  if (shape.mode == BlendMode::anchor && !shape.anchor.allFinite())
    problems.push_back({"anchor", "is not a point with finite coordinates"});
  if (shape.frame == BlendFrame::fixed) {
    const Eigen::Matrix3d product = shape.axes.transpose() * shape.axes;
    const double defect = (product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(defect <= 1e-9))
      problems.push_back(
          {"axes", "are not orthonormal (defect " + scientific_text(defect) + "); it must be at most 1e-9"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::vector<CardinalBasis> make_bases(const BlendShape& shape, int order) {
  if (order == 6)
    return std::vector<CardinalBasis>(3, CardinalBasis::sixth_order(shape.family, shape.tension));
  if (shape.repeated_root)
    return std::vector<CardinalBasis>(3, CardinalBasis::repeated_root(*shape.repeated_root));
  std::vector<CardinalBasis> bases;
  for (std::size_t x = 0; x < 3; ++x) try {
      if (x > 0 && shape.ode[x] == shape.ode[x - 1])
        bases.push_back(bases.back());
      else
        bases.push_back(CardinalBasis::fourth_order(shape.ode[x]));
    } catch (const InputError& e) {
      throw e.under("ode/" + std::to_string(x));
    }
  return bases;
}

/// Largest distance that positions and cross tangents jump over the closing of a trimline.
double closing_gap(const EndCondition& end, bool second) {
  const EndSeries lo = end.series(end.domain.v.lo), hi = end.series(end.domain.v.hi);
  double gap = std::max((derivative(lo.C, 0) - derivative(hi.C, 0)).norm(),
                        (derivative(lo.T, 0) - derivative(hi.T, 0)).norm());
  if (second) gap = std::max(gap, (derivative(lo.D, 0) - derivative(hi.D, 0)).norm());
  return gap;
}

double size_of(const std::array<EndCondition, 2>& ends) {
  Vec3 lo = Vec3::Constant(HUGE_VAL), hi = -lo;
  for (const EndCondition& end : ends)
    for (int k = 0; k <= 16; ++k) {
      const Vec3 C = derivative(end.series(end.domain.v.at(k / 16.0)).C, 0);
      lo = lo.cwiseMin(C);
      hi = hi.cwiseMax(C);
    }
  return (hi - lo).norm();
}

[[noreturn]] void throw_no_frame(double value, const char* what) {
  throw GeometryError(std::string("the moving frame is undefined: ") + what + " (" + scientific_text(value) +
                      "); choose a fixed or the global frame");
}

}  // namespace

const char* name(BlendMode m) {
  switch (m) {
    case BlendMode::origin:
      return "origin";
    case BlendMode::anchor:
      return "anchor";
    case BlendMode::chord:
      return "chord";
  }
  return "?";
}

const char* name(BlendFrame f) {
  switch (f) {
    case BlendFrame::global:
      return "global";
    case BlendFrame::fixed:
      return "fixed";
    case BlendFrame::moving:
      return "moving";
  }
  return "?";
}

/// The section at v with derivatives along v: exact to order 2.
struct OdeBlend::RowSeries {
  std::array<Series3, 6> B;
  Series3 line0, line1;
  std::array<Series3, 3> axes;  // columns
};

OdeBlend::OdeBlend(EndCondition end0, EndCondition end1, BlendShape shape)
    : ends_{std::move(end0), std::move(end1)}, shape_(std::move(shape)) {
  if (ends_[0].continuity == Continuity::G2 || ends_[1].continuity == Continuity::G2) order_ = 6;
  check_shape(shape_);
  bases_ = make_bases(shape_, order_);
  if (order_ == 6) {
    const CardinalBasis lower = CardinalBasis::fourth_order(SweepOde::tension(shape_.tension));
    for (std::size_t i = 0; i < 2; ++i) {
      const CardinalValues phi = lower(static_cast<double>(i));
      std::copy_n(phi.value[2].begin(), 4, completion_[i].begin());
    }
  }
  for (std::size_t x = 0; x < 3 && order_ == 4; ++x)
    bends_[x] = shape_.repeated_root ? end_bends(*shape_.repeated_root) : end_bends(shape_.ode[x]);
  check_ends();
}

void OdeBlend::check_ends() const {
  const Interval a = ends_[0].domain.v, b = ends_[1].domain.v;
  const double slack = 1e-12 * std::max(std::abs(a.length()), std::abs(b.length()));
  if (!(a.lo < a.hi)) throw GeometryError("the domain " + text(a) + " of end 0 is empty");
  if (!(std::abs(a.lo - b.lo) <= slack) || !(std::abs(a.hi - b.hi) <= slack))
    throw GeometryError("the ends have different domains in v, " + text(a) + " and " + text(b) +
                        "; they must agree");
  const double size = size_of(ends_);
  for (std::size_t i = 0; i < 2; ++i) {
    if (!ends_[i].domain.closed) continue;
    const double gap = closing_gap(ends_[i], ends_[i].continuity == Continuity::G2);
    if (!(gap <= 1e-10 * size))
      throw GeometryError("end " + std::to_string(i) + " is closed but its data do not close: gap " +
                          scientific_text(gap) + ", must be at most 1e-10 of the size " +
                          number_text(size, 6));
  }
  if (shape_.frame == BlendFrame::moving)
    for (int k = 0; k <= 16; ++k) (void)row_series(a.at(k / 16.0));
}

std::array<Series3, 3> OdeBlend::frame(const EndSeries& e0, const EndSeries& e1) const {
  if (shape_.frame != BlendFrame::moving) {
    const Eigen::Matrix3d axes =
        shape_.frame == BlendFrame::fixed ? shape_.axes : Eigen::Matrix3d::Identity();
    return {constant(axes.col(0)), constant(axes.col(1)), constant(axes.col(2))};
  }
  const Series3 De = e1.C - e0.C;
  const Series3 n0 = cross(e0.T, differentiated(e0.C)), n1 = cross(e1.T, differentiated(e1.C));
  const auto length = [](const Series3& s) { return derivative(s, 0).norm(); };
  if (!(length(De) > 0.0)) throw_no_frame(length(De), "the trimlines touch, |C1 - C0| vanishes");
  if (!(length(n0) > 0.0)) throw_no_frame(length(n0), "the cross tangent at end 0 runs along the trimline");
  if (!(length(n1) > 0.0)) throw_no_frame(length(n1), "the cross tangent at end 1 runs along the trimline");
  const Series3 x = normalized(De), sum = normalized(n0) + normalized(n1);
  const Series3 normal = sum - dot(sum, x) * x;
  if (!(length(normal) > 1e-8))
    throw_no_frame(length(normal), "the normals at both ends cancel, their sum across the chord");
  const Series3 z = normalized(normal);
  return {x, cross(z, x), z};
}

OdeBlend::RowSeries OdeBlend::row_series(double v) const {
  const EndSeries e0 = ends_[0].series(v), e1 = ends_[1].series(v);
  const std::array<Series3, 4> data{e0.C, e0.T, e1.C, e1.T};
  const auto second = [&](std::size_t end, const Series3& given) {
    if (ends_[end].continuity == Continuity::G2) return given;
    Series3 D{};
    for (std::size_t k = 0; k < 4; ++k) D = D + completion_[end][k] * data[k];
    return D;
  };
  RowSeries r;
  r.axes = frame(e0, e1);
  Series3 De{};  // the slope of what is taken off before (1)
  if (shape_.mode == BlendMode::chord) {
    r.line0 = e0.C;
    r.line1 = e1.C;
    De = e1.C - e0.C;
  } else if (shape_.mode == BlendMode::anchor) {
    r.line0 = r.line1 = constant(shape_.anchor);
  }
  const std::size_t half = static_cast<std::size_t>(order_) / 2;
  r.B[0] = e0.C - r.line0;
  r.B[1] = e0.T - De;
  r.B[half] = e1.C - r.line1;
  r.B[half + 1] = e1.T - De;
  if (order_ == 6) {
    r.B[2] = second(0, e0.D);
    r.B[5] = second(1, e1.D);
  }
  if (shape_.frame != BlendFrame::global)
    for (std::size_t k = 0; k < 2 * half; ++k)
      r.B[k] = {dot(r.axes[0], r.B[k]), dot(r.axes[1], r.B[k]), dot(r.axes[2], r.B[k])};
  return r;
}

BlendSection OdeBlend::section(double v) const {
  const RowSeries r = row_series(v);
  BlendSection s;
  for (std::size_t k = 0; k < 6; ++k) s.B[k] = derivative(r.B[k], 0);
  s.line0 = derivative(r.line0, 0);
  s.line1 = derivative(r.line1, 0);
  for (std::size_t x = 0; x < 3; ++x) s.axes.col(static_cast<Eigen::Index>(x)) = derivative(r.axes[x], 0);
  return s;
}

std::array<CardinalValues, 3> OdeBlend::cardinals(double u) const {
  const CardinalValues first = bases_[0](u);
  if (order_ == 6 || shape_.isotropic()) return {first, first, first};
  return {first, bases_[1](u), bases_[2](u)};
}

std::array<Series3, 4> OdeBlend::u_derivatives(UV p) const {
  const RowSeries r = row_series(p.v);
  const std::array<CardinalValues, 3> phi = cardinals(p.u);
  std::array<Series3, 4> G{};
  for (std::size_t j = 0; j < 4; ++j) {
    Series3 local{};
    for (std::size_t x = 0; x < 3; ++x)
      for (std::size_t k = 0; k < static_cast<std::size_t>(order_); ++k)
        local[x] = local[x] + phi[x].value[j][k] * r.B[k][x];
    G[j] = local;
    if (shape_.frame != BlendFrame::global)
      G[j] = local[0] * r.axes[0] + local[1] * r.axes[1] + local[2] * r.axes[2];
  }
  if (shape_.mode != BlendMode::origin) {
    G[0] = G[0] + ((1.0 - p.u) * r.line0 + p.u * r.line1);
    G[1] = G[1] + (r.line1 - r.line0);
  }
  return G;
}

SurfaceJet OdeBlend::jet(UV p) const {
  const std::array<Series3, 4> G = u_derivatives(p);
  return {derivative(G[0], 0), derivative(G[1], 0), derivative(G[0], 1),
          derivative(G[2], 0), derivative(G[1], 1), derivative(G[0], 2)};
}

SurfacePartials OdeBlend::partials(UV p) const {
  const std::array<Series3, 4> G = u_derivatives(p);
  SurfacePartials P;
  P.d.fill(Vec3::Zero());
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; j <= 2 && i + j <= 4; ++j) P(i, j) = derivative(G[static_cast<std::size_t>(i)], j);
  return P;
}

SurfaceDomain OdeBlend::domain() const {
  return {
      .u = {0.0, 1.0}, .v = ends_[0].domain.v, .v_closed = ends_[0].domain.closed && ends_[1].domain.closed};
}

}  // namespace blendwright
