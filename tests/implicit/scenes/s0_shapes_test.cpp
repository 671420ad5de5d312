// Criteria of the scenes s0-1a to s0-8: primitives, unions in the three level conventions, potentials,
// ranges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/implicit/scenes/rays.hpp"
#include "tests/implicit/scenes/voxels.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

Vec3 random_direction(Rng& rng) {
  const double z = uniform(rng, -1.0, 1.0), t = uniform(rng, -std::numbers::pi, std::numbers::pi);
  const double s = std::sqrt(1.0 - z * z);
  return {s * std::cos(t), s * std::sin(t), z};
}
Vec3 random_point(Rng& rng, double half) {
  return {uniform(rng, -half, half), uniform(rng, -half, half), uniform(rng, -half, half)};
}
double number(const std::string& solid, std::string_view key) {
  return std::stod(solid.substr(solid.find(key) + key.size()));
}

TEST(SceneS0_1a, CapsuleStandsHalfTheInfluenceRadiusFromItsSegment) {
  const PointFunction capsule = depth(ExampleScene("s0-1a").field());
  for_all([&](Rng& rng) {
    const Vec3 from(0.5, 0, 0), d = random_direction(rng), p = from + radius(capsule, from, d, 20.0) * d;
    const Vec3 foot(std::clamp(p.x(), -3.0, 4.0), 0, 0);
    EXPECT_NEAR((p - foot).norm(), 2.5, 1e-13 * 10.0);
  });
}

TEST(SceneS0_1b, SuperquadricsHaveTheirRadii) {
  const ExampleScene scene("s0-1b");
  const std::vector<std::string> solids = scene.solids();
  ASSERT_EQ(solids.size(), 25u);
  for (const std::string& solid : solids) {
    SCOPED_TRACE(solid);
    const PointFunction f = depth(scene.field(solid));
    const double n1 = number(solid, "n1=");
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 d = Vec3::Zero();
      d[axis] = 1.0;
      EXPECT_NEAR(2.0 * radius(f, Vec3::Zero(), d, 50.0), 10.0, 1e-11);
    }
    EXPECT_NEAR(2.0 * radius(f, Vec3::Zero(), {1, 1, 0}, 50.0),
                10.0 * std::numbers::sqrt2 * std::pow(2.0, -1.0 / n1), 1e-11);
  }
}

TEST(SceneS0_1c, SuperEllipsoidsGrowFromOctahedronToCube) {
  const ExampleScene scene("s0-1c");
  const std::vector<std::string> solids = scene.solids();
  ASSERT_EQ(solids.size(), 8u);
  double last = 0.0;
  for (const double n : {1.1, 1.3, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0}) {
    std::ostringstream name;
    name << "n=" << n;
    const double R = 2.0 * radius(depth(scene.field(name.str())), Vec3::Zero(), {1, 1, 1}, 50.0);
    EXPECT_NEAR(R, 10.0 * std::numbers::sqrt3 * std::pow(3.0, -1.0 / n), 1e-11);
    EXPECT_GT(R, last);
    last = R;
  }
}

TEST(SceneS0_2, CreaseAndFilletsStandWherePrinted) {
  const ExampleScene scene("s0-2");
  const auto t = [&](const std::string& solid) {
    return radius(depth(scene.field(solid)), Vec3::Zero(), {1, 0, 1}, 20.0) / std::numbers::sqrt2;
  };
  EXPECT_TRUE(prints_as(t("a"), "5.000000"));
  EXPECT_TRUE(prints_as(t("b"), "5.785129"));
  EXPECT_TRUE(prints_as(t("soft-blend"), "6.437528"));
  // A range of half the radius gives a smaller fillet: the figure does not hold for any scale union.
  const ExampleScene narrow = scene.with("b", "r1", 0.5).with("b", "r2", 0.5);
  const double other = radius(depth(narrow.field("b")), Vec3::Zero(), {1, 0, 1}, 20.0) / std::numbers::sqrt2;
  EXPECT_FALSE(prints_as(other, "5.785129"));
  EXPECT_GT(other, 5.0);
}

