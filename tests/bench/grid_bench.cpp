// Question: how many points of a blend does a second give, beside the speed of memory and the CAD kernel's
// evaluation of the same blend as a B-spline?
//
// The blend joins two coaxial circles. All run on the same grid and print points and bytes per second; memory
// is the limit of the first, 24 bytes a point. Compare within one run only.
#include <benchmark/benchmark.h>

#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernel/base/parallel_for.hpp"
#include "parametric/fit/blend_fit.hpp"
#include "parametric/ode/ode_blend.hpp"
#include "tests/bench/plain_write.hpp"

namespace {

using namespace blendwright;

/// A circle with its series written out: the ends cost little, the grid is what is measured.
EndCondition circle(double radius, double z) {
  return {{{0.0, 2.0 * std::numbers::pi}, true}, Continuity::G1, [=](double v) {
            const double x = radius * std::cos(v), y = radius * std::sin(v);
            EndSeries end{{}, constant({0, 0, 3}), {}};
            end.C[0].c = {x, -y, -x / 2, y / 6};
            end.C[1].c = {y, x, -y / 2, -x / 6};
            end.C[2].c[0] = z;
            return end;
          }};
}

OdeBlend coaxial() {
  BlendShape shape;
  shape.repeated_root = 1.5;
  return {circle(1.0, 0.0), circle(2.0, 3.0), shape};
}

std::vector<double> even(std::size_t n, double hi) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = hi * static_cast<double>(i) / static_cast<double>(n - 1);
  return x;
}

struct Grid {
  std::vector<double> u, v, out;
  explicit Grid(const benchmark::State& state)
      : u(even(static_cast<std::size_t>(state.range(0)), 1.0)),
        v(even(static_cast<std::size_t>(state.range(0)), 2.0 * std::numbers::pi)),
        out(3 * u.size() * v.size()) {}
  void count(benchmark::State& state) const {
    const auto points = static_cast<std::int64_t>(u.size() * v.size());
    state.SetItemsProcessed(state.iterations() * points);
    state.SetBytesProcessed(state.iterations() * points * 24);
  }
};

void GridPositions(benchmark::State& state) {
  const OdeBlend blend = coaxial();
  Grid grid(state);
  for (auto _ : state) evaluate_grid(blend, grid.u, grid.v, grid.out);
  grid.count(state);
}
BENCHMARK(GridPositions)->ArgName("n")->Arg(1024)->Arg(4096)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Writes past the caches from all cores, as evaluate_grid does, without computing anything.
void GridPlainWrite(benchmark::State& state) {
  Grid grid(state);
  constexpr std::size_t chunk = 1 << 16;
  for (auto _ : state)
    parallel_for(grid.out.size(), chunk, [&](std::size_t begin, std::size_t end) {
      bench::plain_write(grid.out.data() + begin, end - begin);
    });
  grid.count(state);
}
BENCHMARK(GridPlainWrite)->ArgName("n")->Arg(1024)->Arg(4096)->UseRealTime()->Unit(benchmark::kMillisecond);

opencascade::handle<Geom_BSplineSurface> occt_surface(const BSplineSurface& s) {
  const auto reals = [](const std::vector<double>& x) {
    TColStd_Array1OfReal a(1, static_cast<int>(x.size()));
    for (int i = 1; i <= a.Length(); ++i) a.SetValue(i, x[static_cast<std::size_t>(i - 1)]);
    return a;
  };
  const auto integers = [](const std::vector<int>& x) {
    TColStd_Array1OfInteger a(1, static_cast<int>(x.size()));
    for (int i = 1; i <= a.Length(); ++i) a.SetValue(i, x[static_cast<std::size_t>(i - 1)]);
    return a;
  };
  const BSplineBasis &bu = s.basis_u(), &bv = s.basis_v();
  TColgp_Array2OfPnt poles(1, bu.count(), 1, bv.count());
  for (int i = 0; i < bu.count(); ++i)
    for (int j = 0; j < bv.count(); ++j)
      poles.SetValue(i + 1, j + 1, gp_Pnt(s.control(i, j).x(), s.control(i, j).y(), s.control(i, j).z()));
  return new Geom_BSplineSurface(poles, reals(bu.breaks()), reals(bv.breaks()), integers(bu.multiplicities()),
                                 integers(bv.multiplicities()), bu.degree(), bv.degree(), bu.periodic(),
                                 bv.periodic());
}

/// The CAD kernel on the fitted B-spline; argument 1: on all cores.
void GridByCadKernel(benchmark::State& state) {
  const BlendFit fit = fit_blend(coaxial(), {.position = 1e-6});
  const auto surface = occt_surface(fit.surface);
  Grid grid(state);
  const auto rows = [&](std::size_t begin, std::size_t end) {
    gp_Pnt p;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = 0; j < grid.v.size(); ++j) {
        surface->D0(grid.u[i], grid.v[j], p);
        double* out = &grid.out[(i * grid.v.size() + j) * 3];
        p.Coord(out[0], out[1], out[2]);
      }
  };
  for (auto _ : state) {
    if (state.range(1) != 0)
      parallel_for(grid.u.size(), 16, rows);
    else
      rows(0, grid.u.size());
  }
  grid.count(state);
  state.counters["control_points"] = fit.report.control_points;
  state.counters["error_bound"] = fit.report.position_bound;
}
BENCHMARK(GridByCadKernel)
    ->ArgNames({"n", "all_cores"})
    ->Args({1024, 0})
    ->Args({1024, 1})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// One exact sample to second order, for what is not a grid.
void BlendJetPerSample(benchmark::State& state) {
  const OdeBlend blend = coaxial();
  double v = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(blend.jet({0.3, v += 1e-3}));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BlendJetPerSample);

}  // namespace
