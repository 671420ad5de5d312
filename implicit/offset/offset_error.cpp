#include "implicit/offset/offset_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr double reach = 0.9;        // of |distance|: how far roots are looked for
constexpr int steps_each_way = 180;  // of the scan: 1/200 of |distance|

/// phi along a normal.
class Line {
 public:
  Line(const ScalarField& field, const Vec3& from, const Vec3& direction)
      : field_(field), from_(from), direction_(direction) {}
  struct At {
    double phi, slope;
  };
  [[nodiscard]] Vec3 point(double e) const { return from_ + e * direction_; }
  [[nodiscard]] At operator()(double e) const {
    const Vec3 p = point(e);
    const FieldValues f = field_.evaluate(Order::gradient, std::span<const Vec3>(&p, 1));
    return {inside(field_.level(), f.value(0)), sense(field_.level()) * f.gradient(0).dot(direction_)};
  }
  /// phi at e = step * k for k = first ... first + count - 1.
  [[nodiscard]] std::vector<double> scan(double step, int first, int count) const {
    std::vector<Vec3> points;
    for (int k = first; k < first + count; ++k) points.push_back(point(step * k));
    const FieldValues f = field_.evaluate(Order::value, points);
    std::vector<double> phi;
    for (std::size_t i = 0; i < points.size(); ++i) phi.push_back(inside(field_.level(), f.value(i)));
    return phi;
  }

 private:
  const ScalarField& field_;
  Vec3 from_, direction_;
};

/// The root between a and b, where phi has different signs: Newton's method, halving where it leaves the
/// bracket or does not halve it in three steps.
double root_between(const Line& line, double a, double phi_a, double b) {
  double e = 0.5 * (a + b);
  for (int k = 0; k < 200; ++k) {
    const Line::At at = line(e);
    if (at.phi == 0.0) return e;
    ((at.phi > 0.0) == (phi_a > 0.0) ? a : b) = e;
    const double lo = std::min(a, b), hi = std::max(a, b);
    double next = e - at.phi / at.slope;
    if (!(next > lo && next < hi) || k % 4 == 3) {
      // A Newton step that is below the resolution of e is the end, whichever side it falls to.
      if (std::abs(next - e) <= 1e-16 * (std::abs(e) + std::abs(line.point(e).norm()))) return e;
      next = 0.5 * (a + b);
    }
    if (next == e || next == a || next == b) return next;
    e = next;
  }
  return e;
}

/// The root nearest 0 in |e| <= 0.9 |distance|; NaN: there is none. Looks from 0 outward, some steps at a
/// time.
double nearest_root(const Line& line, double distance) {
  constexpr int some = 12;
  static_assert(steps_each_way % some == 0);
  const double step = reach * std::abs(distance) / steps_each_way;
  for (int first = 0; first < steps_each_way; first += some) {
    const std::vector<double> out = line.scan(step, first, some + 1),
                              in = line.scan(step, -first - some, some + 1);
    if (first == 0 && out[0] == 0.0) return 0.0;
    for (int k = 0; k < some; ++k) {
      double best = std::numeric_limits<double>::quiet_NaN();
      for (const int way : {1, -1}) {
        const auto phi = [&](int n) {
          return way > 0 ? out[static_cast<std::size_t>(n)] : in[static_cast<std::size_t>(some - n)];
        };
        const double near = phi(k), far = phi(k + 1);
        if ((near > 0.0) == (far > 0.0) && far != 0.0) continue;
        const double a = way * step * (first + k), b = way * step * (first + k + 1);
        const double e = far == 0.0 ? b : root_between(line, a, near, b);
        if (!(std::abs(best) <= std::abs(e))) best = e;
      }
      if (!std::isnan(best)) return best;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void check(double distance, std::span<const Vec3> surface) {
  if (!std::isfinite(distance) || distance == 0.0)
    throw InputError("distance", "is " + number_text(distance) + ", must be a finite number other than 0");
  if (surface.empty()) throw InputError("points", "is empty, must have at least one point");
  for (std::size_t i = 0; i < surface.size(); ++i)
    if (!surface[i].allFinite())
      throw InputError("points/" + std::to_string(i), "has a coordinate that is not finite");
}

}  // namespace

OffsetError offset_error(const ScalarField& original, const ScalarField& offset, double distance,
                         std::span<const Vec3> surface) {
  check(distance, surface);
  const FieldValues f = original.evaluate(Order::gradient, surface);
  OffsetError error;
  double squares = 0.0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Vec3 g = f.gradient(i);
    const double size = g.stableNorm();
    if (!(size > 0.0)) continue;
    ++error.samples;
    const Vec3 n = (-sense(original.level()) / size) * g;
    const Line line(offset, surface[i] + distance * n, n);
    const double e = nearest_root(line, distance);
    if (std::isnan(e)) {
      ++error.without_root;
      continue;
    }
    squares += e * e;
    if (std::abs(e) > std::abs(error.worst) || error.samples == error.without_root + 1) {
      error.worst = e;
      error.where = line.point(0.0);
    }
  }
  if (error.samples > error.without_root)
    error.rms = std::sqrt(squares / static_cast<double>(error.samples - error.without_root));
  return error;
}

}  // namespace blendwright
