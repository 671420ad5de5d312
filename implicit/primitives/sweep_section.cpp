#include "implicit/primitives/sweep_section.hpp"

#include <algorithm>

#include "implicit/eval/op.hpp"
#include "implicit/primitives/sweep_section-inl.hpp"

namespace blendwright::detail {

double Section::reach(double value, Range k) const {
  const double s = s0 + std::max(ds * k.lo, ds * k.hi);
  return profile.radius().hi * s * std::max(value, 0.0) * (1.0 + 1e-12);
}

Range section_range(const Section& b, const PlanePart& part, Range k, Range alpha) {
  const Range turn{std::min(b.twist * k.lo, b.twist * k.hi), std::max(b.twist * k.lo, b.twist * k.hi)};
  const Range s{b.s0 + std::min(b.ds * k.lo, b.ds * k.hi), b.s0 + std::max(b.ds * k.lo, b.ds * k.hi)};
  const Range g = gauge_range(b.profile, part, turn);
  const Range q = Range{g.lo / s.hi, g.hi / s.lo}.widened(range_slack);
  if (alpha.hi == 0.0) return q;
  const double lo[2] = {q.lo, alpha.lo * b.inverse_cap}, hi[2] = {q.hi, alpha.hi * b.inverse_cap};
  return Range{HWY_NAMESPACE::p_norm(lo, b.m, b.inverse_m), HWY_NAMESPACE::p_norm(hi, b.m, b.inverse_m)}
      .widened(range_slack);
}

Box end_box(const Section& b, double k, const Vec3& end, const Vec3& tangent, double value) {
  const double radius = b.reach(value, {k, k}), length = std::max(value, 0.0) / b.inverse_cap;
  const Vec3 across = (1.0 - tangent.array().square()).max(0.0).sqrt();
  const Vec3 reach = (radius * across + length * tangent.cwiseAbs()) * (1.0 + 1e-12);
  return {end - reach, end + reach};
}

}  // namespace blendwright::detail
