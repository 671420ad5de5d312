#pragma once
// The blend swept from trimline 0 (u = 0) to trimline 1 (u = 1) by the sweep equation; v runs along both.
//
//   S_x(u, v) = sum_k phi_k(u; b_x, c_x, d_x) B_k,x(v)         one sum per component x, y, z of the frame (1)
// Modes: origin (as in the paper: pulled towards the coordinate origin), anchor (the equation holds for S -
// a), chord (for S minus the chord C0 + u (C1 - C0); the default: invariant under rigid motion and scaling).
// Boundary values and cross derivatives hold exactly in every mode, frame and for every (b, c, d).
// Source: You et al., Sweeping based controllable surface blending, eqs. (2)-(7); modes: formula sheet 2.4,
// frames 2.5.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "parametric/cross_tangent/end_condition.hpp"
#include "parametric/ode/cardinal_basis.hpp"
#include "parametric/ode/cardinal_ends.hpp"

namespace blendwright {

enum class BlendMode { origin, anchor, chord };
/// fixed: columns given. moving: e1 = De/|De|, e3 = the sum of the unit normals T_i x C_i' made normal to e1
/// (the normals Su x Sv of the blend at its ends), e2 = e3 x e1; De = C1 - C0.
enum class BlendFrame { global, fixed, moving };
[[nodiscard]] const char* name(BlendMode m);
[[nodiscard]] const char* name(BlendFrame f);

/// How the blend is generated between its end conditions.
struct BlendShape {
  BlendMode mode = BlendMode::chord;
  Vec3 anchor = Vec3::Zero();             ///< mode anchor
  std::array<SweepOde, 3> ode{};          ///< fourth order: per component of the frame
  std::optional<double> repeated_root{};  ///< fourth order: exact q for all components, instead of `ode`
  SixthOrderFamily family = SixthOrderFamily::tension1;  ///< used when a side asks G2
  double tension = 0.0;                                  ///< root of the sixth-order family
  BlendFrame frame = BlendFrame::global;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< frame fixed: orthonormal columns
  [[nodiscard]] bool isotropic() const { return repeated_root || (ode[0] == ode[1] && ode[1] == ode[2]); }
};

/// The blend at one v: S(u) = (1 - u) line0 + u line1 + axes diag(phi_k(u)) B_k summed over k < order.
struct BlendSection {
  std::array<Vec3, 6> B;  ///< rows of (1) after mode and frame are applied, in frame components
  Vec3 line0, line1;      ///< chord mode: C0 and C1; anchor mode: both the anchor; origin mode: 0
  Eigen::Matrix3d axes;   ///< columns of the frame at this v
};

class OdeBlend {
 public:
  /// Sixth order when either end asks G2; an end that does not gets the second derivative that the tension
  /// spline (cubic when tension = 0) of the same positions and tangents has there. The blend is closed in v
  /// when both ends are. Throws GeometryError when the ends' domains differ, when closed ends do not close to
  /// 1e-10 of the size, or when a moving frame is undefined (De = 0, or opposite normals), InputError for a
  /// bad shape, ResonanceError.
  OdeBlend(EndCondition end0, EndCondition end1, BlendShape shape);

  [[nodiscard]] SurfaceJet jet(UV p) const;
  [[nodiscard]] SurfacePartials partials(
      UV p) const;  ///< exact to order 2 in v and 3 in u; higher entries are 0
  [[nodiscard]] SurfaceDomain domain() const;
  /// Along the ends u = 0 and u = 1 only, where the boundary data are met exactly: S = C, Su = T and, of
  /// sixth order, Suu = D; Suu of the fourth order from the data at both ends and the proven phi_k'' there.
  void enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const;
  [[nodiscard]] const BlendShape& shape() const { return shape_; }
  [[nodiscard]] const EndCondition& end(int side) const { return ends_[static_cast<std::size_t>(side)]; }
  [[nodiscard]] int order() const { return order_; }  ///< 4 or 6
  [[nodiscard]] bool separable() const { return shape_.frame != BlendFrame::moving; }
  [[nodiscard]] const CardinalBasis& basis(int component) const {
    return bases_[static_cast<std::size_t>(component)];
  }

  /// The data of (1) at v after mode and frame are applied: row k holds B_k(v), in frame components; k <
  /// order(). Chord mode: the chord is *not* in these rows; add C0 + u (C1 - C0).
  [[nodiscard]] std::array<Vec3, 6> rows(double v) const { return section(v).B; }
  [[nodiscard]] BlendSection section(double v) const;
  /// phi[x]: the cardinal functions of component x at u (one evaluation when the parameters agree).
  [[nodiscard]] std::array<CardinalValues, 3> cardinals(double u) const;

 private:
  struct RowSeries;
  [[nodiscard]] RowSeries row_series(double v) const;
  [[nodiscard]] std::array<Series3, 3> frame(const EndSeries& e0, const EndSeries& e1) const;
  /// d^j S / du^j for j = 0..3, as series along v.
  [[nodiscard]] std::array<Series3, 4> u_derivatives(UV p) const;
  /// The frame at a piece of v, columns.
  [[nodiscard]] std::array<ModelVector, 3> frame(const EndEnclosure& e0, const EndEnclosure& e1) const;
  /// Suu of the fourth order at an end.
  [[nodiscard]] ModelVector bend(std::size_t side, const EndEnclosure& e0, const EndEnclosure& e1) const;
  /// What (1) makes of data that go into a fixed frame and out again: its axes are orthonormal to 1e-9 only.
  void turn(const EndEnclosure& e0, const EndEnclosure& e1, SurfaceEnclosure& out) const;
  void check_ends() const;

  std::array<EndCondition, 2> ends_;
  BlendShape shape_;
  int order_ = 4;
  std::vector<CardinalBasis> bases_;
  std::array<std::array<double, 4>, 2>
      completion_{};                 // D at end i from (C0, T0, C1, T1) when i does not ask G2
  std::array<EndBends, 3> bends_{};  // fourth order: phi_k'' of component x at the ends
};

/// Positions on a grid: out[(i * nv + j) * 3 + x] for u[i], v[j]; the small matrix product that a separable
/// blend is. SIMD with run-time dispatch, streaming stores, all cores; the same bytes on any number of
/// threads. `out` has u.size() * v.size() * 3 values, else InputError. Works for moving frames too, more
/// slowly.
void evaluate_grid(const OdeBlend& blend, std::span<const double> u, std::span<const double> v,
                   std::span<double> out);

}  // namespace blendwright
