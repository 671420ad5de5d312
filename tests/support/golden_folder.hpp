#pragma once
// Where golden data are.
#include <cstdlib>
#include <filesystem>

namespace blendwright::test {

/// BLENDWRIGHT_GOLDEN_DIR when set, else the project's own folder.
[[nodiscard]] inline std::filesystem::path golden_folder() {
  const char* chosen = std::getenv("BLENDWRIGHT_GOLDEN_DIR");
  if (chosen != nullptr && *chosen != '\0') return chosen;
  return std::filesystem::path(BLENDWRIGHT_SOURCE_DIR) / "tests/data/golden";
}

}  // namespace blendwright::test
