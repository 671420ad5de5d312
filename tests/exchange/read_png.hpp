#pragma once
// Pixels of a PNG, by VTK's reader.
#include <array>
#include <filesystem>
#include <vector>

namespace blendwright::test {

struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  ///< three per pixel, rows from the top
  [[nodiscard]] std::array<unsigned char, 3> at(int x, int y) const {
    const auto i = static_cast<std::size_t>(3 * (y * width + x));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

/// Throws std::runtime_error when the file is no RGB PNG.
[[nodiscard]] Pixels read_png(const std::filesystem::path& file);

}  // namespace blendwright::test
