// Every operation under the suite that all tapes must pass; ranges and linear bounds over many boxes.
#include <gtest/gtest.h>

#include <functional>

#include "implicit/operators/function_liming.hpp"
#include "implicit/operators/function_local.hpp"
#include "implicit/operators/function_rockwood.hpp"
#include "implicit/operators/operation_rows.hpp"
#include "tests/implicit/functions/argument_tape.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/random_scene.hpp"

namespace blendwright::test {
namespace {

using detail::SuperEllipse;

/// Random parameters of one operation, of up to three arguments.
struct Sample {
  Combination combine;
  std::size_t arguments;
};
struct Family {
  std::string name;
  std::function<Sample(Rng&)> make;
  bool first_is_share = false;  ///< argument 0 is an omega in [0, 1]
  /// Whether bounds close in quadratically on random boxes: the operation has no kinks.
  bool smooth = true;
};

Join any_join(Rng& rng) { return joins[rng.next() % 3]; }
double any_weight(Rng& rng) {
  return integer(rng, 0, 1) == 0 ? integer(rng, 1, 4) : log_uniform(rng, 1.0, 30.0);
}
SuperEllipse any_ellipse(Rng& rng, std::size_t k) {
  std::vector<double> r;
  for (std::size_t i = 0; i < k; ++i) r.push_back(log_uniform(rng, 0.1, 2.0));
  return {r, any_weight(rng)};
}
double length(Rng& rng) { return log_uniform(rng, 0.2, 3.0); }
double any_alpha(Rng& rng) { return integer(rng, 0, 3) == 0 ? 0.0 : uniform(rng, -0.9, 0.999); }

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      {"r_alpha",
       [](Rng& rng) {
         return Sample{r_alpha(any_alpha(rng), any_join(rng)), 2 + rng.next() % 2};
       }},
      {"r_m",
       [](Rng& rng) {
         return Sample{r_m(integer(rng, 1, 4), any_join(rng)), 2};
       }},
      {"ricci",
       [](Rng& rng) {
         return Sample{ricci(log_uniform(rng, 0.3, 30.0), any_join(rng)), 2 + rng.next() % 2};
       }},
      {"liming",
       [](Rng& rng) {
         return Sample{step(detail::Liming{uniform(rng, 0.01, 0.99), integer(rng, 1, 4)}), 3};
       }},
      {"liming_clipped",
       [](Rng& rng) {
         return Sample{step(detail::LimingClipped{length(rng), length(rng), length(rng),
                                                  uniform(rng, 0.01, 0.99), any_join(rng)}),
                       2};
       }},
      {"rockwood",
       [](Rng& rng) {
         const std::size_t k = 2 + rng.next() % 2;
         return Sample{step(detail::Displacement{any_ellipse(rng, k), any_join(rng)}), k};
       },
       false, false},
      {"local_rockwood",
       [](Rng& rng) {
         return Sample{step(detail::LocalDisplacement{any_ellipse(rng, 2), any_join(rng)}), 3};
       },
       true, false},
      {"rockwood_raw",
       [](Rng& rng) {
         const std::size_t k = 2 + rng.next() % 2;
         return Sample{step(detail::RockwoodRaw{any_ellipse(rng, k)}), k};
       },
       false, false},
      {"edge_material",
       [](Rng& rng) {
         return Sample{step(detail::EdgeMaterial{uniform(rng, -2, 2), length(rng), length(rng)}), 2};
       }},
      {"bounded_material",
       [](Rng& rng) {
         return Sample{
             step(detail::BoundedMaterial{uniform(rng, -2, 2), length(rng), length(rng), length(rng)}), 3};
       }},
      {"cutoff",
       [](Rng& rng) {
         return Sample{step(detail::Cutoff{length(rng)}), 1};
       }},
  };
  return all;
}

Box arguments_of(const Family& family) {
  Box box{Vec3::Constant(-1.5), Vec3::Constant(2.0)};
  if (family.first_is_share) {
    box.lo[0] = 0.0;
    box.hi[0] = 1.0;
  }
  return box;
}

TEST(FunctionOperator, PassesTheSuiteOnCoordinates) {
  for (const Family& family : families())
    for_all(
        [&](Rng& rng) {
          const Sample sample = family.make(rng);
          EXPECT_EQ(evaluator_faults(*combination_tape(sample.combine, sample.arguments),
                                     {.where = arguments_of(family),
                                      .points = 60,
                                      .boxes = 30,
                                      .samples = 60,
                                      .seed = rng.next(),
                                      .useless_share = 0.6}),
                    no_faults)
              << family.name;
        },
        40);
}

