#pragma once
// Jets of a surface on a grid, made once and shared by the checks.
#include <vector>

#include "verify/continuity/seam.hpp"
#include "verify/surface/surface_checks.hpp"

namespace blendwright::detail {

class JetGrid {
 public:
  /// nu x nv cells (at least 2 each).
  JetGrid(const Surface& surface, int nu, int nv);

  [[nodiscard]] int nu() const { return nu_; }  ///< cells
  [[nodiscard]] int nv() const { return nv_; }
  [[nodiscard]] UV uv(int i, int j) const {
    return {u_[static_cast<std::size_t>(i)], v_[static_cast<std::size_t>(j)]};
  }
  [[nodiscard]] const SurfaceJet& jet(int i, int j) const {
    return jets_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nu_ + 1) +
                 static_cast<std::size_t>(i)];
  }
  [[nodiscard]] double size() const { return size_; }       ///< diagonal of the samples' box
  [[nodiscard]] double mean_area() const { return area_; }  ///< mean |Su| times mean |Sv|
  [[nodiscard]] const SurfaceDomain& domain() const { return domain_; }

 private:
  SurfaceDomain domain_;
  int nu_, nv_;
  std::vector<double> u_, v_;
  std::vector<SurfaceJet> jets_;
  double size_ = 0.0, area_ = 0.0;
};

[[nodiscard]] FoldReport fold(const Surface& blend, const JetGrid& grid);
[[nodiscard]] Extreme minimum_radius(const Surface& blend, const JetGrid& grid);
/// Takes every `stride`-th sample in both directions. `seam` has a primary; its pcurve, when given, saves
/// searching.
[[nodiscard]] PenetrationReport penetration(const Surface& blend, const JetGrid& grid, int stride,
                                            const Seam& seam);
[[nodiscard]] SelfIntersectionReport self_intersection(const JetGrid& grid);

}  // namespace blendwright::detail
