// Inclusion, emptiness and set relations with known answers.
#include "implicit/relations/set_relation.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "tests/implicit/moving/motions.hpp"
#include "tests/implicit/relations/bodies.hpp"

namespace blendwright::test {
namespace {

using Kind = SetRelation::Kind;

ScalarField ball_at(double radius, const Vec3& at) {
  return field_of(ball_body(radius), {Eigen::Matrix3d::Identity(), at});
}

/// -1 - |X|^2, nowhere >= 0.
ScalarField nothing() {
  return build_scene(
             scene_of({part("nothing", "quadric",
                            {{"coefficients", std::vector<double>{-1, -1, -1, 0, 0, 0, 0, 0, 0, -1}}})}))
      .field;
}
const Box around_all{Vec3::Constant(-4.1), Vec3::Constant(4)};

/// Right, undecided or wrong, with the witness checked by values.
bool wrong(const Proof& p, bool holds, const ScalarField& inner, const ScalarField& outer) {
  if (p.answer == Answer::undecided) return false;
  if ((p.answer == Answer::proven) != holds) return true;
  return p.answer == Answer::refuted &&
         (inner.value(*p.witness) < 0.0 || inside(outer.level(), outer.value(*p.witness)) >= 0.0);
}

// A ball in a ball, nearest at one point by `margin`.
TEST(Inclusion, OfBallsWithPlantedMargins) {
  std::size_t undecided = 0, count = 0, boxes = 0;
  for_all(
      [&](Rng& rng) {
        const double margin = random_gap(rng), large = uniform(rng, 1.0, 2.0), small = uniform(rng, 0.2, 0.7);
        const Vec3 u = random_turn(rng).col(0), c = random_vector(rng, 1.0);
        const ScalarField outer = ball_at(large, c), inner = ball_at(small, c + (large - small - margin) * u);
        const Proof p = is_inside(inner, outer, {.max_boxes = 100'000, .domain = {}});
        ASSERT_FALSE(wrong(p, margin > 0.0, inner, outer)) << margin;
        ++count;
        boxes += p.boxes;
        undecided += p.answer == Answer::undecided ? 1 : 0;
      },
      100);
  std::cout << "balls in balls: " << count << " pairs, undecided " << undecided << ", boxes " << boxes / count
            << " on average\n";
  EXPECT_LE(undecided, count / 50);
}

// Any body in a half space whose plane stands `margin` beyond the body's end.
TEST(Inclusion, InHalfSpacesWithPlantedMargins) {
  for (const Family family : families) {
    std::size_t undecided = 0, count = 0, boxes = 0;
    for_all(
        [&](Rng& rng) {
          const double margin = random_gap(rng);
          // The second body of a pair lies beyond the plane through the middle of the gap by half of it.
          const PlantedPair pair = planted_pair(rng, family, 2.0 * margin);
          const Vec3 n = pair.normal;
          const ScalarField outer =
              build_scene(
                  scene_of({part("plane", "quadric",
                                 {{"coefficients", std::vector<double>{0, 0, 0, 0, 0, 0, -n[0], -n[1], -n[2],
                                                                       n.dot(pair.middle)}}})}))
                  .field;
          const Proof p = is_inside(pair.first, outer, {.max_boxes = 100'000, .domain = pair.domain});
          ASSERT_FALSE(wrong(p, margin > 0.0, pair.first, outer)) << name(family) << " " << margin;
          ++count;
          boxes += p.boxes;
          undecided += p.answer == Answer::undecided ? 1 : 0;
        },
        40);
    std::cout << name(family) << " in half spaces: " << count << " pairs, undecided " << undecided
              << ", boxes " << boxes / count << " on average\n";
    EXPECT_LE(undecided, count / 20);
  }
}

// Nested scaled copies are near everywhere: boxes grow as 1/margin.
TEST(Inclusion, OfScaledCopies) {
  const auto scaled = [](const Body& body, double scale) {
    SceneSpec scene = scene_of(body.nodes);
    scene.nodes.push_back(part("scaled", "place", {{"of", ref("body")}, {"scale", scale}}));
    scene.solid = "scaled";
    return build_scene(scene).field;
  };
  const Box domain{Vec3::Constant(-3.1), Vec3::Constant(3)};
  for (const Body& body : {ellipsoid_body({1, 0.8, 1.2}), exact_ellipsoid_body({1, 0.8, 1.2}),
                           box_body({1, 0.5, 0.7}), planes_body({1, 0.5, 0.7})}) {
    const ScalarField outer = field_of(body);
    for (const double margin : {1e-1, 1e-2}) {
      const ScalarField inner = scaled(body, 1.0 - margin), larger = scaled(body, 1.0 + margin);
      const Proof p = is_inside(inner, outer, {.domain = domain});
      std::cout << body.nodes.back().kind << ", shrunk by " << margin << ": " << name(p.answer) << ", "
                << p.boxes << " boxes\n";
      EXPECT_EQ(p.answer, Answer::proven);
      const Proof r = is_inside(larger, outer, {.domain = domain});
      EXPECT_EQ(r.answer, Answer::refuted);
      EXPECT_FALSE(wrong(r, false, larger, outer));
    }
  }
}

TEST(Inclusion, OfEqualAndTouchingSolidsIsUndecided) {
  const ScalarField a = ball_at(1, Vec3::Zero());
  EXPECT_EQ(is_inside(a, a, {.max_boxes = 5'000, .domain = {}}).answer, Answer::undecided);
  const Proof touching = is_inside(ball_at(0.5, {0.5, 0, 0}), a, {.max_boxes = 50'000, .domain = {}});
  EXPECT_EQ(touching.answer, Answer::undecided);
  EXPECT_TRUE(touching.undecided->contains({1, 0, 0}));
}

TEST(Emptiness, IsProvenOrRefuted) {
  EXPECT_EQ(is_empty(nothing(), {.domain = around_all}).answer, Answer::proven);
  const Proof p = is_empty(ball_at(1e-3, {0.3, 0.2, 0.1}), {.domain = around_all});
  EXPECT_EQ(p.answer, Answer::refuted);
  EXPECT_GE(ball_at(1e-3, {0.3, 0.2, 0.1}).value(*p.witness), 0.0);
  // What two balls have in common, as one solid: empty when they are apart.
  const auto lens = [](double x) {
    return build_scene(
               scene_of({part("a", "sphere", {{"radius", 1.0}}),
                         part("b", "place", {{"of", ref("a")}, {"move", std::vector<double>{x, 0.1, 0.2}}}),
                         part("lens", "min", {{"of", refs({"a", "b"})}})}))
        .field;
  };
  EXPECT_EQ(is_empty(lens(2.0), {.domain = around_all}).answer, Answer::proven);
  EXPECT_EQ(is_empty(lens(1.9), {.domain = around_all}).answer, Answer::refuted);
}

TEST(SetRelations, AreOfEveryKind) {
  const ScalarField ball = ball_at(1, Vec3::Zero()), none = nothing();
  const auto kind = [](const ScalarField& a, const ScalarField& b) {
    return set_relation(a, b, {.max_boxes = 20'000, .domain = around_all}).kind;
  };
  EXPECT_EQ(kind(ball, ball_at(1, {2.001, 0, 0})), Kind::disjoint);
  EXPECT_EQ(kind(ball, ball_at(2, {0.9, 0, 0})), Kind::first_inside_second);
  EXPECT_EQ(kind(ball_at(2, {0.9, 0, 0}), ball), Kind::second_inside_first);
  EXPECT_EQ(kind(ball, ball_at(1, {1.5, 0, 0})), Kind::overlapping);
  EXPECT_EQ(kind(ball, ball), Kind::undecided);
  EXPECT_EQ(kind(ball, none), Kind::disjoint);
  EXPECT_EQ(kind(none, none), Kind::disjoint);
  const SetRelation r = set_relation(none, ball, {.domain = around_all});
  EXPECT_EQ(r.first_empty.answer, Answer::proven);
  EXPECT_EQ(r.second_empty.answer, Answer::refuted);
  EXPECT_EQ(r.first_in_second.answer, Answer::proven);
  EXPECT_EQ(r.second_in_first.answer, Answer::refuted);
}

TEST(SetRelations, ReportProgressOnce) {
  double last = 0.0;
  Progress progress;
  progress.report = [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  (void)set_relation(ball_at(1, Vec3::Zero()), ball_at(1, {1.5, 0, 0}), {.domain = {}}, progress);
  EXPECT_GE(last, 0.8);
}

}  // namespace
}  // namespace blendwright::test
