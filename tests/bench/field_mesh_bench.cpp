// Question: what does the mesh of a field cost, beside VTK on a grid filled with the same field?
//
// Ours has its vertices projected onto the surface and exact normals; VTK's vtkFlyingEdges3D has neither. The
// grid is filled once by the plain scalar loop of the model and once by our batch evaluator, both on all
// cores. L/n: cells of 32 / n in the box [-16, 16]^3. Counters: wall and CPU seconds of each;
// `wall_ratio_...` and `cpu_ratio_...` = VTK / ours; triangles; `distance` = largest distance of our vertices
// from the surface in cells, `vtk_distance` that of VTK's. Compare within one run only.
#include <benchmark/benchmark.h>
#include <vtkDoubleArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

#include "implicit/polygonize/polygonize.hpp"
#include "kernel/base/parallel_for.hpp"
#include "tests/bench/clocks.hpp"
#include "tests/bench/field_models.hpp"

namespace {

using namespace blendwright;

FieldMesh mesh(const ScalarField& field, double cell, bool columns = false) {
  MeshOptions options;
  options.cell = cell;
  options.box = bench::model_box;
  options.columns = columns;
  return polygonize(field, options);
}

/// VTK's way: fills the (n + 1)^3 points of the box row by row, on all cores, then extracts the level.
vtkSmartPointer<vtkPolyData> flying_edges(const bench::PlainLoop& fill, int n, double level) {
  const double cell = 32.0 / n;
  const auto points = static_cast<std::size_t>(n + 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(n + 1, n + 1, n + 1);
  image->SetOrigin(-16.0, -16.0, -16.0);
  image->SetSpacing(cell, cell, cell);
  image->AllocateScalars(VTK_DOUBLE, 1);
  auto* values = static_cast<double*>(image->GetScalarPointer());
  std::vector<double> x(points);
  for (std::size_t i = 0; i < points; ++i) x[i] = -16.0 + cell * static_cast<double>(i);
  parallel_for(points, 1, [&](std::size_t begin, std::size_t end) {
    std::vector<double> y(points), z(points);
    for (std::size_t k = begin; k < end; ++k) {
      std::fill(z.begin(), z.end(), x[k]);
      for (std::size_t j = 0; j < points; ++j) {
        std::fill(y.begin(), y.end(), x[j]);
        fill(x.data(), y.data(), z.data(), points, values + (k * points + j) * points);
      }
    }
  });
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(image);
  edges->SetValue(0, level);
  edges->Update();
  return edges->GetOutput();
}

double largest_distance(const ScalarField& field, vtkPolyData& surface, double cell) {
  std::vector<Vec3> points(static_cast<std::size_t>(surface.GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
    surface.GetPoint(static_cast<vtkIdType>(i), points[i].data());
  const FieldValues f = field.evaluate(Order::gradient, points);
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double slope = f.gradient(i).norm(); slope > 0.0)
      largest = std::max(largest, std::abs(inside(field.level(), f.value(i))) / (slope * cell));
  return largest;
}

void FieldMeshAgainstVtk(benchmark::State& state, const std::string& name, int n) {
  const bench::FieldModel model = bench::field_model(name);
  const ScalarField field = build_scene(model.scene).field;
  const bench::PlainLoop batch = [&field](const double* x, const double* y, const double* z,
                                          std::size_t count, double* out) {
    field.model().evaluate(Order::value, {{x, count}, {y, count}, {z, count}}, {out, count});
  };
  const double cell = 32.0 / n, level = surface_value(field.level());
  bench::Cost ours, with_columns, plain_vtk, batch_vtk;
  FieldMesh made;
  vtkSmartPointer<vtkPolyData> surface;
  for (auto _ : state) {
    ours += bench::cost_of([&] { made = mesh(field, cell); });
    with_columns += bench::cost_of([&] { (void)mesh(field, cell, true); });
    plain_vtk += bench::cost_of([&] { surface = flying_edges(model.plain, n, level); });
    batch_vtk += bench::cost_of([&] { surface = flying_edges(batch, n, level); });
  }
  const auto runs = static_cast<double>(state.iterations());
  state.counters["wall"] = ours.wall / runs;
  state.counters["cpu"] = ours.cpu / runs;
  state.counters["columns_cpu"] = with_columns.cpu / runs;
  state.counters["vtk_plain_wall"] = plain_vtk.wall / runs;
  state.counters["vtk_plain_cpu"] = plain_vtk.cpu / runs;
  state.counters["vtk_batch_wall"] = batch_vtk.wall / runs;
  state.counters["vtk_batch_cpu"] = batch_vtk.cpu / runs;
  state.counters["wall_ratio_plain"] = plain_vtk.wall / ours.wall;
  state.counters["cpu_ratio_plain"] = plain_vtk.cpu / ours.cpu;
  state.counters["wall_ratio_batch"] = batch_vtk.wall / ours.wall;
  state.counters["cpu_ratio_batch"] = batch_vtk.cpu / ours.cpu;
  state.counters["triangles"] = static_cast<double>(made.facts.triangles);
  state.counters["vtk_triangles"] = static_cast<double>(surface->GetNumberOfCells());
  state.counters["distance"] = made.facts.largest_distance / cell;
  state.counters["vtk_distance"] = largest_distance(field, *surface, cell);
}
BENCHMARK_CAPTURE(FieldMeshAgainstVtk, blend_L256, "blend", 256)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshAgainstVtk, vir06_L256, "vir06", 256)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshAgainstVtk, vir2_L256, "vir2", 256)->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshAgainstVtk, ring_L256, "ring", 256)->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshAgainstVtk, sixball_L256, "sixball", 256)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshAgainstVtk, soft100_L256, "soft100", 256)
    ->Iterations(2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshAgainstVtk, bumps20_L256, "bumps20", 256)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshAgainstVtk, soft1000_L128, "soft1000", 128)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// The process's resident memory now ("VmRSS") or at its peak ("VmHWM"), bytes; 0 when not known.
