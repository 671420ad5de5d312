#include "parametric/trimline/crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "parametric/trimline/planar_line.hpp"

namespace blendwright {
namespace {

constexpr double newton_tolerance = 1e-9;  // of the lines' size
constexpr double smallest_loop = 1e-5;     // of the lines' size
constexpr double at_end = 1e-6;            // of the range
/// A loop turns by at least pi; less by the part that samples may miss.
constexpr double least_turning = 0.9 * std::numbers::pi;

/// A segment of a line, moved by whole periods into the primary's first period.
struct Copy {
  std::uint64_t cell;
  std::uint32_t line, segment;
  Turns moved;
};

class CrossingSearch {
 public:
  /// Two lines against each other, or one against itself. They must outlive the search.
  CrossingSearch(const PlanarLine& line0, const PlanarLine& line1) : lines_{&line0, &line1} {
    Vec2 lo = line0.samples()[0].c, hi = lo;
    for (const PlanarLine* line : lines_)
      for (std::size_t i = 0; i <= line->segments(); ++i) {
        lo = lo.cwiseMin(line->samples()[i].c);
        hi = hi.cwiseMax(line->samples()[i].c);
        if (i < line->segments())
          cell_ = std::max(cell_, (line->samples()[i + 1].c - line->samples()[i].c).norm());
      }
    origin_ = lo;
    size_ = (hi - lo).norm();
    cell_ = std::max(cell_, 1e-3 * size_);
  }

  [[nodiscard]] std::optional<std::array<double, 2>> first() const {
    if (!(size_ > 0.0)) return std::nullopt;
    const std::vector<Copy> copies = sorted_copies();
    for (std::size_t begin = 0, end = 0; begin < copies.size(); begin = end) {
      while (end < copies.size() && copies[end].cell == copies[begin].cell) ++end;
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t k = i + 1; k < end; ++k)
          if (const auto found = of_pair(copies[i], copies[k])) return found;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool alone() const { return lines_[0] == lines_[1]; }
  [[nodiscard]] const PlanarLine& line0() const { return *lines_[0]; }
  [[nodiscard]] const PlanarLine& line1() const { return *lines_[1]; }

  [[nodiscard]] std::vector<Copy> sorted_copies() const {
    std::vector<Copy> copies;
    for (std::uint32_t l = 0; l < (alone() ? 1u : 2u); ++l)
      for (std::uint32_t s = 0; s < lines_[l]->segments(); ++s) add_copies(l, s, copies);
    std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) {
      if (a.cell != b.cell) return a.cell < b.cell;
      if (a.line != b.line) return a.line < b.line;
      return a.segment < b.segment;
    });
    return copies;
  }

  /// In the first period, and once more beyond each border that it is near to.
  void add_copies(std::uint32_t l, std::uint32_t s, std::vector<Copy>& copies) const {
    const PlanarLine& line = *lines_[l];
    const Vec2 a = line.samples()[s].c, b = line.samples()[s + 1].c;
    const double margin = (b - a).norm() + line.deviation(s);
    std::array<std::array<int, 3>, 2> moves{};
    std::array<std::size_t, 2> count{1, 1};
    for (std::size_t d = 0; d < 2; ++d) {
      const auto x = static_cast<Eigen::Index>(d);
      const double period = line.period()[x];
      if (!(period > 0.0)) continue;
      const double from = 0.5 * (a[x] + b[x]) - origin_[x], home = std::floor(from / period);
      moves[d][0] = -static_cast<int>(home);
      if (from - home * period < margin + cell_) moves[d][count[d]++] = moves[d][0] + 1;
      if (from - home * period > period - margin - cell_) moves[d][count[d]++] = moves[d][0] - 1;
    }
    for (std::size_t i = 0; i < count[0]; ++i)
      for (std::size_t k = 0; k < count[1]; ++k) {
        const Turns moved{moves[0][i], moves[1][k]};
        const Vec2 shift = line.shift(moved) - origin_;
        const double reach = line.deviation(s) + newton_tolerance * size_;
        const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
        const Vec2 low = a.cwiseMin(b) + shift, high = a.cwiseMax(b) + shift;
        for (std::int64_t x = index(low[0] - reach); x <= index(high[0] + reach); ++x)
          for (std::int64_t y = index(low[1] - reach); y <= index(high[1] + reach); ++y)
            copies.push_back(
                {(static_cast<std::uint64_t>(x) << 32) ^ static_cast<std::uint32_t>(y), l, s, moved});
      }
  }

