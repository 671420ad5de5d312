#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/verify/judged.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Judge, SelfIntersectionFails) {
  const Surface eight = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{sin(v), sin(2.0 * v), u};
  });
  BlendUnderTest blend{
      "eight", eight, {Seam{"eight/from", eight, 0, {}, {}, true}, Seam{"eight/to", eight, 1, {}, {}, true}}};
  EXPECT_EQ(failed_checks(blend), Names{"self-intersection"});
  EXPECT_THAT(failures(blend)[0].text, HasSubstr("passes through itself"));
}

TEST(Judge, PenetrationFailsOnlyBeyondTheTolerance) {
  const auto plane_joint = [](double depth) {
    // (1-u)^2 (1 - a u) dips by `depth`: min at u = (a + 2) / (3 a).
    const auto dive = ramp([depth](const auto& u) {
      const auto w = 1.0 - u;
      return w * w * w * (1.0 + 3.0 * u) - 64.0 * depth * u * u * u * w * w * w;
    });
    const Seam from{"ramp/from", dive, 0, {}, {}, true};
    const Seam to{"ramp/to", dive, 1, plane_patch(), isoline_u(1.0, {{-1.0, 1.0}, false}), false};
    return BlendUnderTest{"ramp", dive, {from, to}, false};
  };
  EXPECT_EQ(failed_checks(plane_joint(0.0)), Names{});
  // At u = 1/2 the height is (1/8)(5/2) - depth.
  const auto deep = plane_joint(0.5);
  EXPECT_EQ(failed_checks(deep), Names{"penetration"});
  EXPECT_THAT(failures(deep)[0].text, StartsWith("ramp/to: penetration of the primary 0."));
  EXPECT_EQ(failures(deep, g2, {1.0, Radians(1.0), 1e3}).size(), 0u);
}

TEST(Judge, DegenerateSurfaceFails) {
  const auto still = revolution(
      turn, [](const auto&) { return 1.0; }, [](const auto& u) { return 1.0 + 0.0 * u; });
  auto blend = between_cylinders(still);
  blend.seams[1].primary.reset();
  const Names names = failed_checks(blend);
  EXPECT_TRUE(names.contains("degenerate surface"));
  EXPECT_TRUE(names.contains("angle"));
}

TEST(Judge, SmallTransversalityIsAWarning) {
  const Surface oblique = surface({{0.0, 1.0}, {-1.0, 1.0}, false, false}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u, v + 20.0 * u, u * u * u};
  });
  BlendUnderTest blend{"ramp", oblique, {on_plane(oblique), Seam{"ramp/to", oblique, 1, {}, {}, true}}};
  EXPECT_EQ(failed_checks(blend), Names{});
  const std::vector<Finding> found = judge(verify_blend(blend, "formula"), g2, Tolerance{});
  const auto warning =
      std::find_if(found.begin(), found.end(), [](const Finding& f) { return f.check == "transversality"; });
  ASSERT_NE(warning, found.end());
  EXPECT_THAT(warning->text, HasSubstr("0.0499 is below 0.1"));
}

TEST(Judge, OpenEndOfAClosedBlendFailsTheClosingSeam) {
  const Surface spiral = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const T w = u * (1.0 - u);
    const T r = 1.0 + 1e-3 * w * w * w * v;
    return std::array<T, 3>{r * cos(v), r * sin(v), 1.0 + 2.0 * u};
  });
  auto blend = between_cylinders(spiral);
  EXPECT_EQ(failed_checks(blend), Names{"closing seam"});
  EXPECT_THAT(failures(blend)[0].text, HasSubstr("closing seam gap 9.8"));  // 1e-3 2 pi / 64
  blend.closed = false;
  EXPECT_EQ(failed_checks(blend), Names{});
}

}  // namespace
}  // namespace blendwright
