// Colour modes: their table, their columns and the scales of their colours.
#include "app/pipeline/show.hpp"

#include <gtest/gtest.h>

#include <set>

#include "kernel/base/error.hpp"
#include "tests/app/picture/picture_models.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

TEST(Show, EveryModeHasARowUnderItsNumberAndAName) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < show_table().size(); ++i) {
    const ShowRow& row = show_table()[i];
    EXPECT_EQ(static_cast<std::size_t>(row.show), i);
    EXPECT_EQ(show_named(row.name), row.show);
    EXPECT_FALSE(row.description.empty());
    names.insert(row.name);
  }
  EXPECT_EQ(names.size(), show_table().size());
  EXPECT_EQ(show_named("zebras"), std::nullopt);
}

TEST(Show, UnitsFollowTheModelAndStandInTheBarsTitle) {
  ShowOptions options;
  options.unit = LengthUnit::inch;
  EXPECT_EQ(bar_title(Show::gap, options), "gap (in)");
  EXPECT_EQ(bar_title(Show::curvature, options), "mean curvature (1/in)");
  options.curvature = CurvatureFigure::gaussian;
  EXPECT_EQ(bar_title(Show::curvature, options), "Gaussian curvature (1/in^2)");
  EXPECT_EQ(bar_title(Show::draft, options), "draft angle (deg)");
  EXPECT_EQ(bar_title(Show::zebra, options), "");
}

TEST(Show, RadiusAndPrincipalCurvaturesComeFromMeanAndGaussian) {
  TriMesh mesh = test::ball(2.5);
  ASSERT_TRUE(add_column(mesh, Show::radius, {}));
  ShowOptions largest;
  largest.curvature = CurvatureFigure::largest;
  ASSERT_TRUE(add_column(mesh, Show::curvature, largest));
  // sqrt(H^2 - K) of an umbilic is the root of rounding: sqrt(2^-52) relative to H.
  for (const double r : find_column(mesh, "least_radius")->values) EXPECT_NEAR(r, 2.5, 2.5 * 3e-8);
  for (const double k : find_column(mesh, "largest_curvature")->values) EXPECT_NEAR(k, 0.4, 0.4 * 3e-8);
  EXPECT_DOUBLE_EQ(least_radius(0.5, 0.0), 1.0);       // a cylinder of radius 1: k = 1, 0
  EXPECT_DOUBLE_EQ(least_curvature(0.0, -4.0), -2.0);  // a saddle
  EXPECT_TRUE(std::isinf(least_radius(0.0, 0.0)));     // a plane
}

TEST(Show, ColumnsThatAMeshCannotGiveAreNotInvented) {
  TriMesh bare = test::ball(1.0);
  bare.columns.clear();
  EXPECT_FALSE(add_column(bare, Show::gap, {}));
  EXPECT_FALSE(add_column(bare, Show::radius, {}));
  EXPECT_TRUE(add_column(bare, Show::draft, {}));
  bare.normals.clear();
  EXPECT_FALSE(add_column(bare, Show::draft, {}));  // the old one is not kept either
  EXPECT_EQ(find_column(bare, "draft_deg"), nullptr);
}

TEST(Show, DraftIsZeroAlongThePullAndRightAngledAcross) {
  ShowOptions options;
  options.pull = Vec3(0.0, 1.0, 0.0);
  EXPECT_DOUBLE_EQ(draft_deg(Vec3::UnitX(), options), 0.0);
  EXPECT_DOUBLE_EQ(draft_deg(Vec3::UnitY(), options), 90.0);
  EXPECT_DOUBLE_EQ(draft_deg(-Vec3::UnitY(), options), -90.0);
  // asin loses no digits at 30 degrees.
  EXPECT_NEAR(draft_deg(Vec3(std::sqrt(0.75), 0.5, 0.0), options), 30.0, 1e-12);
}

/// The reflected line of sight does not know which side a normal is on; the light does not either.
TEST(Show, StripesAreTheSameFromBothSidesOfTheSurface) {
  test::for_all([](test::Rng& rng) {
    const Vec3 n =
        Vec3(test::uniform(rng, -1, 1), test::uniform(rng, -1, 1), test::uniform(rng, -1, 1)).normalized();
    const ShowOptions options;
    EXPECT_NEAR(zebra_phase(n, options), zebra_phase(-n, options), 1e-12);
    EXPECT_DOUBLE_EQ(light_angle_deg(n, options), light_angle_deg(-n, options));
  });
}

/// Turning the normal by d about the strips' direction turns the reflection by 2 d: the phase advances by
/// stripes 2 d / pi.
TEST(Show, StripesMoveWithTwiceTheTurnOfTheNormal) {
  ShowOptions options;
  options.stripes = 10.0;
  const auto tilted = [](double angle) { return Vec3(0.0, std::sin(angle), std::cos(angle)); };
  const double d = 0.05;
  for (const double start : {-0.6, -0.2, 0.1, 0.5})
    EXPECT_NEAR(zebra_phase(tilted(start), options) - zebra_phase(tilted(start + d), options),
                10.0 * 2.0 * d / std::numbers::pi, 1e-9);
  // Straight ahead is the middle of a light strip; half a pair further is a dark one.
  EXPECT_EQ(zebra_value(tilted(0.0), options), 1.0);
  EXPECT_EQ(zebra_value(tilted(0.02), options), 1.0);
  EXPECT_EQ(zebra_value(tilted(0.02 + std::numbers::pi / 40.0), options), 0.0);
}