  [[nodiscard]] std::optional<std::array<double, 2>> of_pair(const Copy& i, const Copy& k) const {
    if (alone() ? i.segment == k.segment : i.line == k.line) return std::nullopt;
    const Turns by{k.moved.u - i.moved.u, k.moved.v - i.moved.v};  // c(v0) = c(v1) + by
    if (alone() && neighbours(i.segment, k.segment, by)) return std::nullopt;
    const PlanarLine &a = line0(), &b = line1();
    const auto middle = [](const PlanarLine& line, std::size_t s) {
      return 0.5 * (line.samples()[s].v + line.samples()[s + 1].v);
    };
    const double reach = a.deviation(i.segment) + b.deviation(k.segment) + newton_tolerance * size_;
    if (distance(i.segment, k.segment, a.shift(by)) > reach) return std::nullopt;
    return refined(middle(a, i.segment), middle(b, k.segment), by);
  }

  /// The line between the two segments (on a closed line: on either way that leads from one to the other)
  /// turns too little to come back.
  [[nodiscard]] bool neighbours(std::size_t i, std::size_t k, Turns by) const {
    const PlanarLine& line = line0();
    const auto& s = line.samples();
    if (by == Turns{} && s[k + 1].turned - s[i].turned < least_turning) return true;
    const Turns n = line.advance();
    return line.domain().closed && by == Turns{-n.u, -n.v} &&
           line.total_turning() - s[k].turned + s[i + 1].turned < least_turning;
  }

