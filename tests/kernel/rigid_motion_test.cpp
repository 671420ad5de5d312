#include "kernel/geometry/rigid_motion.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "kernel/base/error.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

constexpr double eps = 2.220446049250313e-16;

/// (u, v, u^2 v^2): every partial derivative to order 4 is known.
struct Saddle {
  [[nodiscard]] SurfaceDomain domain() const { return {{-1, 1}, {-1, 1}}; }
  [[nodiscard]] SurfacePartials partials(UV p) const {
    const std::array<double, 5> u{p.u * p.u, 2 * p.u, 2, 0, 0}, v{p.v * p.v, 2 * p.v, 2, 0, 0};
    SurfacePartials d;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j)
        d(i, j) = Vec3(i == 0 && j == 0 ? p.u : (i == 1 && j == 0 ? 1 : 0),
                       i == 0 && j == 0 ? p.v : (i == 0 && j == 1 ? 1 : 0),
                       u[static_cast<std::size_t>(i)] * v[static_cast<std::size_t>(j)]);
    return d;
  }
  [[nodiscard]] SurfaceJet jet(UV p) const {
    const SurfacePartials d = partials(p);
    return {d(0, 0), d(1, 0), d(0, 1), d(2, 0), d(1, 1), d(0, 2)};
  }
};

Vec3 random_vector(Rng& rng) { return {uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)}; }

RigidMotion random_motion(Rng& rng) {
  return RigidMotion::from_axis(5 * random_vector(rng), random_vector(rng), random_vector(rng));
}

TEST(RigidMotion, FromAxisIsARotationThatTakesZToTheDirection) {
  for_all([](Rng& rng) {
    const Vec3 origin = random_vector(rng), z = random_vector(rng);
    for (const Vec3& x : {Vec3(random_vector(rng)), Vec3(Vec3::Zero())}) {
      const RigidMotion m = RigidMotion::from_axis(origin, z, x);
      EXPECT_LE((m.R.transpose() * m.R - Eigen::Matrix3d::Identity()).norm(), 20 * eps);
      EXPECT_NEAR(m.R.determinant(), 1.0, 20 * eps);
      EXPECT_LE((m.R.col(2) - z.normalized()).norm(), 4 * eps);
      EXPECT_EQ(m(Vec3::Zero()), origin);
      // x keeps its side: it lies in the half plane of z and the image of local x.
      EXPECT_GE(m.R.col(0).dot(x), 0.0);
      EXPECT_NEAR(m.R.col(1).dot(x), 0.0, 20 * eps);
    }
  });
}

TEST(RigidMotion, FromTheZAxisIsTheIdentity) {
  EXPECT_TRUE(RigidMotion::from_axis(Vec3::Zero(), Vec3::UnitZ()).is_identity());
  EXPECT_FALSE(RigidMotion::from_axis(Vec3(0, 0, 1e-300), Vec3::UnitZ()).is_identity());
}

TEST(RigidMotion, FromAxisRefusesWhatGivesNoFrame) {
  EXPECT_THROW((void)RigidMotion::from_axis(Vec3::Zero(), Vec3::Zero()), InputError);
  EXPECT_THROW((void)RigidMotion::from_axis(Vec3::Zero(), Vec3(0, std::nan(""), 1)), InputError);
  EXPECT_THROW((void)RigidMotion::from_axis(Vec3::Zero(), Vec3(1, 2, 3), Vec3(-2, -4, -6)), InputError);
  EXPECT_NO_THROW((void)RigidMotion::from_axis(Vec3::Zero(), Vec3::UnitX()));
}

TEST(PlacedSurface, MovesPositionsAndTurnsDerivatives) {
  for_all([](Rng& rng) {
    const RigidMotion m = random_motion(rng);
    const UV p{uniform(rng, -1, 1), uniform(rng, -1, 1)};
    const Surface moved = placed(Saddle{}, m);
    const SurfacePartials a = Saddle{}.partials(p), b = moved.partials(p);
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) {
        const Vec3 expected = i + j == 0 ? m(a(i, j)) : Vec3(m.R * a(i, j));
        EXPECT_LE((b(i, j) - expected).norm(), 10 * eps * (1 + expected.norm()));
      }
    const SurfaceJet jet = moved.jet(p);
    EXPECT_LE((jet.S - b(0, 0)).norm() + (jet.Suv - b(1, 1)).norm() + (jet.Svv - b(0, 2)).norm(), 40 * eps);
  });
}

TEST(PlacedSurface, PlacementsOfPlacementsAreMerged) {
  for_all([](Rng& rng) {
    const RigidMotion a = random_motion(rng), b = random_motion(rng);
    const Surface twice = placed(placed(Saddle{}, a), b);
    const PlacedSurface* outer = twice.target<PlacedSurface>();
    ASSERT_NE(outer, nullptr);
    EXPECT_NE(outer->shape.target<Saddle>(), nullptr);
    const UV p{uniform(rng, -1, 1), uniform(rng, -1, 1)};
    EXPECT_LE((twice.point(p) - b(a(Saddle{}.jet(p).S))).norm(), 100 * eps * 10);
  });
  EXPECT_NE(placed(Saddle{}, RigidMotion{}).target<Saddle>(), nullptr);
}

}  // namespace
}  // namespace blendwright
