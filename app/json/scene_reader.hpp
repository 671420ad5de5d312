#pragma once
// Scene files: JSON with comments -> SceneSpec -> Scene.
//
//   {"unit": "mm", "strict": true, "let": {"r": 3}, "nodes": {"<name>": {"kind": ..., ...}, ...}, "solid":
//   "<name>", "adjust": {"<name>/<key>": [lowest, highest], ...}}
//
// A node stands wherever a node is expected, by its name or as an object in place; such an inner node is
// named by its JSON pointer. Numbers may be constant formulas ("2*pi*r").
#include <filesystem>
#include <string>
#include <string_view>

#include "app/json/scene_adjust.hpp"
#include "implicit/scene/scene.hpp"

namespace blendwright {

/// Throws InputError with every problem of the text at once, each with its JSON pointer in the order of the
/// file; a syntax error names line and column. When the text alone is in order, build_scene() may still find
/// problems of the scene.
[[nodiscard]] SceneSpec read_scene(std::string_view text);
/// Reads the file ("-": standard input). IoError when it cannot be read.
[[nodiscard]] SceneSpec read_scene_file(const std::filesystem::path& file);

/// A scene file that is in order in every respect.
struct SceneFile {
  std::string name{};         ///< stem of the file
  std::string source_hash{};  ///< of the text
  SceneSpec spec;
  Scene scene;
  std::vector<SceneAdjust> adjust{};  ///< in the order of the file
};
/// Reads and builds; `solid`, when not empty, replaces the scene's. Throws InputError with the problems of
/// the text and of the scene together, in the order of the file.
[[nodiscard]] SceneFile build_scene_text(std::string_view text, const std::filesystem::path& file,
                                         const std::string& solid = "");
[[nodiscard]] SceneFile build_scene_file(const std::filesystem::path& file, const std::string& solid = "");

/// JSON Schema (draft 2020-12) of a scene.
[[nodiscard]] std::string scene_schema();

}  // namespace blendwright
