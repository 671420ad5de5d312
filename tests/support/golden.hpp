#pragma once
// Golden data of the sweep equation, as plain structs. The schema is described in
// tests/data/golden/README.md.
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "kernel/base/units.hpp"
#include "parametric/ode/sweep_ode.hpp"
#include "tests/support/golden_folder.hpp"

namespace blendwright::test {

using Table = std::vector<std::vector<double>>;  // [row][column]

struct CardinalCase {
  std::string label;
  bool by_root = false;  ///< given by q, else by ode
  double q = 0.0;
  SweepOde ode;
  std::string regime;
  std::vector<double> u;
  std::array<Table, 4> derivative;  ///< phi, d1, d2, d3: [u][H0, K0, H1, K1]
};

struct SixthOrderCase {
  std::string kind;
  double q = 0.0;
  std::vector<double> u;
  std::array<Table, 4> derivative;  ///< [u][pos0, d0, dd0, pos1, d1, dd1]
};

using PointGrid = std::vector<std::vector<Vec3>>;  // [u][v]

struct ExampleSurface {
  std::string label, regime, mode;
  SweepOde ode;
  PointGrid S, Su, Sv, Suu;
};

struct ExampleSide {
  double max_pos_err = 0.0, max_tangent_out_of_plane_rad = 0.0, min_sin_tangent_vs_trimline = 0.0;
};

struct ExampleCase {
  std::string id;
  std::map<std::string, double> constants;
  Interval v_range;
  bool closed = false;
  std::vector<double> u, v;
  std::array<double, 2> s{};
  std::map<std::string, std::vector<Vec3>> boundary, boundary_dv;  ///< by C0, T0, C1, T1
  std::vector<ExampleSurface> surfaces;
  std::array<ExampleSide, 2> sides;
};

struct SweepGolden {
  std::vector<CardinalCase> cardinal;
  std::vector<SixthOrderCase> sixth_order;
  std::map<std::string, std::vector<double>> resonances;
  std::vector<ExampleCase> examples;
};

/// All cases of all files of this schema in `folder`. Throws std::runtime_error naming file and place: an
/// unknown key, a missing one, a wrong shape, a file without a schema that is not of this one.
[[nodiscard]] SweepGolden read_sweep_golden(const std::filesystem::path& folder);

}  // namespace blendwright::test
