#include "implicit/relations/contact_point.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace blendwright::detail {
namespace {

using Matrix4 = Eigen::Matrix4d;
using Vector4 = Eigen::Vector4d;

/// psi, its gradient and Hessian at a point.
struct Jet {
  double value;
  Vec3 gradient;
  Eigen::Matrix3d hessian;
};

Jet jet_at(const Half& half, const Vec3& point) {
  const FieldValues f = half.field->evaluate(Order::hessian, std::span<const Vec3>(&point, 1));
  const auto h = f.hessian(0);
  Jet jet{half.psi(f.value(0)), half.sign() * f.gradient(0), {}};
  jet.hessian << h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2];
  jet.hessian *= half.sign();
  return jet;
}

/// The solution of m s = r on the eigenspaces of the symmetric m whose eigenvalues are larger than `cut` of
/// the largest. Jacobi's method: turns in the planes (p, q) until the rest vanishes.
Vector4 solve_symmetric(Matrix4 m, const Vector4& r, double cut) {
  // |m| |m^-1| is at least the ratio of any two eigenvalues: below 1/cut nothing is cut off.
  const Matrix4 inverse = m.inverse();
  if (m.norm() * inverse.norm() < std::min(1.0 / cut, 1e6)) return inverse * r;
  Matrix4 v = Matrix4::Identity();
  for (int sweep = 0; sweep < 12; ++sweep) {
    double rest = 0.0;
    for (int p = 0; p < 3; ++p) {
      for (int q = p + 1; q < 4; ++q) {
        rest += m(p, q) * m(p, q);
        if (m(p, q) == 0.0) continue;
        const double theta = (m(q, q) - m(p, p)) / (2.0 * m(p, q));
        const double size = std::abs(theta);
        const double t =
            size > 1e8 ? 0.5 / theta : std::copysign(1.0, theta) / (size + std::sqrt(size * size + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
        for (int k = 0; k < 4; ++k) {
          const double a = m(k, p), b = m(k, q);
          m(k, p) = c * a - s * b;
          m(k, q) = s * a + c * b;
        }
        for (int k = 0; k < 4; ++k) {
          const double a = m(p, k), b = m(q, k), va = v(k, p), vb = v(k, q);
          m(p, k) = c * a - s * b;
          m(q, k) = s * a + c * b;
          v(k, p) = c * va - s * vb;
          v(k, q) = s * va + c * vb;
        }
      }
    }
    if (!(rest > 1e-30 * m.diagonal().squaredNorm())) break;
  }
  const double largest = m.diagonal().cwiseAbs().maxCoeff();
  Vector4 s = Vector4::Zero();
  for (int i = 0; i < 4; ++i)
    if (std::abs(m(i, i)) > cut * largest) s += v.col(i) * (v.col(i).dot(r) / m(i, i));
  return s;
}

ContactPoint contact_of(const Vec3& x, const Jet& a, const Jet& b, bool settled) {
  return {x, std::min(a.value, b.value), a.value, b.value, a.gradient, b.gradient, settled};
}

bool usable(const Jet& a, const Jet& b) {
  return std::isfinite(a.value) && std::isfinite(b.value) && a.gradient.squaredNorm() > 0.0 &&
         b.gradient.squaredNorm() > 0.0;
}

/// Weight of the first in the convex combination of unit gradients that is shortest. Both fields are divided
/// by their gradients' lengths, so that their scales do not matter.
struct Balance {
  double mu;
  Vec3 residual;
  Balance(const Vec3& g1, const Vec3& g2) {
    const Vec3 d = g1 - g2;
    const double dd = d.squaredNorm();
    mu = dd > 0.0 ? std::clamp(-g2.dot(d) / dd, 0.0, 1.0) : 0.5;
    residual = mu * g1 + (1.0 - mu) * g2;
  }
};

std::optional<ContactPoint> newton(const Half& first, const Half& second, const Vec3& start, double reach,
                                   double cut, int steps) {
  Vec3 x = start;
  Jet a = jet_at(first, x), b = jet_at(second, x);
  const double far = 4.0 * reach;
  bool small = false;  // the last step was
  for (int step = 0; step < steps; ++step) {
    if (!usable(a, b)) return std::nullopt;
    const double s1 = 1.0 / a.gradient.norm(), s2 = 1.0 / b.gradient.norm();
    const Vec3 g1 = s1 * a.gradient, g2 = s2 * b.gradient, d = g1 - g2;
    const Balance balance(g1, g2);
    const Eigen::Matrix3d bend = balance.mu * s1 * a.hessian + (1.0 - balance.mu) * s2 * b.hessian;
    // Lengths in units of the radius of curvature, so that they compare with mu.
    const double curvature = bend.norm(), unit = curvature * reach > 1e-9 ? 1.0 / curvature : reach;
    Matrix4 m = Matrix4::Zero();
    m.topLeftCorner<3, 3>() = unit * bend;
    m.topRightCorner<3, 1>() = d;
    m.bottomLeftCorner<1, 3>() = d.transpose();
    Vector4 r;
    r << -balance.residual, (s2 * b.value - s1 * a.value) / unit;
    Vec3 move = unit * solve_symmetric(m, r, cut).head<3>();
    if (!move.allFinite()) return std::nullopt;
    if (const double length = move.norm(); length > reach) move *= reach / length;
    const bool last = move.norm() <= 1e-12 * (x.norm() + reach);
    const Vec3 next = x + move;
    if (!((next - start).norm() <= far)) break;
    x = next;
    a = jet_at(first, x);
    b = jet_at(second, x);
    if (last) {
      small = true;
      break;
    }
  }
  if (!usable(a, b)) return std::nullopt;
  const double s1 = 1.0 / a.gradient.norm(), s2 = 1.0 / b.gradient.norm();
  const Balance balance(s1 * a.gradient, s2 * b.gradient);
  const bool settled =
      small && balance.residual.norm() <= 1e-6 && std::abs(s1 * a.value - s2 * b.value) <= 1e-6 * reach;
  return contact_of(x, a, b, settled);
}

}  // namespace

/// Gradients point inward.
std::optional<Vec3> ContactPoint::normal() const {
  const double l1 = g1.norm(), l2 = g2.norm();
  if (!(l1 > 0.0) || !(l2 > 0.0) || !std::isfinite(l1) || !std::isfinite(l2)) return std::nullopt;
  const Vec3 mean = g2 / l2 - g1 / l1;
  const double length = mean.norm();
  return length > 1e-3 ? mean / length : Vec3(-g1 / l1);
}

std::optional<ContactPoint> contact_point(const Half& first, const Half& second, const Vec3& start,
                                          double reach) {
  if (!(reach > 0.0)) return std::nullopt;
  const auto found = newton(first, second, start, reach, 1e-8, 15);
  if (found && found->settled) return found;
  const auto coarse = newton(first, second, start, reach, 0.05, 15);
  return coarse && coarse->settled ? coarse : found;
}

std::optional<ContactPoint> contact_point_near(const Half& first, const Half& second, const Vec3& start,
                                               double reach, int steps) {
  return reach > 0.0 ? newton(first, second, start, reach, 1e-8, steps) : std::nullopt;
}

ContactPoint values_at(const Half& first, const Half& second, const Vec3& point) {
  return contact_of(point, jet_at(first, point), jet_at(second, point), false);
}

}  // namespace blendwright::detail
