// Answers about random pairs whose gap is known are never wrong.
#include <gtest/gtest.h>

#include <iostream>

#include "implicit/relations/collision.hpp"
#include "tests/implicit/relations/bodies.hpp"

namespace blendwright::test {
namespace {

enum class Judged { right, undecided, wrong };

/// What the answer is worth: a witness must be in both solids by the values of the fields too.
Judged judge(const PlantedPair& pair, double gap, const Collision& c) {
  if (c.contact == Contact::undecided) return Judged::undecided;
  if ((c.contact == Contact::disjoint) != (gap > 0.0)) return Judged::wrong;
  if (c.contact == Contact::disjoint) return Judged::right;
  const bool both = c.point && pair.first.value(*c.point) >= 0.0 && pair.second.value(*c.point) >= 0.0;
  return both ? Judged::right : Judged::wrong;
}

struct Tally {
  std::size_t count[3] = {0, 0, 0};
  std::size_t boxes = 0, most = 0;
  void add(Judged judged, std::size_t examined) {
    ++count[static_cast<std::size_t>(judged)];
    boxes += examined;
    most = std::max(most, examined);
  }
  [[nodiscard]] std::size_t of(Judged j) const { return count[static_cast<std::size_t>(j)]; }
  [[nodiscard]] std::size_t all() const { return count[0] + count[1] + count[2]; }
};

/// 10^5 pairs of all families together in the long run.
int pairs_of_a_family() { return std::getenv("BLENDWRIGHT_LONG") ? 14300 : 150; }

SearchOptions options_for(const PlantedPair& pair, Family family) {
  SearchOptions options{.max_boxes = 200'000, .domain = {}};
  if (family == Family::planes) options.domain = pair.domain;  // half spaces have no bounds
  return options;
}

class NeverWrong : public ::testing::TestWithParam<Family> {};

TEST_P(NeverWrong, OnPlantedGaps) {
  Tally tally;
  for (int seed = 1; seed <= pairs_of_a_family(); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed) * 16 + static_cast<std::uint64_t>(GetParam()));
    const double gap = random_gap(rng);
    const PlantedPair pair = planted_pair(rng, GetParam(), gap);
    const Collision c = collide(pair.first, pair.second, options_for(pair, GetParam()));
    const Judged judged = judge(pair, gap, c);
    tally.add(judged, c.boxes);
    ASSERT_NE(judged, Judged::wrong) << "seed " << seed << ", gap " << gap << ": " << name(c.contact);
  }
  std::cout << name(GetParam()) << ": " << tally.all() << " pairs, wrong " << tally.of(Judged::wrong)
            << ", undecided "
            << 100.0 * static_cast<double>(tally.of(Judged::undecided)) / static_cast<double>(tally.all())
            << " %, boxes " << tally.boxes / tally.all() << " on average, " << tally.most << " at most\n";
  // All of these gaps are decidable: far above rounding, and contact is at a point.
  EXPECT_LE(tally.of(Judged::undecided), tally.all() / 100);
}

// Bars know less, but nothing wrong.
TEST_P(NeverWrong, WithBars) {
  Tally tally;
  for (int seed = 1; seed <= bounded(20); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed) * 16 + static_cast<std::uint64_t>(GetParam()));
    const double gap = random_gap(rng);
    const PlantedPair pair = planted_pair(rng, GetParam(), gap);
    SearchOptions options = options_for(pair, GetParam());
    options.tolerance = 1e-2;
    options.max_boxes = 5'000;
    const Collision c = collide_projected(pair.first, pair.second, integer(rng, 0, 2), options);
    const Judged judged = judge(pair, gap, c);
    tally.add(judged, c.boxes);
    ASSERT_NE(judged, Judged::wrong) << "seed " << seed << ", gap " << gap << ": " << name(c.contact);
  }
  std::cout << name(GetParam()) << ", bars: undecided " << tally.of(Judged::undecided) << " of "
            << tally.all() << "\n";
}

INSTANTIATE_TEST_SUITE_P(Families, NeverWrong, ::testing::ValuesIn(families),
                         [](const ::testing::TestParamInfo<Family>& at) {
                           std::string id = name(at.param);
                           std::erase(id, ' ');
                           return id;
                         });

/// A field that claims to stay below what it is by `less`.
class TooNarrow final : public ScalarField::Model {
 public:
  TooNarrow(std::shared_ptr<const Model> of, double less) : of_(std::move(of)), less_(less) {}
  void evaluate(Order order, PointArrays points, std::span<double> out) const override {
    of_->evaluate(order, points, out);
  }
  Range range(const Box& box) const override {
    const Range r = of_->range(box);
    return {r.lo - less_, r.hi - less_};
  }
  LinearBound linear(const Box& box) const override {
    LinearBound b = of_->linear(box);
    b.value -= less_;
    return b;
  }
  Within within(const Box& box) const override { return {range(box), nullptr}; }
  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override {
    of_->nearest_member(points, out);
  }

 private:
  std::shared_ptr<const Model> of_;
  double less_;
};

TEST(NeverWrongControl, SeesRangesThatAreTooNarrow) {
  Tally tally;
  for (int seed = 1; seed <= 40; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    const double gap = -log_uniform(rng, 1e-4, 1e-2);
    PlantedPair pair = planted_pair(rng, Family::spheres, gap);
    pair.first = ScalarField(std::make_shared<TooNarrow>(pair.first.shared_model(), 0.1), Level::function,
                             pair.first.bounds());
    tally.add(judge(pair, gap, collide(pair.first, pair.second, {.domain = {}})), 0);
  }
  EXPECT_GT(tally.of(Judged::wrong), 30u);
}

TEST(NeverWrongControl, SeesWrongWitnesses) {
  Rng rng(1);
  const PlantedPair pair = planted_pair(rng, Family::spheres, -1e-3);
  Collision c = collide(pair.first, pair.second, {.domain = {}});
  ASSERT_EQ(judge(pair, -1e-3, c), Judged::right);
  *c.point += 1e-2 * pair.normal;
  EXPECT_EQ(judge(pair, -1e-3, c), Judged::wrong);
}

}  // namespace
}  // namespace blendwright::test
