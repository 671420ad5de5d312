// What a fit must reach, on blends that are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "kernel/geometry/curvature.hpp"
#include "tests/parametric/shape_fit/fit_scenes.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

double seconds_of(const auto& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Largest |radius - R| / R of the u-lines in the middle, by the kernel's curvature.
double radius_error(const Blend& blend, double R) {
  double worst = 0.0;
  for (int i = 0; i < 400; ++i) {
    const SurfaceJet j = blend.surface.jet({0.5, blend.surface.domain().v.at(i / 400.0)});
    worst = std::max(worst, std::abs(1.0 / std::abs(normal_curvature(j, j.Su, unit_normal(j))) - R) / R);
  }
  return worst;
}

TEST(ShapeFit, GivesTheMiddleOfABlendOfPerpendicularCylindersTheRadiusOfABall) {
  for (const double R : {0.6, 0.8}) {
    const FitScene scene = perpendicular_cylinders(Continuity::G2);
    ShapeFitOptions options;
    options.threads = 2;
    RollingBall ball;
    ball.radius = {{0.0, R}};
    ball.across = {0.5, 0.5};
    options.objectives = {ball};
    options.unknowns.magnitudes = {8, 8};
    ShapeFitResult result;
    const double seconds = seconds_of([&] { result = fit(scene, options); });
    const double before = radius_error(made(scene, scene.spec), R),
                 after = radius_error(made(scene, result.spec), R);
    std::printf("rolling ball %.1f: deviation %.2f %% before, %.3f %% after, %.2f s, %zu steps\n", R,
                100 * before, 100 * after, seconds, result.costs.size() - 1);
    EXPECT_GT(before, 0.01);
    EXPECT_LE(after, 0.01);
    EXPECT_TRUE(result.objectives[0].fulfilled);
  }
}

/// A known blend of one of the scenes, with points of it, and the default blend to start from.
struct KnownBlend {
  FitScene scene;
  BlendSpec known;
  std::vector<Vec3> points;
};

KnownBlend known_blend(Rng& rng) {
  const Continuity c = integer(rng, 0, 1) == 0 ? Continuity::G1 : Continuity::G2;
  KnownBlend k{integer(rng, 0, 1) == 0 ? free_surfaces(c) : open_panel(c), {}, {}};
  k.scene.spec.shape.tension = 2.0;
  k.scene.spec.shape.repeated_root = 2.0;
  k.known = k.scene.spec;
  k.known.shape.tension = log_uniform(rng, 1.0, 8.0);
  k.known.shape.repeated_root = k.known.shape.tension;
  const bool closed = k.scene.line0.domain().closed;
  for (SideSpec& side : k.known.sides) {
    side.factor.clear();
    for (int j = 0; j < 4; ++j) side.factor.push_back({j / (closed ? 4.0 : 3.0), uniform(rng, 0.7, 1.4)});
  }
  k.known.correspondence.rule = CorrespondenceRule::mapped;
  for (int j = 0; j < 3; ++j) {
    const double t = closed ? j / 3.0 : (j + 1) / 4.0;
    k.known.correspondence.map.push_back({t, t + uniform(rng, -0.03, 0.03)});
  }
  if (closed) {  // seam and direction as the start has them
    const Blend start = made(k.scene, k.scene.spec);
    k.known.correspondence.seam_offset = start.correspondence->seam_offset;
    k.known.correspondence.reverse = start.correspondence->reversed;
  }
  const Blend blend = made(k.scene, k.known);
  for (int i = 0; i < 300; ++i) {
    const Vec3 S =
        blend.surface.jet({uniform(rng, 0.05, 0.95), blend.surface.domain().v.at(uniform(rng, 0.0, 1.0))}).S;
    k.points.push_back(S + 1e-6 * Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)));
  }
  return k;
}

/// Largest difference of a parameter from the known one, relative to its size.
double recovery_error(const KnownBlend& k, const BlendSpec& found) {
  const bool sixth = k.known.sides[0].continuity == Continuity::G2;
  const double q = sixth ? found.shape.tension : *found.shape.repeated_root;
  double worst = std::abs(q / k.known.shape.tension - 1.0);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      worst =
          std::max(worst, std::abs(found.sides[i].factor[j].value / k.known.sides[i].factor[j].value - 1.0));
  for (std::size_t j = 0; j < 3; ++j)
    worst =
        std::max(worst, std::abs(found.correspondence.map[j].value - k.known.correspondence.map[j].value));
  return worst;
}

