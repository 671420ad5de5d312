// How far offsets are from the exact ones: the table of the formula sheet, and what the measure refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "implicit/offset/offset_error.hpp"
#include "implicit/scene/scene.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using List = std::vector<double>;
using Nodes = std::vector<NodeSpec>;
constexpr double pi = std::numbers::pi;

NodeSpec quadric(std::string name, List a) {
  return part(std::move(name), "quadric", {{"coefficients", std::move(a)}});
}
NodeSpec ellipsoid_quadric(double a, double b, double c) {
  return part("solid", "ellipsoid_quadric", {{"a", a}, {"b", b}, {"c", c}});
}

/// r^2 - (rho - R)^2 - z^2 = r^2 - (r - d)^2 with the exact distance d: a function of a distance.
Nodes torus_of_distance(double R, double r) {
  return {part("torus", "torus", {{"ring", R}, {"tube", r}}),
          part("minus d", "complement", {{"of", ref("torus")}}),
          quadric("constant", {0, 0, 0, 0, 0, 0, 0, 0, 0, r * r}),
          part("square", "perturbation",
               {{"of", ref("minus d")}, {"free_term", r}, {"power", 2.0}, {"weight", -1.0}}),
          part("solid", "freeform", {{"base", ref("constant")}, {"bumps", refs({"square"})}})};
}
/// 4 R^2 (x^2 + y^2) - (|X|^2 + R^2 - r^2)^2; the square's argument is > 0.
Nodes quartic_torus(double R, double r) {
  return {quadric("base", {4 * R * R, 4 * R * R, 0, 0, 0, 0, 0, 0, 0, 0}),
          quadric("q", {1, 1, 1, 0, 0, 0, 0, 0, 0, R * R - r * r}),
          part("square", "perturbation", {{"of", ref("q")}, {"power", 2.0}, {"weight", -1.0}}),
          part("solid", "freeform", {{"base", ref("base")}, {"bumps", refs({"square"})}})};
}
/// min of h_i -+ x_i.
Nodes box_of_planes(const Vec3& h) {
  Nodes nodes;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 3; ++i)
    for (const double side : {1.0, -1.0}) {
      List a(10, 0.0);
      a[6 + i] = side;
      a[9] = h[static_cast<Eigen::Index>(i)];
      names.push_back("side " + std::to_string(names.size()));
      nodes.push_back(quadric(names.back(), a));
    }
  nodes.push_back(part("solid", "min", {{"of", refs(names)}}));
  return nodes;
}

Scene scene_with(Nodes nodes, const std::string& kind, Values values) {
  values["of"] = ref("solid");
  nodes.push_back(part("offset", kind, std::move(values)));
  SceneSpec spec = scene_of(std::move(nodes));
  spec.strict = false;
  return build_scene(spec);
}
OffsetError error_of(const Nodes& nodes, const std::string& kind, Values values, double distance,
                     const std::vector<Vec3>& surface) {
  SceneSpec alone = scene_of(nodes);
  alone.strict = false;
  return offset_error(build_scene(alone).field, scene_with(nodes, kind, std::move(values)).field, distance,
                      surface);
}
OffsetError normal_error(const Nodes& nodes, double distance, const std::vector<Vec3>& surface) {
  return error_of(nodes, "normal_offset", {{"distance", distance}}, distance, surface);
}
OffsetError ball_error(const Nodes& nodes, double distance, const std::vector<Vec3>& surface) {
  return error_of(nodes, "ball_offset", {{"distance", distance}}, distance, surface);
}
/// Calibrated at P0: C = D |g(P0)|.
OffsetError iso_error(const Nodes& nodes, double distance, const Vec3& p0, const std::vector<Vec3>& surface) {
  SceneSpec alone = scene_of(nodes);
  alone.strict = false;
  const FieldValues f = build_scene(alone).field.evaluate(Order::gradient, std::span<const Vec3>(&p0, 1));
  return error_of(nodes, "iso_offset", {{"value", distance * f.gradient(0).norm()}}, distance, surface);
}

