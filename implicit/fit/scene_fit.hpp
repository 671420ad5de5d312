#pragma once
// The numbers of a scene that bring its surface closest to points: of a scan, whole or of one side only, or
// of a mesh.
//
//   minimise sum_i rho(r_i^2)                                                            (1)
//   a form:  r = (d(X) - 1) / |grad d(X)|                                                (2)
//   a blend: r = (1/2 - f(X)) / |grad f(X)|, f = sum_k f_k                               (3)
// r: distance to first order, model units, > 0 outside. Ray-linear d have the same gradient along a ray from
// their centre, so that (2) is the distance of X from the tangent plane where its ray meets the surface. The
// length along the ray itself, |X| (1 - 1/d), is not taken: it weighs grazing rays more, and forms came out
// up to 6 % too short of scans of one side. Where no field of a blend reaches, r is that length for the
// nearest member, with d/2. rho(s) = s, or c^2 log(1 + s/c^2) with the robust scale c (model units). Sources:
// Taubin 1991 (2), (3); Gross and Boult 1988 (the length along the ray); Holland and Welsch 1977 (Cauchy's
// rho). Derivatives by automatic differentiation.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "implicit/scene/node_spec.hpp"
#include "kernel/base/progress.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// A number of a scene that may change: a node's value, one component of a list, or the turn of a placement.
struct SceneUnknown {
  std::string node, key;  ///< key "turn": all three angles of a "place" together
  Interval bounds{};      ///< of a number; of each component of a list; not used for "turn"
};

struct SceneFitOptions {
  /// Empty: every number of the nodes below the scene's solid that can be fitted, within the widest bounds.
  std::vector<SceneUnknown> unknowns{};
  std::optional<double> robust_scale{};  ///< model units; nullopt: plain squares
  /// Where to start: the scene as it stands, or its one form laid into the points' box and principal axes, in
  /// all sensible turns. Points of a scan need no first guess then.
  bool start_from_points = false;
  int max_iterations = 200;
};

struct FittedNumber {
  std::string name;                 ///< "form/a", "placed/move/0", "placed/turn"
  double start = 0.0, value = 0.0;  ///< "turn": degrees, start: 0, value: angle to the start
  double deviation = 0.0;  ///< standard deviation, from the residuals and the Jacobian; degrees for "turn"
  bool at_bound = false;
  bool determined = true;  ///< false: the points say next to nothing about it
};

struct SceneFitResult {
  SceneSpec spec;  ///< the scene with its new numbers
  std::vector<FittedNumber> numbers;
  double rms_before = 0.0, rms = 0.0, worst = 0.0;  ///< of r, model units
  Vec3 worst_point = Vec3::Zero();
  std::size_t points = 0, inliers = 0;  ///< |r| <= 3 robust deviations (1.4826 median |r|)
  double condition = 0.0;               ///< of the Jacobian with columns scaled to unit length
  bool converged = false;
  std::vector<double> costs;            ///< of (1) after each iteration, the last run
  std::vector<std::string> not_unique;  ///< sentences
  std::vector<std::string> warnings;    ///< sentences: active bounds, few inliers
};

/// Kinds that can be fitted: lp_metric, superquadric, asymmetric_superellipsoid; ray_scaling of these; place
/// of these; soft_object (with a number w1) and soft_blend of all these; n of ray_scaling may have either
/// sign. Throws InputError (where: "points", "unknowns/0", "nodes/<name>"; all problems at once): no points
/// or fewer than unknowns, points that are not finite, all in a plane (with start_from_points), another kind
/// of node, an unknown that does not exist or is no number, crossed bounds, a robust scale <= 0, nothing to
/// fit; ConvergenceError: no finite residual; Cancelled.
[[nodiscard]] SceneFitResult fit_scene(const SceneSpec& start, std::span<const Vec3> points,
                                       const SceneFitOptions& options = {}, const Progress& progress = {});

}  // namespace blendwright
