#include "kernel/geometry/spline_enclosure.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright {
namespace {

constexpr std::size_t most_spans = 4;

/// Functions of degree q = levels.size() - 1 and lower on the span that begins at knot[p - 1].
using Levels = std::vector<std::vector<TaylorModel>>;

/// The triangle of Cox and de Boor: level q holds the q + 1 functions of degree q that do not vanish.
Levels cox_de_boor(std::span<const double> knots, int degree, const TaylorModel& t) {
  const auto p = static_cast<std::size_t>(degree);
  const auto knot = [&](std::size_t above, std::size_t below) { return knots[p - 1 + above - below]; };
  Levels level(p + 1);
  level[0] = {TaylorModel(1.0)};
  for (std::size_t q = 1; q <= p; ++q) {
    level[q].assign(q + 1, TaylorModel());
    for (std::size_t r = 0; r < q; ++r) {
      // Function r of degree q - 1 lives on [knot(r + 1 - q), knot(r + 1)] counted from the span's start.
      const double hi = knot(r + 1, 0), lo = knot(r + 1, q);
      const TaylorModel over(Bounds(1.0) / (Bounds(hi) - Bounds(lo)));
      const TaylorModel share = level[q - 1][r] * over;
      level[q][r] = level[q][r] + (TaylorModel(hi) - t) * share;
      level[q][r + 1] = level[q][r + 1] + (t - TaylorModel(lo)) * share;
    }
  }
  return level;
}

/// Derivatives of functions of degree q from functions of degree q - 1.
std::vector<TaylorModel> raised(std::span<const double> knots, std::size_t p, std::size_t q,
                                const std::vector<TaylorModel>& lower) {
  std::vector<TaylorModel> d(q + 1);
  for (std::size_t r = 0; r < q; ++r) {
    const double hi = knots[p + r], lo = knots[p + r - q];
    const TaylorModel rate(Bounds(static_cast<double>(q)) / (Bounds(hi) - Bounds(lo)));
    const TaylorModel x = lower[r] * rate;
    d[r] = d[r] - x;
    d[r + 1] = d[r + 1] + x;
  }
  return d;
}

SplinePiece piece(const BSplineBasis& basis, std::size_t span, const TaylorModel& t) {
  const std::span<const double> knots = basis.span_knots(span);
  const auto p = static_cast<std::size_t>(basis.degree());
  const Levels level = cox_de_boor(knots, basis.degree(), t);
  SplinePiece out;
  out.first = basis.first_function(span);
  out.value[0] = level[p];
  out.value[1] = raised(knots, p, p, level[p - 1]);
  out.value[2].assign(p + 1, TaylorModel());
  if (p >= 2) out.value[2] = raised(knots, p, p, raised(knots, p, p - 1, level[p - 2]));
  return out;
}

}  // namespace

std::vector<SplinePiece> spline_pieces(const BSplineBasis& basis, const TaylorModel& t) {
  const std::vector<double>& breaks = basis.breaks();
  const Interval domain = basis.domain();
  const double slack = 1e-9 * domain.length();
  TaylorModel inside = t;
  if (basis.periodic()) {
    const double turns = std::floor((t.centre() - domain.lo) / domain.length());
    if (turns != 0.0) inside = t - TaylorModel(Bounds(turns) * (Bounds(domain.hi) - Bounds(domain.lo)));
  }
  const Bounds range = inside.range();
  std::vector<SplinePiece> pieces;
  if (!range.finite()) return pieces;
  if (!basis.periodic() && (range.lo < domain.lo - slack || range.hi > domain.hi + slack)) return pieces;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const bool first = i == 0 && !basis.periodic(), last = i + 2 == breaks.size() && !basis.periodic();
    if ((range.hi < breaks[i] && !first) || (range.lo > breaks[i + 1] && !last)) continue;
    if (pieces.size() == most_spans) return {};
    pieces.push_back(piece(basis, i, inside));
  }
  if (!basis.periodic()) return pieces;
  // What reaches over the seam lies on the spans of the turn before or after.
  const TaylorModel period(Bounds(domain.hi) - Bounds(domain.lo));
  const double rounding = 1e-14 * domain.length();
  if (range.lo < domain.lo - rounding) {
    if (range.lo < breaks[breaks.size() - 2] - domain.length()) return {};
    pieces.push_back(piece(basis, breaks.size() - 2, inside + period));
  }
  if (range.hi > domain.hi + rounding) {
    if (range.hi > breaks[1] + domain.length()) return {};
    pieces.push_back(piece(basis, 0, inside - period));
  }
  return pieces;
}

