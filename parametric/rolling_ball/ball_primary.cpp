#include "parametric/rolling_ball/ball_primary.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/geometry/project.hpp"
#include "kernel/math/small_solve.hpp"

namespace blendwright {
namespace {

Eigen::Matrix2d inverse_of(const Eigen::Matrix2d& A) {
  return solve_small<2, 2>(A, Eigen::Matrix2d::Identity());
}

constexpr int max_steps = 40;
/// A Newton step this much shorter than the model leaves an error of the order of its square, below rounding.
constexpr double last_step = 1e-8;
/// Part of c - p across the normal, relative to the coordinates, that counts as none.
constexpr double orthogonal = 1e-10;

/// phi >= 0 inside, with its derivatives.
struct Phi {
  double f = 0.0;
  Vec3 g = Vec3::Zero();
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
};

Phi phi_at(const ScalarField& field, const Vec3& p, Order order) {
  const FieldValues values = field.evaluate(order, std::span(&p, 1));
  const double s = sense(field.level());
  Phi phi{inside(field.level(), values.value(0)), s * values.gradient(0), {}};
  if (order == Order::hessian) {
    const std::array<double, 6> h = values.hessian(0);
    phi.H << h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2];
    phi.H *= s;
  }
  return phi;
}

/// Two unit vectors that span the plane across n.
Eigen::Matrix<double, 3, 2> tangents(const Vec3& n) {
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  Eigen::Matrix<double, 3, 2> e;
  e.col(0) = n.cross(Vec3(Vec3::Unit(least))).normalized();
  e.col(1) = n.cross(e.col(0));
  return e;
}

/// Fills distance, bend, turn and room from the symmetric W in the tangent basis e.
void set_second_order(BallFoot& foot, const Vec3& c, const Eigen::Matrix<double, 3, 2>& e,
                      const Eigen::Matrix2d& W) {
  foot.distance = (c - foot.point).dot(foot.normal);
  foot.bend = e * W * e.transpose();
  const double mean = 0.5 * (W(0, 0) + W(1, 1));
  const double spread = std::hypot(0.5 * (W(0, 0) - W(1, 1)), 0.5 * (W(0, 1) + W(1, 0)));
  foot.room = 1.0 + std::min(foot.distance * (mean - spread), foot.distance * (mean + spread));
  if (!(foot.room > 0.0)) return;
  const Eigen::Matrix2d A = Eigen::Matrix2d::Identity() + foot.distance * W;
  foot.turn = e * (W * inverse_of(A)) * e.transpose();
}

/// Whether c - p stands on the surface, up to rounding of the coordinates.
bool stands(const BallFoot& foot, const Vec3& c) {
  const Vec3 d = c - foot.point;
  const double size = 1e-300 + c.norm() + foot.point.norm() + d.norm();
  return (d - foot.normal * foot.normal.dot(d)).norm() <= orthogonal * size;
}

std::optional<BallFoot> foot_of(const ScalarField& field, const Vec3& c, Vec3 p) {
  const auto start = descended(field, p);
  if (!start) return std::nullopt;
  p = *start;
  double l = 0.0;
  bool last = false;
  for (int k = 0; k < max_steps; ++k) {
    const Phi phi = phi_at(field, p, Order::hessian);
    const double g2 = phi.g.squaredNorm();
    if (!(g2 > 0.0)) return std::nullopt;
    if (k == 0) l = (c - p).dot(phi.g) / g2;
    // Newton of (3): [[I + l H, g], [g^T, 0]] (dp, dl) = -(p - c + l g, phi), with l g of the size of p.
    const double scale = std::sqrt(g2);
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    M.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() + l * phi.H;
    M.topRightCorner<3, 1>() = phi.g / scale;
    M.bottomLeftCorner<1, 3>() = phi.g.transpose() / scale;
    Eigen::Vector4d rest;
    rest << p - c + l * phi.g, phi.f / scale;
    const Eigen::Vector4d step = solve_small<4, 1>(M, -rest);
    if (!step.allFinite()) return std::nullopt;
    Vec3 dp = step.head<3>();
    // No farther than the centre is, or the flat far side of a field attracts.
    const double reach = std::max((c - p).norm(), 1e-3 * (c.norm() + p.norm()));
    const double length = dp.norm(), share = length > reach ? reach / length : 1.0;
    p += share * dp;
    l += share * step[3] / scale;
    if (last) break;
    last = share == 1.0 && length <= last_step * (c.norm() + p.norm() + reach);
  }
  const Phi phi = phi_at(field, p, Order::hessian);
  const double size = phi.g.norm();
  if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;
  BallFoot foot;
  foot.point = p;
  foot.normal = -phi.g / size;
  const auto e = tangents(foot.normal);
  set_second_order(foot, c, e, Eigen::Matrix2d(-(e.transpose() * phi.H * e) / size));
  const bool reached = std::abs(phi.f) / size <= orthogonal * (1e-300 + c.norm() + p.norm());
  return reached && stands(foot, c) ? std::optional(foot) : std::nullopt;
}

/// How far beyond an open range, in its lengths.
double beyond(double t, const Interval& range, bool closed) {
  return closed ? 0.0 : std::max(range.lo - t, t - range.hi) / range.length();
}

double beyond(UV at, const SurfaceDomain& d) {
  return std::max(beyond(at.u, d.u, d.u_closed), beyond(at.v, d.v, d.v_closed));
}

/// Foot at these parameters; nullopt without a normal.
std::optional<BallFoot> foot_at(const SurfaceJet& j, bool reversed, const Vec3& c, UV at) {
  const Vec3 cross = j.Su.cross(j.Sv);
  const double area = cross.norm();
  if (!(area > 1e-14 * j.Su.norm() * j.Sv.norm())) return std::nullopt;
  BallFoot foot;
  foot.point = j.S;
  foot.at = at;
  foot.normal = (reversed ? -1.0 : 1.0) / area * cross;
  const auto e = tangents(foot.normal);
  // (2): with [Su Sv] = e J and second forms L, M, N of n, W = -J^-T [[L, M], [M, N]] J^-1.
  Eigen::Matrix2d J, II;
  J << e.col(0).dot(j.Su), e.col(0).dot(j.Sv), e.col(1).dot(j.Su), e.col(1).dot(j.Sv);
  const Vec3& n = foot.normal;
  II << n.dot(j.Suu), n.dot(j.Suv), n.dot(j.Suv), n.dot(j.Svv);
  const Eigen::Matrix2d Ji = inverse_of(J);
  set_second_order(foot, c, e, Eigen::Matrix2d(-(Ji.transpose() * II * Ji)));
  return foot;
}

std::optional<BallFoot> foot_of(const Surface& surface, bool reversed, const Vec3& c, UV at) {
  const SurfaceDomain domain = surface.domain();
  bool last = false;
  for (int k = 0; k < max_steps; ++k) {
    const SurfaceJet j = surface.jet(at);
    const Vec3 e = j.S - c;
    const double E = j.Su.dot(j.Su) + e.dot(j.Suu), F = j.Su.dot(j.Sv) + e.dot(j.Suv),
                 G = j.Sv.dot(j.Sv) + e.dot(j.Svv);
    const double gu = e.dot(j.Su), gv = e.dot(j.Sv), determinant = E * G - F * F;
    Vec2 step((-gu * G + gv * F) / determinant, (-gv * E + gu * F) / determinant);
    if (!step.allFinite()) return std::nullopt;
    const double share =
        std::max(std::abs(step[0]) / domain.u.length(), std::abs(step[1]) / domain.v.length());
    if (share > 0.1) step *= 0.1 / share;
    at = {at.u + step[0], at.v + step[1]};
    if (last) break;
    // Half a domain beyond its border nothing is to be found, and splines do not go on there.
    if (beyond(at, domain) > 0.5) break;
    last = j.Su.norm() * std::abs(step[0]) + j.Sv.norm() * std::abs(step[1]) <=
           last_step * (c.norm() + j.S.norm() + e.norm());
  }
  const auto foot = foot_at(surface.jet(at), reversed, c, at);
  if (!foot) return std::nullopt;
  BallFoot found = *foot;
  // Rounding must not put a foot on the border outside.
  found.inside = beyond(at, domain) <= 1e-12;
  return stands(found, c) || !found.inside ? std::optional(found) : std::nullopt;
}

}  // namespace

std::optional<Vec3> descended(const ScalarField& field, const Vec3& start) {
  Vec3 p = start;
  for (int k = 0; k < 2 * max_steps; ++k) {
    const Phi phi = phi_at(field, p, Order::gradient);
    const double g2 = phi.g.squaredNorm();
    if (!(g2 > 0.0) || !std::isfinite(phi.f)) return std::nullopt;
    const Vec3 step = -phi.f / g2 * phi.g;
    if (!step.allFinite()) return std::nullopt;
    p += step;
    if (step.norm() <= 1e-6 * (start.norm() + (p - start).norm())) return p;
  }
  return std::nullopt;
}

std::optional<BallFoot> BallPrimary::foot(const Vec3& c, const Vec3& near_point, UV near_at) const {
  if (const ScalarField* solid = field()) return foot_of(*solid, c, near_point);
  return foot_of(*surface(), reversed_, c, near_at);
}

std::optional<BallFoot> BallPrimary::foot(const Vec3& c) const {
  if (const ScalarField* solid = field()) return foot_of(*solid, c, c);
  return foot_of(*surface(), reversed_, c, closest_point(*surface(), c).at);
}

}  // namespace blendwright
