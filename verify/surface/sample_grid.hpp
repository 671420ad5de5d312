#pragma once
// What the checks need of a surface on a grid: measured once, from one jet per sample, and shared.
#include <vector>

#include "verify/continuity/seam.hpp"
#include "verify/surface/surface_checks.hpp"

namespace blendwright::detail {

/// Largest |principal curvature| of a jet; -1 where it is finite but has no normal, NaN where it is not
/// finite.
[[nodiscard]] double bend(const SurfaceJet& jet);

class SampleGrid {
 public:
  /// nu x nv cells (at least 2 each).
  SampleGrid(const Surface& surface, int nu, int nv);

  [[nodiscard]] int nu() const { return nu_; }  ///< cells
  [[nodiscard]] int nv() const { return nv_; }
  [[nodiscard]] UV uv(int i, int j) const {
    return {u_[static_cast<std::size_t>(i)], v_[static_cast<std::size_t>(j)]};
  }
  struct Sample {
    Vec3 S;
    Vec3 n;                               ///< unit normal; zero where |Su x Sv| = 0
    double area = 0.0;                    ///< |Su x Sv|
    double speed_u = 0.0, speed_v = 0.0;  ///< |Su|, |Sv|
    double bend = 0.0;                    ///< see above
  };
  [[nodiscard]] const Sample& at(int i, int j) const {
    return samples_[static_cast<std::size_t>(j) * u_.size() + static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const Vec3& point(int i, int j) const { return at(i, j).S; }
  [[nodiscard]] double size() const { return size_; }       ///< diagonal of the samples' box
  [[nodiscard]] double mean_area() const { return area_; }  ///< mean |Su| times mean |Sv|
  [[nodiscard]] const SurfaceDomain& domain() const { return domain_; }

 private:
  SurfaceDomain domain_;
  int nu_, nv_;
  std::vector<double> u_, v_;
  std::vector<Sample> samples_;
  double size_ = 0.0, area_ = 0.0;
};

[[nodiscard]] FoldReport fold(const Surface& blend, const SampleGrid& grid);
[[nodiscard]] Extreme minimum_radius(const Surface& blend, const SampleGrid& grid);
/// Takes every `stride`-th sample in both directions. `seam` has a primary; its pcurve, when given, saves
/// searching.
[[nodiscard]] PenetrationReport penetration(const Surface& blend, const SampleGrid& grid, int stride,
                                            const Seam& seam);
[[nodiscard]] SelfIntersectionReport self_intersection(const SampleGrid& grid);

}  // namespace blendwright::detail