TEST(ShapeFit, RecoversTensionMagnitudesAndCorrespondenceFromPoints) {
  const int seeds = std::getenv("BLENDWRIGHT_LONG") ? 50 : 2;
  int recovered = 0;
  double worst = 0.0, seconds = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    const KnownBlend k = known_blend(rng);
    ShapeFitOptions options;
    options.threads = 2;
    options.max_iterations = 200;
    options.unknowns.magnitudes = {4, 4};
    options.unknowns.correspondence = 3;
    options.bounds.prior = 0.0;
    if (seed % 2 == 0) {
      PassThrough through;
      through.points = k.points;
      options.objectives = {through};
    } else {
      ScannedPoints scan;
      scan.points = k.points;
      scan.robust_scale = 0.1;
      options.objectives = {scan};
    }
    ShapeFitResult result;
    seconds += seconds_of([&] { result = fit(k.scene, options); });
    const double error = recovery_error(k, result.spec);
    worst = std::max(worst, error);
    if (error <= 1e-3)
      ++recovered;
    else
      std::printf("seed %d: error %.2g, cost %.2g, condition %.2g, %zu steps%s\n", seed, error,
                  result.costs.back(), result.condition, result.costs.size() - 1,
                  result.converged ? "" : ", not converged");
  }
  std::printf("recovery: %d of %d seeds within 1e-3, largest error %.2g, %.2f s each\n", recovered, seeds,
              worst, seconds / seeds);
  EXPECT_GE(recovered, static_cast<int>(std::ceil(0.95 * seeds)));
}

TEST(ShapeFit, FindsTheBestOfSeveralOptimaFromThreeStartsAndSaysSo) {
  Rng rng(3);  // from its own start this one ends in another optimum
  const KnownBlend k = known_blend(rng);
  ScannedPoints scan;
  scan.points = k.points;
  scan.robust_scale = 0.1;
  ShapeFitOptions options;
  options.threads = 2;
  options.max_iterations = 100;
  options.unknowns.magnitudes = {4, 4};
  options.unknowns.correspondence = 3;
  options.bounds.prior = 0.0;
  options.starts = 3;
  options.objectives = {scan};
  const ShapeFitResult result = fit(k.scene, options);
  EXPECT_LE(recovery_error(k, result.spec), 1e-3);
  EXPECT_THAT(result.not_unique, ::testing::Contains(HasSubstr("different optima")));
}

TEST(ShapeFit, ReachesTheSameOptimumFromThreeStartsOrSaysThatItIsNotUnique) {
  for (const FitScene& scene : {coaxial_cylinders(), free_surfaces(), open_panel(Continuity::G2)}) {
    ShapeFitOptions options;
    options.objectives = {ThinPlate{}};
    options.unknowns.magnitudes = {3, 3};
    options.starts = 3;
    options.samples_v = 24;
    const ShapeFitResult result = fit(scene, options);
    std::printf("three starts: cost %.6f, condition %.3g", result.costs.back(), result.condition);
    for (const std::string& s : result.not_unique) std::printf("; %s", s.c_str());
    std::printf("\n");
    for (const std::string& s : result.not_unique)
      EXPECT_THAT(s, ::testing::Not(HasSubstr("different optima")));
  }
}