TEST(SceneS0_3, FacesBulgeEverywhere) {
  const ExampleScene scene("s0-3");
  const auto height = [&](const char* solid, double x, double y) {
    return radius(depth(scene.field(solid)), {x, y, 0}, {0, 0, 1}, 3.0);
  };
  EXPECT_TRUE(prints_as(height("cube", 0.5, 0.5), "0.967168"));
  EXPECT_TRUE(prints_as(height("cube-8", 0.5, 0.5), "0.999020"));
  for (double x = 0.1; x < 0.85; x += 0.1) EXPECT_LT(height("cube", x, 0.2), height("cube", x - 0.1, 0.2));
  EXPECT_LT(height("cube", 0.1, 0.1), 1.0);
}

TEST(SceneS0_3, DieHas21Pips) {
  const ExampleScene scene("s0-3");
  const Box box{Vec3::Constant(-1.2), Vec3::Constant(1.2)};
  const Voxels die = sample(scene.field("die"), box, 144), cube = sample(scene.field("cube"), box, 144);
  EXPECT_EQ(euler_characteristic(die), 1);
  EXPECT_EQ(components(die), 1u);
  // The balls stand on the flat faces' places; every pip is a hollow of the bulging ones: at its ball's
  // centre the cube has material half a radius deeper and the die has none.
  std::size_t pips = 0;
  const ScalarField f = scene.field("die"), whole = scene.field("cube");
  for (const NodeSpec& node : scene.spec().nodes)
    if (const auto move = node.values.find("move"); move != node.values.end()) {
      const auto& at = std::get<std::vector<double>>(move->second);
      const Vec3 centre(at[0], at[1], at[2]);
      const Vec3 deeper =
          centre - 0.09 * (centre.cwiseAbs().array() == 1.0).select(centre, Vec3::Zero()).matrix();
      EXPECT_GT(inside(whole.level(), whole.value(deeper)), 0.0);
      EXPECT_LT(inside(f.level(), f.value(deeper)), 0.0);
      ++pips;
    }
  EXPECT_EQ(pips, 21u);
  EXPECT_GT(std::count(cube.inside.begin(), cube.inside.end(), 1),
            std::count(die.inside.begin(), die.inside.end(), 1));
}

TEST(SceneS0_4, FacesAreFlatAndEdgesRound) {
  const ExampleScene scene("s0-4");
  const ScalarField cube = scene.field("cube");
  EXPECT_EQ(cube.value({1.0, 0.5, 0.5}), 0.0);
  EXPECT_EQ(cube.value({0.5, -1.0, 0.5}), 0.0);
  const PointFunction f = depth(cube);
  EXPECT_TRUE(prints_as(radius(f, {0, 0, 0.5}, {1, 1, 0}, 3.0) / std::numbers::sqrt2, "0.912132"));
  EXPECT_TRUE(prints_as(radius(f, Vec3::Zero(), {1, 1, 1}, 3.0) / std::numbers::sqrt3, "0.863599"));
  // Ricci's cube of s0-3 is nowhere flat: the same check on it fails.
  EXPECT_NE(ExampleScene("s0-3").field("cube").value({1.0, 0.5, 0.5}), 1.0);
}

