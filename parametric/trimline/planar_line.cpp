#include "parametric/trimline/planar_line.hpp"

#include <algorithm>
#include <cmath>

#include "parametric/trimline/line_point.hpp"

namespace blendwright {
namespace {

constexpr int first_segments = 512;
constexpr double most_turn = 0.3;     // radians, by which a segment's tangent may turn
constexpr double most_stretch = 4.0;  // longest segment over the mean
constexpr int deepest = 12;           // a corner never becomes flat

double angle(const Vec2& a, const Vec2& b) {
  return std::abs(std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b)));
}

double turn_between(const PlanarLine::Sample& a, const PlanarLine::Sample& b) {
  const Vec2 chord = b.c - a.c;
  return angle(a.c1, chord) + angle(chord, b.c1);
}

}  // namespace

Vec2 mean_scale(const Trimline& line) {
  constexpr int places = 8;
  Vec2 sum(0.0, 0.0);
  for (int i = 0; i < places; ++i) {
    const Vec2 p = line.pcurve().point(line.domain().v.at((i + 0.5) / places));
    const SurfaceJet s = line.primary().jet({p[0], p[1]});
    sum += Vec2(s.Su.norm(), s.Sv.norm()) / places;
  }
  return {sum[0] > 0.0 ? sum[0] : 1.0, sum[1] > 0.0 ? sum[1] : 1.0};
}

PlanarLine::PlanarLine(const Trimline& line, const Vec2& scale)
    : pcurve_(line.pcurve()), domain_(line.domain()), scale_(scale), period_(0.0, 0.0) {
  const SurfaceDomain box = line.primary().domain();
  if (box.u_closed) period_[0] = scale[0] * box.u.length();
  if (box.v_closed) period_[1] = scale[1] * box.v.length();
  std::vector<Sample> first;
  double length = 0.0;
  for (int i = 0; i <= first_segments; ++i) {
    const CurveJet<2> p = pcurve_.jet(domain_.v.at(static_cast<double>(i) / first_segments));
    first.push_back({domain_.v.at(static_cast<double>(i) / first_segments), scale.cwiseProduct(p.C()),
                     scale.cwiseProduct(p.C1()), 0.0});
    if (i > 0) length += (first.back().c - first[first.size() - 2].c).norm();
  }
  if (domain_.closed) {
    const Vec2 step = first.back().c - first.front().c;
    const auto whole = [](double x, double period) {
      return period > 0.0 ? static_cast<int>(std::lround(x / period)) : 0;
    };
    advance_ = {whole(step[0], period_[0]), whole(step[1], period_[1])};
  }
  samples_.push_back(first.front());
  for (std::size_t i = 1; i < first.size(); ++i)
    subdivide(first[i - 1], first[i], most_stretch * length / first_segments, deepest);
}

void PlanarLine::subdivide(const Sample& a, const Sample& b, double longest, int depth) {
  const double turn = turn_between(a, b);
  if (depth > 0 && (turn > most_turn || (b.c - a.c).norm() > longest)) {
    const Sample middle = at(0.5 * (a.v + b.v));
    subdivide(a, middle, longest, depth - 1);
    subdivide(middle, b, longest, depth - 1);
    return;
  }
  Sample end = b;
  end.turned = samples_.back().turned + turn;
  samples_.push_back(end);
}

double PlanarLine::deviation(std::size_t i) const {
  const Sample &a = samples_[i], &b = samples_[i + 1];
  // An arc that turns by theta leaves its chord by theta/8 of its length; 4 times that for uneven bends.
  return 0.5 * (b.turned - a.turned) * (b.c - a.c).norm();
}

PlanarLine::Sample PlanarLine::at(double v) const {
  const Wrapped w = wrapped(domain_, v);
  const CurveJet<2> p = pcurve_.jet(w.inside);
  return {v, scale_.cwiseProduct(p.C()) + w.turns * shift(advance_), scale_.cwiseProduct(p.C1()), 0.0};
}

}  // namespace blendwright
