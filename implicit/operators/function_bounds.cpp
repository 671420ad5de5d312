#include "implicit/operators/function_bounds.hpp"

#include <vector>

namespace blendwright::detail {
namespace {

constexpr double round_off = std::numeric_limits<double>::epsilon();

/// The first-order part of an argument, less a constant.
LinearBound less(const LinearBound& a, double c) { return {a.value - c, a.slope, a.rest}; }

bool finite(Range r) { return std::isfinite(r.lo) && std::isfinite(r.hi); }

}  // namespace

Range ends_of_join(const Op& op, const void* body, std::span<const Range> args, Join join) {
  const Range r = join == Join::subtract && args.size() > 1
                      ? range_by_arguments(op, body, args, {true, false})
                      : range_by_arguments(op, body, args, {true});
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {std::isnan(r.lo) ? infinity : r.lo, std::isnan(r.hi) ? -infinity : r.hi};
}

double size_of(std::span<const Range> args) {
  double size = 0.0;
  for (const Range& arg : args)
    for (const double x : {arg.lo, arg.hi})
      if (std::isfinite(x)) size = std::max(size, std::abs(x));
  return size;
}

ArgumentGradient argument_gradient(const Op& op, const void* body, std::span<const double> at) {
  constexpr std::size_t most = ArgumentGradient::most;
  // Kernels of one point read the first number of every component.
  double numbers[most][3 * batch_size + 1];
  double out[4 * batch_size];
  const double* places[most];
  const double origin = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) places[i] = numbers[i];
  ArgumentGradient g;
  for (std::size_t first = 0; first < at.size(); first += 3) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      numbers[i][0] = at[i];
      for (std::size_t c = 0; c < 3; ++c) numbers[i][(1 + c) * batch_size] = i == first + c ? 1.0 : 0.0;
    }
    op.scalar.run[1](body, {&origin, &origin, &origin, nullptr, places, at.size(), 1}, out);
    g.value = out[0];
    for (std::size_t c = 0; c < 3 && first + c < at.size(); ++c)
      g.partials[first + c] = out[(1 + c) * batch_size];
  }
  return g;
}

Middle::Middle(const LinearInput& in) {
  if (in.args.size() > ArgumentGradient::most) return;
  usable = true;
  for (std::size_t i = 0; i < in.args.size(); ++i) {
    const Range r = in.ranges[i];
    usable = usable && finite(r) && std::isfinite(in.args[i].value);
    if (!usable) return;
    at[i] = std::clamp(in.args[i].value, r.lo, r.hi);
    least[i] = r.lo - at[i];
    most[i] = r.hi - at[i];
  }
}

LinearBound expansion_bound(const LinearInput& in, const Middle& middle, const ArgumentGradient& g,
                            Range rest, double slack) {
  LinearBound bound{g.value, Vec3::Zero(), rest};
  double size = std::abs(g.value);
  for (std::size_t i = 0; i < in.args.size(); ++i) {
    if (g.partials[i] == 0.0) continue;
    bound = bound + g.partials[i] * less(in.args[i], middle.at[i]);
    size += std::abs(g.partials[i]) * (std::abs(middle.at[i]) + middle.most[i] - middle.least[i]);
  }
  return bound.widened(slack + 16.0 * round_off * size);
}

LinearBound mean_value_bound(const LinearInput& in, const Middle& middle, double value,
                             std::span<const Range> partials, double slack) {
  ArgumentGradient g;
  g.value = value;
  double rest = 0.0;
  for (std::size_t i = 0; i < partials.size(); ++i) {
    g.partials[i] = 0.5 * (partials[i].lo + partials[i].hi);
    const double half = (0.5 + 4.0 * round_off) * (partials[i].hi - partials[i].lo) +
                        4.0 * round_off * std::abs(g.partials[i]);
    rest += half * std::max(middle.most[i], -middle.least[i]);
  }
  return expansion_bound(in, middle, g, {-rest, rest}, slack);
}

LinearBound tangent_bound(const Op& op, const void* body, const LinearInput& in, Bend bend, double slack) {
  const std::size_t k = in.args.size();
  const Middle middle(in);
  if (!middle.usable || k > 5) return constant_bound(Range::everything());
  const ArgumentGradient g = argument_gradient(op, body, {middle.at, k});
  double largest = 0.0, size = std::abs(g.value);
  for (unsigned corner = 0; corner < (1u << k); ++corner) {
    double at[5], plane = g.value;
    for (std::size_t i = 0; i < k; ++i) {
      const double offset = corner >> i & 1u ? middle.most[i] : middle.least[i];
      at[i] = corner >> i & 1u ? in.ranges[i].hi : in.ranges[i].lo;
      plane += g.partials[i] * offset;
      size = std::max(size, std::abs(at[i]));
    }
    const double below = plane - scalar_value(op, body, Vec3::Zero(), {at, k});
    largest = std::max(largest, bend == Bend::concave ? below : -below);
  }
  // Partials that are off by a few roundings tilt the plane by that much of the arguments' ranges.
  for (std::size_t i = 0; i < k; ++i)
    slack += range_slack * std::abs(g.partials[i]) * (middle.most[i] - middle.least[i]);
  const Range rest = bend == Bend::concave ? Range{-largest, 0.0} : Range{0.0, largest};
  return expansion_bound(in, middle, g, rest, slack + 16.0 * round_off * size);
}

LinearBound shift_bound(const Op& op, const void* body, const LinearInput& in, Join join, double slack) {
  const std::size_t k = in.args.size();
  // The mean follows the arguments that decide in the middle, if they are few.
  const Middle middle(in);
  for (const Range& r : in.ranges)
    if (!finite(r)) return constant_bound(Range::everything());
  ArgumentGradient g;
  if (middle.usable) g = argument_gradient(op, body, {middle.at, k});
  double value = 0.0;
  Vec3 slope = Vec3::Zero();
  for (std::size_t i = 0; i < k; ++i) {
    const double sign = rises(join, i) ? 1.0 : -1.0;
    const double share = middle.usable ? g.partials[i] : sign / static_cast<double>(k);
    value += share * in.args[i].value;
    slope += share * in.args[i].slope;
  }
  std::vector<Range> offsets(k);
  for (std::size_t i = 0; i < k; ++i) {
    const double sign = rises(join, i) ? 1.0 : -1.0;
    offsets[i] = sign * difference(sign * in.args[i], value, slope);
  }
  return LinearBound{value, slope, ends_of_join(op, body, offsets, join)}.widened(slack);
}

}  // namespace blendwright::detail
