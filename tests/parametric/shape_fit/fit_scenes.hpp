#pragma once
// Blends that the tests of fits share.
#include "parametric/blend.hpp"
#include "parametric/shape_fit/shape_fit.hpp"
#include "tests/parametric/sample_lines.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

struct FitScene {
  Trimline line0, line1;
  BlendSpec spec;
};

inline constexpr double scene_tolerance = 1e-6;

/// A branch on the main pipe at a right angle: the branch's radius, and how far the lines stand away from the
/// edge where the pipes meet.
inline FitScene perpendicular_cylinders(Continuity continuity = Continuity::G2) {
  const Surface branch = cylinder(0.5, 0.0, 4.0);
  const Surface main = cylinder(1.2, -3.0, 3.0, RigidMotion::from_axis({0, 0, 0}, {0, 1, 0}, {0, 0, 1}));
  BlendSpec spec;
  spec.sides[0].continuity = spec.sides[1].continuity = continuity;
  // The circle of the branch at height 1.8, and what a circle of radius 1 above casts on the main pipe.
  const Curve3 ring = curve<3>(
      [](const auto& v) {
        return std::array{cos(v), sin(v), 2.0 + 0.0 * v};
      },
      {0.0, 2.0 * pi}, true);
  return {isoline(branch, IsoDirection::constant_u, 1.8), projected(main, ring, -Vec3::UnitZ()), spec};
}

/// Two coaxial pipes of different radius.
inline FitScene coaxial_cylinders(Continuity continuity = Continuity::G1) {
  BlendSpec spec;
  spec.sides[0].continuity = spec.sides[1].continuity = continuity;
  return {isoline(cylinder(1.0, 0.0, 4.0), IsoDirection::constant_u, 2.0),
          isoline(cylinder(2.0, -4.0, 1.0), IsoDirection::constant_u, 0.0), spec};
}

/// A wavy line on a torus and an ellipse on a free surface above it: nothing is symmetric.
inline FitScene free_surfaces(Continuity continuity = Continuity::G1) {
  BlendSpec spec;
  spec.sides[0].continuity = spec.sides[1].continuity = continuity;
  return {Trimline(torus(3.0, 1.0), curve<2>(
                                        [](const auto& v) {
                                          return std::array{1.4 + 0.2 * sin(2.0 * v), v + 0.1 * cos(v)};
                                        },
                                        {0.0, 2.0 * pi}, true)),
          Trimline(formula({"u", "v", "3 + 0.1*u^2 - 0.05*u*v + 0.2*sin(v)"}, {-3.0, 3.0}, {-3.0, 3.0}),
                   ellipse(1.5, 1.2, 0.1, 0.2)),
          spec};
}

/// Open lines: a curved panel and a plane beside it.
inline FitScene open_panel(Continuity continuity = Continuity::G1) {
  BlendSpec spec;
  spec.sides[0].continuity = spec.sides[1].continuity = continuity;
  const Surface panel = formula({"u", "v", "0.2*v^2 + 0.1*u*v - 0.15*u^2"}, {-2.0, 2.0}, {-1.0, 1.0});
  const Surface wall = formula({"1.5 + 0.1*v^2", "v", "u"}, {0.0, 3.0}, {-1.0, 1.0});
  return {isoline(panel, IsoDirection::constant_u, 0.4), isoline(wall, IsoDirection::constant_u, 1.3), spec};
}

inline Blend made(const FitScene& scene, const BlendSpec& spec) {
  return make_blend(scene.line0, scene.line1, spec, scene_tolerance);
}
inline ShapeFitResult fit(const FitScene& scene, const ShapeFitOptions& options,
                          const Progress& progress = {}, const FitStep& step = {}) {
  return fit_shape(scene.line0, scene.line1, scene.spec, scene_tolerance, options, progress, step);
}

}  // namespace blendwright::test
