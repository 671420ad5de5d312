#include "kernel/geometry/enclosure.hpp"

namespace blendwright {

void fill(SurfaceEnclosure& out, const std::array<ModelJet, 3>& s) {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::array<TaylorModel, 6>& c = s[d].c;
    out.S[d] = c[0];
    out.Su[d] = c[1];
    out.Sv[d] = c[2];
    out.Suu[d] = 2.0 * c[3];
    out.Suv[d] = c[4];
    out.Svv[d] = 2.0 * c[5];
  }
}

ModelVector velocity(const SurfaceEnclosure& s, const CurveEnclosure& uv) {
  return uv.D[1][0] * s.Su + uv.D[1][1] * s.Sv;
}

ModelVector acceleration(const SurfaceEnclosure& s, const CurveEnclosure& uv) {
  const TaylorModel &u1 = uv.D[1][0], &v1 = uv.D[1][1];
  return (u1 * u1) * s.Suu + (2.0 * (u1 * v1)) * s.Suv + (v1 * v1) * s.Svv + uv.D[2][0] * s.Su +
         uv.D[2][1] * s.Sv;
}

ModelVector turned(const Eigen::Matrix3d& R, const ModelVector& x) {
  ModelVector r;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    r[i] = R(row, 0) * x[0] + R(row, 1) * x[1] + R(row, 2) * x[2];
  }
  return r;
}

}  // namespace blendwright