TEST(ShapeFit, SaysWhenTheSeamOfARoundBlendIsNotDetermined) {
  FitScene scene = coaxial_cylinders();
  ShapeFitOptions options;
  options.objectives = {ThinPlate{}};
  options.unknowns.magnitudes = {1, 1};
  options.unknowns.correspondence = 3;
  options.samples_v = 24;
  const ShapeFitResult result = fit(scene, options);
  // One point gone through cannot determine a tension and two magnitudes either.
  PassThrough through;
  through.points = {made(scene, scene.spec).surface.jet({0.5, 0.3}).S + Vec3(0.0, 0.0, 0.05)};
  options.objectives = {through};
  options.unknowns.correspondence = 0;
  const ShapeFitResult one = fit(scene, options);
  EXPECT_EQ(one.not_unique.size(), 2u);
  EXPECT_THAT(one.not_unique, ::testing::Contains(HasSubstr("magnitude")));
  EXPECT_TRUE(std::any_of(one.parameters.begin(), one.parameters.end(),
                          [](const FittedParameter& p) { return std::isinf(p.deviation); }));
  EXPECT_TRUE(one.objectives[0].fulfilled);
  // Two hundred points all over do.
  BlendSpec known = scene.spec;
  known.shape.repeated_root = 3.0;
  known.sides[0].factor = {{0.0, 1.2}};
  known.sides[1].factor = {{0.0, 0.9}};
  const Blend blend = made(scene, known);
  through.points.clear();
  Rng rng(3);
  for (int i = 0; i < 200; ++i)
    through.points.push_back(
        blend.surface.jet({uniform(rng, 0.05, 0.95), blend.surface.domain().v.at(uniform(rng, 0.0, 1.0))}).S);
  options.objectives = {through};
  scene.spec.shape.repeated_root = 1.0;
  const ShapeFitResult many = fit(scene, options);
  EXPECT_TRUE(many.not_unique.empty());
  EXPECT_TRUE(std::all_of(many.parameters.begin(), many.parameters.end(),
                          [](const FittedParameter& p) { return p.deviation > 0.0 && p.deviation < 10.0; }));
}

TEST(ShapeFit, KeepsBoundaryDataExactAtEveryIterate) {
  for (const Continuity c : {Continuity::G1, Continuity::G2}) {
    const FitScene scene = free_surfaces(c);
    ShapeFitOptions options;
    options.objectives = {ThinPlate{}};
    options.unknowns.tangent_angle = {true, true};
    options.unknowns.correspondence = 4;
    options.samples_v = 24;
    int steps = 0;
    double gap = 0.0, angle = 0.0, bend = 0.0;
    const ShapeFitResult result =
        fit(scene, options, {}, [&](int iteration, double cost, const Blend& blend) {
          EXPECT_EQ(iteration, steps++);
          EXPECT_TRUE(std::isfinite(cost));
          for (int side = 0; side < 2; ++side)
            for (int i = 0; i < 40; ++i) {
              const Trimline& line = *blend.trimlines[static_cast<std::size_t>(side)];
              const double v = line.domain().v.at(i / 40.0);
              const Vec2 p = line.pcurve().point(v);
              const SurfaceJet primary = line.primary().jet({p[0], p[1]});
              const SurfaceJet s = blend.surface.jet({static_cast<double>(side), v});
              const Vec3 n = unit_normal(primary);
              gap = std::max(gap, (s.S - primary.S).norm());
              angle = std::max(angle, plane_angle(unit_normal(s), n).value);
              bend =
                  std::max(bend, std::abs(normal_curvature(s, s.Su, n) - normal_curvature(primary, s.Su, n)));
            }
        });
    EXPECT_GE(steps, 3);
    EXPECT_EQ(steps, static_cast<int>(result.costs.size()));
    std::printf("%d iterates, %s: gap %.1e, angle %.1e rad%s\n", steps, name(c), gap, angle,
                c == Continuity::G2 ? (", curvature " + std::to_string(bend)).c_str() : "");
    EXPECT_LE(gap, 1e-12);
    EXPECT_LE(angle, 1e-12);
    if (c == Continuity::G2) {
      EXPECT_LE(bend, 1e-11);  // second derivatives of size 10, divided by |Su|^2
    }
  }
}

TEST(ShapeFit, TakesTimeInProportionToTheSamples) {
  const FitScene scene = perpendicular_cylinders(Continuity::G2);
  std::vector<double> per_residual;
  for (const int samples : {12, 36, 108, 324, 926}) {
    ShapeFitOptions options;
    options.objectives = {ThinPlate{}};
    options.samples_v = samples;
    options.threads = 2;
    options.max_iterations = 8;
    ShapeFitResult result;
    const double seconds = seconds_of([&] { result = fit(scene, options); });
    const int residuals = 9 * 12 * samples;
    per_residual.push_back(seconds / residuals / static_cast<double>(result.costs.size()));
    std::printf("time: %6d residuals, %7.3f s for %zu steps, %.2f us per residual and step\n", residuals,
                seconds, result.costs.size() - 1, 1e6 * per_residual.back());
  }
  // In proportion, the time per residual does not grow; with the square of the samples it would grow 8.6
  // times. Between the two, so that other work on the machine does not decide.
  EXPECT_LE(per_residual.back(), 4.0 * per_residual[2]);
}

