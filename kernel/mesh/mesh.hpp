#pragma once
// Triangle meshes and polylines with named columns of point data: what the mesh writers and pictures take.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// One named value (components = 1) or vector (3) per point; unit is written in labels ("mm", "deg", "1/mm",
/// "").
struct Column {
  std::string name, unit;
  int components = 1;
  std::vector<double> values;
  std::vector<std::string> labels{};  ///< of a column of indices: what 0, 1, ... stand for
};

struct TriMesh {
  std::string name;
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  ///< empty or one per point
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Column> columns;
  std::string note{};           ///< how it was made; kept by formats that have a place for it
  std::vector<Column> facts{};  ///< of the whole, any number of rows each: parameters, worst errors
  std::string shown{};          ///< the column that viewers colour by first; empty: theirs to choose
};

struct PolyLine {
  std::string name;
  std::vector<Vec3> points;
  bool closed = false;  ///< the last point joins the first
  std::vector<Column> columns;
  std::string note{};
  std::vector<Column> facts{};
  std::string shown{};
};

/// Mesh of a surface's whole domain on an nu x nv grid of cells; closed directions share their seam points,
/// poles collapse to triangles without zero area. Normals from the jets. Columns "u" and "v" are filled.
[[nodiscard]] TriMesh tessellate(const Surface& surface, int nu, int nv);

}  // namespace blendwright
