// Scenes with known gaps, and how many boxes they take.
#include <gtest/gtest.h>

#include <iostream>

#include "implicit/relations/collision.hpp"
#include "tests/implicit/relations/bodies.hpp"

namespace blendwright::test {
namespace {

const Vec3 oblique(0.6, 0.48, 0.64);

RigidMotion moved(const Vec3& to) { return {Eigen::Matrix3d::Identity(), to}; }
ScalarField ball_at(double radius, const Vec3& at) { return field_of(ball_body(radius), moved(at)); }

/// The field without its bounds, which would already tell much.
ScalarField unbounded(const ScalarField& field) { return {field.shared_model(), field.level()}; }
/// Around the ball of radius 1, without symmetry.
const Box oblong{{-1.1, -1.01, -1.03}, {1.02, 1.07, 1.05}};

// The reference: Vyatkin's scheme with tight ranges and the combination, boxes visited. In the bounds of both
// balls the first box is cut at the very middle of the gap, and decides; so the count is taken in a box that
// has no symmetry.
TEST(TwoSpheres, AreToldApartByFewBoxes) {
  struct Row {
    double gap;
    std::size_t reference;
  };
  const ScalarField a = unbounded(ball_at(1, Vec3::Zero()));
  for (const auto& [gap, reference] : {Row{1e-1, 17}, Row{1e-3, 161}, Row{1e-6, 457}, Row{1e-9, 681}}) {
    const ScalarField b = ball_at(1, (2 + gap) * oblique);
    const Collision in_bounds = collide(ball_at(1, Vec3::Zero()), b, {.domain = {}});
    const Collision found = collide(a, unbounded(b), {.domain = oblong});
    std::cout << "two spheres, gap " << gap << ": " << found.boxes << " boxes (reference " << reference
              << "), in their bounds " << in_bounds.boxes << "; gap estimated " << found.gap.value_or(NAN)
              << "\n";
    EXPECT_EQ(in_bounds.contact, Contact::disjoint);
    EXPECT_EQ(found.contact, Contact::disjoint);
    EXPECT_LE(found.boxes, reference + 5);  // the reference's own box is not known
    EXPECT_EQ(in_bounds.boxes, 1u);
  }
}

// Without the combination the count grows as 1/gap (reference 265, 3017, 30753), and ends undecided at the
// work limit.
TEST(TwoSpheres, NeedTheCombination) {
  std::size_t before = 0;
  for (const double gap : {1e-1, 1e-2, 1e-3}) {
    const Collision found = collide(ball_at(1, Vec3::Zero()), ball_at(1, (2 + gap) * oblique),
                                    {.domain = {}, .combination = false});
    std::cout << "two spheres, independent tests, gap " << gap << ": " << found.boxes << " boxes\n";
    EXPECT_EQ(found.contact, Contact::disjoint);
    EXPECT_GT(found.boxes, 5 * before);
    before = found.boxes;
  }
  const Collision cut = collide(ball_at(1, Vec3::Zero()), ball_at(1, (2 + 1e-6) * oblique),
                                {.max_boxes = 50'000, .domain = {}, .combination = false});
  EXPECT_EQ(cut.contact, Contact::undecided);
  ASSERT_TRUE(cut.undecided);
  EXPECT_TRUE(cut.undecided->contains((1 + 0.5e-6) * oblique));
}

TEST(TwoSpheres, ThatOverlapByOneMicrometreTouchInTheMiddle) {
  const ScalarField a = ball_at(1, Vec3::Zero()), b = ball_at(1, (2 - 1e-6) * oblique);
  const Collision found = collide(a, b, {.domain = {}});
  ASSERT_EQ(found.contact, Contact::contact);
  EXPECT_GE(a.value(*found.point), 0.0);
  EXPECT_GE(b.value(*found.point), 0.0);
  // The deepest point is (1 - 5e-7) u with both values 9.99999750e-7; Newton leaves some units of round-off,
  // across the normal 1e-15 / (curvature 1) more.
  EXPECT_LT((*found.point - (1 - 5e-7) * oblique).norm(), 1e-13);
  EXPECT_NEAR(a.value(*found.point), 9.99999750e-7, 1e-14);
  EXPECT_LT((*found.normal - oblique).norm(), 1e-12);
  EXPECT_NEAR(*found.gap, -1e-6, 1e-12);  // first order: the relative error is the gap over the radius
  std::cout << "two spheres, gap -1e-6: contact after " << found.boxes << " boxes\n";
}

// Contact along a curve: boxes grow as the root of 1/gap (reference 1675, 46487).
TEST(EllipsoidInTorus, IsToldApart) {
  struct Row {
    double gap;
    std::size_t most;
  };
  for (const auto& [gap, most] : {Row{1e-2, 1675}, Row{1e-5, 46487}}) {
    const Collision found = collide(field_of(ellipsoid_body({0.6, 0.6, 2.0})),
                                    field_of(torus_body(1.9, 1.3 - gap)), {.domain = {}});
    std::cout << "ellipsoid in torus, gap " << gap << ": " << found.boxes << " boxes (reference " << most
              << ")\n";
    EXPECT_EQ(found.contact, Contact::disjoint);
    EXPECT_LE(found.boxes, most);
  }
  const Collision in = collide(field_of(ellipsoid_body({0.6, 0.6, 2.0})),
                               field_of(torus_body(1.9, 1.3 + 1e-5)), {.domain = {}});
  EXPECT_EQ(in.contact, Contact::contact);
}

/// The unit sphere with a bump at (1, 0, 0), and its mirror image in the plane x = `plane`.
SceneSpec bumpy(double power) {
  return scene_of({part("base", "ellipsoid_quadric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}}),
                   part("q0", "ellipsoid_quadric", {{"a", 0.5}, {"b", 0.35}, {"c", 0.35}}),
                   part("q", "place", {{"of", ref("q0")}, {"move", std::vector<double>{1, 0, 0}}}),
                   part("bump", "perturbation", {{"of", ref("q")}, {"weight", 0.7}, {"power", power}}),
                   part("body", "freeform", {{"base", ref("base")}, {"bumps", refs({"bump"})}})});
}
ScalarField mirrored(SceneSpec scene, double plane) {
  scene.nodes.push_back(part(
      "image", "affine",
      {{"of", ref("body")},
       {"matrix", std::vector<std::vector<double>>{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2 * plane, 0, 0}}}}));
  scene.solid = "image";
  return build_scene(scene).field;
}

TEST(FreeformAndItsMirrorImage, AreDecidedRightly) {
  struct Row {
    double power, extent;
    std::size_t reference;
  };
  for (const auto& [power, extent, reference] :
       {Row{2, 1.2124557763288396, 769}, Row{3, 1.1947226544500175, 853}}) {
    const SceneSpec scene = bumpy(power);
    const ScalarField body = build_scene(scene).field;
    const Collision apart = collide(body, mirrored(scene, extent + 0.5e-4), {.domain = {}});
    std::cout << "freeform and its image, power " << power << ", gap 1e-4: " << apart.boxes
              << " boxes (reference " << reference << ")\n";
    EXPECT_EQ(apart.contact, Contact::disjoint);
    EXPECT_LE(apart.boxes, reference);
    const Collision in = collide(body, mirrored(scene, extent - 0.5e-4), {.domain = {}});
    EXPECT_EQ(in.contact, Contact::contact);
    EXPECT_NEAR(in.point->x(), extent - 0.5e-4, 0.5e-4);
  }
}

// Two balls behind each other share every bar along the axis through both.
TEST(BallsBehindEachOther, AreToldApartInSpaceButNotByBars) {
  const ScalarField near = ball_at(0.3, {0, 0, 0.5}), far = ball_at(0.3, {0, 0, -0.5});
  const Box all{Vec3::Constant(-1), Vec3::Constant(1)};
  const auto options = [&](bool combination) {
    return SearchOptions{.tolerance = 1e-2, .domain = all, .combination = combination};
  };
  // The bounds of both have nothing in common, so bounds are taken away here.
  const ScalarField a = unbounded(near), b = unbounded(far);
  const Collision space = collide(a, b, options(false));
  EXPECT_EQ(space.contact, Contact::disjoint);
  EXPECT_GT(space.boxes, 10u);
  const Collision bars = collide_projected(a, b, 2, options(false));
  EXPECT_EQ(bars.contact, Contact::undecided);
  EXPECT_TRUE(bars.undecided->contains(Vec3::Zero()));
  const Collision combined = collide(a, b, options(true));
  EXPECT_EQ(combined.contact, Contact::disjoint);
  EXPECT_EQ(combined.boxes, 1u);
  EXPECT_EQ(collide_projected(a, b, 2, options(true)).contact, Contact::disjoint);
  EXPECT_EQ(collide_projected(a, b, 0, options(false)).contact, Contact::disjoint);
  std::cout << "balls behind each other: " << space.boxes << " boxes in space, " << bars.boxes
            << " bars undecided, " << combined.boxes << " box with the combination\n";
}

}  // namespace
}  // namespace blendwright::test
