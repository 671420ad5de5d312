// Does the blend cross a primary?
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/curvature.hpp"
#include "kernel/geometry/project.hpp"
#include "verify/surface/compass_search.hpp"
#include "verify/surface/sample_grid.hpp"

namespace blendwright {
namespace detail {
namespace {

constexpr double no_foot = std::numeric_limits<double>::infinity();

struct SignedFoot {
  UV at;
  double height =
      no_foot;  ///< signed by the primary's normal; `no_foot` where the closest point does not count
};

SignedFoot signed_foot(const Surface& primary, const Vec3& q, std::optional<UV> guess) {
  const Foot foot = guess ? closest_point(primary, q, *guess) : closest_point(primary, q);
  const Vec3 n = unit_normal(primary.jet(foot.at));
  if (!std::isfinite(foot.distance)) return {foot.at, std::numeric_limits<double>::quiet_NaN()};
  const bool counts = foot.interior && !n.isZero(0.0);
  return {foot.at, counts ? std::copysign(foot.distance, (q - foot.point).dot(n)) : no_foot};
}

// Heights of the blend's samples above a primary. Row 0 is the joint, the last row the far end.
class Heights {
 public:
  Heights(const SampleGrid& grid, int stride, const Seam& seam) {
    for (int j = 0; j <= grid.nv(); j += stride) columns_.push_back(j);
    for (int i = 0; i <= grid.nu(); i += stride) rows_.push_back(seam.side == 0 ? i : grid.nu() - i);
    feet_.resize(rows_.size() * columns_.size());
    // Up each column from the joint, where the foot is the sample itself: a foot followed from there stays on
    // the sheet that the blend starts from. The first of a chunk is searched globally, the others start
    // beside it.
    parallel_for(columns_.size(), 8, [&](std::size_t begin, std::size_t end) {
      std::optional<UV> base;
      for (std::size_t c = begin; c < end; ++c) {
        if (seam.pcurve) {
          const Vec2 line = seam.pcurve->point(grid.uv(0, columns_[c]).v);
          base = UV{line.x(), line.y()};
        }
        std::optional<UV> guess = base;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
          foot(r, c) = signed_foot(*seam.primary, grid.point(rows_[r], columns_[c]), guess);
          guess = foot(r, c).at;
          if (r == 0) base = guess;
        }
      }
    });
  }

  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] std::size_t columns() const { return columns_.size(); }
  [[nodiscard]] const SignedFoot& foot(std::size_t r, std::size_t c) const {
    return feet_[r * columns_.size() + c];
  }
  [[nodiscard]] UV uv(const SampleGrid& grid, std::size_t r, std::size_t c) const {
    return grid.uv(rows_[r], columns_[c]);
  }

  /// +1 or -1: the side of the farthest row that leaves the surface; 0: no row does; empty: that row is on
  /// both sides.
  [[nodiscard]] std::optional<int> outside(double tolerance) const {
    for (std::size_t r = rows_.size(); r-- > 0;) {
      bool above = false, below = false;
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        const double h = foot(r, c).height;
        above |= h != no_foot && h > tolerance;
        below |= h < -tolerance;
      }
      if (above && below) return std::nullopt;
      if (above || below) return above ? 1 : -1;
    }
    return 0;
  }

 private:
  [[nodiscard]] SignedFoot& foot(std::size_t r, std::size_t c) { return feet_[r * columns_.size() + c]; }

  std::vector<int> rows_, columns_;  ///< indices of the grid
  std::vector<SignedFoot> feet_;
};

}  // namespace

PenetrationReport penetration(const Surface& blend, const SampleGrid& grid, int stride, const Seam& seam) {
  for (int j = 0; j <= grid.nv(); ++j)
    for (int i = 0; i <= grid.nu(); ++i)
      if (!grid.point(i, j).allFinite())
        return {true, {std::numeric_limits<double>::quiet_NaN(), grid.uv(i, j), grid.point(i, j)}};

  const Heights heights(grid, stride, seam);
  // Far ends that lie on the primary itself (two trimlines on one surface) do not tell the side.
  const std::optional<int> outside = heights.outside(1e-5 * grid.size());
  if (!outside) return {false, {}};

  PenetrationReport report;
  UV foot_at;
  for (std::size_t r = 0; r < heights.rows(); ++r)
    for (std::size_t c = 0; c < heights.columns(); ++c) {
      const SignedFoot& foot = heights.foot(r, c);
      if (std::isnan(foot.height)) return {true, {foot.height, heights.uv(grid, r, c), Vec3::Zero()}};
      if (foot.height == no_foot || !(-*outside * foot.height > report.depth.value)) continue;
      report.depth = {-*outside * foot.height, heights.uv(grid, r, c), Vec3::Zero()};
      foot_at = foot.at;
    }
  if (report.depth.value == 0.0) return report;
  const auto depth_at = [&](UV at) {
    const SignedFoot foot = signed_foot(*seam.primary, blend.point(at), foot_at);
    return foot.height == no_foot ? -no_foot : -*outside * foot.height;
  };
  const SurfaceDomain& domain = grid.domain();
  const PeakUV deepest = compass_maximum(depth_at, domain, {report.depth.at, report.depth.value},
                                         0.5 * stride * domain.u.length() / grid.nu(),
                                         0.5 * stride * domain.v.length() / grid.nv());
  report.depth = {deepest.value, deepest.at, blend.point(deepest.at)};
  return report;
}

}  // namespace detail

PenetrationReport check_penetration(const Surface& blend, int primary_side, const Surface& primary, int nu,
                                    int nv) {
  const Seam seam{{}, blend, primary_side, primary, std::nullopt, true};
  return detail::penetration(blend, detail::SampleGrid(blend, nu, nv), 1, seam);
}

}  // namespace blendwright
