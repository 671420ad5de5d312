#include "implicit/offset/ball_proof.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace blendwright::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// slope t - l (q + h t)^2 for t in [lo, hi], -1 <= lo, hi <= 1: the largest value.
struct Parabola {
  double slope, l, q, h;
  [[nodiscard]] double at(double t) const { return slope * t - l * (q + h * t) * (q + h * t); }
  [[nodiscard]] double largest(double lo, double hi) const {
    if (!(lo <= hi)) return -infinity;
    double best = std::max(at(lo), at(hi));
    const double bend = l * h * h;
    if (bend > 0.0) {
      const double t = (0.5 * slope - l * q * h) / bend;
      if (t > lo && t < hi) best = std::max(best, at(t));
    }
    return best;
  }
};

}  // namespace

/// (2) of ball_search.hpp over a box: a sum of parabolas, one per axis.
struct BallProof::Lagrangian {
  Box box;
  Vec3 centre, half;
  Parabola axis[3];
  double rest;   ///< what is to be added, with rounding
  double plain;  ///< the upper end of f itself
  [[nodiscard]] double upper() const {
    return std::min(plain, rest + axis[0].largest(-1, 1) + axis[1].largest(-1, 1) + axis[2].largest(-1, 1));
  }
  /// The same without the inside of the cube peak +- h.
  [[nodiscard]] double upper_outside(const Vec3& peak, double h) const {
    double full[3], cut[3];
    for (int i = 0; i < 3; ++i) {
      const double below = (peak[i] - h - centre[i]) / half[i], above = (peak[i] + h - centre[i]) / half[i];
      full[i] = axis[i].largest(-1.0, 1.0);
      cut[i] =
          std::max(axis[i].largest(-1.0, std::min(1.0, below)), axis[i].largest(std::max(-1.0, above), 1.0));
    }
    const double one =
        std::max({cut[0] + full[1] + full[2], full[0] + cut[1] + full[2], full[0] + full[1] + cut[2]});
    return std::min(plain, rest + one);
  }
};

struct BallProof::Cell {
  Box box;
  double upper;
  bool operator<(const Cell& other) const { return upper < other.upper; }
};

BallProof::Lagrangian BallProof::bound(const Box& box, double l) {
  ++bounds_;
  LinearBound f = field_.linear(box);
  if (sign_ < 0.0) f = -1.0 * f;
  Lagrangian b;
  b.box = box;
  b.centre = box.centre();
  b.half = 0.5 * box.size();
  b.plain = f.range().hi;
  const Vec3 q = b.centre - ball_.centre;
  for (int i = 0; i < 3; ++i) b.axis[i] = {f.slope[i], l, q[i], b.half[i]};
  const double size = std::abs(f.value) + f.slope.lpNorm<1>() + 8.0 * l * ball_.radius * ball_.radius;
  b.rest = f.value + f.rest.hi + l * ball_.radius * ball_.radius + 1e-15 * size;
  // Turned into a ball, the linear part grows by its length at most.
  if (const Vec3 g = f.slope.cwiseQuotient(b.half); g.allFinite())
    b.plain = std::min(
        b.plain, f.value - g.dot(q) + g.norm() * ball_.radius * (1.0 + 1e-14) + f.rest.hi + 1e-15 * size);
  if (std::isnan(b.rest)) b.rest = infinity;
  return b;
}

BallProof::Cell BallProof::cell(const Box& box, double l) {
  const Vec3 nearest = ball_.centre.cwiseMax(box.lo).cwiseMin(box.hi) - ball_.centre;
  if (nearest.norm() > ball_.radius * (1.0 + 1e-14)) return {box, -infinity};
  return {box, bound(box, l).upper()};
}

Vec3 BallProof::into_ball(const Vec3& p) const {
  const Vec3 w = p - ball_.centre;
  const double size = w.norm();
  return size > ball_.radius ? Vec3(ball_.centre + (ball_.radius / size) * w) : p;
}

BallProof::Result BallProof::run(const Vec3& peak, double l, double limit) {
  Box box = ball_.box;
  double passed = -infinity;
  for (double h = ball_.radius;; h *= 0.5) {
    if (bounds_ >= most_bounds_) return {Result::Kind::undecided, Vec3::Zero(), infinity};
    const Lagrangian b = bound(box, l);
    const double upper = b.upper();
    if (upper <= limit) return {Result::Kind::proven, Vec3::Zero(), std::max(passed, upper)};
    const auto inner = common({peak.array() - h, peak.array() + h}, box);
    const double outside = inner ? b.upper_outside(peak, h) : infinity;
    if (!(outside <= limit) || !inner || h < 1e-9 * ball_.radius) {
      // What lies around the inner cube in six boxes, and the cube.
      std::vector<Cell> cells;
      Box left = box;
      if (inner)
        for (int i = 0; i < 3; ++i) {
          Box below = left, above = left;
          below.hi[i] = left.lo[i] = inner->lo[i];
          above.lo[i] = left.hi[i] = inner->hi[i];
          if (below.hi[i] > below.lo[i]) cells.push_back(cell(below, l));
          if (above.hi[i] > above.lo[i]) cells.push_back(cell(above, l));
        }
      if (!inner || h < 1e-9 * ball_.radius) {
        cells.push_back(cell(left, l));
        return branch(std::move(cells), l, limit, passed);
      }
      const Result around = branch(std::move(cells), l, limit, passed);
      if (around.kind != Result::Kind::proven) return around;
      passed = around.upper;
    } else {
      passed = std::max(passed, outside);
    }
    box = *inner;
  }
}

BallProof::Result BallProof::branch(std::vector<Cell> cells, double l, double limit, double passed) {
  std::make_heap(cells.begin(), cells.end());
  while (!cells.empty()) {
    std::pop_heap(cells.begin(), cells.end());
    const Cell worst = cells.back();
    cells.pop_back();
    if (worst.upper <= limit) return {Result::Kind::proven, Vec3::Zero(), std::max(passed, worst.upper)};
    if (bounds_ >= most_bounds_)
      return {Result::Kind::undecided, Vec3::Zero(), std::max(passed, worst.upper)};
    const Vec3 sample = into_ball(worst.box.centre());
    if (ball_.box.contains(sample) && sign_ * jet_at(field_, Order::value, sample).value > limit)
      return {Result::Kind::better, sample, worst.upper};
    int longest = 0;
    worst.box.size().maxCoeff(&longest);
    const double middle = worst.box.centre()[longest];
    Box below = worst.box, above = worst.box;
    below.hi[longest] = above.lo[longest] = middle;
    for (const Box& half : {below, above}) {
      cells.push_back(cell(half, l));
      std::push_heap(cells.begin(), cells.end());
    }
  }
  return {Result::Kind::proven, Vec3::Zero(), passed};
}

}  // namespace blendwright::detail