/// The octant of an ellipsoid, by latitude and azimuth, n x n points with the poles and the sides.
std::vector<Vec3> octant(const Vec3& s, int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 0.5 * pi * i / (n - 1), v = 0.5 * pi * j / (n - 1);
      points.push_back(
          s.cwiseProduct(Vec3(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u))));
    }
  return points;
}
/// Around the tube from the outer equator almost to the inner one.
std::vector<Vec3> torus_points(double R, double r) {
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) {
    const double u = 3.0 * i / 11, v = 0.3 * i;
    const double rho = R + r * std::cos(u);
    points.push_back({rho * std::cos(v), rho * std::sin(v), r * std::sin(u)});
  }
  return points;
}
/// Inner points of the faces.
std::vector<Vec3> box_points(const Vec3& h) {
  std::vector<Vec3> points;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 9; ++j) {
        Vec3 p;
        p[axis] = h[axis];
        p[(axis + 1) % 3] = h[(axis + 1) % 3] * (i - 4) / 5.0;
        p[(axis + 2) % 3] = h[(axis + 2) % 3] * (j - 4) / 5.0;
        points.push_back(p);
      }
  return points;
}

void expect_within_one_percent(double value, double expected) {
  EXPECT_NEAR(std::abs(value), expected, 0.01 * expected);
}

// Below, figures are those of the table in the sheet (section 4.4); its largest errors to 1 %.
TEST(OffsetErrors, OfASphere) {
  const Nodes sphere{ellipsoid_quadric(1, 1, 1)};
  const auto points = octant(Vec3::Ones(), 12);
  EXPECT_LT(std::abs(normal_error(sphere, 0.3, points).worst), 1e-15);
  expect_within_one_percent(iso_error(sphere, 0.3, {1, 0, 0}, points).worst, 3.51e-2);
  EXPECT_LT(std::abs(ball_error(sphere, 0.3, points).worst), 1e-12);
}

TEST(OffsetErrors, OfAnEllipsoid) {
  const Nodes ellipsoid{ellipsoid_quadric(3, 2, 1)};
  const auto points = octant({3, 2, 1}, 24);
  struct Row {
    double distance, normal, rms, iso;
  };
  for (const Row& row : {Row{0.1, 5.30e-4, 1.44e-4, 6.72e-2}, Row{0.3, 1.29e-2, 3.35e-3, 2.05e-1},
                         Row{-0.3, 1.53e-2, 4.87e-3, 1.94e-1}}) {
    SCOPED_TRACE(row.distance);
    const OffsetError e = normal_error(ellipsoid, row.distance, points);
    expect_within_one_percent(e.worst, row.normal);
    EXPECT_NEAR(e.rms, row.rms, 0.2 * row.rms);  // depends on how the grid is laid out
    EXPECT_EQ(e.samples, points.size());
    expect_within_one_percent(iso_error(ellipsoid, row.distance, {3, 0, 0}, points).worst, row.iso);
    EXPECT_LT(std::abs(ball_error(ellipsoid, row.distance, points).worst), 1e-12);
  }
}

TEST(OffsetErrors, OfATorus) {
  const auto points = torus_points(2.0, 0.6);
  const Nodes simple = torus_of_distance(2.0, 0.6), quartic = quartic_torus(2.0, 0.6);
  EXPECT_LT(std::abs(normal_error(simple, 0.3, points).worst), 2e-15);
  EXPECT_LT(std::abs(normal_error(simple, -0.3, points).worst), 2e-15);
  expect_within_one_percent(iso_error(simple, 0.3, {2.6, 0, 0}, points).worst, 5.15e-2);
  expect_within_one_percent(normal_error(quartic, 0.3, points).worst, 4.28e-3);
  EXPECT_NEAR(normal_error(quartic, 0.3, points).rms, 2.44e-3, 0.02 * 2.44e-3);
  expect_within_one_percent(normal_error(quartic, -0.3, points).worst, 3.74e-3);
  expect_within_one_percent(iso_error(quartic, 0.3, {2.6, 0, 0}, points).worst, 2.45e-1);
  for (const double distance : {0.3, -0.3})
    for (const Nodes& torus :
         {simple, quartic, Nodes{part("solid", "torus", {{"ring", 2.0}, {"tube", 0.6}})}}) {
      const OffsetError e = ball_error(torus, distance, points);
      EXPECT_LT(std::abs(e.worst), 1e-12);
      EXPECT_EQ(e.without_root, 0u);
    }
}

