// Question: how many values of a field, and values with gradients, does a second of one core give at random
// points (so that nothing can be left out), beside a plain scalar loop over the same formulas?
//
// Each round takes the plain loop, our values and our gradients one after the other on the same points, in
// the CPU time of this thread. Counters: millions of points per second of each; `speedup` = ours / plain;
// `gradient_cost` = time of a value with its gradient / time of a value; `difference` = largest deviation
// from the plain loop's value.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/bench/clocks.hpp"
#include "tests/bench/field_models.hpp"

namespace {

using namespace blendwright;

struct Points {
  std::vector<double> x, y, z;
  explicit Points(std::size_t n) {
    std::mt19937_64 random(1);
    for (std::vector<double>* axis : {&x, &y, &z})
      for (std::size_t i = 0; i < n; ++i)
        axis->push_back(-16.0 + 32.0 * static_cast<double>(random() >> 11u) * 0x1.0p-53);
  }
};

void FieldValuesPerCore(benchmark::State& state, const std::string& name) {
  const bench::FieldModel model = bench::field_model(name);
  const ScalarField field = build_scene(model.scene).field;
  constexpr std::size_t n = 1 << 15;
  const Points p(n);
  std::vector<double> plain(n), values(n), gradients(4 * n);
  const PointArrays points{p.x, p.y, p.z};
  double plain_time = 0.0, value_time = 0.0, gradient_time = 0.0;
  for (auto _ : state) {
    plain_time += bench::cost_of([&] { model.plain(p.x.data(), p.y.data(), p.z.data(), n, plain.data()); },
                                 CLOCK_THREAD_CPUTIME_ID)
                      .cpu;
    value_time +=
        bench::cost_of([&] { field.model().evaluate(Order::value, points, values); }, CLOCK_THREAD_CPUTIME_ID)
            .cpu;
    gradient_time += bench::cost_of([&] { field.model().evaluate(Order::gradient, points, gradients); },
                                    CLOCK_THREAD_CPUTIME_ID)
                         .cpu;
  }
  double difference = 0.0;
  for (std::size_t i = 0; i < n; ++i) difference = std::max(difference, std::abs(plain[i] - values[i]));
  if (!(difference < 1e-10)) state.SkipWithError("the plain loop is not the same field");
  const double done = static_cast<double>(state.iterations()) * static_cast<double>(n) * 1e-6;
  state.counters["plain"] = done / plain_time;
  state.counters["values"] = done / value_time;
  state.counters["gradients"] = done / gradient_time;
  state.counters["speedup"] = plain_time / value_time;
  state.counters["gradient_cost"] = gradient_time / value_time;
  state.counters["difference"] = difference;
}
BENCHMARK_CAPTURE(FieldValuesPerCore, blend, "blend")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldValuesPerCore, vir06, "vir06")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldValuesPerCore, vir2, "vir2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldValuesPerCore, ring, "ring")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldValuesPerCore, sixball, "sixball")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldValuesPerCore, soft100, "soft100")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldValuesPerCore, soft1000, "soft1000")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldValuesPerCore, bumps20, "bumps20")->Unit(benchmark::kMillisecond);

}  // namespace
