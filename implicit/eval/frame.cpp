#include <array>

#include "implicit/eval/op.hpp"
#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

/// Encloses { x * m + t : x in box }, with what rounding can add.
Box image(const Box& box, const Eigen::Matrix3d& m, const Vec3& t) {
  const Vec3 c = box.centre(), h = 0.5 * box.size();
  const Vec3 centre = m.transpose() * c + t;
  const Vec3 reach = m.cwiseAbs().transpose() * h;
  const Vec3 slack = 8.0 * std::numeric_limits<double>::epsilon() *
                     (m.cwiseAbs().transpose() * (c.cwiseAbs() + h) + t.cwiseAbs());
  return {centre - reach - slack, centre + reach + slack};
}

}  // namespace

Frame::Frame(const Eigen::Matrix3d& m, const Vec3& t) : matrix(m), offset(t) {
  if (!m.allFinite() || !t.allFinite()) throw InputError("matrix", "has a number that is not finite");
  const double size = m.row(0).norm() * m.row(1).norm() * m.row(2).norm();
  if (!(std::abs(m.determinant()) >= 1e-12 * size) || size == 0.0)
    throw InputError("matrix", "is singular, must have a determinant of at least 1e-12 of its rows' lengths");
  identity = m == Eigen::Matrix3d::Identity() && t == Vec3::Zero();
}

Box Frame::local(const Box& x) const { return identity ? x : image(x, matrix, offset); }

Box Frame::scene(const Box& y) const {
  if (identity) return y;
  const Eigen::Matrix3d inverse = matrix.inverse();
  return image(y, inverse, -(inverse.transpose() * offset));
}

Frame Frame::after(const Frame& outer) const {
  if (identity) return outer;
  if (outer.identity) return *this;
  Frame f;
  f.matrix = outer.matrix * matrix;
  f.offset = matrix.transpose() * outer.offset + offset;
  f.identity = false;
  return f;
}

Frame Frame::scaled(const Vec3& factors) const {
  Frame f;
  f.matrix = matrix * factors.asDiagonal();
  f.offset = offset.cwiseProduct(factors);
  f.identity = identity && factors == Vec3::Ones();
  return f;
}

}  // namespace blendwright
