// Criteria of the scenes s0-9 to s0-14: transitions between a bar and a plate, and variable influential
// radii.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/implicit/scenes/rays.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

struct Contour {
  double axis, diagonal;  ///< radii at 0 and 45 degrees
};
Contour contour(const ScalarField& body, double z) {
  const PointFunction f = depth(body);
  return {radius(f, {0, 0, z}, {1, 0, 0}, 50.0), radius(f, {0, 0, z}, {1, 1, 0}, 50.0)};
}

/// w1 = 2 d / f_c - 1, which is the same along a ray.
PointFunction w1(const ScalarField& d, const ScalarField& fc) {
  return [D = values(d), C = values(fc)](std::span<const Vec3> directions) {
    std::vector<double> w = D(directions);
    const std::vector<double> c = C(directions);
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = 2.0 * w[i] / c[i] - 1.0;
    return w;
  };
}
double lowest_w1(const ScalarField& d, const ScalarField& fc) { return lowest(w1(d, fc)).height; }
/// In the plane z = 0. The angles contain the axes and the diagonals, where sections with these symmetries
/// have their extremes.
double lowest_plane_w1(const ScalarField& d, const ScalarField& fc) {
  std::vector<Vec3> directions;
  for (int k = 0; k < 7200; ++k) {
    const double t = 2.0 * std::numbers::pi * k / 7200.0;
    directions.emplace_back(std::cos(t), std::sin(t), 0.0);
  }
  const std::vector<double> w = w1(d, fc)(directions);
  return *std::min_element(w.begin(), w.end());
}

/// On the plate's surface d2 = 1/2, where d1 > 1/2: the bar's field is positive exactly inside the contour.
struct FootprintLaw {
  std::size_t samples = 0, inside = 0, violations = 0;
};
FootprintLaw footprint_law(const ExampleScene& scene, const std::string& bar, const std::string& contour) {
  const PointFunction d1 = values(scene.field("bar")), d2 = values(scene.field("plate"));
  const PointFunction f1 = values(scene.field(bar)), fc = values(scene.field(contour));
  std::vector<Vec3> points;
  Rng rng(7);
  for (int i = 0; i < 400000; ++i) {  // even in the plane, so that the contour is well covered
    const Vec3 p(uniform(rng, -16.0, 16.0), uniform(rng, -16.0, 16.0), 6.0);
    points.push_back(p);
  }
  const std::vector<double> height = d2(points);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] *= 0.5 / height[i];  // the plate is ray-linear
  const std::vector<double> D = d1(points), F = f1(points), C = fc(points);
  FootprintLaw law;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (D[i] <= 0.5) continue;
    ++law.samples;
    if (C[i] < 1.0) ++law.inside;
    if ((F[i] > 0.0) != (C[i] < 1.0)) ++law.violations;
  }
  return law;
}
void expect_footprint(const ExampleScene& scene, const std::string& bar, const std::string& contour) {
  const FootprintLaw law = footprint_law(scene, bar, contour);
  EXPECT_GT(law.samples, 300000u);
  EXPECT_GT(law.inside, 1000u);
  EXPECT_GT(law.samples - law.inside, 1000u);
  EXPECT_EQ(law.violations, 0u);
}

TEST(SceneS0_9, TransitionHasTheOutlineOfTheBar) {
  const ExampleScene scene("s0-9");
  const auto [axis, diagonal] = contour(scene.field("prism"), 7.0);
  EXPECT_TRUE(prints_as(axis, "5.7397"));
  EXPECT_TRUE(prints_as(diagonal, "4.3226"));
  EXPECT_TRUE(prints_as(diagonal / axis, ".7531"));
  const Contour square = contour(scene.field("square"), 7.0);
  EXPECT_GT(square.diagonal, square.axis);
}

