#include "implicit/primitives/sweep_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "implicit/primitives/sweep_path_pieces.hpp"
#include "kernel/base/error.hpp"
#include "kernel/math/taylor.hpp"

namespace blendwright::detail {
namespace {

template <class S>
using Vec = std::array<S, 3>;
template <class S>
S dot(const Vec<S>& a, const Vec<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class S>
Vec<S> cross(const Vec<S>& a, const Vec<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class S>
Vec<S> combined(const S& a, const Vec<S>& p, const S& b, const Vec<S>& q) {
  return {a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2]};
}

template <class S>
struct Axes {
  Vec<S> U, V, W;
};
/// (1) at tangent (any length) and angle theta.
template <class S>
Axes<S> axes(const Vec<S>& tangent, const Vec3& e, const S& theta) {
  using std::sqrt;
  const S one(1.0), zero(0.0), inverse = one / sqrt(dot(tangent, tangent));
  const Vec<S> W = combined(inverse, tangent, zero, tangent), E = {S(e.x()), S(e.y()), S(e.z())};
  const S along = dot(E, W), n = one / sqrt(one - along * along);
  const Vec<S> A = combined(n, E, zero - n * along, W), B = cross(W, A);
  const auto [sine, cosine] = sin_cos(theta);
  return {combined(cosine, A, sine, B), combined(cosine, B, zero - sine, A), W};
}

template <class S>
S horner(const std::array<double, 9>& c, const S& x) {
  S r(c[8]);
  for (std::size_t k = 8; k-- > 0;) r = r * x + c[k];
  return r;
}

}  // namespace

PathJet PathPiece::jet(double x) const {
  // Horner of the four normalised derivatives at once.
  Vec3 p = c[7], d1 = Vec3::Zero(), d2 = Vec3::Zero(), d3 = Vec3::Zero();
  for (std::size_t k = 7; k-- > 0;) {
    d3 = d3 * x + d2;
    d2 = d2 * x + d1;
    d1 = d1 * x + p;
    p = p * x + c[k];
  }
  return {p, d1, 2.0 * d2, 6.0 * d3};
}

PathFrame PathPiece::frame(double x) const {
  const Vec3 d = jet(x)[1];
  const Axes<double> a = axes<double>({d.x(), d.y(), d.z()}, e, horner(theta, x));
  const auto vec = [](const Vec<double>& v) { return Vec3(v[0], v[1], v[2]); };
  return {{vec(a.U), Vec3::Zero(), Vec3::Zero()}, {vec(a.V), Vec3::Zero(), Vec3::Zero()}, vec(a.W)};
}

PathFrame PathPiece::frame_jet(double x) const {
  using S = Taylor<2>;
  const PathJet j = jet(x);
  Vec<S> tangent;
  for (int i = 0; i < 3; ++i) tangent[static_cast<std::size_t>(i)].c = {j[1][i], j[2][i], 0.5 * j[3][i]};
  const Axes<S> a = axes<S>(tangent, e, horner(theta, S::variable(x)));
  const auto derivative = [](const Vec<S>& v, int k) {
    return Vec3(v[0].derivative(k), v[1].derivative(k), v[2].derivative(k));
  };
  const auto jets = [&](const Vec<S>& v) {
    return std::array<Vec3, 3>{derivative(v, 0), derivative(v, 1), derivative(v, 2)};
  };
  return {jets(a.U), jets(a.V), derivative(a.W, 0)};
}

Box PathPiece::box() const {
  Vec3 reach = Vec3::Zero();
  for (std::size_t k = 1; k < 8; ++k) reach += c[k].cwiseAbs();
  reach *= 1.0 + 1e-12;
  return {c[0] - reach, c[0] + reach};
}

Vec3 PathPiece::least_tangent() const {
  Vec3 least = c[1].cwiseAbs();
  for (std::size_t k = 2; k < 8; ++k) least -= static_cast<double>(k) * c[k].cwiseAbs();
  return least.cwiseMax(0.0) * ((1.0 - 1e-12) / most[1]);
}

Path::Path(const std::vector<std::string>& formulas, double t0, double t1, std::optional<Vec3> u)
    : t0_(t0), t1_(t1), pieces_(path_pieces(formulas, t0, t1)) {
  bounds_ = pieces_.front().box();
  for (const PathPiece& p : pieces_) bounds_ = hull(bounds_, p.box());
  add_balls(0, pieces_.size());
  const PathJet first = pieces_.front().jet(-1.0), last = pieces_.back().jet(1.0);
  const Vec3 d0 = first[1] / pieces_.front().half, d1 = last[1] / pieces_.back().half;
  closed_ =
      (first[0] - last[0]).norm() <= 1e-9 * bounds_.size().norm() && (d0 - d1).norm() <= 1e-9 * d0.norm();
  add_frames(u);
}

double Path::t(const Foot& foot) const {
  const PathPiece& p = pieces_[foot.piece];
  return std::clamp(p.t_middle + p.half * foot.x, t0_, t1_);
}

void Path::add_frames(std::optional<Vec3> u) {
  const Vec3 W = pieces_.front().jet(-1.0)[1].normalized();
  Vec3 direction = Vec3::Zero();
  if (u) {
    direction = *u;
  } else {
    int axis = 0;
    W.cwiseAbs().minCoeff(&axis);
    direction[axis] = 1.0;
  }
  const Vec3 across = direction - direction.dot(W) * W;
  if (!(across.norm() > 1e-6 * direction.norm()))
    throw InputError("u", "is parallel to the curve's direction at its start, must have a part across it");
  const Vec3 U0 = across.normalized(), V0 = W.cross(U0);
  Vec3 U = U0;
  for (PathPiece& p : pieces_) {
    add_frame(p, U);
    U = p.frame(1.0).U[0];
  }
  if (closed_) closing_angle_ = std::atan2(U.dot(V0), U.dot(U0));
}

std::size_t Path::add_balls(std::size_t first, std::size_t count) {
  Box box{pieces_[first].c[0], pieces_[first].c[0]};
  for (std::size_t i = first; i < first + count; ++i) box = hull(box, {pieces_[i].c[0], pieces_[i].c[0]});
  Ball ball{box.centre(), 0.0, first, count, 0};
  for (std::size_t i = first; i < first + count; ++i)
    ball.radius = std::max(ball.radius, (pieces_[i].c[0] - ball.centre).norm() + pieces_[i].radius);
  ball.radius *= 1.0 + 1e-12;
  const std::size_t at = balls_.size();
  balls_.push_back(ball);
  if (count > 1) {
    add_balls(first, count / 2);
    balls_[at].right = add_balls(first + count / 2, count - count / 2);
  }
  return at;
}

}  // namespace blendwright::detail
