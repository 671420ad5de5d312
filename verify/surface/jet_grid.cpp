#include "verify/surface/jet_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/base/parallel_for.hpp"

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

}  // namespace

JetGrid::JetGrid(const Surface& surface, int nu, int nv)
    : domain_(surface.domain()),
      nu_(std::max(nu, 2)),
      nv_(std::max(nv, 2)),
      u_(uneven_places(domain_.u, nu_)),
      v_(uneven_places(domain_.v, nv_)),
      jets_(u_.size() * v_.size()) {
  // v is the outer loop: a surface swept along v has its data there at hand for the whole column.
  parallel_for(v_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for (std::size_t i = 0; i < u_.size(); ++i) jets_[j * u_.size() + i] = surface.jet({u_[i], v_[j]});
  });
  Eigen::AlignedBox3d box;
  double speed_u = 0.0, speed_v = 0.0;
  for (const SurfaceJet& jet : jets_) {
    box.extend(jet.S);
    speed_u += jet.Su.norm();
    speed_v += jet.Sv.norm();
  }
  const auto count = static_cast<double>(jets_.size());
  size_ = box.diagonal().norm();
  area_ = (speed_u / count) * (speed_v / count);
}

}  // namespace blendwright::detail
