#include "kernel/math/model_jet.hpp"

namespace blendwright {
namespace {

template <class Op>
ModelJet termwise(const ModelJet& a, Op op) {
  ModelJet r;
  for (std::size_t k = 0; k < r.c.size(); ++k) r.c[k] = op(a.c[k], k);
  return r;
}

/// a += b c, skipping what is exactly zero.
void add_product(TaylorModel& a, const TaylorModel& b, const TaylorModel& c) {
  if (b.is_zero() || c.is_zero()) return;
  a = a + b * c;
}

}  // namespace

ModelJet operator+(const ModelJet& a, const ModelJet& b) {
  return termwise(a, [&](const TaylorModel& x, std::size_t k) { return x + b.c[k]; });
}
ModelJet operator-(const ModelJet& a, const ModelJet& b) {
  return termwise(a, [&](const TaylorModel& x, std::size_t k) { return x - b.c[k]; });
}
ModelJet operator-(const ModelJet& a) {
  return termwise(a, [](const TaylorModel& x, std::size_t) { return -x; });
}
ModelJet operator*(double s, const ModelJet& a) {
  return termwise(a, [&](const TaylorModel& x, std::size_t) { return s * x; });
}

ModelJet operator*(const ModelJet& a, const ModelJet& b) {
  // Places (in a, in b, in the product) of every pair of coefficients that stays within the order.
  static constexpr std::array<std::array<std::size_t, 3>, 15> pairs{{{0, 0, 0},
                                                                     {0, 1, 1},
                                                                     {1, 0, 1},
                                                                     {0, 2, 2},
                                                                     {2, 0, 2},
                                                                     {0, 3, 3},
                                                                     {1, 1, 3},
                                                                     {3, 0, 3},
                                                                     {0, 4, 4},
                                                                     {1, 2, 4},
                                                                     {2, 1, 4},
                                                                     {4, 0, 4},
                                                                     {0, 5, 5},
                                                                     {2, 2, 5},
                                                                     {5, 0, 5}}};
  ModelJet r;
  for (const auto& [i, j, k] : pairs) add_product(r.c[k], a.c[i], b.c[j]);
  return r;
}

ModelJet composed(const TaylorModel& f, const TaylorModel& f1, const TaylorModel& f2, const ModelJet& a) {
  ModelJet r(f);
  for (std::size_t k = 1; k < r.c.size(); ++k) add_product(r.c[k], f1, a.c[k]);
  const TaylorModel &g = a.c[1], &h = a.c[2];
  if (!g.is_zero()) add_product(r.c[3], f2, g * g);
  if (!g.is_zero() && !h.is_zero()) add_product(r.c[4], f2, 2.0 * (g * h));
  if (!h.is_zero()) add_product(r.c[5], f2, h * h);
  return r;
}

ModelJet operator/(const ModelJet& a, const ModelJet& b) {
  const TaylorModel f = inverse(b.c[0]), f1 = -(f * f);
  return a * composed(f, f1, -(f * f1), b);
}

std::array<ModelJet, 2> sin_cos(const ModelJet& a) {
  const TaylorModel s = sin(a.c[0]), c = cos(a.c[0]);
  return {composed(s, c, -0.5 * s, a), composed(c, -s, -0.5 * c, a)};
}
ModelJet sin(const ModelJet& a) { return sin_cos(a)[0]; }
ModelJet cos(const ModelJet& a) { return sin_cos(a)[1]; }
ModelJet tan(const ModelJet& a) {
  const auto [s, c] = sin_cos(a);
  return s / c;
}
ModelJet sinh(const ModelJet& a) {
  const TaylorModel s = sinh(a.c[0]);
  return composed(s, cosh(a.c[0]), 0.5 * s, a);
}
ModelJet cosh(const ModelJet& a) {
  const TaylorModel c = cosh(a.c[0]);
  return composed(c, sinh(a.c[0]), 0.5 * c, a);
}
ModelJet tanh(const ModelJet& a) {
  // 1 - 2/(exp(2a) + 1), turned over for a > 0 so that nothing overflows.
  const bool positive = a.c[0].centre() > 0.0;
  const ModelJet b = positive ? -a : a;
  const ModelJet t = 1.0 - 2.0 / (exp(2.0 * b) + 1.0);
  return positive ? -t : t;
}
ModelJet exp(const ModelJet& a) {
  const TaylorModel e = exp(a.c[0]);
  return composed(e, e, 0.5 * e, a);
}
ModelJet log(const ModelJet& a) {
  const TaylorModel f1 = inverse(a.c[0]);
  return composed(log(a.c[0]), f1, -0.5 * (f1 * f1), a);
}
ModelJet sqrt(const ModelJet& a) { return pow(a, 0.5); }
ModelJet pow(const ModelJet& a, double p) {
  const TaylorModel f = pow(a.c[0], p), x = inverse(a.c[0]), f1 = p * (f * x);
  return composed(f, f1, TaylorModel(Bounds(0.5) * (Bounds(p) - Bounds(1.0))) * (f1 * x), a);
}
ModelJet pow(const ModelJet& a, const ModelJet& b) {
  bool constant = b.c[0].exact();
  for (std::size_t k = 1; k < b.c.size(); ++k) constant = constant && b.c[k].is_zero();
  return constant ? pow(a, b.c[0].centre()) : exp(b * log(a));
}

ModelJet atan2(const ModelJet& y, const ModelJet& x) {
  // With z = x + i y = z0 (1 + w): the angle is arg z0 + Im(w - w^2/2 + ...), and w has no constant term.
  const TaylorModel &x0 = x.c[0], &y0 = y.c[0];
  const TaylorModel over = inverse(x0 * x0 + y0 * y0), p = x0 * over, q = y0 * over;
  ModelJet dx = x, dy = y;
  dx.c[0] = TaylorModel();
  dy.c[0] = TaylorModel();
  const ModelJet real = dx * ModelJet(p) + dy * ModelJet(q), imaginary = dy * ModelJet(p) - dx * ModelJet(q);
  ModelJet angle = imaginary - real * imaginary;
  angle.c[0] = atan2(y0, x0);
  return angle;
}
ModelJet atan(const ModelJet& a) { return atan2(a, ModelJet(1.0)); }
ModelJet asin(const ModelJet& a) { return atan2(a, sqrt((1.0 - a) * (1.0 + a))); }
ModelJet acos(const ModelJet& a) { return atan2(sqrt((1.0 - a) * (1.0 + a)), a); }

ModelJet unknown_jet() {
  ModelJet r;
  for (TaylorModel& c : r.c) c = TaylorModel::unknown();
  return r;
}

ModelJet abs(const ModelJet& a) {
  const Bounds range = a.c[0].range();
  if (range.lo > 0.0) return a;
  return range.hi < 0.0 ? -a : unknown_jet();
}
ModelJet min(const ModelJet& a, const ModelJet& b) {
  const Bounds first = a.c[0].range(), second = b.c[0].range();
  if (first.hi < second.lo) return a;
  return second.hi < first.lo ? b : unknown_jet();
}
ModelJet max(const ModelJet& a, const ModelJet& b) { return -min(-a, -b); }

TaylorModel inside_range(const TaylorModel& t, double lo, double hi, bool closed, double* turns) {
  const double period = hi - lo, slack = 1e-9 * period;
  TaylorModel inside = t;
  const double away = closed ? std::floor((t.centre() - lo) / period) : 0.0;
  // The end itself belongs to the turn that it ends, as long as nothing reaches beyond it.
  const double whole =
      away > 0.0 && t.centre() - away * period <= lo && t.range().hi <= lo + away * period + slack
          ? away - 1.0
          : away;
  if (whole != 0.0) inside = t - TaylorModel(Bounds(whole) * (Bounds(hi) - Bounds(lo)));
  if (turns) *turns = whole;
  const Bounds range = inside.range();
  if (!(range.lo >= lo - slack) || !(range.hi <= hi + slack)) return TaylorModel::unknown();
  return inside;
}

ModelJet in_closed_range(const ModelJet& t, double lo, double hi) {
  ModelJet r = t;
  r.c[0] = inside_range(t.c[0], lo, hi, true);
  return r;
}

}  // namespace blendwright