/// The law of a chain of scale unions with r = 0.5: never above the nearest, equal to it where all others are
/// more than `factor` times as far. Returns how many of the points at which the law claims equality break it.
std::size_t untouched_law(const ExampleScene& scene, const std::string& result,
                          const std::vector<std::string>& members, double half, double factor) {
  std::vector<Vec3> points;
  Rng rng(1);
  for (int i = 0; i < 50000; ++i) points.push_back(random_point(rng, half));
  const std::vector<double> B = values(scene.field(result))(points);
  std::vector<std::vector<double>> x;
  for (const std::string& m : members) x.push_back(values(scene.field(m))(points));
  std::size_t claimed = 0, broken = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> sorted;
    for (const auto& member : x) sorted.push_back(member[i]);
    std::sort(sorted.begin(), sorted.end());
    EXPECT_LE(B[i], sorted[0] * (1.0 + 1e-14));  // rounding of the root, some units of 2e-16
    if (sorted[1] <= factor * sorted[0]) continue;
    ++claimed;
    if (B[i] != sorted[0]) ++broken;
  }
  EXPECT_GT(claimed, 500u);
  return broken;
}

TEST(SceneS0_5a, ScaleUnionIsTheNearestCylinderAwayFromTheJoint) {
  const ExampleScene scene("s0-5a");
  const std::vector<std::string> members = {"cylinder 0", "cylinder 45", "cylinder 90", "cylinder 135"};
  EXPECT_EQ(untouched_law(scene, "star", members, 6.0, 2.25), 0u);
  // With one stage's range, 1.5, the law does not hold for a chain: the check can fail.
  EXPECT_GT(untouched_law(scene, "star", members, 6.0, 1.5), 0u);
}

TEST(SceneS0_5a, IsOnePieceInsideTheBall) {
  const Voxels v = sample(ExampleScene("s0-5a").field(), {Vec3::Constant(-3.6), Vec3::Constant(3.6)}, 97);
  EXPECT_EQ(euler_characteristic(v), 1);
  EXPECT_EQ(components(v), 1u);
}

TEST(SceneS0_5b, IsASmoothRing) {
  const ExampleScene scene("s0-5b");
  const ScalarField ring = scene.field();
  const Voxels v = sample(ring, {Vec3::Constant(-8.0), Vec3::Constant(8.0)}, 128);
  EXPECT_EQ(euler_characteristic(v), 0);
  EXPECT_EQ(components(v), 1u);
  std::vector<std::string> sides;
  for (int k = 1; k <= 6; ++k) sides.push_back("side " + std::to_string(k));
  EXPECT_EQ(untouched_law(scene, "ring", sides, 8.0, 2.25), 0u);
  // The order of joining breaks the symmetry of 60 degrees, but not by much.
  double largest = 0.0;
  for_all([&](Rng& rng) {
    const Vec3 p = random_point(rng, 8.0);
    const Vec3 q = Eigen::AngleAxisd(std::numbers::pi / 3.0, Vec3::UnitZ()) * p;
    largest = std::max(largest, std::abs(ring.value(p) - ring.value(q)));
  });
  EXPECT_GT(largest, 1e-3);
}

TEST(SceneS0_6, SphereIsTheSameForEverySoftness) {
  const ExampleScene scene("s0-6");
  ASSERT_EQ(scene.solids().size(), 5u);
  std::vector<double> between;
  for (const std::string& solid : scene.solids()) {
    const ScalarField f = scene.field(solid);
    EXPECT_NEAR(radius(depth(f), Vec3::Zero(), {1, 2, 2}, 40.0), 10.0, 1e-13 * 10.0);
    EXPECT_NEAR(f.value({10, 0, 0}), 0.5, 1e-15);
    EXPECT_EQ(f.value({0, 0, 20.0}), 0.0);
    EXPECT_EQ(f.value({0, 25.0, 0}), 0.0);
    EXPECT_GT(f.value({0, 0, 19.99}), 0.0);
    between.push_back(f.value({15, 0, 0}));
  }
  // The fields differ: a softer one has fallen further halfway through the zone.
  for (std::size_t i = 1; i < between.size(); ++i) EXPECT_LT(between[i], between[i - 1]);
}