TEST(Show, FramesOfNormalsAreColouredAsSingleOnes) {
  const TriMesh mesh = test::ball(1.0, 8, 16);
  std::vector<float> normals;
  for (const Vec3& n : mesh.normals)
    for (int k = 0; k < 3; ++k) normals.push_back(static_cast<float>(n[k]));
  std::vector<float> out(mesh.normals.size());
  const ShowOptions options;
  values_of_normals(Show::draft, options, normals, out);
  // Floats of unit normals are right to 6e-8; asin is steepest at 90 degrees: sqrt(2 * 6e-8) rad = 0.02 deg.
  for (std::size_t i = 0; i < out.size(); ++i)
    EXPECT_NEAR(static_cast<double>(out[i]), draft_deg(mesh.normals[i], options), 0.03);
  EXPECT_THROW(values_of_normals(Show::gap, options, normals, out), InputError);
  out.pop_back();
  EXPECT_THROW(values_of_normals(Show::draft, options, normals, out), InputError);
}

TEST(ColourScale, SignedFiguresAreSymmetricAboutTheMiddleColour) {
  const ColourScale scale = ColourScale::over({-1.0, 0.2, 3.0}, ScaleRule::diverging);
  EXPECT_EQ(scale.map(), ColourMap::diverging);
  EXPECT_DOUBLE_EQ(scale.axis().lo, -scale.axis().hi);
  const auto middle = scale.bytes(0.0);
  EXPECT_LE(std::max({middle[0], middle[1], middle[2]}) - std::min({middle[0], middle[1], middle[2]}), 4);
  EXPECT_GT(scale.bytes(3.0)[0], scale.bytes(3.0)[2] + 100);    // red
  EXPECT_GT(scale.bytes(-3.0)[2], scale.bytes(-3.0)[0] + 100);  // blue
}

TEST(ColourScale, DecadesMakeItLogarithmicWhereThereAreMany) {
  EXPECT_TRUE(ColourScale::over({1e-9, 1e-5}, ScaleRule::by_decades).axis().logarithmic);
  EXPECT_FALSE(ColourScale::over({1e-6, 1e-5}, ScaleRule::by_decades).axis().logarithmic);
  EXPECT_FALSE(ColourScale::over({-1e-9, 1e-5}, ScaleRule::by_decades).axis().logarithmic);
  EXPECT_TRUE(ColourScale::over({1e-6, 1e-5}, ScaleRule::logarithmic).axis().logarithmic);
}

TEST(ColourScale, NothingIsGreyAndInfinityIsTheEnd) {
  const ColourScale scale = ColourScale::over({0.0, 1.0, INFINITY}, ScaleRule::linear);
  EXPECT_EQ(scale.bytes(NAN), (std::array<std::uint8_t, 3>{153, 153, 153}));
  EXPECT_EQ(scale.bytes(INFINITY), scale.bytes(1.0));
  const std::vector<float> values{0.0f, 1.0f};
  std::vector<std::uint8_t> rgb(6);
  scale.colour(values, rgb);
  EXPECT_EQ(rgb[0], scale.bytes(0.0)[0]);
  EXPECT_EQ(rgb[5], scale.bytes(1.0)[2]);
  rgb.pop_back();
  EXPECT_THROW(scale.colour(values, rgb), InputError);
}

/// CIELAB of an sRGB colour, from its definition (IEC 61966-2-1, D65).
Vec3 lab(const Colour& c) {
  const auto linear = [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
  const double r = linear(c.r), g = linear(c.g), b = linear(c.b);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047),
               y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b),
               z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// Equal steps of the value look alike: steps of CIELAB differ by less than a factor. A rainbow's do not.
double unevenness(Colour (*map)(double)) {
  double least = 1e9, most = 0.0;
  constexpr int n = 32;
  for (int i = 0; i < n; ++i) {
    const double step =
        (lab(map(static_cast<double>(i + 1) / n)) - lab(map(static_cast<double>(i) / n))).norm();
    least = std::min(least, step);
    most = std::max(most, step);
  }
  return most / least;
}
Colour rainbow(double t) {
  return {std::clamp(std::abs(6.0 * t - 3.0) - 1.0, 0.0, 1.0),
          std::clamp(2.0 - std::abs(6.0 * t - 2.0), 0.0, 1.0),
          std::clamp(2.0 - std::abs(6.0 * t - 4.0), 0.0, 1.0)};
}
TEST(ColourScale, MapsArePerceptuallyEven) {
  // Viridis is even in CAM02-UCS and the diverging map in Moreland's Msh; CIELAB sees both within 3.
  EXPECT_LT(unevenness(viridis), 3.0);
  EXPECT_LT(unevenness(cool_warm), 3.0);
  EXPECT_GT(unevenness(rainbow), 5.0);
  for (int i = 0; i < 32; ++i) EXPECT_LT(lab(viridis(i / 32.0)).x(), lab(viridis((i + 1) / 32.0)).x());
  for (const double t : {0.1, 0.3, 0.45})
    EXPECT_NEAR(lab(cool_warm(t)).x(), lab(cool_warm(1.0 - t)).x(), 1.0);
}

}  // namespace
}  // namespace blendwright