/// 2 10^6 pairs of a box and a point in it for every family, 2 10^7 in a long run.
TEST(FunctionOperator, RangesAndLinearBoundsHoldMillionsOfSamples) {
  for (const Family& family : families()) {
    suite::Faults faults;
    Rng rng(7);
    for (int b = 0; b < bounded(2000); ++b) {
      const Sample sample = family.make(rng);
      const auto tape = combination_tape(sample.combine, sample.arguments);
      const Box box = suite::box_in(rng, arguments_of(family));
      std::vector<Vec3> points{box.lo, box.hi, box.centre()};
      while (points.size() < 1000) points.push_back(suite::point_in(rng, box));
      const suite::Results values = suite::evaluate(*tape, Order::value, points);
      const Range range = tape->range(box);
      for (std::size_t i = 0; i < points.size(); ++i)
        if (!range.contains(values.at(i, 0))) faults.add("range misses a value", suite::text(points[i]));
      suite::check_linear(*tape, box, points, values, faults);
    }
    EXPECT_EQ(faults.list(), no_faults) << family.name;
  }
}

/// What linear bounds leave open falls with the square of the box's size, on average and away from kinks:
/// they are no mere ranges.
TEST(FunctionOperator, LinearBoundsCloseInFasterThanRanges) {
  for (const Family& family : families()) {
    Rng rng(3);
    double wide = 0.0, narrow = 0.0, ranges = 0.0;
    for (int i = 0; i < 400; ++i) {
      const Sample sample = family.make(rng);
      const auto tape = combination_tape(sample.combine, sample.arguments);
      const Vec3 at = suite::point_in(rng, arguments_of(family));
      const auto open = [&](double h) {
        const Range rest = tape->linear({at.array() - h, at.array() + h}).rest;
        return rest.hi - rest.lo;
      };
      const Range range = tape->range({at.array() - 0.002, at.array() + 0.002});
      wide += open(0.008);
      narrow += open(0.002);
      ranges += range.hi - range.lo;
    }
    EXPECT_LE(narrow, 0.1 * ranges) << family.name;
    if (family.smooth) {
      EXPECT_LE(narrow, wide / 8.0) << family.name;
    }
  }
}

TEST(FunctionOperator, BoundsManyOperands) {
  for_all(
      [](Rng& rng) {
        const std::size_t k = 6 + rng.next() % 4;
        std::vector<double> r;
        for (std::size_t i = 0; i < k; ++i) r.push_back(length(rng));
        const Join join = any_join(rng);
        for (const Combination& combine :
             {rockwood(r, any_weight(rng), join), ricci(log_uniform(rng, 1.0, 20.0), join)}) {
          TapeBuilder builder;
          const std::vector<StepIndex> axes = coordinates(builder, 3);
          std::vector<StepIndex> args;
          for (std::size_t i = 0; i < k; ++i) args.push_back(axes[i % 3]);
          EXPECT_EQ(evaluator_faults(*builder.finish(combine(builder, args)),
                                     {.where = {Vec3::Constant(-1.5), Vec3::Constant(2.0)},
                                      .points = 40,
                                      .boxes = 30,
                                      .samples = 40,
                                      .seed = rng.next(),
                                      .useless_share = 0.7}),
                    no_faults);
        }
      },
      20);
}

/// Where one argument is below all others by its reach the step is left out, and the bits stay the same.
TEST(Rockwood, IsLeftOutWhereOneArgumentDecides) {
  int left_out = 0;
  for_all(
      [&](Rng& rng) {
        const SuperEllipse shape = any_ellipse(rng, 2);
        const auto tape = combination_tape(step(detail::Displacement{shape, any_join(rng)}), 2);
        const Box box = suite::box_in(rng, {Vec3::Constant(-2.0), Vec3::Constant(2.0)});
        std::vector<Vec3> points{box.lo, box.hi};
        while (points.size() < 50) points.push_back(suite::point_in(rng, box));
        suite::Faults faults;
        suite::check_box(*tape, box, points, 1, faults);
        EXPECT_EQ(faults.list(), no_faults);
        const auto within = tape->within(box);
        if (within.model && dynamic_cast<const Tape&>(*within.model).size() < tape->size()) ++left_out;
      },
      400);
  EXPECT_GT(left_out, 40);
}

// ---- Kinds of nodes ----------------------------------------------------------------------------------

std::vector<const NodeKind*> function_kinds() {
  std::vector<const NodeKind*> list;
  for (const auto group :
       {detail::function_set_kinds(), detail::function_blend_kinds(), detail::function_material_kinds()})
    for (const NodeKind& kind : group) list.push_back(&kind);
  return list;
}

TEST(FunctionKinds, PassTheSuiteOnRandomSolids) {
  for (const NodeKind* kind : function_kinds())
    for_all(
        [&](Rng& rng) {
          const SceneSpec spec = random_scene_of(rng, *kind);
          EXPECT_EQ(evaluator_faults(build_scene(spec).field, {.points = 40,
                                                               .boxes = 20,
                                                               .samples = 40,
                                                               .seed = rng.next(),
                                                               .agreement = agreement_of(spec),
                                                               .useless_share = 1.0}),
                    no_faults)
              << kind->name;
        },
        12);
  EXPECT_EQ(function_kinds().size(), 22u);
}

}  // namespace
}  // namespace blendwright::test
