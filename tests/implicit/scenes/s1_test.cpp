// Criteria of the scenes s1-2 to s1-7: dilation and erosion of distances.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/implicit/scenes/rays.hpp"
#include "tests/implicit/scenes/voxels.hpp"

namespace blendwright::test {
namespace {

const Vec3 x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

/// The radius of d = 1, twice that of the drawn object d = 1/2.
double R(const ExampleScene& scene, const std::string& solid, const Vec3& direction) {
  return 2.0 * radius(depth(scene.field(solid)), Vec3::Zero(), direction, 100.0);
}
/// The same for many directions.
PointFunction R(const ExampleScene& scene, const std::string& solid) {
  return [f = depth(scene.field(solid))](std::span<const Vec3> directions) {
    std::vector<double> r = radii(f, Vec3::Zero(), directions, 100.0);
    for (double& x : r) x *= 2.0;
    return r;
  };
}
/// How far the tool stays inside the object: the lowest T / d over directions, above 1.
double lowest_ratio(const ExampleScene& scene) {
  const PointFunction d = values(scene.field("sphere")), T = values(scene.field("tool"));
  return lowest([&](std::span<const Vec3> directions) {
           std::vector<double> ratio = T(directions);
           const std::vector<double> below = d(directions);
           for (std::size_t i = 0; i < ratio.size(); ++i) ratio[i] /= below[i];
           return ratio;
         })
      .height;
}
/// A maximum at +d and at -d.
void expect_pair(const std::vector<Peak>& peaks, const Vec3& d) {
  for (const Vec3& at : {d, Vec3(-d)})
    EXPECT_EQ(std::count_if(peaks.begin(), peaks.end(),
                            [&](const Peak& p) { return (p.direction - at).norm() < 1e-5; }),
              1)
        << at.transpose();
}

TEST(SceneS1_2, WheelHasFourHoles) {
  const Voxels v = sample(ExampleScene("s1-2").field(), {Vec3::Constant(-8), Vec3::Constant(8)}, 128);
  EXPECT_EQ(components(v), 1u);
  EXPECT_EQ(euler_characteristic(v), -3);
}

TEST(SceneS1_3, DentsGetShallower) {
  const ExampleScene scene("s1-3");
  const struct {
    const char *solid, *pole, *equator;
  } rows[] = {{"n=1", "20", "30"},
              {"n=1.3", "25.6503", "32.8343"},
              {"n=1.7", "29.8553", "34.2410"},
              {"n=2.5", "33.2517", "34.8918"}};
  for (const auto& [solid, pole, equator] : rows) {
    SCOPED_TRACE(solid);
    EXPECT_TRUE(prints_as(R(scene, solid, z_axis), pole));
    EXPECT_TRUE(prints_as(R(scene, solid, -z_axis), pole));
    EXPECT_TRUE(prints_as(R(scene, solid, x_axis), equator));
    EXPECT_TRUE(prints_as(R(scene, solid, {1, -2, 0}), equator));
  }
  EXPECT_NEAR(R(scene, "n=1", z_axis), 20.0, 1e-12);
  EXPECT_TRUE(prints_as(lowest_ratio(scene), "2.3333"));
}

TEST(SceneS1_3, ToolThatReachesThroughIsRefused) {
  const ExampleScene long_tool = ExampleScene("s1-3").with("tool", "c", 36.0);
  try {
    (void)long_tool.field("n=1");
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(scene_error::erosion_overreach), std::string::npos) << e.what();
  }
}

TEST(SceneS1_4d, HasTwoBalls) {
  const ExampleScene scene("s1-4d");
  const std::vector<Peak> peaks = isolated_maxima(R(scene, "two-balls"));
  ASSERT_EQ(peaks.size(), 2u);
  expect_pair(peaks, x_axis);
  for (const Peak& p : peaks) EXPECT_TRUE(prints_as(p.height, "30"));
  EXPECT_NEAR(R(scene, "two-balls", x_axis), 30.0, 1e-12);
  EXPECT_NEAR(R(scene, "two-balls", y_axis), 20.0, 1e-12);
}

TEST(SceneS1_4e, HasFourBalls) {
  const ExampleScene scene("s1-4e");
  const std::vector<Peak> peaks = isolated_maxima(R(scene, "four-balls"));
  ASSERT_EQ(peaks.size(), 4u);
  expect_pair(peaks, x_axis);
  expect_pair(peaks, y_axis);
  for (const Peak& p : peaks) EXPECT_NEAR(p.height, 25.0, 1e-12);
  EXPECT_TRUE(prints_as(R(scene, "four-balls", {1, 1, 0}), "22.1911"));
  EXPECT_NEAR(R(scene, "four-balls", z_axis), 10.0, 1e-12);
  EXPECT_TRUE(prints_as(lowest_ratio(scene), "1.4"));
}

TEST(SceneS1_5d, PolesAreUnequal) {
  const ExampleScene scene("s1-5d");
  EXPECT_NEAR(R(scene, "unequal", z_axis), 17.0, 1e-12);
  EXPECT_NEAR(R(scene, "unequal", -z_axis), 29.0, 1e-12);
  EXPECT_NEAR(R(scene, "unequal", x_axis), 30.0, 1e-12);
  EXPECT_NEAR(R(scene, "unequal", {3, -4, 0}), 30.0, 1e-12);
}

TEST(SceneS1_5e, PolesAreEqual) {
  const ExampleScene scene("s1-5e");
  EXPECT_NEAR(R(scene, "equal", z_axis), 20.0, 1e-12);
  EXPECT_NEAR(R(scene, "equal", -z_axis), 20.0, 1e-12);
}

TEST(SceneS1_6, SpikesFadeToASphere) {
  const ExampleScene scene("s1-6");
  const struct {
    const char *solid, *z, *x;
  } rows[] = {{"n=1", "41", "29"},
              {"n=1.4", "33.9585", "26.3581"},
              {"n=1.8", "30.7064", "25.5088"},
              {"n=2.6", "27.7635", "25.0818"},
              {"n=5.2", "25.4545", "25.0003"}};
  for (const auto& [solid, z, x] : rows) {
    SCOPED_TRACE(solid);
    EXPECT_TRUE(prints_as(R(scene, solid, z_axis), z));
    EXPECT_TRUE(prints_as(R(scene, solid, x_axis), x));
  }
  EXPECT_NEAR(R(scene, "n=1", z_axis), 41.0, 1e-12);
  expect_pair(isolated_maxima(R(scene, "n=1")), z_axis);
}

TEST(SceneS1_7, ErosionRestoresTheEquator) {
  const ExampleScene scene("s1-7");
  const struct {
    const char* solid;
    double equator, pole;
  } rows[] = {{"round", 20, 20}, {"dilated", 25, 35}, {"eroded", 20, 30}};
  for (const auto& [solid, equator, pole] : rows) {
    SCOPED_TRACE(solid);
    EXPECT_NEAR(R(scene, solid, {1, 1, 0}), equator, 1e-12);
    EXPECT_NEAR(R(scene, solid, z_axis), pole, 1e-12);
  }
}

}  // namespace
}  // namespace blendwright::test
