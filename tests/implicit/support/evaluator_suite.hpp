#pragma once
// What must hold for the evaluation of every tape, checked at seeded points and boxes. Returns what is wrong,
// so a test reads
//   EXPECT_EQ(evaluator_faults(*tape, {.where = box}), no_faults);
// and a negative control looks for its fault.
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "implicit/eval/tape.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

struct EvaluatorSuite {
  Box where{Vec3::Constant(-2.0), Vec3::Constant(2.0)};  ///< points and boxes are taken from here
  int points = 200;                                      ///< for values and derivatives
  int boxes = 60, samples = 60;                          ///< boxes, and points in each of them
  std::uint64_t seed = 1;
  /// Largest difference of vector and scalar values, relative to max(1e-3, magnitude); derivatives get 100
  /// and 10^4 times as much, relative to max(1e-3, largest component of that order).
  double agreement = 1e-12;
  /// Whether derivatives are compared with differences of values and of gradients.
  bool differences = true;
  /// Share of the differences that may be useless because their two step sizes disagree (kinks, cusps, steep
  /// exponents). More is a fault: the comparison would say nothing.
  double useless_share = 0.1;
};

inline const std::vector<std::string> no_faults{};

namespace suite {

class Faults {
 public:
  /// At most three of a kind: one cause shows at many points.
  void add(const std::string& kind, const std::string& text) {
    std::size_t same = 0;
    for (const std::string& f : list_)
      if (f.rfind(kind + ":", 0) == 0) ++same;
    if (same < 3) list_.push_back(kind + ": " + text);
  }
  [[nodiscard]] const std::vector<std::string>& list() const { return list_; }

 private:
  std::vector<std::string> list_;
};

inline std::string text(const Vec3& p) {
  char buffer[100];
  std::snprintf(buffer, sizeof buffer, "at (%.17g, %.17g, %.17g)", p.x(), p.y(), p.z());
  return buffer;
}
inline std::string text(double a, double b) {
  char buffer[100];
  std::snprintf(buffer, sizeof buffer, " %.17g, %.17g", a, b);
  return buffer;
}
inline std::string text(const Box& b) { return "box " + text(b.lo) + " .. " + text(b.hi); }

/// Results of all points, by point.
struct Results {
  std::size_t components = 1;
  std::vector<double> data;
  [[nodiscard]] double at(std::size_t point, std::size_t c) const {
    return data[c * (data.size() / components) + point];
  }
};

enum class Kernels { simd, scalar };

inline Results evaluate(const ScalarField::Model& model, Order order, const std::vector<Vec3>& points,
                        Kernels kernels = Kernels::simd) {
  std::vector<double> x, y, z;
  for (const Vec3& p : points) {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
  }
  Results r{components(order), std::vector<double>(components(order) * points.size())};
  if (kernels == Kernels::simd)
    model.evaluate(order, {x, y, z}, r.data);
  else
    dynamic_cast<const Tape&>(model).evaluate_scalar(order, {x, y, z}, r.data);
  return r;
}

inline Vec3 point_in(Rng& rng, const Box& box) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = uniform(rng, box.lo[i], box.hi[i]);
  return p;
}
inline Box box_in(Rng& rng, const Box& box) {
  const Vec3 c = point_in(rng, box);
  Vec3 h;
  for (int i = 0; i < 3; ++i) h[i] = 0.5 * log_uniform(rng, 1e-3, 1.0) * box.size()[i];
  return *common(box, {c - h, c + h});
}

/// Points where fields tend to be special: the origin, axes, planes and diagonals through it and through the
/// middle, corners, far away and next to nothing.
inline std::vector<Vec3> special_points(Rng& rng, const Box& box) {
  std::vector<Vec3> list{Vec3::Zero(), box.centre(), box.lo, box.hi, 1e6 * box.hi, -1e-9 * box.hi};
  for (int k = 0; k < 27; ++k) {
    const Vec3 corner(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    list.push_back(corner);
    list.push_back(box.centre() + 0.25 * corner.cwiseProduct(box.size()));
    list.push_back(corner.cwiseProduct(point_in(rng, box)));
    list.push_back(1e-160 * corner);
    list.push_back(uniform(rng, 0.0, 1.0) * box.size().norm() * corner);
  }
  return list;
}

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

inline void check_finite(const Results& r, const std::vector<Vec3>& points, Faults& faults) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t c = 0; c < r.components; ++c) {
      const double v = r.at(i, c);
      if (c == 0 ? std::isnan(v) : !std::isfinite(v))
        faults.add("not finite",
                   "component " + std::to_string(c) + " is " + std::to_string(v) + " " + text(points[i]));
    }
}

