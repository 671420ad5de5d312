#pragma once
// Motions of bodies from lines of numbers.
//
//   step, body, x, y, z, qw, qx, qy, qz
//   0, arm, 10, 0, 0, 1, 0, 0, 0
//
// The first line names the columns, in any order: step (or time), body (its name or its number from 1), the
// move x, y, z, and the turn before it, as a quaternion qw, qx, qy, qz of length 1 (within 1e-6; it is made
// exact) or as axis_x, axis_y, axis_z, angle_deg, or left out. Lines of one step stand together and steps
// ascend; a body without a line keeps its placement, at first that of its scene.
#include <filesystem>
#include <istream>
#include <string>
#include <utility>
#include <vector>

#include "kernel/field/rigid_motion.hpp"

namespace blendwright {

struct MotionStep {
  double at = 0.0;                                          ///< step or time
  std::vector<std::pair<std::size_t, RigidMotion>> placed;  ///< bodies that have a line
};

struct Motion {
  std::string at_name = "step";  ///< or "time"
  std::vector<MotionStep> steps;
};

/// Throws InputError with every broken line ("line 7"), at most 20 of them and the count of the others; also
/// when there is no step at all.
[[nodiscard]] Motion read_motion(std::istream& in, const std::vector<std::string>& bodies);
/// The same from a file, or from standard input ("-"). Throws IoError when it cannot be read.
[[nodiscard]] Motion read_motion_file(const std::filesystem::path& file,
                                      const std::vector<std::string>& bodies);

}  // namespace blendwright
