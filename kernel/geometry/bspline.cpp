#include "kernel/geometry/bspline.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

std::string text(int i) { return std::to_string(i); }

void check_breaks(const std::vector<double>& breaks) {
  if (breaks.size() < 2)
    throw InputError("breaks", "has " + text(static_cast<int>(breaks.size())) + ", needs at least 2");
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const std::string where = "breaks/" + std::to_string(i);
    if (!std::isfinite(breaks[i])) throw InputError(where, "is not a finite number");
    if (i > 0 && !(breaks[i] > breaks[i - 1]))
      throw InputError(where, "is " + number_text(breaks[i]) +
                                  ", must be greater than the break before it, " +
                                  number_text(breaks[i - 1]));
  }
}

void check_multiplicities(const std::vector<int>& multiplicities, std::size_t breaks, int degree,
                          bool periodic) {
  if (multiplicities.size() != breaks)
    throw InputError("multiplicities", "has " + std::to_string(multiplicities.size()) +
                                           ", must have one per break, that is " + std::to_string(breaks));
  for (std::size_t i = 0; i < breaks; ++i) {
    const bool end = i == 0 || i + 1 == breaks;
    const int lo = end && !periodic ? degree + 1 : 1, hi = end && !periodic ? degree + 1 : degree;
    if (multiplicities[i] < lo || multiplicities[i] > hi)
      throw InputError("multiplicities/" + std::to_string(i),
                       "is " + text(multiplicities[i]) + ", must be " +
                           (lo == hi ? text(lo) + " at the end of a clamped basis"
                                     : "in [" + text(lo) + ", " + text(hi) + "]"));
  }
  if (periodic && multiplicities.front() != multiplicities.back())
    throw InputError("multiplicities", "first is " + text(multiplicities.front()) + ", last is " +
                                           text(multiplicities.back()) +
                                           "; of a periodic basis they must be equal");
}

std::vector<int> simple_multiplicities(std::size_t breaks, int ends) {
  std::vector<int> m(breaks, 1);
  if (breaks > 0) m.front() = m.back() = ends;
  return m;
}

}  // namespace

BSplineBasis::BSplineBasis(int degree, std::vector<double> breaks, std::vector<int> multiplicities,
                           bool periodic)
    : degree_(degree),
      periodic_(periodic),
      breaks_(std::move(breaks)),
      multiplicities_(std::move(multiplicities)) {
  if (degree_ < 1 || degree_ > max_degree)
    throw InputError("degree", "is " + text(degree_) + ", must be in [1, " + text(max_degree) + "]");
  check_breaks(breaks_);
  check_multiplicities(multiplicities_, breaks_.size(), degree_, periodic_);

  std::vector<double>
      knots;  // every break by its multiplicity; the last one of a periodic basis belongs to the next turn
  const std::size_t used = breaks_.size() - (periodic_ ? 1 : 0);
  for (std::size_t i = 0; i < used; ++i)
    knots.insert(knots.end(), static_cast<std::size_t>(multiplicities_[i]), breaks_[i]);
  const int turn = static_cast<int>(knots.size());
  if (periodic_) {
    count_ = turn;
    // The last copy of the first break gets flat index `degree`: the functions on the first span are
    // 0..degree.
    const int offset = degree_ + 1 - multiplicities_.front();
    const double period = breaks_.back() - breaks_.front();
    const int length = turn + 2 * degree_ + 2;
    flat_.reserve(static_cast<std::size_t>(length));
    for (int i = -offset; i < length - offset; ++i) {
      const int turns = (i >= 0 ? i : i - turn + 1) / turn;  // floor
      flat_.push_back(knots[static_cast<std::size_t>(i - turns * turn)] + turns * period);
    }
  } else {
    count_ = turn - degree_ - 1;
    flat_ = std::move(knots);
  }
  span_.reserve(breaks_.size() - 1);
  int at = degree_;
  for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
    if (i > 0) at += multiplicities_[i];
    span_.push_back(at);
  }
}

BSplineBasis BSplineBasis::clamped(int degree, std::vector<double> breaks) {
  std::vector<int> m = simple_multiplicities(breaks.size(), degree + 1);
  return {degree, std::move(breaks), std::move(m), false};
}