struct TransitionRow {
  const char *n1, *axis, *diagonal;
};
void expect_rows(const char* name, std::initializer_list<TransitionRow> rows) {
  const ExampleScene scene(name);
  double last = 0.0;
  for (const TransitionRow& row : rows) {
    SCOPED_TRACE(row.n1);
    const auto [axis, diagonal] = contour(scene.field(std::string("n1=") + row.n1), 7.0);
    EXPECT_TRUE(prints_as(axis, row.axis));
    EXPECT_TRUE(prints_as(diagonal, row.diagonal));
    EXPECT_GT(diagonal, last);
    last = diagonal;
  }
}

TEST(SceneS0_10, TransitionsFollowTheirContours) {
  expect_rows("s0-10", {{"0.6", "5.3293", "5.5124"},
                        {"1.1", "5.3293", "6.1032"},
                        {"2", "5.3293", "6.5773"},
                        {"20", "5.3293", "7.2800"}});
}

/// Area of the plane z = 0 where the bar's field is positive, outside the bar.
double zone_area(const ScalarField& bar) {
  // Radii have kinks at the corners of the contour: the even sum is then good to the square of the step,
  // (2 pi / 40000)^2 * 14^2 * (change of slope, up to 2): 1e-5.
  return area(section(values(bar), 0.0, 40000, 50.0)) - area(section(depth(bar), 0.0, 40000, 50.0));
}

TEST(SceneS0_11, ZoneIsBoundedByTheSuperEllipse) {
  const ExampleScene scene("s0-11");
  EXPECT_TRUE(prints_as(zone_area(scene.field("bar n=4")), "455.43"));
  EXPECT_TRUE(prints_as(zone_area(scene.field("bar n=0.8")), "224.29"));
  const auto super_ellipse = [](double a, double n) {
    return 4.0 * a * a * std::pow(std::tgamma(1.0 + 1.0 / n), 2) / std::tgamma(1.0 + 2.0 / n);
  };
  EXPECT_NEAR(zone_area(scene.field("bar n=4")), super_ellipse(12.0, 4.0) - 25.0 * std::numbers::pi, 1e-4);
  EXPECT_NEAR(zone_area(scene.field("bar n=0.8")), super_ellipse(14.0, 0.8) - 25.0 * std::numbers::pi, 1e-3);
  EXPECT_TRUE(prints_as(lowest_plane_w1(scene.field("bar"), scene.field("contour n=4")), "1.4"));
  EXPECT_TRUE(prints_as(lowest_plane_w1(scene.field("bar"), scene.field("contour n=0.8")), ".6649"));
}

TEST(SceneS0_12ab, TransitionIsThatOfFigure9) {
  const ExampleScene scene("s0-12ab");
  const auto [axis, diagonal] = contour(scene.field(), 7.0);
  EXPECT_TRUE(prints_as(axis, "5.7397"));
  EXPECT_TRUE(prints_as(diagonal, "4.3226"));
}

TEST(SceneS0_12cn, TransitionsFollowTheirContours) {
  expect_rows("s0-12cn", {{"0.6", "5.7397", "3.2521"},
                          {"1.2", "5.7397", "4.4639"},
                          {"1.5", "5.7397", "4.8020"},
                          {"2", "5.7397", "5.1817"},
                          {"3", "5.7397", "5.6078"},
                          {"20", "5.7397", "6.4553"}});
}

/// Radii of f_c(x, y, 6) = 1.
void expect_footprint_radii(const ExampleScene& scene, const std::string& n1, const char* axis,
                            const char* diagonal) {
  const PointFunction f = depth(scene.field("contour n1=" + n1));
  EXPECT_TRUE(prints_as(radius(f, {0, 0, 6}, {1, 0, 0}, 50.0), axis));
  EXPECT_TRUE(prints_as(radius(f, {0, 0, 6}, {1, 1, 0}, 50.0), diagonal));
}

