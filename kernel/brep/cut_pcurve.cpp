#include "kernel/brep/cut_pcurve.hpp"

#include <Geom2d_BSplineCurve.hxx>
#include <algorithm>

#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/parameter_curves.hpp"
#include "kernel/brep/surface_kinks.hpp"
#include "kernel/geometry/spline_interpolation.hpp"

namespace blendwright::detail {
namespace {

using Points = std::function<Vec2(double)>;

class Gap {
 public:
  Gap(const Interval& range, const std::vector<double>& breaks, const opencascade::handle<Geom_Curve>& edge,
      const opencascade::handle<Geom_Surface>& surface)
      : surface_(surface) {
    std::vector<double> at{range.lo};
    for (const double b : breaks)
      if (b > range.lo && b < range.hi) at.push_back(b);
    at.push_back(range.hi);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      for (const double t : {0.0, 0.211, 0.5, 0.789}) samples_.push_back(at[i] + t * (at[i + 1] - at[i]));
    samples_.push_back(range.hi);
    for (const double v : samples_) edge_.push_back(edge->Value(v));
  }
  [[nodiscard]] double operator()(const Points& p) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Vec2 uv = p(samples_[i]);
      worst = std::max(worst, edge_[i].Distance(surface_->Value(uv.x(), uv.y())));
    }
    return worst;
  }

 private:
  opencascade::handle<Geom_Surface> surface_;
  std::vector<double> samples_;
  std::vector<gp_Pnt> edge_;
};

/// Quintic spline through the cut at the breaks; at its ends, which may be corners of the cut, derivatives
/// are the limits from inside.
BSplineCurve<2> quintic(const std::function<CurveJet<2>(double)>& cut, const std::vector<double>& breaks) {
  const BSplineBasis basis = BSplineBasis::clamped(5, breaks);
  Eigen::MatrixXd values(static_cast<Eigen::Index>(breaks.size()), 2), start(2, 2), end(2, 2);
  for (std::size_t i = 0; i < breaks.size(); ++i)
    values.row(static_cast<Eigen::Index>(i)) = cut(breaks[i]).C().transpose();
  const double inside = 1e-9 * (breaks.back() - breaks.front());
  const CurveJet<2> a = cut(breaks.front() + inside), b = cut(breaks.back() - inside);
  start << a.C1().transpose(), a.C2().transpose();
  end << b.C1().transpose(), b.C2().transpose();
  const Eigen::MatrixXd control = complete_control(basis, values, start, end);
  std::vector<Vec2> points;
  for (Eigen::Index i = 0; i < control.rows(); ++i) points.push_back(control.row(i).transpose());
  return {basis, std::move(points)};
}

/// Every stride-th of the breaks inside the range (stride >= 1), or each span cut in -stride parts.
std::vector<double> thinned(const Interval& range, const std::vector<double>& breaks, int stride) {
  std::vector<double> all{range.lo};
  const double least = 1e-7 * range.length();
  for (const double b : breaks)
    if (b > all.back() + least && b < range.hi - least) all.push_back(b);
  all.push_back(range.hi);
  std::vector<double> result;
  const auto n = static_cast<int>(all.size()) - 1;
  if (stride > 0) {
    const int count = std::max(1, n / stride);
    for (int i = 0; i <= count; ++i) result.push_back(all[static_cast<std::size_t>(i * n / count)]);
    return result;
  }
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < -stride; ++k) {
      const double a = all[static_cast<std::size_t>(i)], b = all[static_cast<std::size_t>(i) + 1];
      result.push_back(a + (b - a) * k / -stride);
    }
  result.push_back(range.hi);
  return result;
}

}  // namespace

CutPcurve cut_pcurve(const std::function<CurveJet<2>(double)>& cut, const Interval& range,
                     const std::vector<double>& breaks, const opencascade::handle<Geom_Curve>& edge,
                     const opencascade::handle<Geom_Surface>& surface, double slack,
                     const std::vector<double>& own_corners) {
  const Gap gap(range, breaks, edge, surface);
  const double own = gap([&](double v) { return cut(v).C(); });
  const Vec2 a = cut(range.lo).C(), b = cut(range.hi).C();
  const BSplineCurve<2> line(BSplineBasis::clamped(1, {range.lo, range.hi}), {a, b});
  std::optional<BSplineCurve<2>> best(line);
  double best_gap = gap([&](double v) { return line.jet(v).C(); });
  if (best_gap > own + 1e-3 * slack) {  // a line that is only nearly one is worth a spline
    std::vector<double> corners = surface_kinks(
        surface, [&](double v) { return cut(v).C(); }, range);
    corners.insert(corners.end(), own_corners.begin(), own_corners.end());
    const double least = 1e-6 * range.length();
    std::erase_if(corners, [&](double v) { return v < range.lo + least || v > range.hi - least; });
    corners.insert(corners.end(), {range.lo, range.hi});
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end(),
                              [&](double lower, double upper) { return upper - lower < least; }),
                  corners.end());
    for (const int stride : {8, 4, 2, 1, -2, -4, -8}) {
      std::vector<BSplineCurve<2>> pieces;
      for (std::size_t i = 0; i + 1 < corners.size(); ++i)
        pieces.push_back(quintic(cut, thinned({corners[i], corners[i + 1]}, breaks, stride)));
      const BSplineCurve<2> next = joined(pieces, false);
      const double next_gap = gap([&](double v) { return next.jet(v).C(); });
      if (next_gap < best_gap) {
        best = next;
        best_gap = next_gap;
      }
      if (best_gap <= own + slack) break;
    }
  }
  return {to_occt(*best), best_gap};
}

}  // namespace blendwright::detail