BSplineBasis BSplineBasis::closed(int degree, std::vector<double> breaks) {
  std::vector<int> m = simple_multiplicities(breaks.size(), 1);
  return {degree, std::move(breaks), std::move(m), true};
}

double BSplineBasis::inside(double t) const {
  const double lo = breaks_.front(), hi = breaks_.back();
  if (!periodic_) return std::clamp(t, lo, hi);
  if (t >= lo && t < hi) return t;
  if (t == hi) return lo;
  const double wrapped = t - (hi - lo) * std::floor((t - lo) / (hi - lo));
  return wrapped >= lo && wrapped < hi ? wrapped : lo;  // rounding may reach either end: the same point
}

BSplineBasis::Local BSplineBasis::evaluate(double t, int order) const {
  t = inside(t);
  const auto after = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, t);
  const int span = span_[static_cast<std::size_t>(after - breaks_.begin() - 1)];
  const int p = degree_;
  const double* const knot = flat_.data() + span;  // knot[0] <= t <= knot[1]

  // Cox-de Boor triangle: upper part basis functions by degree, lower part knot differences (The NURBS Book,
  // A2.2).
  double ndu[max_degree + 1][max_degree + 1];
  double left[max_degree + 1], right[max_degree + 1];
  ndu[0][0] = 1.0;
  for (int j = 1; j <= p; ++j) {
    left[j] = t - knot[1 - j];
    right[j] = knot[j] - t;
    double saved = 0.0;
    for (int r = 0; r < j; ++r) {
      ndu[j][r] = right[r + 1] + left[j - r];
      const double share = ndu[r][j - 1] / ndu[j][r];
      ndu[r][j] = saved + right[r + 1] * share;
      saved = left[j - r] * share;
    }
    ndu[j][j] = saved;
  }

  Local local;
  local.first = span - p;
  for (int r = 0; r <= p; ++r) local.value[0][static_cast<std::size_t>(r)] = ndu[r][p];
  const int top = std::min(order, p);
  if (top == 0) return local;
  for (int r = 0; r <= p; ++r) {  // derivatives (The NURBS Book, A2.3)
    double a[2][max_degree + 1];
    int s1 = 0, s2 = 1;
    a[0][0] = 1.0;
    for (int k = 1; k <= top; ++k) {
      double d = 0.0;
      const int rk = r - k, pk = p - k;
      if (r >= k) {
        a[s2][0] = a[s1][0] / ndu[pk + 1][rk];
        d = a[s2][0] * ndu[rk][pk];
      }
      const int j1 = rk >= -1 ? 1 : -rk, j2 = r - 1 <= pk ? k - 1 : p - r;
      for (int j = j1; j <= j2; ++j) {
        a[s2][j] = (a[s1][j] - a[s1][j - 1]) / ndu[pk + 1][rk + j];
        d += a[s2][j] * ndu[rk + j][pk];
      }
      if (r <= pk) {
        a[s2][k] = -a[s1][k - 1] / ndu[pk + 1][r];
        d += a[s2][k] * ndu[r][pk];
      }
      local.value[static_cast<std::size_t>(k)][static_cast<std::size_t>(r)] = d;
      std::swap(s1, s2);
    }
  }
  double factor = p;
  for (int k = 1; k <= top; ++k) {
    for (int r = 0; r <= p; ++r)
      local.value[static_cast<std::size_t>(k)][static_cast<std::size_t>(r)] *= factor;
    factor *= p - k;
  }
  return local;
}

std::vector<double> BSplineBasis::greville() const {
  std::vector<double> g(static_cast<std::size_t>(count_));
  for (std::size_t i = 0; i < g.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 1; j <= static_cast<std::size_t>(degree_); ++j) sum += flat_[i + j];
    g[i] = inside(sum / degree_);
  }
  return g;
}

template <int Dim>
BSplineCurve<Dim>::BSplineCurve(BSplineBasis basis, std::vector<Point> control)
    : basis_(std::move(basis)), control_(std::move(control)) {
  if (static_cast<int>(control_.size()) != basis_.count())
    throw InputError("control", "has " + std::to_string(control_.size()) + " points, the basis needs " +
                                    text(basis_.count()));
  for (std::size_t i = 0; i < control_.size(); ++i)
    if (!control_[i].allFinite())
      throw InputError("control/" + std::to_string(i), "has a coordinate that is not finite");
}

