#pragma once
// The models of the field benchmarks: as scenes, and as the plain loops that a careful user would write for
// the same formulas. All lie in the box [-16, 16]^3.
//   blend         a prismatic bar (exponent 1) on a plate, soft blend
//   vir06, vir2   the same with a contour of exponent 0.6 or 2 for the bar's influence
//   ring          six cylinders of radius 2.5 and half length 7 end to end along the sides of a hexagon of
//                 circumradius 12, scale union r1 = r2 = 0.5, p = 0
//   sixball       a sphere of radius 15, ray-scaled by a cube-like object of exponent 7, power 3
//   soft<N>       soft sum of N random ellipsoids
//   bumps<N>      an ellipsoid with N perturbations, bumps and dents, of power 3
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "implicit/scene/scene.hpp"

namespace blendwright::bench {

/// Fills out with the field's values at the points, one after the other.
using PlainLoop =
    std::function<void(const double* x, const double* y, const double* z, std::size_t count, double* out)>;

struct FieldModel {
  std::string name;
  SceneSpec scene;
  PlainLoop plain;
};

inline const Box model_box{Vec3::Constant(-16.0), Vec3::Constant(16.0)};

/// "blend", "vir06", "vir2", "ring", "sixball", or "soft" or "bumps" with a number.
[[nodiscard]] FieldModel field_model(const std::string& name);

/// A member of soft<N>: local coordinates are the rows of `axes` times (x - centre).
struct Ellipsoid {
  Vec3 centre, radii;    ///< radii of influence
  Eigen::Matrix3d axes;  ///< rows: the unit axes
};
/// From splitmix64 with seed N, numbers in [0, 1) being its top 53 bits, for each member in this order: three
/// for the centre, even in the box [-10, 10]^3; three for the radii, cbrt(100 / N) * [2, 6); three (u, v, w)
/// for the orientation, the unit quaternion (sqrt(1-u) sin 2 pi v, sqrt(1-u) cos 2 pi v, sqrt(u) sin 2 pi w,
/// sqrt(u) cos 2 pi w) in the order x, y, z, w (Shoemake 1992).
[[nodiscard]] std::vector<Ellipsoid> random_ellipsoids(std::size_t count);

/// f = Q(x) + sum w_i max(q_i(x), 0)^3 with quadrics A11 A22 A33 A12 A13 A23 A14 A24 A34 A44; inside: f >= 0.
struct Freeform {
  struct Bump {
    std::array<double, 10> q;
    double weight;
  };
  std::array<double, 10> base;
  std::vector<Bump> bumps;
};
/// Around the origin: an ellipsoid of semi-axes size * (10, 9, 8) and ellipsoids of semi-axes size * [2, 5)
/// centred on its surface, turned at random; weights in [0.2, 0.8), every third negative.
[[nodiscard]] Freeform random_freeform(std::size_t bumps, double size, std::uint64_t seed);
/// Its nodes; the last one, called `name`, is the solid.
[[nodiscard]] std::vector<NodeSpec> freeform_nodes(const Freeform& freeform, const std::string& name);

}  // namespace blendwright::bench