double resident(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key + ":")) return 1024.0 * std::stod(line.substr(key.size() + 1));
  return 0.0;
}

/// Question: does a mesh of 1024 cells along the box fit into 4 GiB? Counters: peak resident memory of the
/// process during the run and its growth by the run, GiB.
void FieldMeshMemory(benchmark::State& state) {
  const ScalarField field = build_scene(bench::field_model("blend").scene).field;
  FieldMesh made;
  for (auto _ : state) {
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts over
    const double before = resident("VmRSS");
    const bench::Cost cost = bench::cost_of([&] { made = mesh(field, 32.0 / 1024.0, true); });
    constexpr double gib = 1024.0 * 1024.0 * 1024.0;
    state.counters["peak_GiB"] = resident("VmHWM") / gib;
    state.counters["growth_GiB"] = (resident("VmHWM") - before) / gib;
    state.counters["wall"] = cost.wall;
    state.counters["cpu"] = cost.cpu;
  }
  state.counters["triangles"] = static_cast<double>(made.facts.triangles);
  state.counters["distance"] = made.facts.largest_distance * 32.0;
}
BENCHMARK(FieldMeshMemory)->Iterations(1)->Unit(benchmark::kMillisecond);

/// Question: how does the CPU time grow when the cell is halved? Counters: cpu seconds, triangles, and
/// `factor` = cpu / that of the row before (4: like the surface; 8: like the volume). The number of
/// iterations is fixed, so that every row is run once and `before` is the row before.
void FieldMeshGrowthByCell(benchmark::State& state, const std::string& name) {
  static double before = 0.0;
  const ScalarField field = build_scene(bench::field_model(name).scene).field;
  const auto n = static_cast<double>(state.range(0));
  bench::Cost cost;
  FieldMesh made;
  for (auto _ : state) cost += bench::cost_of([&] { made = mesh(field, 32.0 / n); });
  const double cpu = cost.cpu / static_cast<double>(state.iterations());
  state.counters["cpu"] = cpu;
  if (state.range(0) > 64) state.counters["factor"] = cpu / before;
  state.counters["triangles"] = static_cast<double>(made.facts.triangles);
  state.counters["points"] = static_cast<double>(made.facts.evaluated_points);
  before = cpu;
}
BENCHMARK_CAPTURE(FieldMeshGrowthByCell, blend, "blend")
    ->RangeMultiplier(2)
    ->Range(64, 512)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshGrowthByCell, ring, "ring")
    ->RangeMultiplier(2)
    ->Range(64, 512)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FieldMeshGrowthByCell, soft100, "soft100")
    ->RangeMultiplier(2)
    ->Range(64, 512)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

/// Question: how does the CPU time grow with the members of a sum, at cells of 32 / 128? Counters: cpu
/// seconds, and `factor` = cpu / that of the row before, for ten times as many members.
void FieldMeshGrowthByMembers(benchmark::State& state) {
  static double before = 0.0;
  const ScalarField field =
      build_scene(bench::field_model("soft" + std::to_string(state.range(0))).scene).field;
  bench::Cost cost;
  FieldMesh made;
  for (auto _ : state) cost += bench::cost_of([&] { made = mesh(field, 32.0 / 128.0); });
  const double cpu = cost.cpu / static_cast<double>(state.iterations());
  state.counters["cpu"] = cpu;
  if (state.range(0) > 10) state.counters["factor"] = cpu / before;
  state.counters["triangles"] = static_cast<double>(made.facts.triangles);
  before = cpu;
}
BENCHMARK(FieldMeshGrowthByMembers)
    ->RangeMultiplier(10)
    ->Range(10, 10000)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace
