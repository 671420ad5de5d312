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
  bool fairness = false;
  std::string pull;    ///< direction for the draft; empty: none
  std::string report;  ///< page for people; empty: none
  std::string called;  ///< how the program was called
  std::optional<int> threads;
};
/// Builds, writes and verifies.
[[nodiscard]] int blend(const BlendCommand& command, const Console& console);

struct VerifyCommand {
  std::string job;
  std::optional<double> position, angle_deg, curvature;  ///< instead of the job's tolerances
  bool json = false, times = false, quiet = false;
  bool certify = false;  ///< prove bounds between the samples
  bool fairness = false;
  std::string pull, report, called;  ///< as of BlendCommand
  bool force = false;                ///< replace the report
  std::optional<int> threads;
};
/// Builds and verifies in memory.
[[nodiscard]] int verify(const VerifyCommand& command, const Console& console);

struct FitCommand {
  std::string job;                      ///< "-": standard input
  std::string output;                   ///< "-": standard output; empty: none
  std::vector<std::string> objectives;  ///< as typed_objective takes them; empty: the job's
  std::optional<int> starts;
  std::string plot;            ///< empty: none
  std::string report, called;  ///< as of BlendCommand
  std::string points;                 ///< of a scene: what it is fitted to
  std::vector<std::string> unknowns;  ///< of a scene, as typed_unknown takes them; empty: all
  std::optional<double> robust_scale;
  bool from_points = false;
  bool force = false, json = false, times = false, quiet = false;
  std::optional<int> threads;
};
/// Finds the shape that a job asks for, and writes the job that has it; of a scene, the numbers that bring it
/// closest to points.
[[nodiscard]] int fit(const FitCommand& command, const Console& console);

struct MeshCommand {
  std::string scene;  ///< "-": standard input
  std::vector<std::string> outputs;
  std::string solid;  ///< empty: the scene's
  std::optional<double> cell;
  int cells = 128;
  std::string box, at_box = "cap", max_memory = "4G", colour;
  bool force = false, json = false, times = false, quiet = false;
  std::string report, called;  ///< as of BlendCommand
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

struct OffsetCommand {
  MeshCommand mesh;  ///< the scene, how the offset is meshed and what is written
  std::optional<double> distance, round, fillet, tolerance;
  std::string kind = "ball", shell;
};
/// Makes a mesh of an offset of a scene's solid, writes it and measures how exact the offset is.
[[nodiscard]] int offset(const OffsetCommand& command, const Console& console);

/// Limits of a search that is to decide something.
struct SearchCommand {
  double tolerance = 1e-9;
  std::size_t max_boxes = 2'000'000;
  std::string domain;  ///< empty: where the bounds of the solids allow points
};

struct RelateCommand {
  std::vector<std::string> scenes;  ///< "part.json" or "part.json#node"
  std::string points, output, mode = "length";
  SearchCommand search;
  bool confirm = false, convert_units = false, force = false, json = false, quiet = false;
  std::optional<int> threads;
};
/// Says how two solids lie to each other, or where points lie.
[[nodiscard]] int relate(const RelateCommand& command, const Console& console);

struct CollideCommand {
  std::vector<std::string> scenes, cells;
  std::string motion, output, projected, expect;
  SearchCommand search;
  bool all = false, convert_units = false, force = false, json = false, times = false, quiet = false;
  std::optional<int> threads;
};
/// Says whether bodies touch, as they stand or along a motion.
[[nodiscard]] int collide(const CollideCommand& command, const Console& console);

struct CompareCommand {
  std::string first, second;  ///< "-": standard input, for one of them
  std::string output;         ///< empty: none
  std::optional<double> limit;
  bool force = false, json = false, quiet = false;
  std::optional<int> threads;
};
/// Says how far two results are from each other.
[[nodiscard]] int compare(const CompareCommand& command, const Console& console);

struct PictureCommand {
  std::string input, output, show;  ///< input "-": standard input; show empty: what the input is about
  std::string to, solid, plane, range, pull, light, from, box;
  std::string curvature = "mean", size = "1280x960", background = "white";
  std::vector<std::string> views;
  double stripes = 16.0;
  int cells = 160, comb_lines = 24;
  bool log = false, force = false, json = false, times = false, quiet = false;
  std::optional<int> threads;
};
/// Draws a picture of a job, a scene, a STEP file or a mesh.
[[nodiscard]] int picture(const PictureCommand& command, const Console& console);
/// What --show may be.
[[nodiscard]] std::vector<std::string> picture_words();

struct ViewCommand {
  std::vector<std::string> files;  ///< one, or two side by side
  std::string save, script;        ///< empty: beside the file; a person's events
  int width = 1280, height = 960;
  bool force = false, dark = false, times = false;
  std::optional<int> threads;
};
/// Shows files in a window and lets jobs be shaped by hand.
[[nodiscard]] int view(const ViewCommand& command, const Console& console);

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
  std::string of;  ///< "job", "scene", "report" or "fit-report"
};
/// Prints a JSON Schema.
[[nodiscard]] int schema(const SchemaCommand& command, const Console& console);

}  // namespace blendwright
