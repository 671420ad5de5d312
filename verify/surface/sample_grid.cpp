#include "verify/surface/sample_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/curvature.hpp"

namespace blendwright::detail {
namespace {

// Ends exact, interior places shifted by up to an eighth of a step by the golden-ratio sequence.
std::vector<double> uneven_places(Interval range, int cells) {
  std::vector<double> at(static_cast<std::size_t>(cells) + 1);
  for (int i = 0; i <= cells; ++i) {
    const double golden = i * 0.6180339887498949;
    const double shift = i == 0 || i == cells ? 0.0 : 0.25 * (golden - std::floor(golden) - 0.5);
    at[static_cast<std::size_t>(i)] = range.at((i + shift) / cells);
  }
  at.back() = range.hi;
  return at;
}

SampleGrid::Sample sample_of(const SurfaceJet& jet) {
  const Vec3 n = jet.Su.cross(jet.Sv);
  const double area = n.norm();
  return {jet.S, area == 0.0 ? n : Vec3(n / area), area, jet.Su.norm(), jet.Sv.norm(), bend(jet)};
}

}  // namespace

double bend(const SurfaceJet& jet) {
  if (!(jet.Su + jet.Sv + jet.Suu + jet.Suv + jet.Svv).allFinite())
    return std::numeric_limits<double>::quiet_NaN();
  if (unit_normal(jet).isZero(0.0)) return -1.0;
  const SurfaceCurvature k = curvature(jet);
  return std::max(std::abs(k.k_min), std::abs(k.k_max));
}

SampleGrid::SampleGrid(const Surface& surface, int nu, int nv)
    : domain_(surface.domain()),
      nu_(std::max(nu, 2)),
      nv_(std::max(nv, 2)),
      u_(uneven_places(domain_.u, nu_)),
      v_(uneven_places(domain_.v, nv_)),
      samples_(u_.size() * v_.size()) {
  // v is the outer loop: a surface swept along v has its data there at hand for the whole column.
  parallel_for(v_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for (std::size_t i = 0; i < u_.size(); ++i)
        samples_[j * u_.size() + i] = sample_of(surface.jet({u_[i], v_[j]}));
  });
  Eigen::AlignedBox3d box;
  double speed_u = 0.0, speed_v = 0.0;
  for (const Sample& sample : samples_) {
    box.extend(sample.S);
    speed_u += sample.speed_u;
    speed_v += sample.speed_v;
  }
  const auto count = static_cast<double>(samples_.size());
  size_ = box.diagonal().norm();
  area_ = (speed_u / count) * (speed_v / count);
}

}  // namespace blendwright::detail
