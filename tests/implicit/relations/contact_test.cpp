// Contact points, normals and gaps; what a collision query promises besides its answer.
#include <gtest/gtest.h>

#include <iostream>
#include <stop_token>

#include "implicit/relations/collision.hpp"
#include "tests/implicit/moving/motions.hpp"
#include "tests/implicit/relations/bodies.hpp"

namespace blendwright::test {
namespace {

ScalarField ball_at(double radius, const Vec3& at) {
  return field_of(ball_body(radius), {Eigen::Matrix3d::Identity(), at});
}

/// { normal.X <= offset }, normal of any length.
ScalarField half_space(const Vec3& normal, double offset) {
  return build_scene(
             scene_of({part("plane", "quadric",
                            {{"coefficients", std::vector<double>{0, 0, 0, 0, 0, 0, -normal[0], -normal[1],
                                                                  -normal[2], offset}}})}))
      .field;
}

// phi = 1 - sum (x_i/s_i)^2 at a distance d off the surface along the normal n: phi = -|g| d - k d^2 with
// k = sum (n_i/s_i)^2 <= |g|^2/4 ... 1/s_min^2, and |g| there is |g| + 2 k d to first order, so phi/|g| is
// wrong by less than k d^2/|g|; |g| >= 2/s_max, k <= 1/s_min^2.
// 2e-14: placements and quadrics of coordinates up to 6, each rounded about 16 times.
double first_order_error(double gap, double s_min, double s_max) {
  return gap * gap * s_max / (s_min * s_min) + 2e-14;
}

TEST(ContactGap, OfBallsIsRightToFirstOrder) {
  double worst = 0.0;
  for_all([&](Rng& rng) {
    const double gap = random_gap(rng) * 0.1, r1 = uniform(rng, 0.5, 2.0), r2 = uniform(rng, 0.5, 2.0);
    const Vec3 u = random_turn(rng).col(0), c1 = random_vector(rng, 1.0), c2 = c1 + (r1 + r2 + gap) * u;
    const Collision c = collide(ball_at(r1, c1), ball_at(r2, c2), {.domain = {}});
    ASSERT_EQ(c.contact, gap > 0 ? Contact::disjoint : Contact::contact);
    if (!c.gap) return;  // refuted at once
    EXPECT_NEAR(*c.gap, gap, first_order_error(gap, std::min(r1, r2), std::max(r1, r2)));
    EXPECT_LT((*c.normal - u).norm(), 1e-7);
    // The middle in units of the fields' own first-order lengths: off the true one to second order.
    EXPECT_LT((*c.point - (c1 + (r1 + 0.5 * gap) * u)).norm(), gap * gap + 1e-7);
    worst = std::max(worst, std::abs(*c.gap - gap) / std::abs(gap));
  });
  std::cout << "gap of balls: relative error at most " << worst << "\n";
}

TEST(ContactGap, OfEllipsoidAndPlaneIsRightToFirstOrder) {
  std::size_t known = 0;
  for_all([&](Rng& rng) {
    const double gap = random_gap(rng) * 0.01;
    const Vec3 s(uniform(rng, 0.5, 2.0), uniform(rng, 0.5, 2.0), uniform(rng, 0.5, 2.0));
    const Body body = ellipsoid_body(s);
    const RigidMotion at = random_motion(rng, 1.0);
    const Vec3 n = random_turn(rng).col(0);
    const Vec3 end = at(body.support(at.R.transpose() * n));
    // The plane lies beyond the end: { n.X >= n.end + gap }.
    const Collision c = collide(field_of(body, at), half_space(-n, -(n.dot(end) + gap)), {.domain = {}});
    ASSERT_EQ(c.contact, gap > 0 ? Contact::disjoint : Contact::contact) << gap;
    if (!c.gap) return;
    ++known;
    EXPECT_NEAR(*c.gap, gap, first_order_error(gap, s.minCoeff(), s.maxCoeff()));
    EXPECT_LT((*c.normal - n).norm(), 1e-6);
    // Level surfaces of the ellipsoid are scaled about its centre, at most s_max/s_min from along the normal.
    const Vec3 off = *c.point - end;
    EXPECT_NEAR(n.dot(off), 0.5 * gap, first_order_error(gap, s.minCoeff(), s.maxCoeff()) + 1e-13);
    EXPECT_LT(off.norm(), std::abs(gap) * s.maxCoeff() / s.minCoeff() + 1e-7);
  });
  EXPECT_GT(known, 50u);
}

TEST(ContactNormal, TurnsRoundWhenTheSolidsAreSwapped) {
  const ScalarField a = ball_at(1, Vec3::Zero()), b = ball_at(0.5, {0.3, 1.3, 0.1});
  const Collision one = collide(a, b, {.domain = {}}), other = collide(b, a, {.domain = {}});
  ASSERT_EQ(one.contact, Contact::contact);
  EXPECT_LT((*one.normal + *other.normal).norm(), 1e-12);
  EXPECT_LT((*one.point - *other.point).norm(), 1e-12);
}

// The matrix of Newton's method is singular along a curve of contacts.
TEST(ContactPoint, IsFoundOnACurveOfContacts) {
  const Collision c = collide(field_of(ellipsoid_body({0.6, 0.6, 2.0})),
                              field_of(torus_body(1.9, 1.3 + 1e-5)), {.domain = {}});
  ASSERT_EQ(c.contact, Contact::contact);
  EXPECT_NEAR(std::hypot(c.point->x(), c.point->y()), 0.6, 1.1e-5);
  EXPECT_NEAR(*c.gap, -1e-5, 1e-9);
  EXPECT_NEAR(c.normal->z(), 0.0, 1e-6);
}

TEST(ContactPoint, OfSolidsInEachOtherIsCommon) {
  const ScalarField a = ball_at(1, Vec3::Zero()), b = ball_at(0.3, Vec3::Zero());
  const Collision c = collide(a, b, {.domain = {}});
  ASSERT_EQ(c.contact, Contact::contact);
  EXPECT_GE(a.value(*c.point), 0.0);
  EXPECT_GE(b.value(*c.point), 0.0);
}

TEST(CollisionStart, IsTriedFirst) {
  const ScalarField a = ball_at(1, Vec3::Zero()), b = ball_at(1, {1.9, 0.3, 0});
  EXPECT_EQ(collide(a, b, {.domain = {}}, Vec3(0.95, 0.15, 0)).boxes, 0u);
  // From a place near by, Newton goes there.
  EXPECT_EQ(collide(a, b, {.domain = {}}, Vec3(0.9, 0.4, 0.1)).boxes, 0u);
  // A bad start changes no answer.
  EXPECT_EQ(collide(a, b, {.domain = {}}, Vec3(50, 50, 50)).contact, Contact::contact);
  EXPECT_EQ(collide(a, ball_at(1, {2.1, 0.3, 0}), {.domain = {}}, Vec3(1.05, 0.15, 0)).contact,
            Contact::disjoint);
}

TEST(CollisionCells, FillTheDomainWithVerdicts) {
  const ScalarField a = ball_at(1, Vec3::Zero()), b = ball_at(1, 2.001 * Vec3(0.6, 0.48, 0.64));
  const Box domain{{-1.1, -1, -1}, {1, 1.07, 1.03}};
  for (const bool combination : {true, false}) {
    const Collision c = collide(a, b, {.domain = domain, .combination = combination, .keep_cells = true});
    ASSERT_EQ(c.contact, Contact::disjoint);
    const Box inside = *common(domain, *a.bounds());
    const Box searched = *common(inside, *b.bounds());
    double volume = 0.0;
    std::size_t separated = 0;
    Rng rng(1);
    for (const SearchCell& cell : c.cells) {
      volume += cell.box.size().prod();
      separated += cell.verdict == SearchCell::Verdict::separated ? 1 : 0;
      EXPECT_NE(cell.verdict, SearchCell::Verdict::undecided);
      EXPECT_NE(cell.verdict, SearchCell::Verdict::witness);
      for (int i = 0; i < 8; ++i) {
        const Vec3 t = 0.5 * (random_vector(rng, 1.0) + Vec3::Ones());
        const Vec3 x = cell.box.lo + cell.box.size().cwiseProduct(t);
        const double phi1 = a.value(x), phi2 = b.value(x);
        if (cell.verdict == SearchCell::Verdict::outside_first) {
          EXPECT_LT(phi1, 0.0);
        }
        if (cell.verdict == SearchCell::Verdict::outside_second) {
          EXPECT_LT(phi2, 0.0);
        }
        EXPECT_LT(std::min(phi1, phi2), 0.0);
      }
    }
    EXPECT_NEAR(volume, searched.size().prod(), 1e-12);
    EXPECT_EQ(separated > 0, combination);
  }
  EXPECT_TRUE(collide(a, b, {.domain = domain}).cells.empty());
}

TEST(CollisionProgress, RisesAndCanBeStopped) {
  const ScalarField a = field_of(ellipsoid_body({0.6, 0.6, 2.0})), b = field_of(torus_body(1.9, 1.3 - 1e-5));
  double last = 0.0;
  int reports = 0;
  Progress progress;
  progress.report = [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    last = fraction;
    ++reports;
  };
  (void)collide(a, b, {.domain = {}}, std::nullopt, progress);
  EXPECT_GT(reports, 5);
  EXPECT_GT(last, 0.3);
  std::stop_source stop;
  progress.stop = stop.get_token();
  progress.report = [&](double fraction, std::string_view) {
    if (fraction > 0.1) stop.request_stop();
  };
  EXPECT_THROW((void)collide(a, b, {.domain = {}}, std::nullopt, progress), Cancelled);
}

TEST(CollisionLimits, LeaveWhatIsNotDecided) {
  const ScalarField a = ball_at(1, Vec3::Zero()), b = ball_at(1, {2, 0, 0});  // touch at (1, 0, 0)
  const ScalarField far(ball_at(1, {1e8, 0, 0})), next(ball_at(1, {1e8 + 2, 0.25, 0}));
  const Collision touch = collide(a, b, {.domain = {}});
  EXPECT_NE(touch.contact, Contact::disjoint);
  // Coordinates so large that a tolerance of 1e-9 is below their spacing: ends, and is not wrong.
  const Collision coarse = collide(far, next, {.max_boxes = 20'000, .domain = {}});
  EXPECT_NE(coarse.contact, Contact::contact);
  const Vec3 u(0.6, 0.48, 0.64);
  const Box domain{{-1.1, -1, -1}, {1, 1.07, 1.03}};
  const ScalarField other = ball_at(1, 2.000001 * u);  // without bounds, where one box would do
  const Collision limited = collide({a.shared_model(), a.level()}, {other.shared_model(), other.level()},
                                    {.max_boxes = 20, .domain = domain});
  EXPECT_EQ(limited.contact, Contact::undecided);
  ASSERT_TRUE(limited.undecided);
  EXPECT_TRUE(limited.undecided->contains(1.0000005 * u));
}

TEST(Collision, IsDecidedAtEveryLevel) {
  // A ball of radius 1 as a zero level, and as a soft object that is 1/2 half way to its influence radius 2.
  const auto at = [](std::vector<NodeSpec> nodes, const Vec3& to) {
    SceneSpec scene = scene_of(std::move(nodes));
    scene.nodes.push_back(part(
        "placed", "place", {{"of", ref(scene.solid)}, {"move", std::vector<double>{to[0], to[1], to[2]}}}));
    scene.solid = "placed";
    return build_scene(scene).field;
  };
  const std::vector<NodeSpec> level_zero{ball("ball", 1.0),
                                         part("zero", "zero_level", {{"of", ref("ball")}})};
  const std::vector<NodeSpec> level_half{ball("ball", 2.0), soft("soft", "ball")};
  const Vec3 u(0.6, 0.48, 0.64);
  const Box domain{Vec3::Constant(-1.1), Vec3::Constant(1.05)};
  for (const auto& nodes : {level_zero, level_half}) {
    const ScalarField a = at(nodes, Vec3::Zero());
    EXPECT_NE(a.level(), Level::function);
    EXPECT_EQ(collide(a, at(nodes, 2.001 * u), {.domain = domain}).contact, Contact::disjoint);
    EXPECT_EQ(collide(a, ball_at(1, 2.001 * u), {.domain = domain}).contact, Contact::disjoint);
    const Collision in = collide(a, at(nodes, 1.999 * u), {.domain = domain});
    EXPECT_EQ(in.contact, Contact::contact);
    EXPECT_LT((*in.normal - u).norm(), 1e-6);
  }
}

TEST(Collision, RefusesWhatItCannotSearch) {
  const ScalarField a = ball_at(1, Vec3::Zero());
  const auto where = [&](const SearchOptions& options) -> std::string {
    try {
      (void)collide(a, a, options);
      return "";
    } catch (const InputError& e) {
      return e.problems().at(0).where;
    }
  };
  EXPECT_EQ(where({.domain = {}}), "");
  EXPECT_EQ(where({.tolerance = 0.0, .domain = {}}), "tolerance");
  EXPECT_EQ(where({.tolerance = NAN, .domain = {}}), "tolerance");
  EXPECT_EQ(where({.max_boxes = 0, .domain = {}}), "max_boxes");
  EXPECT_EQ(where({.domain = Box{{1, 0, 0}, {0, 1, 1}}}), "domain");
  EXPECT_EQ(where({.domain = Box{{0, 0, 0}, {INFINITY, 1, 1}}}), "domain");
  const ScalarField half = half_space({1, 0, 0}, 0.0);
  EXPECT_THROW((void)collide(half, half, {.domain = {}}), InputError);
  EXPECT_EQ(collide(half, a, {.domain = {}}).contact, Contact::contact);  // one is bounded
  EXPECT_THROW((void)collide_projected(a, a, 3, {.domain = {}}), InputError);
}

}  // namespace
}  // namespace blendwright::test