/// Vector and scalar kernels agree.
inline void check_agreement(const Results& simd, const Results& scalar, const std::vector<Vec3>& points,
                            double tolerance, Faults& faults) {
  const std::size_t first[] = {0, 1, 4, 10};
  for (std::size_t order = 0; first[order] < simd.components; ++order)
    for (std::size_t i = 0; i < points.size(); ++i) {
      double scale = 1e-3;
      for (std::size_t c = first[order]; c < first[order + 1]; ++c)
        scale = std::max(scale, std::abs(scalar.at(i, c)));
      for (std::size_t c = first[order]; c < first[order + 1]; ++c) {
        const double a = simd.at(i, c), b = scalar.at(i, c);
        if (a == b) continue;
        if (!(std::abs(a - b) <= tolerance * std::pow(100.0, static_cast<double>(order)) * scale))
          faults.add("simd differs from scalar",
                     "component " + std::to_string(c) + text(a, b) + " " + text(points[i]));
      }
    }
}

/// The same bits one at a time, in another order and in other company.
inline void check_independence(const ScalarField::Model& model, Order order, const Results& together,
                               const std::vector<Vec3>& points, Faults& faults) {
  const std::size_t n = points.size();
  std::vector<Vec3> moved;  // 7 is no multiple of any vector's width
  for (std::size_t i = 0; i < n; ++i) moved.push_back(points[(i + 7) % n]);
  const Results elsewhere = evaluate(model, order, moved);
  for (std::size_t i = 0; i < n; ++i) {
    const Results alone = evaluate(model, order, {points[i]});
    for (std::size_t c = 0; c < together.components; ++c)
      if (!same_bits(alone.at(0, c), together.at(i, c)) ||
          !same_bits(elsewhere.at((i + n - 7 % n) % n, c), together.at(i, c)))
        faults.add("depends on the batch", "component " + std::to_string(c) +
                                               text(alone.at(0, c), together.at(i, c)) + " " +
                                               text(points[i]));
  }
}

/// Values f(-h), f(-h/2), f(0), f(h/2), f(h) and the derivative d that is claimed at 0. Central differences
/// D(h) have the error E(h) = O(h^2), so E(h/2) = |D(h) - D(h/2)| / 3 where f is smooth. The second
/// differences S(h) = f(h) - 2 f(0) + f(-h), over h, halve with h there; at a kink they do not: a kink at 0 <
/// t < h/2 of jump j makes D(h/2) wrong by j (1/2 - t/h), which is below 2 (j t/(2h) + j |1 - 3 t/h|), twice
/// the sum of both disagreements. So that sum bounds the error in either case; `noise` is what rounding of f
/// adds.
struct Difference {
  double estimate, error;
};
inline Difference difference(const double (&f)[5], double h, double noise) {
  const double wide = (f[4] - f[0]) / (2.0 * h), narrow = (f[3] - f[1]) / h;
  const double bend = (f[4] - 2.0 * f[2] + f[0]) / h, narrow_bend = (f[3] - 2.0 * f[2] + f[1]) / (0.5 * h);
  return {narrow, 2.0 * (std::abs(wide - narrow) + std::abs(bend - 2.0 * narrow_bend)) + 40.0 * noise / h};
}

/// Components of d/d(axis) of gradient component c: xx, yy, zz, xy, xz, yz stand at 4 ... 9.
inline std::size_t hessian_component(std::size_t axis, std::size_t c) {
  return axis == c ? 4 + axis : 6 + axis + c;
}

inline void check_differences(const ScalarField::Model& model, const std::vector<Vec3>& points,
                              const EvaluatorSuite& options, Faults& faults) {
  const double length = options.where.size().maxCoeff(), h = 1e-4 * length;
  constexpr double offsets[5] = {-1.0, -0.5, 0.0, 0.5, 1.0};
  std::vector<Vec3> stencil;
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis)
      for (const double o : offsets) stencil.push_back(p + h * o * Vec3::Unit(axis));
  const Results around = evaluate(model, Order::gradient, stencil);
  const Results at = evaluate(model, Order::hessian, points);
  std::size_t useless = 0, all = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double slope = 0.0;
    for (std::size_t c = 1; c < 4; ++c) slope = std::max(slope, std::abs(at.at(i, c)));
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t c = 0; c < 4; ++c) {
        double f[5], size = c == 0 ? 1e-3 : 1e-3 / length;
        for (std::size_t k = 0; k < 5; ++k) {
          f[k] = around.at((i * 3 + axis) * 5 + k, c);
          size = std::max(size, std::abs(f[k]));
        }
        if (c > 0) size = std::max(size, slope);
        const double claimed = c == 0 ? at.at(i, 1 + axis) : at.at(i, hessian_component(axis, c - 1));
        const Difference d = difference(f, h, (c == 0 ? 1e-14 : 1e-13) * size);
        ++all;
        if (!(d.error <= 1e-2 * (size / length + std::abs(d.estimate)))) {
          ++useless;
        } else if (!(std::abs(claimed - d.estimate) <= d.error)) {
          faults.add(c == 0 ? "gradient differs from differences" : "hessian differs from differences",
                     "axis " + std::to_string(axis) + " of component " + std::to_string(c) +
                         text(claimed, d.estimate) + " " + text(points[i]));
        }
      }
  }
  if (static_cast<double>(useless) > options.useless_share * static_cast<double>(all))
    faults.add("differences say nothing",
               std::to_string(useless) + " of " + std::to_string(all) + " have two step sizes that disagree");
}

