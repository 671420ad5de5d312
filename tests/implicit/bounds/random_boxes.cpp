#include "tests/implicit/bounds/random_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace blendwright::test {
namespace {

bool chance(Rng& rng, double p) { return uniform(rng, 0.0, 1.0) < p; }

std::vector<double> values_of(const ScalarField::Model& model, const std::vector<Vec3>& points) {
  std::vector<double> x, y, z, f(points.size());
  for (const Vec3& p : points) {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
  }
  model.evaluate(Order::value, {x, y, z}, f);
  return f;
}

/// f - (value + slope.t) at a point of the box, with what rounding of this sum can add: long doubles have 64
/// bits, so that the sum of five terms is off by less than 5 * 2^-64 of their magnitudes.
struct Remainder {
  long double value, slack;
};
Remainder remainder(const LinearBound& bound, const Box& box, const Vec3& p, double f) {
  const Vec3 c = box.centre(), h = 0.5 * box.size();
  long double line = bound.value, size = std::abs(f) + std::abs(bound.value);
  for (int k = 0; k < 3; ++k) {
    if (!(h[k] > 0.0)) continue;
    // The centre is rounded, so that the ends of the box can be beyond t = +-1 by that.
    const long double t = (static_cast<long double>(p[k]) - static_cast<long double>(c[k])) / h[k];
    const long double term = bound.slope[k] * std::clamp(t, -1.0L, 1.0L);
    line += term;
    size += std::abs(term);
  }
  return {f - line, 1e-18L * size};
}

void add_example(BoundCount& count, const char* kind, const std::string& what, const Box& box, const Vec3& p,
                 double value, Range range) {
  if (count.examples.size() >= 6) return;
  char text[500];
  std::snprintf(text, sizeof text,
                "%s: %s: %.17g not in [%.17g, %.17g] at (%.17g, %.17g, %.17g) in (%.17g, %.17g, %.17g) .. "
                "(%.17g, %.17g, %.17g)",
                what.c_str(), kind, value, range.lo, range.hi, p.x(), p.y(), p.z(), box.lo.x(), box.lo.y(),
                box.lo.z(), box.hi.x(), box.hi.y(), box.hi.z());
  count.examples.emplace_back(text);
}

double width(Range r) { return r.hi - r.lo; }

}  // namespace

Box random_box(Rng& rng, const Box& where) {
  const double reach = where.size().maxCoeff();
  Vec3 c;
  for (int i = 0; i < 3; ++i) c[i] = uniform(rng, where.lo[i], where.hi[i]);
  if (chance(rng, 0.1)) c *= log_uniform(rng, 1.0, 1e6);
  const bool special = chance(rng, 0.15);
  for (int i = 0; i < 3; ++i)
    if (special && chance(rng, 0.5)) c[i] = chance(rng, 0.8) ? 0.0 : std::round(c[i]);
  const double size =
      chance(rng, 0.1) ? reach * log_uniform(rng, 1.0, 1e6) : reach * log_uniform(rng, 1e-8, 1.0);
  Vec3 h;
  for (int i = 0; i < 3; ++i) {
    h[i] = 0.5 * size * (chance(rng, 0.5) ? 1.0 : log_uniform(rng, 1e-3, 1.0));
    if (chance(rng, 0.05)) h[i] = 0.0;
  }
  Box box{c - h, c + h};
  if (special && chance(rng, 0.3)) box.lo = box.lo.cwiseMin(c), box.hi = c;  // ends at a special place
  return box;
}

std::vector<Vec3> points_in(Rng& rng, const Box& box, int random) {
  std::vector<Vec3> points{box.centre()};
  for (unsigned k = 0; k < 8; ++k)
    points.emplace_back(k & 1 ? box.hi.x() : box.lo.x(), k & 2 ? box.hi.y() : box.lo.y(),
                        k & 4 ? box.hi.z() : box.lo.z());
  for (int n = 0; n < random; ++n) {
    Vec3 p;
    for (int i = 0; i < 3; ++i) {
      p[i] = uniform(rng, box.lo[i], box.hi[i]);
      if (n % 3 != 0 && chance(rng, 0.4)) p[i] = chance(rng, 0.5) ? box.lo[i] : box.hi[i];
      if (n % 3 == 1 && box.lo[i] < 0.0 && box.hi[i] > 0.0 && chance(rng, 0.3)) p[i] = 0.0;
      p[i] = std::clamp(p[i], box.lo[i], box.hi[i]);
    }
    points.push_back(p);
  }
  return points;
}

void check_bounds(const ScalarField::Model& model, const Box& box, const std::vector<Vec3>& points,
                  const std::string& what, BoundCount& count) {
  const Range range = model.range(box);
  const LinearBound linear = model.linear(box);
  const Range of_linear = linear.range();
  const auto within = model.within(box);
  const std::vector<double> values = values_of(model, points);
  const std::vector<double> less = within.model ? values_of(*within.model, points) : values;
  ++count.boxes;
  count.pairs += points.size();
  if (width(linear.rest) < 0.999 * width(range)) ++count.first_order;
  // A range as a bound around its middle is wider by the rounding of that.
  const double rounding = 1e-15 * (std::abs(range.lo) + std::abs(range.hi));
  if (width(linear.rest) > width(range) + (std::isfinite(rounding) ? rounding : 0.0)) {
    ++count.wider;
    add_example(count, "linear bound wider than the range", what, box, box.centre(), width(linear.rest),
                range);
  }
  if (!(within.range == range)) {
    ++count.within;
    add_example(count, "within() has another range", what, box, box.centre(), within.range.lo, range);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double f = values[i];
    if (!range.contains(f)) {
      ++count.range;
      add_example(count, "range", what, box, points[i], f, range);
    }
    if (!of_linear.contains(f)) {
      ++count.linear_range;
      add_example(count, "range of the linear bound", what, box, points[i], f, of_linear);
    }
    if (std::isfinite(f)) {
      const Remainder r = remainder(linear, box, points[i], f);
      if (!(r.value >= linear.rest.lo - r.slack && r.value <= linear.rest.hi + r.slack)) {
        ++count.linear;
        add_example(count, "linear bound", what, box, points[i], static_cast<double>(r.value), linear.rest);
      }
    }
    if (less[i] != f) {
      ++count.within;
      add_example(count, "shortened model", what, box, points[i], less[i], {f, f});
    }
  }
}

}  // namespace blendwright::test
