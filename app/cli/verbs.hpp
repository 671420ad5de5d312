#pragma once
// The program's verbs: what each is asked, one plain function for each, and their table.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/console.hpp"

namespace blendwright {

/// A row of the verbs table: --help prints it.
struct VerbInfo {
  std::string_view name, summary, example;
};
[[nodiscard]] std::span<const VerbInfo> verbs_table();

struct BlendCommand {
  std::string job;  ///< "-": standard input
  std::string folder = "out";
  std::vector<std::string> formats;  ///< words of the format family; empty: as the job says
  bool force = false, json = false, times = false, quiet = false;
  bool certify = false;  ///< prove bounds between the samples
  std::optional<int> threads;
};
/// Builds, writes and verifies.
[[nodiscard]] int blend(const BlendCommand& command, const Console& console);

struct VerifyCommand {
  std::string job;
  std::optional<double> position, angle_deg, curvature;  ///< instead of the job's tolerances
  bool json = false, times = false, quiet = false;
  bool certify = false;  ///< prove bounds between the samples
  std::optional<int> threads;
};
/// Builds and verifies in memory.
[[nodiscard]] int verify(const VerifyCommand& command, const Console& console);

struct MeshCommand {
  std::string scene;  ///< "-": standard input
  std::vector<std::string> outputs;
  std::string solid;  ///< empty: the scene's
  std::optional<double> cell;
  int cells = 128;
  std::string box, at_box = "cap", max_memory = "4G", colour;
  bool force = false, json = false, times = false, quiet = false;
  std::optional<int> threads;
};
/// Makes a mesh of a scene's solid, writes and measures it.
[[nodiscard]] int mesh(const MeshCommand& command, const Console& console);

struct EvalCommand {
  std::string scene, points, solid, output;  ///< output empty: standard output
  bool force = false, json = false, quiet = false;
  std::optional<int> threads;
};
/// Evaluates a scene's field at given points.
[[nodiscard]] int eval(const EvalCommand& command, const Console& console);

struct InspectCommand {
  std::string part;
  bool json = false;
};
/// Lists the faces and edges of a STEP file with their selectors.
[[nodiscard]] int inspect(const InspectCommand& command, const Console& console);

struct ListCommand {
  std::string family;  ///< empty: the families themselves
  bool json = false;
};
/// Lists the rows of a family table, or the families.
[[nodiscard]] int list(const ListCommand& command, const Console& console);
[[nodiscard]] std::vector<std::string> listed_families();

struct SchemaCommand {
  std::string of;  ///< "job", "scene" or "report"
};
/// Prints a JSON Schema.
[[nodiscard]] int schema(const SchemaCommand& command, const Console& console);

}  // namespace blendwright
