#pragma once
// Points from files: lines of numbers, or the points of VTK poly data.
#include <filesystem>
#include <istream>
#include <vector>

#include "kernel/base/units.hpp"

namespace blendwright {

/// One point per line: numbers separated by commas, semicolons, tabs or blanks. A first line of names chooses
/// the columns x, y and z among others; without one, every line has exactly three numbers. Empty lines and
/// lines that start with # are left out. Throws InputError with every broken line ("line 7"), at most 20 of
/// them and the count of the others; a number that is not finite breaks its line.
[[nodiscard]] std::vector<Vec3> read_csv_points(std::istream& in);

/// The points of a .vtp, whatever its cells are; any other file is read as lines of numbers. Throws IoError,
/// and InputError as above.
[[nodiscard]] std::vector<Vec3> read_points(const std::filesystem::path& file);

}  // namespace blendwright