template <int Dim>
CurveJet<Dim> BSplineCurve<Dim>::jet(double v) const {
  const BSplineBasis::Local N = basis_.evaluate(v, 3);
  CurveJet<Dim> jet;
  for (Point& d : jet.D) d.setZero();
  for (int i = 0; i <= basis_.degree(); ++i) {
    const Point& P = control_[static_cast<std::size_t>(basis_.index(N.first + i))];
    for (std::size_t k = 0; k < 4; ++k) jet.D[k] += N.value[k][static_cast<std::size_t>(i)] * P;
  }
  return jet;
}

template class BSplineCurve<1>;
template class BSplineCurve<2>;
template class BSplineCurve<3>;

BSplineSurface::BSplineSurface(BSplineBasis basis_u, BSplineBasis basis_v, std::vector<Vec3> control)
    : basis_u_(std::move(basis_u)), basis_v_(std::move(basis_v)), control_(std::move(control)) {
  const std::size_t needed =
      static_cast<std::size_t>(basis_u_.count()) * static_cast<std::size_t>(basis_v_.count());
  if (control_.size() != needed)
    throw InputError("control", "has " + std::to_string(control_.size()) + " points, the bases need " +
                                    text(basis_u_.count()) + " x " + text(basis_v_.count()));
  for (std::size_t i = 0; i < control_.size(); ++i)
    if (!control_[i].allFinite())
      throw InputError("control/" + std::to_string(i), "has a coordinate that is not finite");
}

SurfacePartials BSplineSurface::partials_to(UV p, int order) const {
  const BSplineBasis::Local Nu = basis_u_.evaluate(p.u, order), Nv = basis_v_.evaluate(p.v, order);
  std::array<int, BSplineBasis::max_degree + 1> column;
  for (int j = 0; j <= basis_v_.degree(); ++j)
    column[static_cast<std::size_t>(j)] = basis_v_.index(Nv.first + j);
  SurfacePartials partials;
  for (Vec3& d : partials.d) d.setZero();
  for (int i = 0; i <= basis_u_.degree(); ++i) {
    const Vec3* const row = &control(basis_u_.index(Nu.first + i), 0);
    std::array<Vec3, 5> along_v;  // derivatives with respect to v of the i-th row curve
    for (int l = 0; l <= order; ++l) along_v[static_cast<std::size_t>(l)].setZero();
    for (int j = 0; j <= basis_v_.degree(); ++j) {
      const Vec3& P = row[column[static_cast<std::size_t>(j)]];
      for (int l = 0; l <= order; ++l)
        along_v[static_cast<std::size_t>(l)] +=
            Nv.value[static_cast<std::size_t>(l)][static_cast<std::size_t>(j)] * P;
    }
    for (int k = 0; k <= order; ++k)
      for (int l = 0; k + l <= order; ++l)
        partials(k, l) += Nu.value[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] *
                          along_v[static_cast<std::size_t>(l)];
  }
  return partials;
}

SurfaceJet BSplineSurface::jet(UV p) const {
  const SurfacePartials d = partials_to(p, 2);
  return {d(0, 0), d(1, 0), d(0, 1), d(2, 0), d(1, 1), d(0, 2)};
}

SurfacePartials BSplineSurface::partials(UV p) const { return partials_to(p, 4); }

SurfaceDomain BSplineSurface::domain() const {
  return {basis_u_.domain(), basis_v_.domain(), basis_u_.periodic(), basis_v_.periodic()};
}

BSplineCurve<3> BSplineSurface::edge_u(int side) const {
  if (basis_u_.periodic()) throw GeometryError("edge_u: the surface is periodic in u and has no edge there");
  if (side != 0 && side != 1) throw InputError("side", "is " + text(side) + ", must be 0 or 1");
  const Vec3* const first = &control(side == 0 ? 0 : basis_u_.count() - 1, 0);
  return {basis_v_, std::vector<Vec3>(first, first + basis_v_.count())};
}

}  // namespace blendwright