ObstacleSample from_sphere(const Vec3& centre, double radius, const Vec3& p) {
  const Vec3 d = p - centre;
  return {d.norm() - radius, d.normalized()};
}

TEST(ShapeFit, KeepsClearOfASphere) {
  const FitScene scene = coaxial_cylinders();
  const Blend start = made(scene, scene.spec);
  // A ball on the outside of the blend that it comes too close to.
  const SurfaceJet j = start.surface.jet({0.5, 0.25});
  Vec3 outward = unit_normal(j);
  if (outward.dot(Vec3(j.S[0], j.S[1], 0.0)) < 0.0) outward = -outward;
  const Vec3 centre = j.S + 0.35 * outward;
  Clearance clear;
  clear.distance = 0.2;
  clear.obstacle = [centre](const Vec3& p) { return from_sphere(centre, 0.25, p); };
  ShapeFitOptions options;
  options.objectives = {ThinPlate{}, clear};
  options.samples_v = 24;
  options.threads = 2;
  const ShapeFitResult result = fit(scene, options);
  const Blend blend = made(scene, result.spec);
  double before = 1e9, after = 1e9;
  for (int i = 1; i < 40; ++i)
    for (int k = 0; k < 200; ++k) {
      const UV at{i / 40.0, blend.surface.domain().v.at(k / 200.0)};
      before = std::min(before, clear.obstacle(start.surface.jet(at).S).distance);
      after = std::min(after, clear.obstacle(blend.surface.jet(at).S).distance);
    }
  std::printf("clearance: %.4f before, %.4f after, wanted %.2f\n", before, after, clear.distance);
  EXPECT_LT(before, 0.15);
  EXPECT_GE(after, 0.99 * clear.distance);
  EXPECT_TRUE(result.objectives[1].fulfilled);
}

TEST(ShapeFit, LimitsCurvature) {
  const FitScene scene = coaxial_cylinders(Continuity::G1);
  const auto least_radius = [&](const BlendSpec& spec) {
    const Blend blend = made(scene, spec);
    double most = 0.0;
    for (int i = 0; i <= 60; ++i) {
      const SurfaceCurvature k = curvature(blend.surface.jet({i / 60.0, 0.3}));
      most = std::max({most, std::abs(k.k_min), std::abs(k.k_max)});
    }
    return 1.0 / most;
  };
  LargestCurvature limit;
  limit.least_radius = 0.95;
  ShapeFitOptions options;
  options.objectives = {limit};
  const ShapeFitResult result = fit(scene, options);
  std::printf("least radius: %.4f before, %.4f after, wanted %.2f\n", least_radius(scene.spec),
              least_radius(result.spec), limit.least_radius);
  EXPECT_LT(least_radius(scene.spec), 0.85);
  EXPECT_GE(least_radius(result.spec), 0.99 * limit.least_radius);
}

TEST(ShapeFit, UnfoldsABlendThatTurnsOver) {
  FitScene scene = coaxial_cylinders();
  for (SideSpec& side : scene.spec.sides) side.factor = {{0.0, 4.5}};
  const auto folds = [&](const BlendSpec& spec) {
    const Blend blend = made(scene, spec);
    const Vec3 reference =
        unit_normal(blend.surface.jet({0.0, 0.3})) + unit_normal(blend.surface.jet({1.0, 0.3}));
    int count = 0;
    for (int i = 0; i <= 60; ++i)
      count += unit_normal(blend.surface.jet({i / 60.0, 0.3})).dot(reference) < 0.0;
    return count;
  };
  ShapeFitOptions options;
  options.objectives = {NoFold{}};
  options.unknowns.tension = false;
  const ShapeFitResult result = fit(scene, options);
  EXPECT_GT(folds(scene.spec), 0);
  EXPECT_EQ(folds(result.spec), 0);
  EXPECT_TRUE(result.objectives[0].fulfilled);
}

