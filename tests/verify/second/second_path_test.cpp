// The second path: derivatives from positions are right to their own error estimates, it agrees with the
// first path where both are sound, and it sees a wrong first path and a surface that contradicts itself.
#include "verify/second/second_path.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "kernel/geometry/bspline.hpp"
#include "kernel/geometry/project.hpp"
#include "tests/verify/shapes.hpp"
#include "verify/second/differences.hpp"
#include "verify/second/spline_step.hpp"

namespace blendwright {
namespace {

using namespace test;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// The surface as itself: what is left to differ are derivatives and the search.
SecondSurface itself(const Surface& surface) {
  return {[surface](UV at) { return surface.point(at); },
          [surface](const Vec3& q) -> SecondSurface::Closest {
            const Foot foot = closest_point(surface, q);
            return {foot.at, foot.distance, 1e-12};
          },
          0.0};
}
SecondSeam again(const Seam& seam, const SeamReport& first) {
  return second_path(seam, first, {itself(seam.blend), itself(*seam.primary)});
}

BSplineSurface random_spline(Rng& rng, bool closed) {
  const int p = integer(rng, 1, 5), q = integer(rng, 1, 5);
  const auto breaks = [&](int count) {
    std::vector<double> t{uniform(rng, -1.0, 1.0)};
    for (int i = 0; i < count; ++i) t.push_back(t.back() + uniform(rng, 0.1, 2.0));
    return t;
  };
  const BSplineBasis u = BSplineBasis::clamped(p, breaks(integer(rng, 1, 5)));
  const BSplineBasis v =
      closed ? BSplineBasis::closed(q, breaks(q + 3)) : BSplineBasis::clamped(q, breaks(4));
  std::vector<Vec3> control;
  for (int i = 0; i < u.count() * v.count(); ++i)
    control.emplace_back(uniform(rng, -3, 3), uniform(rng, -3, 3), uniform(rng, -3, 3));
  return {u, v, control};
}

TEST(ComplexStep, IsTheDerivativeOfRandomSplines) {
  for_all([](Rng& rng) {
    const BSplineSurface s = random_spline(rng, rng.next() % 2 == 0);
    const SurfaceDomain d = s.domain();
    for (const UV at : {UV{d.u.lo, d.v.at(uniform(rng, 0, 1))}, UV{d.u.hi, d.v.lo},
                        UV{d.u.at(uniform(rng, 0, 1)), d.v.at(uniform(rng, 0, 1))}}) {
      const SurfaceJet jet = s.jet(at);
      const detail::SplineTangents t = detail::complex_step(s, at);
      // Twice: both sides round.
      EXPECT_LE((t.Su - jet.Su).norm(), 2.0 * t.error_u);
      EXPECT_LE((t.Sv - jet.Sv).norm(), 2.0 * t.error_v);
    }
  });
}

TEST(DifferenceQuotient, IsRightToItsEstimateInsideAndAtEnds) {
  for_all([](Rng& rng) {
    const double w = uniform(rng, 0.1, 20.0), k = uniform(rng, -3.0, 3.0), far = uniform(rng, -100.0, 100.0);
    const auto f = [&](double t) { return Vec3(std::sin(w * t), std::exp(k * t) + far, 1.0 / (t + 1.5)); };
    for (const double x : {0.0, 1.0, 0.005, uniform(rng, 0.0, 1.0)}) {
      const detail::Derivative d = detail::difference_quotient(f, x, {0.0, 1.0});
      const Vec3 exact(w * std::cos(w * x), k * std::exp(k * x), -1.0 / ((x + 1.5) * (x + 1.5)));
      EXPECT_LE((d.value - exact).norm(), 10.0 * d.error);  // 10: the bound (6) trusts it as far
      // One-sided quotients lose more to rounding; still far below any angle that is asked of a joint.
      EXPECT_LE(d.error, 1e-9 * (1.0 + w + exact.norm()) * (1.0 + 0.01 * std::abs(far)));
    }
  });
}

TEST(DifferenceQuotient, KnowsThatACornerHasNone) {
  const detail::Derivative d = detail::difference_quotient(
      [](double t) { return Vec3(std::abs(t - 0.3), t, 0.0); }, 0.3 + 1e-7, {0.0, 1.0});
  EXPECT_GT(d.error, 1e-9);
}

TEST(SecondPath, AgreesOnSoundAndOnBrokenJoints) {
  for (const double shift : {0.0, 1e-9, 1e-4})
    for (const double tilt : {0.0, 1e-6, 0.1}) {
      const Seam seam = on_cylinder(revolution(
          turn, [=](const auto& u) { return 1.0 + shift + tilt * u; },
          [](const auto& u) { return 1.0 + u; }));
      const SecondSeam second = again(seam, check_seam(seam));
      EXPECT_EQ(second.gap.places, 9u);
      EXPECT_EQ(second.angle.places, 9u);
      EXPECT_EQ(second.surface_gap.places, 10u);
      for (const SecondFigure& f : {second.gap, second.surface_gap, second.angle}) {
        EXPECT_TRUE(f.agrees()) << f.first << " " << f.second << " bound " << f.bound;
        EXPECT_LE(f.bound, 1e-8);
      }
      EXPECT_NEAR(second.angle.second, std::atan(tilt), 1e-9);  // and it is the angle
      EXPECT_NEAR(second.gap.second, shift, 64 * eps);
    }
}

TEST(SecondPath, SeesAFirstPathThatIsWrong) {
  const Seam seam = on_cylinder(revolution(
      turn, [](const auto& u) { return 1.0 + 1e-7 + 1e-4 * u; }, [](const auto& u) { return 1.0 + u; }));
  const SeamReport sound = check_seam(seam);
  SeamReport wrong = sound;
  wrong.gap.worst *= 1.001;
  EXPECT_FALSE(again(seam, wrong).gap.agrees());
  EXPECT_TRUE(again(seam, wrong).angle.agrees());
  wrong = sound;
  wrong.angle.worst += 1e-8;
  EXPECT_FALSE(again(seam, wrong).angle.agrees());
  EXPECT_TRUE(again(seam, wrong).gap.agrees());
  wrong = sound;
  wrong.surface_gap.worst -= 1e-10;
  EXPECT_FALSE(again(seam, wrong).surface_gap.agrees());
  wrong = sound;
  for (double& angle : wrong.angle_at) angle = 0.0;  // as if every sample were looked at elsewhere
  EXPECT_FALSE(again(seam, wrong).angle.agrees());
}

/// Right positions, wrong derivatives: what the first path would believe.
struct Contradiction {
  Surface truth;
  double turn = 0.0;
  [[nodiscard]] SurfaceJet jet(UV p) const {
    SurfaceJet jet = truth.jet(p);
    jet.Su += turn * jet.Su.cross(jet.Sv);
    return jet;
  }
  [[nodiscard]] SurfacePartials partials(UV p) const { return truth.partials(p); }
  [[nodiscard]] SurfaceDomain domain() const { return truth.domain(); }
};

TEST(SecondPath, SeesASurfaceWhoseDerivativesAreNotItsOwn) {
  const Seam sound = on_cylinder(Contradiction{continued_cylinder(), 0.0});
  EXPECT_TRUE(again(sound, check_seam(sound)).angle.agrees());
  const Seam seam = on_cylinder(Contradiction{continued_cylinder(), 1e-7});
  const SecondSeam second = again(seam, check_seam(seam));
  EXPECT_FALSE(second.angle.agrees());
  EXPECT_TRUE(second.gap.agrees());
}

TEST(SecondPath, SeesASurfaceThatIsNotWhereItSays) {
  const Seam seam = on_cylinder(continued_cylinder());
  SecondSurface elsewhere = itself(seam.blend);
  elsewhere.point = [blend = seam.blend](UV at) { return Vec3(blend.point(at) + Vec3(0, 0, 1e-9)); };
  const SecondSeam second = second_path(seam, check_seam(seam), {elsewhere, itself(*seam.primary)});
  EXPECT_FALSE(second.gap.agrees());
}

TEST(SecondPath, ComparesNothingWithoutAPrimary) {
  Seam seam = on_cylinder(continued_cylinder());
  seam.primary.reset();
  const SecondSeam second = second_path(seam, check_seam(seam), {itself(seam.blend), {}});
  EXPECT_EQ(second.gap.places + second.angle.places + second.surface_gap.places, 0u);
  EXPECT_TRUE(second.gap.agrees());
}

TEST(SecondPath, FindsFeetWhereNoTrimlineIsGiven) {
  Seam seam = on_cylinder(continued_cylinder());
  seam.pcurve.reset();
  const SecondSeam second = again(seam, check_seam(seam));
  EXPECT_TRUE(second.gap.agrees() && second.angle.agrees());
  EXPECT_EQ(second.angle.places, 9u);
}

TEST(SecondClosing, AgreesAndSeesAWrongFirstPath) {
  const Surface band = continued_cylinder();
  const ClosingReport first = check_closing(band);
  const SecondClosing second = second_closing(band, first, itself(band));
  EXPECT_TRUE(second.gap.agrees() && second.angle.agrees());
  EXPECT_EQ(second.gap.places, 10u);
  const Surface open = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{cos(v), sin(v), T(u + 1e-6 * v)};
  });
  ClosingReport gap = check_closing(open);
  EXPECT_TRUE(second_closing(open, gap, itself(open)).gap.agrees());
  gap.gap *= 0.999;
  EXPECT_FALSE(second_closing(open, gap, itself(open)).gap.agrees());
}

TEST(SecondPath, SharesNoCodeWithTheFirst) {
  namespace fs = std::filesystem;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(BLENDWRIGHT_SOURCE_DIR) / "verify/second")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    ++files;
    std::ifstream in(entry.path());
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    for (const char* forbidden : {"seam_probe.hpp", "curvature.hpp", "project.hpp", "jet(", "partials(",
                                  "evaluate(", "unit_normal", "plane_angle"})
      EXPECT_EQ(text.find(forbidden), std::string::npos) << entry.path() << " has " << forbidden;
  }
  EXPECT_EQ(files, 6u);
}

}  // namespace
}  // namespace blendwright