TEST(OffsetErrors, OfABox) {
  const Vec3 h(1.0, 0.8, 0.6);
  const Nodes box = box_of_planes(h);
  const auto faces = box_points(h);
  EXPECT_LT(std::abs(normal_error(box, 0.3, faces).worst), 1e-15);
  // Faces move, edges and corners do not: beyond them one face is moved away and the next one is met.
  const Scene along = scene_with(box, "normal_offset", {{"distance", 0.3}});
  EXPECT_NEAR(along.field.value(h + Vec3(0.01, 0.01, 0.0)), -0.01, 1e-15);
  // The iso-offset moves planes: along a normal n of the corner it is D/max(n_i) - D too large, up to
  // (sqrt(3) - 1) D = 0.22 (the sheet's 1.77e-1 is that of the steepest n that it samples, max(n_i) = 0.629).
  const Scene iso = scene_with(box, "iso_offset", {{"value", 0.3}});
  for (const Vec3& n : {Vec3(0.629, 0.549, 0.5505), Vec3(1.0, 1.0, 1.0)}) {
    const Vec3 unit = n.normalized();
    EXPECT_NEAR(iso.field.value(h + (0.3 / unit.maxCoeff()) * unit), 0.0, 1e-15);
  }
  const Nodes exact{part("solid", "box", {{"half", List{1.0, 0.8, 0.6}}})};
  for (const double distance : {0.3, -0.3}) {
    EXPECT_LT(std::abs(ball_error(exact, distance, faces).worst), 1e-12);
    EXPECT_LT(std::abs(ball_error(box, distance, faces).worst), 1e-12);
  }
}

TEST(OffsetErrors, SayWhatHasNoRoot) {
  // Shrunk by more than its radius a ball is gone.
  const Nodes sphere{ellipsoid_quadric(0.5, 0.5, 0.5)};
  const auto points = octant(Vec3::Constant(0.5), 4);
  const OffsetError e = ball_error(sphere, -0.6, points);
  EXPECT_EQ(e.without_root, e.samples);
  EXPECT_EQ(e.worst, 0.0);
  EXPECT_EQ(e.rms, 0.0);
}

TEST(OffsetErrors, HaveTheSignOfWhatIsTooLarge) {
  const auto points = octant(Vec3::Ones(), 4);
  const ScalarField sphere = build_scene(scene_of({part("a", "sphere", {{"radius", 1.0}})})).field;
  const ScalarField large = build_scene(scene_of({part("a", "sphere", {{"radius", 1.32}})})).field;
  EXPECT_NEAR(offset_error(sphere, large, 0.3, points).worst, 0.02, 1e-14);
  const ScalarField small = build_scene(scene_of({part("a", "sphere", {{"radius", 0.65}})})).field;
  EXPECT_NEAR(offset_error(sphere, small, -0.3, points).worst, -0.05, 1e-14);
}

TEST(OffsetErrors, RefuseBadInput) {
  const ScalarField f = build_scene(scene_of({part("a", "sphere", {{"radius", 1.0}})})).field;
  const std::vector<Vec3> points{Vec3(1, 0, 0)};
  EXPECT_THROW(static_cast<void>(offset_error(f, f, 0.0, points)), InputError);
  EXPECT_THROW(static_cast<void>(offset_error(f, f, std::nan(""), points)), InputError);
  EXPECT_THROW(static_cast<void>(offset_error(f, f, 0.1, {})), InputError);
  EXPECT_THROW(static_cast<void>(offset_error(f, f, 0.1, std::vector<Vec3>{Vec3(0, 0, std::nan(""))})),
               InputError);
}

}  // namespace
}  // namespace blendwright::test