template <int Dim>
void BSplineCurve<Dim>::enclose(const TaylorModel& v, CurveEnclosure& out) const {
  const std::vector<SplinePiece> pieces = spline_pieces(basis_, v);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t d = 0; d < static_cast<std::size_t>(Dim); ++d) {
      TaylorModel whole = TaylorModel::unknown();
      for (const SplinePiece& p : pieces) {
        TaylorModel sum;
        for (std::size_t i = 0; i < p.value[k].size(); ++i) {
          const Point& P = control_[static_cast<std::size_t>(basis_.index(p.first + static_cast<int>(i)))];
          sum = sum + P[static_cast<Eigen::Index>(d)] * p.value[k][i];
        }
        whole = &p == &pieces.front() ? sum : TaylorModel::hull(whole, sum);
      }
      out.D[k][d] = whole;
    }
}
template void BSplineCurve<1>::enclose(const TaylorModel&, CurveEnclosure&) const;
template void BSplineCurve<2>::enclose(const TaylorModel&, CurveEnclosure&) const;
template void BSplineCurve<3>::enclose(const TaylorModel&, CurveEnclosure&) const;

namespace {

/// Derivatives (k, l), k + l <= 2, in the order of SurfaceEnclosure.
constexpr std::array<std::array<std::size_t, 2>, 6> orders{{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};

/// Derivatives of the functions sum to 0, so that any point may be taken off the control points: with the one
/// at the nearer end of the span, a row that stops there stops in rounded arithmetic too.
std::array<ModelVector, 6> patch(const BSplineSurface& s, const SplinePiece& pu, const SplinePiece& pv) {
  std::array<ModelVector, 6> out;
  const std::vector<TaylorModel>& N = pv.value[0];
  const bool near_start = N.front().range().magnitude() >= N.back().range().magnitude();
  const int reference = s.basis_v().index(pv.first + (near_start ? 0 : static_cast<int>(N.size()) - 1));
  for (std::size_t i = 0; i < pu.value[0].size(); ++i) {
    if (pu.value[0][i].is_zero() && pu.value[1][i].is_zero() && pu.value[2][i].is_zero()) continue;
    std::array<ModelVector, 3> row;  // derivatives by v of the i-th row curve
    const int at = s.basis_u().index(pu.first + static_cast<int>(i));
    const Vec3& R = s.control(at, reference);
    for (std::size_t j = 0; j < N.size(); ++j) {
      const Vec3& P = s.control(at, s.basis_v().index(pv.first + static_cast<int>(j)));
      for (std::size_t d = 0; d < 3; ++d) {
        const auto x = static_cast<Eigen::Index>(d);
        const TaylorModel apart = TaylorModel(P[x]) - TaylorModel(R[x]);
        row[0][d] = row[0][d] + P[x] * N[j];
        for (std::size_t l = 1; l < 3; ++l) row[l][d] = row[l][d] + apart * pv.value[l][j];
      }
    }
    for (std::size_t n = 0; n < orders.size(); ++n)
      out[n] = out[n] + pu.value[orders[n][0]][i] * row[orders[n][1]];
  }
  return out;
}

ModelVector hull(const ModelVector& a, const ModelVector& b) {
  return {TaylorModel::hull(a[0], b[0]), TaylorModel::hull(a[1], b[1]), TaylorModel::hull(a[2], b[2])};
}

}  // namespace

void BSplineSurface::enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const {
  const std::vector<SplinePiece> in_u = spline_pieces(basis_u_, u), in_v = spline_pieces(basis_v_, v);
  std::array<ModelVector, 6> whole;
  whole.fill(unknown_vector());
  bool first = true;
  for (const SplinePiece& pu : in_u)
    for (const SplinePiece& pv : in_v) {
      const std::array<ModelVector, 6> part = patch(*this, pu, pv);
      for (std::size_t n = 0; n < whole.size(); ++n) whole[n] = first ? part[n] : hull(whole[n], part[n]);
      first = false;
    }
  out.S = whole[0];
  out.Su = whole[1];
  out.Sv = whole[2];
  out.Suu = whole[3];
  out.Suv = whole[4];
  out.Svv = whole[5];
}

}  // namespace blendwright
