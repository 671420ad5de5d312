// The laws of all evaluators, on every offset; ranges over many boxes.
#include <gtest/gtest.h>

#include <set>

#include "implicit/scene/node.hpp"
#include "implicit/scene/scene.hpp"
#include "tests/implicit/offset/offset_samples.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright::test {
namespace {

TEST(Offsets, HaveASampleOfEveryRow) {
  std::set<std::string_view> seen;
  for (const OffsetSample& s : offset_samples()) seen.insert(s.kind);
  for (const NodeKind& row : offset_kinds()) EXPECT_TRUE(seen.contains(row.name)) << row.name;
}

TEST(Offsets, ObeyTheLawsOfEvaluation) {
  for (const OffsetSample& s : offset_samples()) {
    if (s.slow) continue;
    SCOPED_TRACE(s.id);
    EXPECT_EQ(evaluator_faults(*build_tape(s.scene), {.where = s.where,
                                                      .points = 60,
                                                      .boxes = 20,
                                                      .samples = 20,
                                                      .differences = !s.edges,
                                                      .useless_share = s.useless_share}),
              no_faults);
  }
}

TEST(Offsets, OfOffsetsObeyTheLawsOfEvaluation) {
  for (const OffsetSample& s : offset_samples()) {
    if (!s.slow) continue;
    SCOPED_TRACE(s.id);
    EXPECT_EQ(
        evaluator_faults(*build_tape(s.scene),
                         {.where = s.where, .points = 2, .boxes = 1, .samples = 2, .differences = false}),
        no_faults);
  }
}

TEST(Offsets, RangesAndLinearBoundsHoldManySamples) {
  constexpr int boxes = 60, points = 20;
  for (const OffsetSample& s : offset_samples()) {
    if (s.slow) continue;
    SCOPED_TRACE(s.id);
    const auto tape = build_tape(s.scene);
    Rng rng(11);
    suite::Faults faults;
    for (int b = 0; b < bounded(boxes); ++b) {
      const Box box = suite::box_in(rng, s.where);
      std::vector<Vec3> inside{box.lo, box.hi, box.centre()};
      while (inside.size() < points) inside.push_back(suite::point_in(rng, box));
      const suite::Results values = suite::evaluate(*tape, Order::value, inside);
      const Range range = tape->range(box);
      for (std::size_t i = 0; i < inside.size(); ++i)
        if (!range.contains(values.at(i, 0))) faults.add("range misses a value", suite::text(inside[i]));
      suite::check_linear(*tape, box, inside, values, faults);
    }
    EXPECT_EQ(faults.list(), no_faults);
  }
}

}  // namespace
}  // namespace blendwright::test
