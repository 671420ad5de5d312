#include "kernel/brep/cut_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright::detail {
namespace {

constexpr int samples = 768;  // per cut; only topology is decided on them

struct Direction {
  Interval range;
  bool closed;
};
std::array<Direction, 2> directions(const SurfaceDomain& d) {
  return {{{d.u, d.u_closed}, {d.v, d.v_closed}}};
}

/// Position in periods from the seam: an integer on the seam.
double turns(const RegionCut& cut, int d, const Direction& dir, double v) {
  return (cut.at(v)[d] - dir.range.lo) / dir.range.length();
}

/// Parameters strictly inside the cut where it crosses a seam.
std::vector<double> crossings(const RegionBox& box, const RegionCut& cut) {
  std::vector<double> found;
  for (int d = 0; d < 2; ++d) {
    const Direction dir = directions(box.box)[static_cast<std::size_t>(d)];
    if (!dir.closed) continue;
    const double fuzz = 1e-10;
    double previous = turns(cut, d, dir, cut.v.lo), previous_v = cut.v.lo;
    for (int i = 1; i <= samples; ++i) {
      const double v = cut.v.at(static_cast<double>(i) / samples), now = turns(cut, d, dir, v);
      const double lo = std::min(previous, now), hi = std::max(previous, now);
      for (double k = std::ceil(lo + fuzz); k < hi - fuzz; k += 1.0) {
        double a = previous_v, b = v;
        const bool up = now > previous;
        for (int step = 0; step < 80 && b - a > 0.0; ++step) {
          const double m = 0.5 * (a + b);
          if (m <= a || m >= b) break;
          ((turns(cut, d, dir, m) < k) == up ? a : b) = m;
        }
        found.push_back(0.5 * (a + b));
      }
      // A sample that hits the seam is a crossing when the line goes on to the other side.
      if (i < samples && std::abs(now - std::round(now)) <= fuzz) {
        const double after = turns(cut, d, dir, cut.v.at(static_cast<double>(i + 1) / samples));
        if ((previous - now) * (after - now) < 0.0) found.push_back(v);
      }
      previous = now;
      previous_v = v;
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end(),
                          [&](double a, double b) { return b - a <= 1e-10 * cut.v.length(); }),
              found.end());
  return found;
}

/// Moves a point that is nearly on the border onto it; true when it is.
bool snap(Vec2& p, const RegionBox& box) {
  bool on = false;
  for (int d = 0; d < 2; ++d) {
    const Direction dir = directions(box.box)[static_cast<std::size_t>(d)];
    const double slack = std::max(box.slack / std::max(box.scale[d], 1e-300), 1e-9 * dir.range.length());
    for (const double border : {dir.range.lo, dir.range.hi})
      if (std::abs(p[d] - border) <= std::min(slack, 0.01 * dir.range.length())) {
        p[d] = border;
        on = true;
      }
  }
  return on;
}

}  // namespace

std::vector<CutPiece> cut_pieces(const RegionBox& box, const std::vector<RegionCut>& cuts) {
  std::vector<CutPiece> pieces;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const RegionCut& cut = cuts[c];
    std::vector<double> at = crossings(box, cut);
    at.insert(at.begin(), cut.v.lo);
    at.push_back(cut.v.hi);
    const Vec2 span = cut.at(cut.v.hi) - cut.at(cut.v.lo);
    const bool loop = span.cwiseProduct(box.scale).norm() <= box.slack;
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      CutPiece p{c, {at[i], at[i + 1]}, Vec2::Zero(), {}, false, false};
      for (int d = 0; d < 2; ++d) {
        const Direction dir = directions(box.box)[static_cast<std::size_t>(d)];
        if (dir.closed) p.shift[d] = -dir.range.length() * std::floor(turns(cut, d, dir, p.v.middle()));
      }
      for (int k = 0; k <= samples; ++k)
        p.points.push_back(cut.at(p.v.at(static_cast<double>(k) / samples)) + p.shift);
      // The start of a loop lies on the border only when the loop is split there, which is when it crosses.
      Vec2 first = p.points.front(), last = p.points.back();
      const bool first_on = snap(first, box), last_on = snap(last, box);
      p.lo_on_border = first_on && !(loop && i == 0);
      p.hi_on_border = last_on && !(loop && i + 2 == at.size());
      if (p.lo_on_border) p.points.front() = first;
      if (p.hi_on_border) p.points.back() = last;
      pieces.push_back(std::move(p));
    }
  }
  return pieces;
}

std::array<std::vector<double>, 2> seam_candidates(const SurfaceDomain& box,
                                                   const std::vector<RegionCut>& cuts) {
  std::array<std::vector<double>, 2> result;
  for (int d = 0; d < 2; ++d) {
    const Direction dir = directions(box)[static_cast<std::size_t>(d)];
    std::vector<double>& out = result[static_cast<std::size_t>(d)];
    out.push_back(dir.range.lo);
    if (!dir.closed) continue;
    const double period = dir.range.length();
    constexpr int cells = 720;
    std::vector<char> taken(cells, 0);
    for (const RegionCut& cut : cuts) {
      if (std::abs(cut.at(cut.v.hi)[d] - cut.at(cut.v.lo)[d]) > 0.5 * period)
        out.push_back(cut.at(cut.v.lo)[d]);
      double previous = turns(cut, d, dir, cut.v.lo);
      for (int i = 1; i <= samples; ++i) {
        const double now = turns(cut, d, dir, cut.v.at(static_cast<double>(i) / samples));
        const auto a = static_cast<int>(std::floor(std::min(previous, now) * cells));
        const auto b = static_cast<int>(std::floor(std::max(previous, now) * cells));
        for (int k = a; k <= b; ++k) taken[static_cast<std::size_t>(((k % cells) + cells) % cells)] = 1;
        previous = now;
      }
    }
    const auto start = std::find(taken.begin(), taken.end(), 1) - taken.begin();
    for (int i = 0, run = 0; start < cells && i <= cells; ++i) {
      const bool free = i < cells && !taken[static_cast<std::size_t>((start + i) % cells)];
      if (free) ++run;
      if (free || run == 0) continue;
      const double middle = (static_cast<double>(start + i) - 0.5 * run) / cells;
      out.push_back(dir.range.lo + period * (middle - std::floor(middle)));
      run = 0;
    }
  }
  return result;
}

}  // namespace blendwright::detail
