// Every residual's analytic derivative against differences of the residual itself.
#include <gtest/gtest.h>

#include <cmath>

#include "parametric/shape_fit/fit_problem.hpp"
#include "parametric/shape_fit/fit_residuals.hpp"
#include "tests/parametric/shape_fit/fit_scenes.hpp"

namespace blendwright::detail {
namespace {

using namespace test;

FitInput input_of(const FitScene& scene) {
  FitInput input;
  input.lines = {scene.line0, scene.line1};
  input.spec = scene.spec;
  input.tolerance = scene_tolerance;
  return input;
}

/// Largest |J - differences| of a column relative to the column's largest entry; `spoil` is added to J.
double disagreement(const FitScene& scene, const ShapeFitOptions& options, double spoil = 0.0) {
  const Blend start = made(scene, scene.spec);
  const FitProblem problem = fit_problem(input_of(scene), start, options);
  std::vector<double> x0 = problem.x0;
  for (std::size_t p = 0; p < x0.size(); ++p) x0[p] *= problem.scale[p];
  const FitResiduals residuals(*problem.model, options, x0);
  // Away from the start, so that no term vanishes.
  std::vector<double> x = x0;
  for (std::size_t p = 0; p < x.size(); ++p)
    x[p] += 0.02 * problem.scale[p] * std::cos(static_cast<double>(p));
  Eigen::VectorXd r(residuals.count());
  RowMatrix J;
  EXPECT_TRUE(residuals.evaluate(x.data(), r.data(), &J));
  double worst = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    // Where a limit is just reached, within the step, its residual has no derivative: those rows are left
    // out.
    Eigen::VectorXd least = Eigen::VectorXd::Constant(residuals.count(), HUGE_VAL), most = -least;
    const auto at = [&](double h) {
      std::vector<double> y = x;
      y[p] += h;
      Eigen::VectorXd f(residuals.count());
      EXPECT_TRUE(residuals.evaluate(y.data(), f.data(), nullptr));
      least = least.cwiseMin(f);
      most = most.cwiseMax(f);
      return f;
    };
    // Central difference of fourth order: error h^4 f^(5)/30, rounding 1e-13 / h of the residuals.
    const Eigen::VectorXd d = difference(at, 0.0, 1e-3 * problem.scale[p]);
    const Eigen::VectorXd column = J.col(static_cast<Eigen::Index>(p)).array() + spoil;
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (least[i] != 0.0 || most[i] == 0.0)
        worst = std::max(worst, std::abs(column[i] - d[i]) / std::max(d.cwiseAbs().maxCoeff(), 1e-6));
  }
  return worst;
}

// h = 1e-3: error 1e-12 times fifth derivatives of up to 1e3, rounding 1e-10.
constexpr double agreement = 1e-7;

/// Points near the blend, on both sides of it, and one over its edge.
std::vector<Vec3> points_near(const FitScene& scene, double away) {
  const Blend blend = made(scene, scene.spec);
  std::vector<Vec3> points;
  Rng rng(7);
  for (int i = 0; i < 20; ++i) {
    const SurfaceJet j =
        blend.surface.jet({uniform(rng, 0.1, 0.9), blend.surface.domain().v.at(uniform(rng, 0.05, 0.95))});
    points.push_back(j.S + uniform(rng, -away, away) * j.Su.cross(j.Sv).normalized());
  }
  return points;
}

ObstacleSample sphere_obstacle(const Vec3& p) {
  const Vec3 d = p - Vec3(0.3, 1.5, 1.5);
  return {d.norm() - 0.5, d.normalized()};
}

std::vector<FitObjective> every_objective(const FitScene& scene) {
  PassThrough through;
  through.points = points_near(scene, 0.05);
  ScannedPoints scan;
  scan.points = points_near(scene, 0.2);
  scan.robust_scale = 0.05;
  RollingBall ball;
  ball.radius = {{0.0, 0.8}, {0.5, 1.1}};
  LargestCurvature limit;
  limit.least_radius = 5.0;  // so that it is broken nearly everywhere
  Clearance clear;
  clear.distance = 10.0;
  clear.obstacle = sphere_obstacle;
  NoFold fold;
  fold.margin = 0.999;
  return {ThinPlate{}, CurvatureVariation{}, ball, through, limit, clear, fold, scan};
}

ShapeFitOptions options_for(std::vector<FitObjective> objectives) {
  ShapeFitOptions options;
  options.objectives = std::move(objectives);
  options.samples_u = 5;
  options.samples_v = 12;
  options.bounds.prior = 0.1;
  return options;
}

void expect_agreement(const FitScene& scene, const FitUnknowns& unknowns) {
  for (const FitObjective& o : every_objective(scene)) {
    ShapeFitOptions options = options_for({o});
    options.unknowns = unknowns;
    EXPECT_LE(disagreement(scene, options), agreement) << name(o);
  }
}

FitUnknowns everything() {
  FitUnknowns u;
  u.magnitudes = {4, 3};
  u.tangent_angle = {true, true};
  u.correspondence = 4;
  return u;
}

TEST(FitJacobian, OfEveryObjectiveAgreesWithDifferencesOnFourthOrder) {
  expect_agreement(free_surfaces(Continuity::G1), everything());
}

TEST(FitJacobian, OfEveryObjectiveAgreesWithDifferencesOnSixthOrder) {
  FitScene scene = free_surfaces(Continuity::G2);
  scene.spec.shape.tension = 2.0;
  expect_agreement(scene, everything());
}

TEST(FitJacobian, HoldsWhenOneSideIsG1AndTheOtherG2) {
  FitScene scene = open_panel(Continuity::G1);
  scene.spec.sides[1].continuity = Continuity::G2;
  scene.spec.shape.tension = 1.5;
  expect_agreement(scene, everything());
}

TEST(FitJacobian, HoldsInEveryModeFamilyAndRule) {
  for (const BlendMode mode : {BlendMode::origin, BlendMode::anchor, BlendMode::chord})
    for (const SixthOrderFamily family :
         {SixthOrderFamily::tension1, SixthOrderFamily::tension2, SixthOrderFamily::triple})
      for (const MagnitudeRule rule :
           {MagnitudeRule::chord, MagnitudeRule::constant, MagnitudeRule::circle_like}) {
        FitScene scene = free_surfaces(Continuity::G2);
        scene.spec.sides[0].rule = rule;
        scene.spec.shape.mode = mode;
        scene.spec.shape.anchor = {0.3, -0.2, 1.0};
        scene.spec.shape.family = family;
        scene.spec.shape.tension = 1.2;
        ShapeFitOptions options = options_for({ThinPlate{}});
        options.unknowns = everything();
        EXPECT_LE(disagreement(scene, options), agreement) << name(mode) << name(family);
      }
}

TEST(FitJacobian, HoldsForCoefficientsAndForTensionsPerComponentInAFrame) {
  FitScene scene = free_surfaces(Continuity::G1);
  scene.spec.shape.ode.fill({1.0, -3.0, 1.5});
  ShapeFitOptions options = options_for({ThinPlate{}, CurvatureVariation{}});
  options.unknowns.tension = false;
  options.unknowns.coefficients = true;
  EXPECT_LE(disagreement(scene, options), agreement);

  scene.spec.shape.ode = {SweepOde::repeated_root(1.0), SweepOde::tension(2.0), SweepOde::repeated_root(0.5)};
  scene.spec.shape.frame = BlendFrame::fixed;
  scene.spec.shape.axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  options.unknowns = {};
  options.unknowns.tension_per_component = true;
  EXPECT_LE(disagreement(scene, options), agreement);
}

TEST(FitJacobian, ThatIsWrongIsSeen) {
  ShapeFitOptions options = options_for({ThinPlate{}});
  EXPECT_LE(disagreement(free_surfaces(), options), agreement);
  EXPECT_GT(disagreement(free_surfaces(), options, 1e-5), agreement);
}

/// The model that the solver sees is the blend that is made.
TEST(FitModel, IsTheBlendItself) {
  for (const Continuity c : {Continuity::G1, Continuity::G2})
    for (const FitScene& scene : {free_surfaces(c), open_panel(c), perpendicular_cylinders(c)}) {
      const Blend start = made(scene, scene.spec);
      ShapeFitOptions options = options_for({ThinPlate{}});
      options.unknowns = everything();
      const FitProblem problem = fit_problem(input_of(scene), start, options);
      std::vector<double> x = problem.x0;
      for (std::size_t p = 0; p < x.size(); ++p)
        x[p] = problem.scale[p] * (x[p] + 0.03 * std::sin(static_cast<double>(p + 1)));
      const Blend blend = made(scene, problem.spec(x.data()));
      const BlendModel::At model(*problem.model, x.data());
      const Interval v = blend.surface.domain().v;
      for (int i = 0; i < 30; ++i) {
        const double u = (i % 7) / 6.0, t = (i + 0.3) / 30.0;
        const JetAt m = model.jet(u, t, false);
        const SurfaceJet j = blend.surface.jet({u, v.at(t)});
        const double length = v.length(), size = 5.0;
        // Tables are good to 1e-11; each derivative costs a step of 1/128 or finer.
        EXPECT_LE((m.part(at_S) - j.S).norm(), 1e-9 * size);
        EXPECT_LE((m.part(at_Su) - j.Su).norm(), 1e-9 * size);
        EXPECT_LE((m.part(at_Suu) - j.Suu).norm(), 1e-8 * size * 10.0);
        EXPECT_LE((m.part(at_Svv) - length * length * j.Svv).norm(), 1e-4 * size * 40.0);
      }
    }
}

}  // namespace
}  // namespace blendwright::detail
