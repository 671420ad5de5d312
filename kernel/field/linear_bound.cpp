#include "kernel/field/linear_bound.hpp"

namespace blendwright {
namespace {

constexpr double round_off = std::numeric_limits<double>::epsilon();

double size_of(const LinearBound& a) {
  return std::abs(a.value) + a.slope.lpNorm<1>() + std::max(std::abs(a.rest.lo), std::abs(a.rest.hi));
}

/// Slack of a bound whose parts were each rounded once or twice; none where the bound says nothing.
LinearBound rounded(const LinearBound& a, double size) {
  const double slack = 4.0 * round_off * size;
  return std::isfinite(slack) ? a.widened(slack) : a;
}

/// An end that infinities of both signs left open.
Range known(Range r) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {std::isnan(r.lo) ? -infinity : r.lo, std::isnan(r.hi) ? infinity : r.hi};
}

}  // namespace

Range LinearBound::range() const {
  const double reach = slope.lpNorm<1>();
  const double size = std::abs(value) + reach;
  const double slack = 4.0 * round_off * size;
  const double lo = value - reach + rest.lo, hi = value + reach + rest.hi;
  // A field may be infinite all over the box.
  return known({std::isinf(lo) ? lo : lo - slack - round_off * std::abs(rest.lo),
                std::isinf(hi) ? hi : hi + slack + round_off * std::abs(rest.hi)});
}

LinearBound constant_bound(Range range) {
  const double middle = 0.5 * range.lo + 0.5 * range.hi;
  if (!std::isfinite(range.lo) || !std::isfinite(range.hi)) return {0.0, Vec3::Zero(), range};
  if (range.constant()) return {range.lo, Vec3::Zero(), {0.0, 0.0}};
  const double half = std::max(range.hi - middle, middle - range.lo);
  return {middle, Vec3::Zero(), Range{-half, half}.widened(round_off)};
}

LinearBound operator+(const LinearBound& a, const LinearBound& b) {
  const LinearBound sum{a.value + b.value, a.slope + b.slope,
                        known({a.rest.lo + b.rest.lo, a.rest.hi + b.rest.hi})};
  return rounded(sum, size_of(a) + size_of(b));
}

LinearBound operator*(double factor, const LinearBound& a) {
  LinearBound scaled{factor * a.value, factor * a.slope, {factor * a.rest.lo, factor * a.rest.hi}};
  if (factor < 0.0) std::swap(scaled.rest.lo, scaled.rest.hi);
  if (factor == 0.0) return {};
  return std::abs(factor) == 1.0 ? scaled : rounded(scaled, size_of(scaled));
}

Range difference(const LinearBound& f, double value, const Vec3& slope) {
  return LinearBound{f.value - value, f.slope - slope, f.rest}
      .widened(round_off * (std::abs(f.value) + std::abs(value) + f.slope.lpNorm<1>() + slope.lpNorm<1>()))
      .range();
}

}  // namespace blendwright
