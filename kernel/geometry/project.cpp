#include "kernel/geometry/project.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace blendwright {
namespace {

constexpr int max_steps = 50;
constexpr int seeds_per_direction = 24;
/// Steps up to this share of the surface's size change the distance by about its rounding: they may.
constexpr double small_step = 1e-6;
/// A Newton step this much shorter than the surface leaves an error of the order of its square, below
/// rounding.
constexpr double last_step = 1e-9;
/// Tangential part of a residual, relative to the size of the surface, that counts as orthogonal.
constexpr double orthogonal = 1e-9;

double wrapped(double t, const Interval& range) {
  return t - range.length() * std::floor((t - range.lo) / range.length());
}
double into(double t, const Interval& range, bool closed) {
  return closed ? wrapped(t, range) : range.clamp(t);
}
UV into(UV p, const SurfaceDomain& d) { return {into(p.u, d.u, d.u_closed), into(p.v, d.v, d.v_closed)}; }

/// Size of the surface as seen from one point: how far its parameter ranges reach at the speed there.
double reach(const SurfaceJet& j, const SurfaceDomain& d) {
  return j.Su.norm() * d.u.length() + j.Sv.norm() * d.v.length();
}

/// What rounding of points of this size (coordinates and reach) does to f = |r|^2 / 2.
double rounding_of(double f, double size) {
  const double noise = 8.0 * std::numeric_limits<double>::epsilon() * size;
  return noise * (std::sqrt(2.0 * f) + noise);
}

/// Whether a descent along -gradient would leave an open range at t: the parameter is then held at the
/// border.
bool held(double t, double gradient, const Interval& range, bool closed) {
  return !closed && ((t <= range.lo && gradient > 0.0) || (t >= range.hi && gradient < 0.0));
}

/// Minimises a function of (u, v) with the first two derivatives, inside the domain.
struct Quadratic {
  double f = 0.0;  ///< value
  Vec2 g;          ///< gradient
  Vec2 diagonal;   ///< of the Hessian
  double mixed = 0.0;
  Vec2 safe_diagonal;  ///< of a positive semidefinite approximation of the Hessian (Gauss-Newton)
  double safe_mixed = 0.0;
};

/// Newton step of a quadratic model; the Gauss-Newton model when the Hessian is not positive definite.
Vec2 step_of(const Quadratic& q, bool hold_u, bool hold_v) {
  const auto solve = [&](const Vec2& d, double mixed) -> std::optional<Vec2> {
    if (hold_u && hold_v) return Vec2(0.0, 0.0);
    if (hold_u || hold_v) {
      const int k = hold_u ? 1 : 0;
      if (!(d[k] > 0.0)) return std::nullopt;
      Vec2 s(0.0, 0.0);
      s[k] = -q.g[k] / d[k];
      return s;
    }
    const double determinant = d[0] * d[1] - mixed * mixed;
    if (!(d[0] > 0.0) || !(determinant > 1e-14 * d[0] * d[1])) return std::nullopt;
    return Vec2((-q.g[0] * d[1] + q.g[1] * mixed) / determinant,
                (-q.g[1] * d[0] + q.g[0] * mixed) / determinant);
  };
  if (const auto newton = solve(q.diagonal, q.mixed)) return *newton;
  if (const auto gauss = solve(q.safe_diagonal, q.safe_mixed)) return *gauss;
  // A direction without speed (a pole): each parameter by itself.
  Vec2 s(0.0, 0.0);
  for (int k = 0; k < 2; ++k)
    if (!(k == 0 ? hold_u : hold_v) && q.safe_diagonal[k] > 0.0) s[k] = -q.g[k] / q.safe_diagonal[k];
  return s;
}

/// f = |S - q|^2 / 2,  f_u = Su . r,  f_uv = Su . Sv + Suv . r  with r = S - q.
Quadratic distance_model(const SurfaceJet& j, const Vec3& q) {
  const Vec3 r = j.S - q;
  const double E = j.Su.dot(j.Su), F = j.Su.dot(j.Sv), G = j.Sv.dot(j.Sv);
  return {0.5 * r.dot(r),
          {j.Su.dot(r), j.Sv.dot(r)},
          {E + j.Suu.dot(r), G + j.Svv.dot(r)},
          F + j.Suv.dot(r),
          {E, G},
          F};
}

/// f = |r|^2 / 2 with r the part of S - q across the unit vector d; only the Gauss-Newton model is used,
/// which is Newton's method for r = 0.
Quadratic line_model(const SurfaceJet& j, const Vec3& q, const Vec3& d) {
  const auto across = [&](const Vec3& x) -> Vec3 { return x - d * d.dot(x); };
  const Vec3 r = across(j.S - q), a = across(j.Su), b = across(j.Sv);
  const double E = a.dot(a), F = a.dot(b), G = b.dot(b);
  return {0.5 * r.dot(r), {a.dot(r), b.dot(r)}, {E, G}, F, {E, G}, F};
}

struct Minimum {
  UV at;
  SurfaceJet jet;
  Quadratic model;
};

/// Damped Newton from `start`.
template <class Model>
Minimum minimise(const Surface& surface, const SurfaceDomain& domain, Model model, UV start) {
  Minimum m{into(start, domain), {}, {}};
  m.jet = surface.jet(m.at);
  m.model = model(m.jet);
  for (int k = 0; k < max_steps; ++k) {
    const bool hold_u = held(m.at.u, m.model.g[0], domain.u, domain.u_closed);
    const bool hold_v = held(m.at.v, m.model.g[1], domain.v, domain.v_closed);
    Vec2 step = step_of(m.model, hold_u, hold_v);
    // At most a quarter of the range at a time, so that a flat model does not jump around a closed direction.
    const double share =
        std::max(std::abs(step[0]) / domain.u.length(), std::abs(step[1]) / domain.v.length());
    if (!std::isfinite(share)) break;
    if (share > 0.25) step *= 0.25 / share;
    const double size = reach(m.jet, domain);
    bool moved = false, last = false;
    for (int halving = 0; halving < 30 && !moved; ++halving, step *= 0.5) {
      const double length = m.jet.Su.norm() * std::abs(step[0]) + m.jet.Sv.norm() * std::abs(step[1]);
      if (!(length > 1e-16 * size)) break;
      last = length <= last_step * size;
      const UV next = into(UV{m.at.u + step[0], m.at.v + step[1]}, domain);
      const SurfaceJet jet = surface.jet(next);
      const Quadratic q = model(jet);
      const double slack = length <= small_step * size ? rounding_of(m.model.f, size + jet.S.norm()) : 0.0;
      if (q.f < m.model.f + slack) {
        m = {next, jet, q};
        moved = true;
      } else if (last) {
        break;
      }
    }
    if (!moved || last) break;
  }
  return m;
}

/// At a pole (one parameter has no speed) the gradient does not see the meridians: tries them all. Returns a
/// start with a smaller f, or nothing when `m` is a minimum.
template <class Model>
std::optional<UV> leave_pole(const Surface& surface, const SurfaceDomain& domain, Model model,
                             const Minimum& m) {
  const double su = m.jet.Su.norm() * domain.u.length(), sv = m.jet.Sv.norm() * domain.v.length();
  if (std::min(su, sv) > 1e-9 * std::max(su, sv)) return std::nullopt;
  const bool v_is_idle = sv < su;
  const Interval& turn = v_is_idle ? domain.v : domain.u;
  std::optional<UV> best;
  double best_f = m.model.f - rounding_of(m.model.f, reach(m.jet, domain) + m.jet.S.norm());
  for (int k = 0; k < seeds_per_direction; ++k) {
    const double t = turn.at((k + 0.5) / seeds_per_direction);
    UV p = v_is_idle ? UV{m.at.u, t} : UV{t, m.at.v};
    const Quadratic q = model(surface.jet(p));
    const int along = v_is_idle ? 0 : 1;
    if (!(q.safe_diagonal[along] > 0.0)) continue;
    (v_is_idle ? p.u : p.v) -= q.g[along] / q.safe_diagonal[along];
    p = into(p, domain);
    if (const double f = model(surface.jet(p)).f; f < best_f) {
      best_f = f;
      best = p;
    }
  }
  return best;
}

template <class Model>
Minimum local_minimum(const Surface& surface, const SurfaceDomain& domain, Model model, UV start) {
  Minimum m = minimise(surface, domain, model, start);
  if (const auto again = leave_pole(surface, domain, model, m)) {
    const Minimum other = minimise(surface, domain, model, *again);
    if (other.model.f < m.model.f) m = other;
  }
  return m;
}

struct Seed {
  UV at;
  double f = 0.0;
};

/// The lowest `count` local minima of f on a grid of cell centres (which avoid poles and borders), best
/// first. Of cells that differ by rounding only, as around a pole on the axis of projection, one is taken:
/// otherwise a ring of them would fill the list and leave no seed elsewhere.
template <class F>
std::vector<Seed> grid_minima(const Surface& surface, const SurfaceDomain& domain, F f, std::size_t count) {
  constexpr int n = seeds_per_direction;
  std::vector<Seed> grid(static_cast<std::size_t>(n * n));
  const auto cell = [&](int i, int j) -> Seed& { return grid[static_cast<std::size_t>(i * n + j)]; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const UV p{domain.u.at((i + 0.5) / n), domain.v.at((j + 0.5) / n)};
      cell(i, j) = {p, f(surface.jet(p))};
    }
  std::vector<Seed> minima;
  const auto is_lower = [&](int a, int b, int i, int j) {
    const auto there = static_cast<float>(cell(a, b).f), here = static_cast<float>(cell(i, j).f);
    return there < here || (there == here && a * n + b < i * n + j);
  };
  const auto neighbour_is_lower = [&](int i, int j) {
    for (int a = i - 1; a <= i + 1; ++a)
      for (int b = j - 1; b <= j + 1; ++b) {
        if ((a < 0 || a >= n) && !domain.u_closed) continue;
        if ((b < 0 || b >= n) && !domain.v_closed) continue;
        if (is_lower((a + n) % n, (b + n) % n, i, j)) return true;
      }
    return false;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (std::isfinite(cell(i, j).f) && !neighbour_is_lower(i, j)) minima.push_back(cell(i, j));
  std::stable_sort(minima.begin(), minima.end(), [](const Seed& a, const Seed& b) { return a.f < b.f; });
  if (minima.size() > count) minima.resize(count);
  if (minima.empty()) minima.push_back({{domain.u.middle(), domain.v.middle()}, 0.0});
  return minima;
}

Foot foot_of(const Minimum& m, const SurfaceDomain& domain, const Vec3& q) {
  const Vec3 r = q - m.jet.S;
  const double tolerance = orthogonal * std::max(reach(m.jet, domain), r.norm());
  const auto tangential = [&](const Vec3& tangent) {
    const double speed = tangent.norm();
    return speed > 0.0 ? std::abs(tangent.dot(r)) / speed : 0.0;
  };
  return {m.at, m.jet.S, r.norm(), tangential(m.jet.Su) <= tolerance && tangential(m.jet.Sv) <= tolerance};
}

}  // namespace

Foot closest_point(const Surface& surface, const Vec3& q, UV guess) {
  const SurfaceDomain domain = surface.domain();
  const auto model = [&](const SurfaceJet& j) { return distance_model(j, q); };
  return foot_of(local_minimum(surface, domain, model, guess), domain, q);
}

Foot closest_point(const Surface& surface, const Vec3& q) {
  const SurfaceDomain domain = surface.domain();
  const auto model = [&](const SurfaceJet& j) { return distance_model(j, q); };
  std::optional<Minimum> best;
  for (const Seed& seed : grid_minima(
           surface, domain, [&](const SurfaceJet& j) { return (j.S - q).squaredNorm(); }, 4)) {
    const Minimum m = local_minimum(surface, domain, model, seed.at);
    if (!best || m.model.f < best->model.f) best = m;
  }
  return foot_of(*best, domain, q);
}

std::optional<Foot> shoot(const Surface& surface, const Vec3& q, const Vec3& direction, UV guess) {
  const Vec3 d = direction.normalized();
  const SurfaceDomain domain = surface.domain();
  const Minimum m = local_minimum(
      surface, domain, [&](const SurfaceJet& j) { return line_model(j, q, d); }, guess);
  const double miss = std::sqrt(2.0 * m.model.f);
  const double size = std::max({reach(m.jet, domain), m.jet.S.norm(), q.norm()});
  if (!(miss <= 1e-12 * size)) return std::nullopt;  // NaN misses too
  return Foot{m.at, m.jet.S, (m.jet.S - q).norm(), true};
}

std::optional<Foot> shoot(const Surface& surface, const Vec3& q, const Vec3& direction) {
  const Vec3 d = direction.normalized();
  const auto miss = [&](const SurfaceJet& j) {
    const Vec3 r = j.S - q;
    return (r - d * d.dot(r)).squaredNorm();
  };
  std::optional<Foot> best;
  for (const Seed& seed : grid_minima(surface, surface.domain(), miss, 12)) {
    const auto hit = shoot(surface, q, d, seed.at);
    if (hit && (!best || hit->distance < best->distance)) best = hit;
  }
  return best;
}

CurveFoot closest_point(const Curve3& curve, const Vec3& q, double guess) {
  const CurveDomain domain = curve.domain();
  double v = into(guess, domain.v, domain.closed);
  CurveJet<3> jet = curve.jet(v);
  for (int k = 0; k < max_steps; ++k) {
    // f = |C - q|^2 / 2,  f' = C' . r,  f'' = C'.C' + C''.r; without the last term where f'' <= 0.
    const Vec3 r = jet.C() - q;
    const double f = 0.5 * r.squaredNorm(), g = jet.C1().dot(r), speed2 = jet.C1().squaredNorm();
    const double curvature = speed2 + jet.C2().dot(r);
    if (!(speed2 > 0.0) || held(v, g, domain.v, domain.closed)) break;
    double step = -g / (curvature > 1e-12 * speed2 ? curvature : speed2);
    step = std::clamp(step, -0.25 * domain.v.length(), 0.25 * domain.v.length());
    bool moved = false, last = false;
    for (int halving = 0; halving < 30 && !moved; ++halving, step *= 0.5) {
      if (!(std::abs(step) > 1e-16 * domain.v.length())) break;
      last = std::abs(step) <= last_step * domain.v.length();
      const double next = into(v + step, domain.v, domain.closed);
      const CurveJet<3> there = curve.jet(next);
      const double size = std::sqrt(speed2) * domain.v.length() + there.C().norm();
      const double slack = std::abs(step) <= small_step * domain.v.length() ? rounding_of(f, size) : 0.0;
      if (0.5 * (there.C() - q).squaredNorm() < f + slack) {
        v = next;
        jet = there;
        moved = true;
      } else if (last) {
        break;
      }
    }
    if (!moved || last) break;
  }
  return {v, jet.C(), (jet.C() - q).norm()};
}

}  // namespace blendwright