/// The linear bound holds values: f - value - slope.t lies in its rest, t being the place in the box.
inline void check_linear(const ScalarField::Model& model, const Box& box, const std::vector<Vec3>& points,
                         const Results& values, Faults& faults) {
  const LinearBound bound = model.linear(box);
  const Vec3 c = box.centre(), h = 0.5 * box.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    double line = bound.value;
    for (int k = 0; k < 3; ++k)
      if (h[k] > 0.0) line += bound.slope[k] * ((points[i][k] - c[k]) / h[k]);
    const double v = values.at(i, 0);
    // Four roundings of this sum.
    const double slack =
        std::isinf(v) ? 0.0 : 1e-15 * (std::abs(v) + std::abs(bound.value) + bound.slope.lpNorm<1>());
    if (!Range{bound.rest.lo - slack, bound.rest.hi + slack}.contains(v - line))
      faults.add("linear bound misses a value", std::to_string(v) + " - " + std::to_string(line) + " in" +
                                                    text(bound.rest.lo, bound.rest.hi) + " " +
                                                    text(points[i]) + " in " + text(box));
  }
}

/// Ranges and linear bounds hold values; the shortened model has the same bits.
inline void check_box(const ScalarField::Model& model, const Box& box, const std::vector<Vec3>& points,
                      int depth, Faults& faults) {
  const Range range = model.range(box);
  const Results values = evaluate(model, Order::value, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!range.contains(values.at(i, 0)))
      faults.add("range misses a value", std::to_string(values.at(i, 0)) + " in" + text(range.lo, range.hi) +
                                             " " + text(points[i]) + " in " + text(box));
  check_linear(model, box, points, values, faults);
  const auto within = model.within(box);
  if (!(within.range == range)) faults.add("two ranges", text(within.range.lo, within.range.hi));
  if (!within.model) return;
  for (const Order order : {Order::value, Order::gradient, Order::hessian}) {
    const Results full = evaluate(model, order, points), less = evaluate(*within.model, order, points);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t c = 0; c < full.components; ++c)
        if (full.at(i, c) != less.at(i, c))  // bits, but for the sign of a zero
          faults.add("shortened model differs", "component " + std::to_string(c) +
                                                    text(full.at(i, c), less.at(i, c)) + " " +
                                                    text(points[i]) + " in " + text(box));
  }
  if (depth > 0) check_box(*within.model, box, points, depth - 1, faults);
}

}  // namespace suite

/// Everything that is wrong with the tape; empty: nothing was found.
inline std::vector<std::string> evaluator_faults(const Tape& tape, const EvaluatorSuite& options = {}) {
  Rng rng(options.seed + 0x10000000u);  // not the sequence that the caller drew its field from
  suite::Faults faults;
  std::vector<Vec3> points;
  for (int i = 0; i < bounded(options.points); ++i) points.push_back(suite::point_in(rng, options.where));
  for (const Order order : {Order::value, Order::gradient, Order::hessian}) {
    const suite::Results simd = suite::evaluate(tape, order, points);
    suite::check_finite(simd, points, faults);
    const suite::Results scalar = suite::evaluate(tape, order, points, suite::Kernels::scalar);
    suite::check_finite(scalar, points, faults);
    suite::check_agreement(simd, scalar, points, options.agreement, faults);
    suite::check_independence(tape, order, simd, points, faults);
    const std::vector<Vec3> special = suite::special_points(rng, options.where);
    const suite::Results at_special = suite::evaluate(tape, order, special);
    suite::check_finite(at_special, special, faults);
    suite::check_finite(suite::evaluate(tape, order, special, suite::Kernels::scalar), special, faults);
    suite::check_independence(tape, order, at_special, special, faults);
  }
  if (options.differences) suite::check_differences(tape, points, options, faults);
  for (int b = 0; b < bounded(options.boxes); ++b) {
    Box box = suite::box_in(rng, options.where);
    if (b % 10 == 0) box.hi[b / 10 % 3] = box.lo[b / 10 % 3];  // flat boxes are boxes too
    std::vector<Vec3> inside{box.lo, box.hi, box.centre()};
    for (int i = 0; i < options.samples; ++i) inside.push_back(suite::point_in(rng, box));
    for (const Vec3& p : suite::special_points(rng, options.where))
      if (box.contains(p)) inside.push_back(p);
    suite::check_box(tape, box, inside, 1, faults);
  }
  return faults.list();
}
inline std::vector<std::string> evaluator_faults(const ScalarField& field,
                                                 const EvaluatorSuite& options = {}) {
  return evaluator_faults(dynamic_cast<const Tape&>(field.model()), options);
}

}  // namespace blendwright::test
