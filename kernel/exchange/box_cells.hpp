#pragma once
// Files of boxes: a subdivision of space, with what is known of each box.
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/field/range.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

struct BoxCells {
  std::string name;
  std::vector<Box> boxes;
  std::vector<Column> columns;  ///< one row per box
  std::vector<Column> facts{};  ///< of the whole: any number of rows each
  std::string note{};
};

/// VTK XML unstructured grid (.vtu) of hexahedra along the axes, so that viewers can cut them; everything as
/// 64-bit floats, columns as cell data, facts, name and note as field data. Throws IoError and leaves nothing
/// then; InputError when a column does not fit the boxes or a box is not finite.
void write_vtu(const std::filesystem::path& file, const BoxCells& cells);
/// Reads such a file, for checks on what a user receives. Throws IoError.
[[nodiscard]] BoxCells read_vtu(const std::filesystem::path& file);

}  // namespace blendwright
