#include "implicit/relations/membership.hpp"

#include <gtest/gtest.h>

#include "tests/implicit/moving/motions.hpp"
#include "tests/implicit/relations/bodies.hpp"

namespace blendwright::test {
namespace {

using Mode = MembershipOptions::Mode;
constexpr Mode modes[] = {Mode::value, Mode::length, Mode::guaranteed};

Membership one(const ScalarField& solid, const Vec3& x, const MembershipOptions& options) {
  return membership(solid, std::span(&x, 1), options).at(0);
}

NodeSpec half_space(const std::string& id, double sign, double offset = 0.0) {
  return part(id, "quadric", {{"coefficients", std::vector<double>{0, 0, 0, 0, 0, 0, sign, 0, 0, offset}}});
}

/// The union of { x >= 0 } and { x <= 0 } within the ball of radius 1: its field is 0 on x = 0, inside.
ScalarField with_inner_zeros() {
  return build_scene(scene_of({half_space("right", 1.0), half_space("left", -1.0),
                               part("all", "max", {{"of", refs({"right", "left"})}}),
                               part("ball", "sphere", {{"radius", 1.0}}),
                               part("body", "min", {{"of", refs({"all", "ball"})}})}))
      .field;
}

// Distances are exact, so the three modes know where the tolerance ends.
TEST(Membership, KnowsPlacesToWithinItsTolerance) {
  for_all([](Rng& rng) {
    const Vec3 s(uniform(rng, 0.3, 2.0), uniform(rng, 0.3, 2.0), uniform(rng, 0.3, 2.0));
    const RigidMotion at = random_motion(rng, 2.0);
    const Body body = exact_ellipsoid_body(s);
    const ScalarField solid = field_of(body, at);
    const Vec3 n = random_turn(rng).col(0);
    const Vec3 end = at(body.support(at.R.transpose() * n));
    const double tolerance = log_uniform(rng, 1e-9, 1e-3);
    for (const Mode mode : modes) {
      const MembershipOptions options{.mode = mode, .tolerance = tolerance};
      // A box of half size e reaches sqrt(3) e. Inside, a point deeper than the least radius of curvature has
      // another nearest point; 2e-3 is less than 0.3^2/2.
      EXPECT_EQ(one(solid, end + 2.0 * tolerance * n, options).place, Place::outside);
      EXPECT_EQ(one(solid, end - 2.0 * tolerance * n, options).place, Place::inside);
      const Membership near = one(solid, end - 0.5 * tolerance * n, options);
      EXPECT_EQ(near.place, Place::boundary);
      EXPECT_TRUE(near.belongs);
      EXPECT_NEAR(near.distance, 0.5 * tolerance, 1e-13);
      EXPECT_NEAR(near.phi, 0.5 * tolerance, 1e-13);
      EXPECT_FALSE(one(solid, end + 0.5 * tolerance * n, options).belongs);
    }
  });
}

TEST(Membership, ByValueAndByLengthDiffer) {
  // 100 (1 - |X|^2): near the surface |grad| = 200.
  const ScalarField solid =
      build_scene(
          scene_of({part("ball", "quadric",
                         {{"coefficients", std::vector<double>{-100, -100, -100, 0, 0, 0, 0, 0, 0, 100}}})}))
          .field;
  const Vec3 x(1.0 - 1e-4, 0, 0);  // phi = 0.02
  EXPECT_EQ(one(solid, x, {.mode = Mode::value, .tolerance = 1e-3}).place, Place::inside);
  EXPECT_EQ(one(solid, x, {.mode = Mode::length, .tolerance = 1e-3}).place, Place::boundary);
  EXPECT_EQ(one(solid, x, {.mode = Mode::guaranteed, .tolerance = 1e-3}).place, Place::boundary);
  EXPECT_EQ(one(solid, x, {.mode = Mode::length, .tolerance = 1e-5}).place, Place::inside);
  EXPECT_EQ(one(solid, x, {.mode = Mode::guaranteed, .tolerance = 1e-5}).place, Place::inside);
  EXPECT_NEAR(one(solid, x, {}).distance, 1e-4, 1e-8);
}

// Without a tolerance rounding alone decides: a point that doubles cannot tell from the surface.
TEST(Membership, OfPointsOnTheSurfaceIsTheBoundary) {
  const ScalarField solid = field_of(ball_body(1.0));
  for_all([&](Rng& rng) {
    const Vec3 x = random_turn(rng).col(0);
    EXPECT_EQ(one(solid, x, {.mode = Mode::length, .tolerance = 1e-14}).place, Place::boundary);
    EXPECT_EQ(one(solid, x, {.mode = Mode::guaranteed, .tolerance = 1e-14}).place, Place::boundary);
  });
}

TEST(Membership, ConfirmsTheBoundary) {
  const ScalarField body = with_inner_zeros();
  const Vec3 inner(0.0, 0.3, 0.2), surface(0.6, 0.8, 0.0), rim(0.0, 0.6, 0.8);
  for (const Mode mode : {Mode::value, Mode::length}) {
    const MembershipOptions plain{.mode = mode, .tolerance = 1e-6};
    MembershipOptions confirmed = plain;
    confirmed.confirm = true;
    EXPECT_EQ(one(body, inner, plain).place, Place::boundary);
    EXPECT_EQ(one(body, inner, confirmed).place, Place::inside);
    EXPECT_EQ(one(body, surface, confirmed).place, Place::boundary);
    EXPECT_EQ(one(body, rim, confirmed).place, Place::boundary);  // both: zero inside, and surface
  }
  // Guaranteed: only a proof counts. The zeros between two solids that overlap by more than the box have one.
  const ScalarField overlapping =
      build_scene(scene_of({half_space("right", 1.0, 1e-7), half_space("left", -1.0, 1e-7),
                            part("body", "max", {{"of", refs({"right", "left"})}})}))
          .field;
  const MembershipOptions guaranteed{.mode = Mode::guaranteed, .tolerance = 1e-6, .confirm = true};
  EXPECT_EQ(one(overlapping, {0.0, 0.3, 0.2}, guaranteed).place, Place::inside);
  EXPECT_EQ(one(body, surface, guaranteed).place, Place::boundary);
  EXPECT_EQ(one(body, {0.0, 0.3, 0.2}, guaranteed).place, Place::boundary);
}

// The guaranteed answers hold for every point of the box, by values at random points of it.
TEST(Membership, GuaranteesItsAnswersInTheWholeBox) {
  for_all(
      [](Rng& rng) {
        const ScalarField solid = field_of(freeform_body(rng), random_motion(rng, 1.0));
        const double e = log_uniform(rng, 1e-4, 0.2);
        for (int i = 0; i < 50; ++i) {
          const Vec3 x = random_vector(rng, 2.0);
          const Place place = one(solid, x, {.mode = Mode::guaranteed, .tolerance = e}).place;
          for (int k = 0; k < 20 && place != Place::boundary; ++k) {
            const double phi = solid.value(x + random_vector(rng, e));
            EXPECT_EQ(phi > 0.0, place == Place::inside) << phi;
          }
        }
      },
      50);
}

TEST(Membership, RefusesBadInput) {
  const ScalarField solid = field_of(ball_body(1.0));
  EXPECT_THROW((void)one(solid, {0, 0, 0}, {.tolerance = -1.0}), InputError);
  EXPECT_THROW((void)one(solid, {0, 0, 0}, {.tolerance = NAN}), InputError);
  EXPECT_THROW((void)one(solid, {0, NAN, 0}, {}), InputError);
  EXPECT_TRUE(membership(solid, {}, {}).empty());
}

}  // namespace
}  // namespace blendwright::test
