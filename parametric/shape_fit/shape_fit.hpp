#pragma once
// Shape from intent: the parameters of a blend that fulfil what is wanted of it best, by nonlinear least
// squares.
//
//   minimise  sum_k w_k |r_k(x)|^2 + |priors(x)|^2      bounds lo <= x <= hi (1)
// x: tension, magnitudes along v, tangent angles, correspondence. The boundary conditions are part of the
// blend's formula and hold exactly for every x, so continuity is the same before, during and after the fit.
// Each residual is divided by a length, an angle or an energy of the start, so that weights are plain
// numbers: a weight of 1 makes every objective equally important when it is as bad as at the start or, for
// those with a target, when it misses the target by its own size. Source: formula sheet, "Fitting"; variable
// projection: Golub and Pereyra 1973.
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kernel/base/progress.hpp"
#include "parametric/blend.hpp"

namespace blendwright {

/// What the solver may change. Nothing else of the spec changes.
struct FitUnknowns {
  bool tension = true;                 ///< the root q of fourth order, the tension of sixth order
  bool tension_per_component = false;  ///< fourth order only: three roots
  bool coefficients = false;  ///< fourth order only: (c, d) with b = 1, inside the safe set; excludes tension
  std::array<int, 2> magnitudes{6, 6};  ///< values of each side's factor law along v; 0: kept, 1: constant
  std::array<bool, 2> tangent_angle{false, false};
  int correspondence = 0;  ///< inner values of the map of v; 0: kept
};

struct FitBounds {
  Interval tension{1e-3, 50.0};
  Interval magnitude{0.05, 5.0};              ///< of m / |C1 - C0|
  Radians tangent_angle{1.0471975511965976};  ///< largest |psi|
  double least_speed = 0.05;                  ///< of the correspondence map, g' >= this
  double prior =
      1e-3;  ///< weight of the pull towards the start; 0 is allowed, then non-uniqueness is more likely
};

/// Thin-plate energy int Suu^2 + 2 Suv^2 + Svv^2 over the parameters scaled to the surface's mean lengths.
struct ThinPlate {
  double weight = 1.0;
};
/// Change of normal curvature along the u-lines.
struct CurvatureVariation {
  double weight = 1.0;
};
/// The normal curvature of the u-lines in the middle of the blend (u in `across`) is that of a ball of this
/// radius. One law point: constant; more: along v.
struct RollingBall {
  double weight = 1.0;
  std::vector<LawPoint> radius{};
  Interval across{0.45, 0.55};
};
/// The surface goes through these points (foot points are found on the way).
struct PassThrough {
  double weight = 1.0;
  std::vector<Vec3> points{};
};
/// No principal curvature above 1 / least_radius.
struct LargestCurvature {
  double weight = 1.0;
  double least_radius = 0.0;
};
/// Distance and its gradient (unit where it is known) of an obstacle, at a point; > 0 outside it.
struct ObstacleSample {
  double distance = 0.0;
  Vec3 gradient = Vec3::Zero();
};
struct Clearance {
  double weight = 1.0;
  double distance = 0.0;                                  ///< keep at least this far
  std::function<ObstacleSample(const Vec3&)> obstacle{};  ///< called from several threads
  std::string name{};
};
/// n . n_ref > margin, n_ref the normal of the start smoothed over u: the surface does not turn over.
struct NoFold {
  double weight = 1.0;
  double margin = 0.05;
};
/// The surface is close to these points; robust (Cauchy) with this scale, model units; empty: plain squares.
struct ScannedPoints {
  double weight = 1.0;
  std::vector<Vec3> points{};
  std::optional<double> robust_scale{};
};

using FitObjective = std::variant<ThinPlate, CurvatureVariation, RollingBall, PassThrough, LargestCurvature,
                                  Clearance, NoFold, ScannedPoints>;
[[nodiscard]] const char* name(const FitObjective& objective);

struct ShapeFitOptions {
  FitUnknowns unknowns{};
  FitBounds bounds{};
  std::vector<FitObjective> objectives{};
  int samples_u = 12, samples_v = 48;  ///< Gauss points across, places along v of the surface objectives
  int max_iterations = 60;
  int starts =
      1;  ///< > 1: further seeded starts inside the bounds, to see whether the optimum is the only one
  int threads = 1;
};

/// One unknown of the result.
struct FittedParameter {
  std::string name;  ///< as in a job: "shape/tension", "from/magnitude at 0.25", "to/tangent_angle",
                     ///< "correspondence at 0.5"
  double start = 0.0, value = 0.0;
  double deviation = 0.0;  ///< standard deviation from the Jacobian; infinite when not determined
  Interval bounds{};
  bool at_bound = false;
};

/// An objective before and after, in the words of its definition.
struct ObjectiveChange {
  std::string name, measure, unit;  ///< "rolling ball", "largest deviation of the radius", "mm"
  double weight = 1.0, before = 0.0, after = 0.0;
  bool fulfilled = true;  ///< of those with a target: it is met within its tolerance (1 % of a radius, 1e-6
                          ///< of the size...)
};

struct ShapeFitResult {
  BlendSpec spec;  ///< reproduces the blend with make_blend on the same trimlines
  std::vector<FittedParameter> parameters;
  std::vector<ObjectiveChange> objectives;
  std::vector<double> costs;  ///< of (1), after each iteration; costs[0]: start
  bool converged = false;
  double condition = 0.0;  ///< of the scaled Jacobian without the priors
  std::vector<double> singular_values{};
  /// Sentences: "shape/tension and both magnitudes trade off along ...: not determined by the objectives",
  /// "3 starts reach 2 different optima (cost 1.2e-3 and 1.9e-3); the better is returned".
  std::vector<std::string> not_unique;
  std::vector<std::string>
      warnings;  ///< active bounds, objectives that are not fulfilled and what stands against them
};

/// Called after every accepted step with the blend as it stands.
using FitStep = std::function<void(int iteration, double cost, const Blend& blend)>;

/// Throws InputError (where: "objectives/1/radius", "unknowns/magnitudes/0", "bounds/tension", ...; all
/// problems at once: no objective, all weights zero, not finite, bounds crossed, no unknown, a point off by
/// more than 10 times the blend's size, ...), GeometryError (the start cannot be built), ConvergenceError (no
/// finite cost anywhere), Cancelled. The same bytes for any number of threads. Time is linear in samples_v. A
/// limit (LargestCurvature, Clearance, NoFold) that is missed is fitted again on twice as many samples each way
/// with more weight, twice at most; `costs` and the calls of `step` are then those of the last fit.
[[nodiscard]] ShapeFitResult fit_shape(const Trimline& line0, const Trimline& line1, const BlendSpec& start,
                                       double tolerance, const ShapeFitOptions& options,
                                       const Progress& progress = {}, const FitStep& step = {});

/// The same for boundary data typed as formulas: nothing but the shape can change. `result.spec` carries the
/// shape only; it reproduces the blend with make_literal_blend on the same ends. Unknowns of the sides and of
/// the correspondence at their defaults are taken as not asked for.
[[nodiscard]] ShapeFitResult fit_literal_shape(const EndCondition& end0, const EndCondition& end1,
                                               const BlendShape& start, const ShapeFitOptions& options,
                                               const Progress& progress = {}, const FitStep& step = {});

}  // namespace blendwright