  [[nodiscard]] double distance(std::size_t i, std::size_t k, const Vec2& shift) const {
    const Vec2 a = line0().samples()[i].c, b = line0().samples()[i + 1].c;
    const Vec2 c = line1().samples()[k].c + shift, d = line1().samples()[k + 1].c + shift;
    const auto side = [](const Vec2& p, const Vec2& q, const Vec2& x) {
      return (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]);
    };
    if (side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0) return 0.0;
    const auto to_segment = [](const Vec2& x, const Vec2& p, const Vec2& q) {
      const Vec2 e = q - p;
      const double ee = e.squaredNorm();
      const double t = ee > 0.0 ? std::clamp((x - p).dot(e) / ee, 0.0, 1.0) : 0.0;
      return (x - p - t * e).norm();
    };
    return std::min({to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
  }

  /// Newton on (1) by the shortest step, which also settles where the lines run along each other.
  [[nodiscard]] std::optional<std::array<double, 2>> refined(double v0, double v1, Turns by) const {
    const PlanarLine &first = line0(), &second = line1();
    const Vec2 shift = first.shift(by);
    const auto held = [](const PlanarLine& line, double v) {
      return line.domain().closed ? v : line.domain().v.clamp(v);
    };
    double gap = std::numeric_limits<double>::infinity();
    bool settled = false;
    for (int step = 0; step < 60 && !settled; ++step) {
      const PlanarLine::Sample a = first.at(v0), b = second.at(v1);
      const Vec2 F = a.c - b.c - shift;
      // One more step after the tolerance is met takes a simple crossing to rounding.
      settled = gap <= newton_tolerance * size_;
      gap = F.norm();
      Eigen::Matrix2d J;
      J << a.c1[0], -b.c1[0], a.c1[1], -b.c1[1];
      Eigen::Matrix2d M = J * J.transpose();
      const double damping = 1e-8 * M.trace();
      if (!(damping > 0.0)) return std::nullopt;
      M(0, 0) += damping, M(1, 1) += damping;
      const double det = M(0, 0) * M(1, 1) - M(0, 1) * M(1, 0);
      const Vec2 w((M(1, 1) * F[0] - M(0, 1) * F[1]) / det, (M(0, 0) * F[1] - M(1, 0) * F[0]) / det);
      const Vec2 move = J.transpose() * w;
      v0 = held(first, v0 - move[0]);
      v1 = held(second, v1 - move[1]);
    }
    const double last = (first.at(v0).c - second.at(v1).c - shift).norm();
    if (!(last <= newton_tolerance * size_) || is_end(first, v0, second, v1)) return std::nullopt;
    if (alone() && is_trivial(v0, v1, by)) return std::nullopt;
    return std::array{v0, v1};
  }

  [[nodiscard]] bool is_end(const PlanarLine& line0, double v0, const PlanarLine& line1, double v1) const {
    const auto end = [](const PlanarLine& line, double v) {
      const Interval& range = line.domain().v;
      return !line.domain().closed && std::min(v - range.lo, range.hi - v) <= at_end * range.length();
    };
    return end(line0, v0) && end(line1, v1);
  }

  /// v0 and v1 are one place of the line: the way between them does not leave it.
  [[nodiscard]] bool is_trivial(double v0, double v1, Turns by) const {
    const PlanarLine& line = line0();
    const Turns n = line.advance();
    const auto stays = [&](double from, double to) {
      const Vec2 c = line.at(from).c;
      return std::max((line.at(from + 0.5 * (to - from)).c - c).norm(),
                      (line.at(from + 0.3 * (to - from)).c - c).norm()) <= smallest_loop * size_;
    };
    if (by == Turns{} && stays(v0, v1)) return true;
    if (!line.domain().closed) return false;
    const double length = line.domain().v.length();
    return (by == Turns{-n.u, -n.v} && stays(v0, v1 - length)) ||
           (by == Turns{n.u, n.v} && stays(v0, v1 + length));
  }

  std::array<const PlanarLine*, 2> lines_;
  Vec2 origin_;
  double size_ = 0.0, cell_ = 0.0;
};

/// One parameter only grows or only falls, over no more than its period: such a line cannot come back.
bool runs_one_way(const PlanarLine& line) {
  const auto& s = line.samples();
  for (Eigen::Index d = 0; d < 2; ++d) {
    const double step = s.back().c[d] - s.front().c[d], period = line.period()[d];
    if (step == 0.0 || (period > 0.0 && std::abs(step) > period * (1.0 + 1e-9))) continue;
    if (std::all_of(s.begin(), s.end(), [&](const auto& p) { return p.c1[d] * step > 0.0; })) return true;
  }
  return false;
}

Crossing placed(const Trimline& line, double v0, double v1) { return {v0, v1, line.jet(v0).C()}; }

double within(const Trimline& line, double v) {
  const CurveDomain domain = line.domain();
  if (!domain.closed) return v;
  const double length = domain.v.length();
  return domain.v.clamp(v - std::floor((v - domain.v.lo) / length) * length);
}

}  // namespace

std::optional<Crossing> self_crossing(const Trimline& line) {
  const PlanarLine planar(line, mean_scale(line));
  if (runs_one_way(planar)) return std::nullopt;
  const auto found = CrossingSearch(planar, planar).first();
  if (!found) return std::nullopt;
  const double a = within(line, (*found)[0]), b = within(line, (*found)[1]);
  return placed(line, std::min(a, b), std::max(a, b));
}

std::optional<Crossing> crossing(const Trimline& line0, const Trimline& line1) {
  const Vec2 scale = mean_scale(line0);
  const PlanarLine planar0(line0, scale), planar1(line1, scale);
  const auto found = CrossingSearch(planar0, planar1).first();
  if (!found) return std::nullopt;
  return placed(line0, within(line0, (*found)[0]), within(line1, (*found)[1]));
}

}  // namespace blendwright