TEST(SceneS0_12cn, FieldEndsAtTheContourOnThePlate) {
  const ExampleScene scene("s0-12cn");
  const std::pair<const char*, const char*> rows[] = {{"0.6", "3.5636"}, {"1.2", "6.3496"},
                                                      {"1.5", "7.1272"}, {"2", "8.0000"},
                                                      {"3", "8.9797"},   {"20", "10.9283"}};
  for (const auto& [n1, diagonal] : rows) {
    SCOPED_TRACE(n1);
    expect_footprint_radii(scene, n1, "8", diagonal);
    expect_footprint(scene, std::string("bar n1=") + n1, std::string("contour n1=") + n1);
  }
  // The law tells contours apart: with another bar's contour it is broken.
  EXPECT_GT(footprint_law(scene, "bar n1=2", "contour n1=3").violations, 1000u);
}

TEST(SceneS0_13, SixLobedBarHasAFivePointedTransition) {
  const ExampleScene scene("s0-13");
  EXPECT_TRUE(prints_as(lowest_w1(scene.field("bar"), scene.field("contour")), ".5909"));
  const auto radii_at = [&](const char* solid, double z) {
    return section(depth(scene.field(solid)), z, 3600, 50.0);
  };
  const auto ends = [](const std::vector<double>& r) { return std::minmax_element(r.begin(), r.end()); };
  const std::vector<double> foot = radii_at("d", 6.0 + 1e-12);
  EXPECT_EQ(count_maxima(foot, 0.1), 5);
  EXPECT_TRUE(prints_as(*ends(foot).first, "6.363"));
  EXPECT_TRUE(prints_as(*ends(foot).second, "13.79"));
  const std::vector<double> plain = radii_at("b", 6.0 + 1e-12);
  EXPECT_EQ(count_maxima(plain, 0.1), 6);
  EXPECT_TRUE(prints_as(*ends(plain).first, "3.852"));
  EXPECT_TRUE(prints_as(*ends(plain).second, "7.999"));
  EXPECT_EQ(count_maxima(radii_at("d", 10.0), 0.1), 6);
  expect_footprint(scene, "star bar", "contour");
}

TEST(SceneS0_14ab, TransitionIsSquare) {
  const auto [axis, diagonal] = contour(ExampleScene("s0-14ab").field(), 7.0);
  EXPECT_TRUE(prints_as(axis, "4.5908"));
  EXPECT_TRUE(prints_as(diagonal, "6.2713"));
}

TEST(SceneS0_14cn, TransitionsFollowTheirContours) {
  expect_rows("s0-14cn", {{"0.6", "5.3293", "5.5124"},
                          {"1.1", "5.3293", "6.1032"},
                          {"1.5", "5.3293", "6.3678"},
                          {"2", "5.3293", "6.5773"},
                          {"3", "5.3293", "6.8124"},
                          {"20", "5.3293", "7.2800"}});
}

TEST(SceneS0_14cn, FieldEndsAtTheContourOnThePlate) {
  const ExampleScene scene("s0-14cn");
  const struct {
    const char *n1, *diagonal, *w1;
  } rows[] = {{"0.6", "5.7908", ".0598"}, {"1.1", "9.7903", ".7917"}, {"1.5", "11.5817", "1"},
              {"2", "13.0000", "1"},      {"3", "14.5920", "1"},      {"20", "17.7585", "1"}};
  for (const auto& [n1, diagonal, w1] : rows) {
    SCOPED_TRACE(n1);
    expect_footprint_radii(scene, n1, "13", diagonal);
    expect_footprint(scene, std::string("bar n1=") + n1, std::string("contour n1=") + n1);
    EXPECT_TRUE(prints_as(lowest_w1(scene.field("bar"), scene.field(std::string("contour n1=") + n1)), w1));
  }
}

TEST(SceneS0_14cn, ContourInsideItsBarIsRefused) {
  // Half-axes of 4 instead of 13 stand inside the drawn bar's diagonals.
  const ExampleScene scene("s0-14cn");
  const ExampleScene small = scene.with("contour n1=0.6", "a", 4.0).with("contour n1=0.6", "b", 4.0);
  try {
    (void)small.field("n1=0.6");
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(scene_error::contour_inside_object), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace blendwright::test
