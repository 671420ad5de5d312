// Tapes of moved solids.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/implicit/moving/motions.hpp"
#include "tests/implicit/primitives/solid_samples.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/random_scene.hpp"

namespace blendwright::test {
namespace {

std::shared_ptr<const Tape> moved_tape(const Tape& tape, const RigidMotion& motion) {
  return std::dynamic_pointer_cast<const Tape>(tape.placed(motion));
}
/// Hides what a tape can do, so that its points are moved back one by one.
class Plain final : public ScalarField::Model {
 public:
  explicit Plain(std::shared_ptr<const Model> of) : of_(std::move(of)) {}
  void evaluate(Order order, PointArrays p, std::span<double> out) const override {
    of_->evaluate(order, p, out);
  }
  [[nodiscard]] Range range(const Box& box) const override { return of_->range(box); }
  [[nodiscard]] LinearBound linear(const Box& box) const override { return of_->linear(box); }
  [[nodiscard]] Within within(const Box& box) const override { return of_->within(box); }
  void nearest_member(PointArrays p, std::span<std::uint32_t> out) const override {
    of_->nearest_member(p, out);
  }

 private:
  std::shared_ptr<const Model> of_;
};

/// The box of the solid after the motion.
Box moved_box(const Box& box, const RigidMotion& motion) {
  const Vec3 c = motion(box.centre()), h = motion.R.cwiseAbs() * (0.5 * box.size());
  return {c - h, c + h};
}

TEST(PlacedTape, ObeysTheLawsOfEvaluation) {
  Rng rng(21);
  for (const SolidSample& s : solid_samples()) {
    SCOPED_TRACE(s.id);
    const RigidMotion motion = random_motion(rng, 3.0);
    EXPECT_EQ(
        evaluator_faults(*moved_tape(*build_tape(s.scene), motion), {.where = moved_box(s.where, motion),
                                                                     .points = 60,
                                                                     .boxes = 30,
                                                                     .samples = 30,
                                                                     .useless_share = 0.2}),
        no_faults);
  }
}

/// How two fields agree.
struct Agreement {
  std::size_t points = 0, same_values = 0, same_gradients = 0;
  void add(const FieldValues& a, const FieldValues& b) {
    for (std::size_t i = 0; i < a.size; ++i) {
      ++points;
      const Vec3 g = a.gradient(i), h = b.gradient(i);
      // Coordinates of up to 10 differ by some units of round-off, 1e-14, and values by the gradient times
      // that; second derivatives of up to 1e4 change gradients by 1e-10.
      if (a.value(i) == b.value(i) ||
          std::abs(a.value(i) - b.value(i)) <= 1e-12 * (1.0 + std::abs(a.value(i)) + g.norm()))
        ++same_values;
      if ((g - h).norm() <= 1e-9 * (1.0 + g.norm())) ++same_gradients;
    }
  }
};

Agreement against_points_moved_back(const ScalarField& field, const Box& where, Rng& rng) {
  const RigidMotion motion = random_motion(rng, 3.0);
  const ScalarField moved = placed(field, motion);
  const ScalarField plain =
      placed({std::make_shared<Plain>(field.shared_model()), field.level(), {}, field.members()}, motion);
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) points.push_back(motion(suite::point_in(rng, where)));
  Agreement agreement;
  agreement.add(moved.evaluate(Order::gradient, points), plain.evaluate(Order::gradient, points));
  EXPECT_EQ(moved.members(), field.members());
  EXPECT_EQ(moved.bounds().has_value(), field.bounds() && field.bounds()->finite());
  return agreement;
}

TEST(PlacedTape, IsTheFieldAtThePointsMovedBack) {
  Rng rng(22);
  for (const SolidSample& s : solid_samples()) {
    SCOPED_TRACE(s.id);
    const Agreement a = against_points_moved_back(build_scene(s.scene).field, s.where, rng);
    EXPECT_EQ(a.same_values, a.points);
    // Gradients jump on the medial axes of exact distances; no random point is that near to one.
    EXPECT_EQ(a.same_gradients, a.points);
  }
}

// Scenes of all kinds: merged steps, frames in frames, steps in the scene's own coordinates. Cusps and
// exponents of 20 magnify rounding at a few points; a wrong frame of any step is seen at most points.
TEST(PlacedTape, IsTheFieldAtThePointsMovedBackForAllKindsOfNodes) {
  Agreement all;
  for_all(
      [&](Rng& rng) {
        const ScalarField field = build_scene(RandomScene(rng).make(3)).field;
        const Agreement a =
            against_points_moved_back(field, {Vec3::Constant(-2.0), Vec3::Constant(2.0)}, rng);
        EXPECT_GE(a.same_values, a.points * 9 / 10);
        all.points += a.points;
        all.same_values += a.same_values;
        all.same_gradients += a.same_gradients;
      },
      150);
  EXPECT_GE(static_cast<double>(all.same_values), 0.999 * static_cast<double>(all.points));
  EXPECT_GE(static_cast<double>(all.same_gradients), 0.99 * static_cast<double>(all.points));
}

TEST(PlacedTape, MembersAreThoseOfTheOriginal) {
  for_all(
      [](Rng& rng) {
        const ScalarField field = build_scene(RandomScene(rng).make(3)).field;
        const RigidMotion motion = random_motion(rng, 3.0);
        const auto tape = field.model().placed(motion);
        std::vector<double> own[3], there[3];
        constexpr std::size_t n = 50;
        for (std::size_t i = 0; i < n; ++i) {
          const Vec3 p = random_vector(rng, 2.0), q = motion(p);
          for (int c = 0; c < 3; ++c) {
            own[c].push_back(p[c]);
            there[c].push_back(q[c]);
          }
        }
        std::vector<std::uint32_t> a(n), b(n);
        field.model().nearest_member({own[0], own[1], own[2]}, a);
        tape->nearest_member({there[0], there[1], there[2]}, b);
        std::size_t same = 0;
        for (std::size_t i = 0; i < n; ++i) same += a[i] == b[i] ? 1 : 0;
        EXPECT_GE(same, n - 2) << "ties may turn by rounding";
      },
      60);
}

// The local box of every step is that of one turn, however many frames there were: never wider than the
// turned box of the original. 1.01 and 1e-12 are for rounding.
TEST(PlacedTape, BoundsAreAsNarrowAsThoseOfTheTurnedBox) {
  Rng rng(23);
  double widest = 0.0, widest_rest = 0.0;
  for (const SolidSample& s : solid_samples()) {
    SCOPED_TRACE(s.id);
    const auto tape = build_tape(s.scene);
    for (int i = 0; i < bounded(100); ++i) {
      const RigidMotion motion = random_motion(rng, 3.0);
      const auto moved = moved_tape(*tape, motion);
      const Vec3 h = log_uniform(rng, 1e-4, 0.5) * (Vec3::Constant(0.2) + random_vector(rng, 1.0).cwiseAbs());
      const Vec3 c = motion(suite::point_in(rng, s.where));
      const Box box{c - h, c + h};
      const Box own = moved_box(box, inverse(motion));
      const Range a = moved->range(box), b = tape->range(own);
      const double width = b.hi - b.lo, size = std::abs(b.lo) + std::abs(b.hi) + 1.0;
      EXPECT_LE(a.hi - a.lo, 1.01 * width + 1e-12 * size);
      if (std::isfinite(width) && width > 0.0) widest = std::max(widest, (a.hi - a.lo) / width);
      const LinearBound la = moved->linear(box), lb = tape->linear(own);
      const double rest = lb.rest.hi - lb.rest.lo;
      EXPECT_LE(la.rest.hi - la.rest.lo, 1.01 * rest + 1e-12 * size);
      if (rest > 1e-10 * size) widest_rest = std::max(widest_rest, (la.rest.hi - la.rest.lo) / rest);
    }
  }
  std::printf(
      "[  figure ] range of a moved solid: at most %.6f of that over the turned box, linear rest %.6f\n",
      widest, widest_rest);
}

TEST(PlacedTape, BallsAreAsRoundAsBefore) {
  // 1 - |X|^2: over any box of half sizes h the rest of the linear bound is [-|h|^2, 0], turned or not.
  const auto tape =
      build_tape(scene_of({part("ball", "ellipsoid_quadric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}})}));
  for_all([&](Rng& rng) {
    const RigidMotion motion = random_motion(rng, 3.0);
    const Vec3 c = motion(random_vector(rng, 1.0)), h = random_vector(rng, 0.5).cwiseAbs();
    const Range rest = tape->placed(motion)->linear({c - h, c + h}).rest;
    EXPECT_NEAR(rest.lo, -h.squaredNorm(), 1e-12);
    EXPECT_NEAR(rest.hi, 0.0, 1e-12);
  });
}

TEST(PlacedTape, PlacementsOfPlacementsCompose) {
  for_all(
      [](Rng& rng) {
        const ScalarField field =
            build_scene(solid_samples()[rng.next() % solid_samples().size()].scene).field;
        const RigidMotion a = random_motion(rng, 3.0), b = random_motion(rng, 3.0);
        const ScalarField twice = placed(placed(field, a), b), once = placed(field, after(b, a));
        EXPECT_EQ(dynamic_cast<const Tape&>(twice.model()).size(),
                  dynamic_cast<const Tape&>(field.model()).size());
        for (int i = 0; i < 20; ++i) {
          const Vec3 p = random_vector(rng, 1.5);
          const double expected = once.value(after(b, a)(p));
          EXPECT_NEAR(twice.value(after(b, a)(p)), expected, 1e-12 * (1.0 + 100.0 * std::abs(expected)));
        }
      },
      60);
}

}  // namespace
}  // namespace blendwright::test
