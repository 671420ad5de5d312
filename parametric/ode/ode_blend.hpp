#pragma once
// The blend swept from trimline 0 (u = 0) to trimline 1 (u = 1) by the sweep equation; v runs along both.
//
//   S_x(u, v) = sum_k phi_k(u; b_x, c_x, d_x) B_k,x(v)         one sum per component x, y, z of the frame       (1)
// Modes: origin (as in the paper: pulled towards the coordinate origin), anchor (the equation holds for S - a), chord
// (for S minus the chord C0 + u (C1 - C0); the default: invariant under rigid motion and scaling).
// Boundary values and cross derivatives hold exactly in every mode, frame and for every (b, c, d).
// Source: You et al., Sweeping based controllable surface blending, eqs. (2)-(7); modes: formula sheet 2.4, frames 2.5.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "parametric/cross_tangent/end_condition.hpp"
#include "parametric/ode/cardinal_basis.hpp"

namespace blendwright {

enum class BlendMode { origin, anchor, chord };
enum class BlendFrame { global, fixed, moving };  ///< fixed: columns given; moving: e1 = De/|De|, e3 = blended normal
[[nodiscard]] const char* name(BlendMode m);
[[nodiscard]] const char* name(BlendFrame f);

/// How the blend is generated between its end conditions.
struct BlendShape {
  BlendMode mode = BlendMode::chord;
  Vec3 anchor = Vec3::Zero();                          ///< mode anchor
  std::array<SweepOde, 3> ode{};                       ///< fourth order: per component of the frame
  std::optional<double> repeated_root;                 ///< fourth order: exact q for all components, instead of `ode`
  SixthOrderFamily family = SixthOrderFamily::tension1;  ///< used when a side asks G2
  double tension = 0.0;                                ///< root of the sixth-order family
  BlendFrame frame = BlendFrame::global;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< frame fixed: orthonormal columns
  [[nodiscard]] bool isotropic() const { return repeated_root || (ode[0] == ode[1] && ode[1] == ode[2]); }
};

class OdeBlend {
 public:
  /// Sixth order when either end asks G2; an end that does not gets the second derivative that the fourth-order blend
  /// of the same positions and tangents (cubic in chord mode) has there. Throws GeometryError when the ends' domains
  /// differ, when closed ends do not close to 1e-10 of the size, InputError for a bad shape, ResonanceError.
  OdeBlend(EndCondition end0, EndCondition end1, BlendShape shape);

  [[nodiscard]] SurfaceJet jet(UV p) const;
  [[nodiscard]] SurfacePartials partials(UV p) const;  ///< exact to order 2 in v and 3 in u; higher entries are 0
  [[nodiscard]] SurfaceDomain domain() const;
  [[nodiscard]] const BlendShape& shape() const { return shape_; }
  [[nodiscard]] const EndCondition& end(int side) const { return ends_[static_cast<std::size_t>(side)]; }
  [[nodiscard]] int order() const { return order_; }   ///< 4 or 6
  [[nodiscard]] bool separable() const { return shape_.frame != BlendFrame::moving; }
  [[nodiscard]] const CardinalBasis& basis(int component) const { return bases_[static_cast<std::size_t>(component)]; }

  /// The data of (1) at v after mode and frame are applied: row k holds B_k(v), in frame components; k < order().
  /// Chord mode: the chord is *not* in these rows; add C0 + u (C1 - C0).
  [[nodiscard]] std::array<Vec3, 6> rows(double v) const;

 private:
  std::array<EndCondition, 2> ends_;
  BlendShape shape_;
  int order_ = 4;
  std::vector<CardinalBasis> bases_;
};

/// Positions on a grid: out[(i * nv + j) * 3 + x] for u[i], v[j]; the small matrix product that a separable blend is.
/// SIMD with run-time dispatch, streaming stores, all cores; the same bytes on any number of threads.
/// `out` has u.size() * v.size() * 3 values. Works for moving frames too, more slowly.
void evaluate_grid(const OdeBlend& blend, std::span<const double> u, std::span<const double> v, std::span<double> out);

}  // namespace blendwright
