// Golden cases of relations.
#include <gtest/gtest.h>

#include <iostream>

#include "implicit/relations/collision.hpp"
#include "implicit/relations/membership.hpp"
#include "tests/implicit/relations/bodies.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright::test {
namespace {

Vec3 point_of(const std::vector<double>& p) { return {p[0], p[1], p[2]}; }

RigidMotion moved(const Vec3& to) { return {Eigen::Matrix3d::Identity(), to}; }

struct TwoFields {
  ScalarField first, second;
};

TwoFields bodies_of(const RelationSample& s) {
  const std::string kind = s.words.at("kind");
  if (kind == "sphere_sphere")
    return {field_of(ball_body(s.numbers.at("r1")), moved(point_of(s.lists.at("c1")))),
            field_of(ball_body(s.numbers.at("r2")), moved(point_of(s.lists.at("c2"))))};
  if (kind == "ellipsoid_torus_coaxial") {
    const auto& t = s.lists.at("torus");
    return {field_of(ellipsoid_body(point_of(s.lists.at("semi_axes")))), field_of(torus_body(t[0], t[1]))};
  }
  EXPECT_EQ(kind, "freeform_mirror");
  SceneSpec mirrored = s.body;
  const double x = s.numbers.at("mirror_x");
  mirrored.nodes.push_back(
      part("mirrored", "affine",
           {{"of", ref(s.body.solid)},
            {"matrix", std::vector<std::vector<double>>{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2 * x, 0, 0}}}}));
  mirrored.solid = "mirrored";
  return {build_scene(s.body).field, build_scene(mirrored).field};
}

TEST(GoldenRelations, CollisionsAreDecidedRightly) {
  std::size_t samples = 0;
  for (const RelationCase& c : read_relation_golden(golden_folder())) {
    if (c.function != "collision") continue;
    for (const RelationSample& s : c.samples) {
      ++samples;
      const auto [first, second] = bodies_of(s);
      const bool touch = s.flags.at("collide");
      const double gap = s.numbers.at("gap");
      const Collision found = collide(first, second, {.domain = {}});
      EXPECT_EQ(found.contact, touch ? Contact::contact : Contact::disjoint)
          << s.words.at("kind") << " " << gap << ", " << found.boxes << " boxes";
      std::cout << s.words.at("kind") << ", gap " << gap << ": " << name(found.contact) << " after "
                << found.boxes << " boxes, gap estimated " << found.gap.value_or(NAN) << "\n";
      if (touch) {
        ASSERT_TRUE(found.point);
        EXPECT_GE(first.value(*found.point), 0.0);
        EXPECT_GE(second.value(*found.point), 0.0);
        const Vec3 there = point_of(s.lists.at("witness"));
        EXPECT_GE(first.value(there), 0.0);
        EXPECT_GE(second.value(there), 0.0);
      }
      if (found.gap) {
        EXPECT_NEAR(*found.gap, gap, 0.01 * std::abs(gap) + 1e-12);
      }
    }
  }
  EXPECT_EQ(samples, 11u);
}

TEST(GoldenRelations, MembershipIsDecidedRightly) {
  std::size_t samples = 0;
  for (const RelationCase& c : read_relation_golden(golden_folder())) {
    if (c.function != "point_membership") continue;
    const ScalarField field = build_scene(c.scene).field;
    for (const RelationSample& s : c.samples) {
      ++samples;
      const Vec3 x = point_of(s.x());
      for (const auto mode : {MembershipOptions::Mode::value, MembershipOptions::Mode::length,
                              MembershipOptions::Mode::guaranteed}) {
        const Membership m = membership(field, std::span(&x, 1), {.mode = mode, .tolerance = 1e-9})[0];
        EXPECT_NEAR(m.phi, s.value(), 1e-12 * std::max(1.0, std::abs(s.value())));
        EXPECT_EQ(m.belongs, s.numbers.at("s2") == 1.0);
        EXPECT_EQ(static_cast<int>(m.place), static_cast<int>(s.numbers.at("s3")));
      }
    }
  }
  EXPECT_GE(samples, 8u);
}

}  // namespace
}  // namespace blendwright::test
