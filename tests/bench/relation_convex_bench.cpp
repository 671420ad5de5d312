// Question: what does a proven answer cost beside FCL's, on convex pairs with known answers, and how often is
// each right?
//
// Both get the same shapes and motions; 2,000 random pairs with planted gaps +-10^-k, 200 for each k = 1 ...
// 5 and sign. Counters: microseconds per query of each (ours with placing the bodies), `ratio` = ours / FCL;
// `wrong`, `undecided`: of our answers; `fcl_wrong`: of FCL's, which are never undecided. FCL answers convex
// pairs other than spheres by libccd (iterations to a tolerance of 1e-6) or its own GJK.
#include <benchmark/benchmark.h>

#include "tests/bench/clocks.hpp"
#include "tests/bench/fcl_pairs.hpp"
#include "tests/bench/relation_models.hpp"

namespace {

using namespace blendwright;
using bench::Pair;
using bench::Shape;

struct Known {
  Pair pair;
  ScalarField first, second;
  bool contact;
};
std::vector<Known> known_pairs(Shape shape) {
  std::vector<Known> all;
  bench::Numbers numbers{7};
  for (int k = 1; k <= 5; ++k)
    for (const double sign : {1.0, -1.0})
      for (int i = 0; i < 200; ++i) {
        const Pair p = bench::planted_pair(numbers, shape, sign * std::pow(10.0, -k));
        all.push_back({p, p.first.field(), p.second.field(), sign < 0.0});
      }
  return all;
}

void ConvexPairsAgainstFcl(benchmark::State& state, Shape shape) {
  if (!bench::fcl_is_here()) {
    state.SkipWithError("built without FCL: install libfcl-dev and configure again");
    return;
  }
  const std::vector<Known> pairs = known_pairs(shape);
  double wrong = 0.0, undecided = 0.0, fcl_wrong = 0.0, gjk_wrong = 0.0, boxes = 0.0;
  bench::Cost ours, fcl, gjk;
  for (auto _ : state) {
    wrong = undecided = fcl_wrong = gjk_wrong = boxes = 0.0;
    ours += bench::cost_of([&] {
      for (const Known& p : pairs) {
        const Collision c = collide(placed(p.first, p.pair.first.at), placed(p.second, p.pair.second.at), {});
        boxes += static_cast<double>(c.boxes);
        if (c.contact == Contact::undecided)
          ++undecided;
        else if ((c.contact == Contact::contact) != p.contact)
          ++wrong;
      }
    });
    std::vector<bench::FclPair> theirs;
    for (const Known& p : pairs) theirs.emplace_back(p.pair);
    fcl += bench::cost_of([&] {
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (theirs[i].in_contact(bench::FclSolver::libccd) != pairs[i].contact) ++fcl_wrong;
    });
    gjk += bench::cost_of([&] {
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (theirs[i].in_contact(bench::FclSolver::own) != pairs[i].contact) ++gjk_wrong;
    });
  }
  const auto n = static_cast<double>(pairs.size()), runs = static_cast<double>(state.iterations());
  state.counters["ours_us"] = 1e6 * ours.cpu / (n * runs);
  state.counters["fcl_us"] = 1e6 * fcl.cpu / (n * runs);
  state.counters["fcl_gjk_us"] = 1e6 * gjk.cpu / (n * runs);
  state.counters["ratio"] = ours.cpu / fcl.cpu;
  state.counters["boxes"] = boxes / n;
  state.counters["wrong"] = wrong;
  state.counters["undecided"] = undecided;
  state.counters["fcl_wrong"] = fcl_wrong;
  state.counters["fcl_gjk_wrong"] = gjk_wrong;
}
BENCHMARK_CAPTURE(ConvexPairsAgainstFcl, spheres, Shape::sphere)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ConvexPairsAgainstFcl, ellipsoids, Shape::ellipsoid)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ConvexPairsAgainstFcl, boxes, Shape::box)->Iterations(3)->Unit(benchmark::kMillisecond);

}  // namespace
