#pragma once
// A primary as a rolling ball sees it: the point that the ball touches, and how its normal turns when the
// centre moves.
//
// Solids are given by fields, or by a surface and the side that is outside. n: unit normal, out of the solid.
//   W = dn/dp on the tangent plane (shape operator; principal curvatures kappa, a ball of radius R: +1/R) (1)
//   implicit, phi >= 0 inside, g = grad phi, H its Hessian:  n = -g/|g|,  W = -(I - n n^T) H (I - n n^T)/|g|
//   parametric:  n = +-Su x Sv/|Su x Sv|,  W by the Weingarten equations (2) foot p of c, implicit: p - c + l
//   g = 0, phi = 0;  parametric: (S - c).Su = (S - c).Sv = 0              (3) d = (c - p).n,  grad d = n,
//   dn/dc = W (I + d W)^-1,  a minimum of |c - p| where 1 + d kappa > 0       (4)
#include <Eigen/Core>
#include <concepts>
#include <optional>
#include <utility>
#include <variant>

#include "kernel/field/scalar_field.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// The foot of a ball's centre on one primary, to second order.
struct BallFoot {
  Vec3 point = Vec3::Zero();
  UV at{};                      ///< of a surface; unrolled in closed directions, so that it is continuous
  Vec3 normal = Vec3::UnitZ();  ///< n
  double distance = 0.0;        ///< d, model units; negative where the centre is in the solid
  Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();  ///< W of (1), 0 along n
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();  ///< dn/dc of (4), 0 along n; 0 where `room` is not > 0
  double room = 1.0;   ///< smaller one of 1 + d kappa: the foot is a minimum where it is > 0
  bool inside = true;  ///< of the domain of a surface
};

class BallPrimary {
 public:
  explicit BallPrimary(ScalarField solid) : shape_(std::move(solid)) {}
  /// Outside is where Su x Sv points, or the other side.
  template <std::same_as<Surface> S>
  explicit BallPrimary(S surface, bool reversed = false) : shape_(std::move(surface)), reversed_(reversed) {}

  /// Newton on (3) from a point near the foot. A surface is followed beyond its domain where its formula is.
  /// nullopt: no foot was reached, or no normal exists there.
  [[nodiscard]] std::optional<BallFoot> foot(const Vec3& c, const Vec3& near_point, UV near_at) const;
  [[nodiscard]] std::optional<BallFoot> foot(const Vec3& c, const BallFoot& near) const {
    return foot(c, near.point, near.at);
  }
  /// The nearest foot on a surface, by search; of a field the one that a descent from c reaches.
  [[nodiscard]] std::optional<BallFoot> foot(const Vec3& c) const;

  [[nodiscard]] const ScalarField* field() const { return std::get_if<ScalarField>(&shape_); }
  [[nodiscard]] const Surface* surface() const { return std::get_if<Surface>(&shape_); }
  [[nodiscard]] bool reversed() const { return reversed_; }

 private:
  std::variant<ScalarField, Surface> shape_;
  bool reversed_ = false;
};

/// A point of the field's surface reached from `start` along gradients; nullopt when none is.
[[nodiscard]] std::optional<Vec3> descended(const ScalarField& field, const Vec3& start);

}  // namespace blendwright