TEST(SceneS0_7cd, ThinCylinderIsUndeformedWhereTheThickFieldHasEnded) {
  const ExampleScene scene("s0-7cd");
  const ScalarField thin = scene.field("soft thin"), distance = scene.field("thick");
  const ScalarField wide = scene.field("wide thick"), narrow = scene.field("narrow thick");
  const ScalarField c = scene.field("c"), d = scene.field("d");
  std::size_t between = 0, changed = 0;
  for_all(
      [&](Rng& rng) {
        const Vec3 p(uniform(rng, 10.0, 30.0), uniform(rng, -5.0, 5.0), uniform(rng, -5.0, 5.0));
        const double x = distance.value(p);
        EXPECT_EQ(wide.value(p) > 0.0, x < 1.0);
        EXPECT_EQ(narrow.value(p) > 0.0, x < 0.75);
        if (x >= 0.75) {
          EXPECT_EQ(d.value(p), thin.value(p));
          if (x < 1.0) {
            ++between;
            if (c.value(p) != thin.value(p)) ++changed;
          }
        }
        if (x >= 1.0) {
          EXPECT_EQ(c.value(p), thin.value(p));
        }
        EXPECT_GE(c.value(p), d.value(p));  // the fillet of (d) is the smaller one
      },
      2000);
  EXPECT_GT(between, 100u);
  EXPECT_EQ(changed, between);
  // In the plane of the axes the joint stands further out in (c).
  const auto joint = [](const ScalarField& f) { return radius(depth(f), {0, 0, 4}, {1, 0, 0.2}, 40.0); };
  EXPECT_GT(joint(c), joint(d) + 0.1);
  EXPECT_GE(joint(d), 10.0);
}

TEST(SceneS0_8, UnionsFollowTheirCurves) {
  const ExampleScene scene("s0-8");
  const ScalarField f1 = scene.field("f1"), f2 = scene.field("f2");
  const ScalarField g1 = scene.field("g1"), g2 = scene.field("g2");
  const PointFunction sum = depth(scene.field("soft-blend")), scale = depth(scene.field("scale-union"));
  const PointFunction arc = depth(scene.field("hoffmann-union"));
  for (double x = 10.01; x < 19.5; x += 0.37) {
    // In the joint between the walls: from the diagonal's side of x up to the other wall.
    const auto at = [&](const PointFunction& f) {
      return Vec3(x, radius(f, {x, 0, 0}, {0, 1, 0}, 25.0), 0.0);
    };
    const Vec3 p = at(sum), q = at(scale);
    // Values are within 4e-16 of exact; the radius is exact to rounding, 2e-15, and fields change by less
    // than 0.2 per mm.
    EXPECT_NEAR(f1.value(p) + f2.value(p), 0.5, 1e-14);
    EXPECT_NEAR(std::hypot(f1.value(q), f2.value(q)), 0.5, 1e-14);
    EXPECT_GT(std::abs(f1.value(q) + f2.value(q) - 0.5), 1e-9);  // the curves differ
  }
  for (double x = 10.01; x < 15.0; x += 0.17) {
    const Vec3 p(x, radius(arc, {x, 0, 0}, {0, 1, 0}, 25.0), 0.0);
    EXPECT_NEAR(std::hypot(g1.value(p) - 0.5, g2.value(p) - 0.5), 0.5, 1e-14);
  }
  // End points: (1/2, 0) and (0, 1/2).
  EXPECT_NEAR(radius(sum, {20, 0, 0}, {0, 1, 0}, 25.0), 10.0, 1e-13);
  EXPECT_NEAR(radius(scale, {20, 0, 0}, {0, 1, 0}, 25.0), 10.0, 1e-13);
  EXPECT_EQ(f1.value({20, 10, 0}), 0.0);
  EXPECT_NEAR(f2.value({20, 10, 0}), 0.5, 1e-15);
  EXPECT_NEAR(radius(arc, {15, 0, 0}, {0, 1, 0}, 25.0), 10.0,
              1e-7);  // tangent there: the root is a double one
}

}  // namespace
}  // namespace blendwright::test
