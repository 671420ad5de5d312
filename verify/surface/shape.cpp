// Folds, degenerate places and the smallest radius.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/geometry/curvature.hpp"
#include "verify/surface/compass_search.hpp"
#include "verify/surface/sample_grid.hpp"

namespace blendwright {
namespace detail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double right_angle = 0.5 * std::numbers::pi;

double turn(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

UV between(UV a, UV b) { return {0.5 * (a.u + b.u), 0.5 * (a.v + b.v)}; }

// Narrows the turn down to a thousandth of the distance: a tight but smooth bend then turns by less than 90
// deg.
bool folds_between(const Surface& blend, UV a, Vec3 na, UV b, Vec3 nb) {
  for (int step = 0; step < 10; ++step) {
    const UV middle = between(a, b);
    const Vec3 n = unit_normal(blend.jet(middle));
    if (n.isZero(0.0)) return true;
    const bool first = turn(na, n) >= turn(n, nb);
    (first ? b : a) = middle;
    (first ? nb : na) = n;
    if (na.dot(nb) >= 0.0) return false;
  }
  return true;
}

class FoldSearch {
 public:
  FoldSearch(const Surface& blend, const SampleGrid& grid) : blend_(blend), grid_(grid) {
    report_.smallest_area.value = std::numeric_limits<double>::infinity();
    for (int j = 0; j <= grid.nv(); ++j)
      for (int i = 0; i <= grid.nu(); ++i) normals_.push_back(normal_of(grid.at(i, j)));
    for (int j = 0; j <= grid.nv(); ++j)
      for (int i = 0; i <= grid.nu(); ++i) {
        if (i > 0 && i < grid.nu()) add_area(i, j);
        if (i < grid.nu()) add_turn(i, j, i + 1, j);
        if (j < grid.nv()) add_turn(i, j, i, j + 1);
      }
  }
  [[nodiscard]] FoldReport report() const { return report_; }

 private:
  // Rounding leaves a direction where there is no normal, so the area decides.
  [[nodiscard]] Vec3 normal_of(const SampleGrid::Sample& sample) const {
    return sample.area <= 1e-9 * grid_.mean_area() ? Vec3(Vec3::Zero()) : sample.n;
  }
  [[nodiscard]] const Vec3& normal(int i, int j) const {
    return normals_[static_cast<std::size_t>(j) * static_cast<std::size_t>(grid_.nu() + 1) +
                    static_cast<std::size_t>(i)];
  }
  void add_area(int i, int j) {
    // 0/0 where nothing moves at all is as degenerate as can be, not unknown.
    const double area = grid_.mean_area() == 0.0 ? 0.0 : grid_.at(i, j).area / grid_.mean_area();
    const bool worse =
        area < report_.smallest_area.value || (std::isnan(area) && !std::isnan(report_.smallest_area.value));
    if (worse) report_.smallest_area = {area, grid_.uv(i, j), grid_.point(i, j)};
  }
  void add_turn(int i, int j, int k, int l) {
    const Vec3 &a = normal(i, j), &b = normal(k, l);
    if (a.isZero(0.0) || b.isZero(0.0)) return;
    // Most neighbours turn little; the angle is needed only for the sharpest.
    const double cosine = a.dot(b);
    if (cosine < sharpest_) {
      sharpest_ = cosine;
      report_.where = {turn(a, b), between(grid_.uv(i, j), grid_.uv(k, l)), grid_.point(i, j)};
    }
    if (cosine < 0.0 && folds_between(blend_, grid_.uv(i, j), a, grid_.uv(k, l), b)) ++report_.folded;
  }

  const Surface& blend_;
  const SampleGrid& grid_;
  std::vector<Vec3> normals_;
  FoldReport report_;
  double sharpest_ = 1.0;
};

}  // namespace

FoldReport fold(const Surface& blend, const SampleGrid& grid) { return FoldSearch(blend, grid).report(); }

Extreme minimum_radius(const Surface& blend, const SampleGrid& grid) {
  PeakUV sharpest{{}, -1.0};
  for (int j = 0; j <= grid.nv(); ++j)
    for (int i = 0; i <= grid.nu(); ++i) {
      const double k = grid.at(i, j).bend;
      if (std::isnan(k)) return {k, grid.uv(i, j), grid.point(i, j)};
      if (k > sharpest.value) sharpest = {grid.uv(i, j), k};
    }
  if (sharpest.value < 0.0) return {nan, grid.uv(0, 0), grid.point(0, 0)};
  const SurfaceDomain& domain = grid.domain();
  sharpest = compass_maximum([&](UV at) { return bend(blend.jet(at)); }, domain, sharpest,
                             0.5 * domain.u.length() / grid.nu(), 0.5 * domain.v.length() / grid.nv());
  return {1.0 / sharpest.value, sharpest.at, blend.point(sharpest.at)};
}

}  // namespace detail

FoldReport check_fold(const Surface& blend, int nu, int nv) {
  return detail::fold(blend, detail::SampleGrid(blend, nu, nv));
}

Extreme minimum_radius(const Surface& blend, int nu, int nv) {
  return detail::minimum_radius(blend, detail::SampleGrid(blend, nu, nv));
}

}  // namespace blendwright
