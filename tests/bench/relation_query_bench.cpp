// Question: what does one query cost, and how does it grow as the gap shrinks?
#include <benchmark/benchmark.h>

#include "tests/bench/clocks.hpp"
#include "tests/bench/relation_models.hpp"

namespace {

using namespace blendwright;

/// The first body and the second, which was moved along x until they touch and then by `gap` away: 48
/// bisections between a proven contact and a proven gap, down to 1e-14 of their size.
std::pair<ScalarField, ScalarField> at_gap(const ScalarField& first, const ScalarField& second, double gap) {
  SearchOptions precise;
  precise.tolerance = 1e-12;
  precise.max_boxes = 100'000;
  double in = 0.0, out = 4.0;
  const auto moved = [&second](double x) {
    return placed(second, {Eigen::Matrix3d::Identity(), {x, 0.0, 0.0}});
  };
  for (int i = 0; i < 48; ++i) {
    const double middle = 0.5 * (in + out);
    const Contact c = collide(first, moved(middle), precise).contact;
    (c == Contact::disjoint ? out : in) = middle;
  }
  return {first, moved(out + gap)};
}

enum class Bodies { spheres, ellipsoids, freeforms };
std::pair<ScalarField, ScalarField> bodies(Bodies kind, double gap) {
  if (kind == Bodies::freeforms) return at_gap(bench::freeform(20, 1), bench::freeform(20, 2), gap);
  bench::Numbers numbers{3};
  const auto [a, b] = bench::planted_pair(
      numbers, kind == Bodies::spheres ? bench::Shape::sphere : bench::Shape::ellipsoid, gap);
  return {placed(a.field(), a.at), placed(b.field(), b.at)};
}

/// Counters: boxes examined, microseconds per query. The gap is 10^-range(0); freeforms have 20 bumps each.
void OneQuery(benchmark::State& state, Bodies kind, bool combination) {
  SearchOptions options;
  options.combination = combination;
  const auto [first, second] = bodies(kind, std::pow(10.0, -static_cast<double>(state.range(0))));
  Collision c;
  for (auto _ : state) c = collide(first, second, options);
  if (c.contact == Contact::contact) state.SkipWithError("contact where a gap was planted");
  state.counters["boxes"] = static_cast<double>(c.boxes);
  state.counters["undecided"] = c.contact == Contact::undecided ? 1.0 : 0.0;
}
BENCHMARK_CAPTURE(OneQuery, spheres, Bodies::spheres, true)->DenseRange(1, 9)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneQuery, ellipsoids, Bodies::ellipsoids, true)
    ->DenseRange(1, 9)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneQuery, freeforms, Bodies::freeforms, true)
    ->DenseRange(1, 9)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneQuery, freeforms_without_combination, Bodies::freeforms, false)
    ->DenseRange(1, 3)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