TEST(ShapeFit, SolvesLinearUnknownsInOneStep) {
  const FitScene scene = free_surfaces();
  ShapeFitOptions options;
  options.objectives = {ThinPlate{}};
  options.unknowns.tension = false;
  const ShapeFitResult result = fit(scene, options);
  ASSERT_GE(result.costs.size(), 2u);
  // The first step is the solution; what follows is rounding.
  EXPECT_NEAR(result.costs[1], result.costs.back(), 1e-10 * result.costs[0]);
  EXPECT_LT(result.costs[1], 0.99 * result.costs[0]);
  EXPECT_TRUE(result.converged);
}

TEST(ShapeFit, EliminatesLinearUnknownsBesidesOthers) {
  const FitScene scene = free_surfaces();
  ShapeFitOptions options;
  options.objectives = {ThinPlate{}};
  const ShapeFitResult all = fit(scene, options);
  // At the tension found, the magnitudes alone cannot be bettered.
  FitScene at = scene;
  at.spec.shape = all.spec.shape;
  at.spec.sides = all.spec.sides;
  options.unknowns.tension = false;
  const ShapeFitResult rest = fit(at, options);
  // The energy of the two reports is scaled by the lengths of each start; their own before and after are
  // comparable. The prior (1e-3) pulls towards different starts: its effect is of its square.
  EXPECT_LE(rest.objectives[0].after, rest.objectives[0].before * (1.0 + 1e-9));
  EXPECT_GE(rest.objectives[0].after, rest.objectives[0].before * (1.0 - 1e-4));
  std::printf("variable projection: %zu steps to %.6f of the start\n", all.costs.size() - 1,
              all.costs.back());
}

TEST(ShapeFit, ReportsActiveBounds) {
  const FitScene scene = coaxial_cylinders();
  ShapeFitOptions options;
  options.objectives = {ThinPlate{}};
  options.unknowns.tension = false;
  options.unknowns.magnitudes = {1, 1};
  options.bounds.magnitude = {1.3, 1.6};
  const ShapeFitResult result = fit(scene, options);
  EXPECT_TRUE(std::any_of(result.parameters.begin(), result.parameters.end(),
                          [](const FittedParameter& p) { return p.at_bound; }));
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("stands at its bound")));
}

TEST(ShapeFit, GivesTheSameBytesOnOneAndTwoThreads) {
  const FitScene scene = free_surfaces();
  Rng rng(5);
  const KnownBlend known = known_blend(rng);
  ScannedPoints scan;
  scan.points = known.points;
  ShapeFitOptions options;
  options.objectives = {ThinPlate{}, scan};
  options.samples_v = 24;
  options.max_iterations = 5;
  const ShapeFitResult one = fit(known.scene, options);
  options.threads = 2;
  const ShapeFitResult two = fit(known.scene, options);
  EXPECT_EQ(one.costs, two.costs);
  ASSERT_EQ(one.parameters.size(), two.parameters.size());
  for (std::size_t p = 0; p < one.parameters.size(); ++p)
    EXPECT_EQ(one.parameters[p].value, two.parameters[p].value);
}

TEST(ShapeFit, StopsWhenAsked) {
  const FitScene scene = free_surfaces();
  std::stop_source source;
  Progress progress;
  progress.stop = source.get_token();
  int reports = 0;
  progress.report = [&](double, std::string_view stage) {
    if (stage == "fitting" && ++reports == 2) source.request_stop();
  };
  ShapeFitOptions options;
  options.objectives = {ThinPlate{}};
  EXPECT_THROW((void)fit(scene, options, progress), Cancelled);
}

TEST(ShapeFit, GivesTheBestItCanWhenABallDoesNotFit) {
  const FitScene scene = perpendicular_cylinders(Continuity::G2);
  RollingBall ball;
  ball.radius = {{0.0, 50.0}};
  ShapeFitOptions options;
  options.objectives = {ball};
  const ShapeFitResult result = fit(scene, options);
  EXPECT_FALSE(result.objectives[0].fulfilled);
  EXPECT_LE(result.costs.back(), result.costs.front());
  EXPECT_THAT(result.warnings,
              ::testing::Contains(HasSubstr("rolling ball is not fulfilled: the radius in the middle")));
}

}  // namespace
}  // namespace blendwright
