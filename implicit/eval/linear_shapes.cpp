#include "implicit/eval/linear_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "implicit/eval/linear_rules.hpp"

namespace blendwright::detail {
namespace {

constexpr double round_off = std::numeric_limits<double>::epsilon();
constexpr std::size_t most_knots = 8;

bool finite(Range r) { return std::isfinite(r.lo) && std::isfinite(r.hi); }
LinearBound nothing_known() { return constant_bound(Range::everything()); }

/// A function at rising places, with its curve between neighbours.
struct Curved {
  std::array<Knot, most_knots> knots{};
  std::array<Curve, most_knots> curves{};
  std::size_t count = 0;
  std::size_t middle = 0;  ///< the knot next to the middle

  void add(const Knot& knot, Curve before) {
    knots[count] = knot;
    if (count > 0) curves[count - 1] = before;
    ++count;
  }
  [[nodiscard]] const Knot& first() const { return knots[0]; }
  [[nodiscard]] const Knot& last() const { return knots[count - 1]; }
};

Curved curved(double u0, Range range, std::span<const double> joints, std::span<const Curve> curves,
              KnotAt at, const void* body) {
  std::size_t joint = 0;
  while (joint < joints.size() && joints[joint] <= range.lo) ++joint;
  Curved all;
  all.add(at(body, range.lo), Curve::convex);
  const auto go_to = [&](double place) {
    if (place > all.last().at) all.add(at(body, place), curves[joint]);
  };
  bool passed = false;
  const auto go_to_middle = [&](double before) {
    if (passed || u0 > before) return;
    passed = true;
    go_to(u0);
    all.middle = all.count - 1;
  };
  for (; joint < joints.size() && joints[joint] < range.hi; ++joint) {
    go_to_middle(joints[joint]);
    go_to(joints[joint]);
  }
  go_to_middle(range.hi);
  go_to(range.hi);
  return all;
}

/// The least of a convex function on [0, length] with these values and slopes at its ends: above both
/// tangents, which meet in between. Its largest value is at an end.
struct End {
  double value, slope;
};
double least_convex(End a, End b, double length) {
  const double at_ends = std::min(a.value, b.value);
  if (a.slope >= 0.0 || b.slope <= 0.0) return at_ends;
  const double t = std::clamp((b.value - a.value - b.slope * length) / (a.slope - b.slope), 0.0, length);
  return std::min(at_ends, a.value + a.slope * t);
}

/// g(u) - g(u0) - slope (u - u0), with what rounding can add.
Range left_over(const Curved& g, double slope) {
  const Knot& middle = g.knots[g.middle];
  Range r{0.0, 0.0};
  double size = 0.0;
  const auto end = [&](const Knot& k, double side) {
    return End{(k.value - middle.value) - slope * (k.at - middle.at), side - slope};
  };
  for (std::size_t i = 0; i + 1 < g.count; ++i) {
    const Knot &a = g.knots[i], &b = g.knots[i + 1];
    const End from = end(a, a.right), to = end(b, b.left);
    const double length = b.at - a.at;
    const bool convex = g.curves[i] == Curve::convex;
    const double extreme = convex ? least_convex(from, to, length)
                                  : -least_convex({-from.value, -from.slope}, {-to.value, -to.slope}, length);
    r.lo = std::min({r.lo, extreme, from.value, to.value});
    r.hi = std::max({r.hi, extreme, from.value, to.value});
    size = std::max(size, (std::abs(a.right) + std::abs(b.left) + std::abs(slope)) * length);
  }
  for (std::size_t i = 0; i < g.count; ++i)
    size = std::max(size, std::abs(slope * (g.knots[i].at - middle.at)));
  const double slack = range_slack * size;
  return {r.lo - slack, r.hi + slack};
}

Knot positive_knot(const void*, double u) {
  return {u, std::max(u, 0.0), u > 0.0 ? 1.0 : 0.0, u >= 0.0 ? 1.0 : 0.0};
}
Knot magnitude_knot(const void*, double u) {
  return {u, std::abs(u), u > 0.0 ? 1.0 : -1.0, u >= 0.0 ? 1.0 : -1.0};
}
Knot logarithm_knot(const void*, double u) { return {u, std::log(u), 1.0 / u, 1.0 / u}; }
Knot exponential_knot(const void*, double u) {
  const double e = std::exp(u);
  return {u, e, e, e};
}

constexpr double zero[] = {0.0};
constexpr Curve convex_twice[] = {Curve::convex, Curve::convex};
constexpr Curve convex_once[] = {Curve::convex}, concave_once[] = {Curve::concave};

}  // namespace

LinearBound of_curves(const LinearBound& u, Range range, std::span<const double> joints,
                      std::span<const Curve> curves, KnotAt at, const void* body, double slack) {
  if (!finite(range) || !std::isfinite(u.value) || !(range.lo <= range.hi)) return nothing_known();
  const Curved g = curved(std::clamp(u.value, range.lo, range.hi), range, joints, curves, at, body);
  const Knot& middle = g.knots[g.middle];
  const double reach = range.hi - range.lo, rest = u.rest.hi - u.rest.lo;
  const double chord = reach > 0.0 ? (g.last().value - g.first().value) / reach : middle.right;
  double slope = 0.0, least = std::numeric_limits<double>::infinity();
  Range over;
  for (const double candidate : {middle.left, middle.right, chord}) {
    const Range r = left_over(g, candidate);
    const double width = r.hi - r.lo + std::abs(candidate) * rest;
    if (!(width < least)) continue;
    least = width;
    slope = candidate;
    over = r;
  }
  if (!std::isfinite(least)) return nothing_known();
  const LinearBound away{u.value - middle.at, u.slope, u.rest};
  LinearBound bound = slope * away;
  bound.value += middle.value;
  bound.rest = {bound.rest.lo + over.lo, bound.rest.hi + over.hi};
  const double size =
      std::abs(middle.value) + std::abs(g.first().value) + std::abs(g.last().value) +
      std::abs(slope) * (std::abs(u.value) + std::abs(middle.at) + reach + u.slope.lpNorm<1>());
  return bound.widened(slack + 16.0 * round_off * size);
}

LinearBound positive_part(const LinearBound& u, Range range) {
  return of_curves(u, range, zero, convex_twice, positive_knot, nullptr, 0.0);
}
LinearBound magnitude_bound(const LinearBound& u, Range range) {
  return of_curves(u, range, zero, convex_twice, magnitude_knot, nullptr, 0.0);
}
LinearBound logarithm_bound(const LinearBound& u, Range range) {
  if (!(range.lo > 0.0)) return nothing_known();
  const double size = std::max(std::abs(std::log(range.lo)), std::abs(std::log(range.hi)));
  return of_curves(u, range, {}, concave_once, logarithm_knot, nullptr, 4.0 * range_slack * size);
}
LinearBound exponential_bound(const LinearBound& u, Range range) {
  if (!(range.hi < 700.0)) return nothing_known();
  return of_curves(u, range, {}, convex_once, exponential_knot, nullptr,
                   4.0 * range_slack * std::exp(range.hi));
}

LinearBound recentred(const LinearBound& u, Range range) {
  if (!finite(range) || (u.value > range.lo && u.value < range.hi)) return u;
  const double middle = 0.5 * range.lo + 0.5 * range.hi, shift = u.value - middle;
  const double size =
      std::abs(u.value) + std::abs(middle) + std::max(std::abs(u.rest.lo), std::abs(u.rest.hi));
  return LinearBound{middle, u.slope, {u.rest.lo + shift, u.rest.hi + shift}}.widened(2.0 * round_off * size);
}

Knot smooth_knot(const Op& op, const void* body, double at) {
  double argument[3 * batch_size + 1], out[4 * batch_size];  // one point: the first number of each component
  argument[0] = at;
  argument[batch_size] = 1.0;
  argument[2 * batch_size] = argument[3 * batch_size] = 0.0;
  const double* const arguments[] = {argument};
  const double origin = 0.0;
  op.scalar.run[1](body, {&origin, &origin, &origin, nullptr, arguments, 1, 1}, out);
  return {at, out[0], out[batch_size], out[batch_size]};
}

Vec3 reach_of(const LinearInput& in) { return in.local.lo.cwiseAbs().cwiseMax(in.local.hi.cwiseAbs()); }

LinearBound linear_form(const Vec3& n, const LinearInput& in) {
  const double slack = n.cwiseAbs().dot(8.0 * round_off * reach_of(in) + 2.0 * in.slack);
  return LinearBound{n.dot(in.centre), in.slope(n), {0.0, 0.0}}.widened(slack);
}

LinearBound length_bound(const LinearInput& in) {
  const double distance = in.centre.stableNorm();
  const Vec3 g = distance > 0.0 ? Vec3(in.centre / distance) : Vec3::Zero();
  double most = 0.0;
  for (unsigned k = 0; k < 8; ++k) {
    const Vec3 y = in.corner(k);
    most = std::max(most, y.stableNorm() - g.dot(y));
  }
  return LinearBound{g.dot(in.centre), in.slope(g), {0.0, most}}.widened(
      32.0 * round_off * reach_of(in).sum() + 2.0 * in.slack.sum());
}

LinearBound supported_bound(const Op& op, const void* body, const LinearInput& in, Curve curve,
                            const Support& plane, const Vec3& steepness, double slack) {
  // All corners at once, by the vector kernel.
  double x[batch_size], y[batch_size], z[batch_size], f[batch_size];
  for (unsigned k = 0; k < 8; ++k) {
    const Vec3 corner = in.corner(k);
    x[k] = corner.x();
    y[k] = corner.y();
    z[k] = corner.z();
  }
  op.simd.run[0](body, {x, y, z, nullptr, nullptr, 0, 8}, f);
  double most = 0.0, size = 0.0;
  for (unsigned k = 0; k < 8; ++k) {
    const double off = f[k] - plane.offset - plane.gradient.dot(Vec3(x[k], y[k], z[k]));
    if (!std::isfinite(off)) return nothing_known();
    most = std::max(most, curve == Curve::convex ? off : -off);
    size = std::max(size, std::abs(f[k]));
  }
  const Range rest = curve == Curve::convex ? Range{0.0, most} : Range{-most, 0.0};
  const double value = plane.offset + plane.gradient.dot(in.centre);
  const Vec3 steepest = steepness.cwiseMax(plane.gradient.cwiseAbs());
  return LinearBound{value, in.slope(plane.gradient), rest}.widened(
      slack + range_slack * (size + std::abs(plane.offset) + steepest.dot(reach_of(in))) +
      2.0 * steepest.dot(in.slack));
}

LinearBound gauge_bound(const Op& op, const void* body, const LinearInput& in, Curve curve,
                        const Vec3& steepness, double slack) {
  const ValueGradient f = scalar_gradient(op, body, in.centre);
  return supported_bound(op, body, in, curve, {0.0, f.gradient}, steepness, slack);
}

}  // namespace blendwright::detail
