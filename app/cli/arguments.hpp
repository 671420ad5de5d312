#pragma once
// Values of flags that are more than a number or a word.
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "kernel/field/range.hpp"
#include "verify/surface/fairness.hpp"

namespace blendwright {

/// "x0,y0,z0,x1,y1,z1" with x0 < x1, y0 < y1, z0 < z1. Throws InputError: what it is and what it must be.
[[nodiscard]] Box box_argument(const std::string& text);
/// "inner,outer", both >= 0. Throws InputError.
[[nodiscard]] std::array<double, 2> shell_argument(const std::string& text);
/// "x,y,z", not all 0: a unit vector. Throws InputError.
[[nodiscard]] Vec3 direction_argument(const std::string& text);
/// "1280x960": width and height in pixels. Throws InputError.
[[nodiscard]] std::array<int, 2> size_argument(const std::string& text);
/// "z=1.5": the axis (0, 1, 2) and the place. Throws InputError.
[[nodiscard]] std::pair<int, double> plane_argument(const std::string& text);
/// "lo,hi" with lo < hi. Throws InputError.
[[nodiscard]] Interval range_argument(const std::string& text);
/// Bytes: a number, with K, M or G for 1024, 1024^2, 1024^3. Throws InputError.
[[nodiscard]] std::size_t memory_argument(const std::string& text);

/// What --fairness and --pull ask for; nothing when `wanted` is false.
[[nodiscard]] std::optional<FairnessOptions> fairness_of(bool wanted, const std::string& pull);
/// How the program was called, as a line for a shell: "blendwright" and the arguments, quoted where needed.
[[nodiscard]] std::string command_line(int argc, const char* const* argv);

}  // namespace blendwright
