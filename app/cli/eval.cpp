#include <fstream>
#include <iostream>

#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/json_value.hpp"
#include "app/pipeline/eval_job.hpp"
#include "app/pipeline/staging.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/point_files.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

/// Samples that are held at a time, besides the points.
constexpr std::size_t block = 1 << 16;

std::vector<Vec3> points_of(const std::string& file) {
  return file == "-" ? read_csv_points(std::cin) : read_points(file);
}

/// What can be said before anything is read.
void require_sensible(const EvalCommand& command) {
  if (command.points == "-" && command.scene == "-")
    throw InputError("--points", "is standard input, as the scene is; must be a file");
  if (command.output.empty()) return;
  const std::string extension = lower_case_extension(command.output);
  if (extension != ".csv" && extension != ".vtp")
    throw InputError("--output", "is " + in_quotes(command.output) + ", must end in \".csv\" or \".vtp\"");
  if (!command.force) refuse_existing({command.output});
}

/// Calls `use` with the samples of all points, a block at a time.
template <class Use>
void for_each_block(const ScalarField& field, std::span<const Vec3> points, const Progress& progress,
                    Use use) {
  for (std::size_t at = 0; at < points.size(); at += block) {
    progress.at(static_cast<double>(at) / static_cast<double>(points.size()), "evaluating");
    use(samples_at(field, points.subspan(at, std::min(block, points.size() - at))));
  }
}

void print_csv(std::ostream& out, const SceneFile& scene, std::span<const Vec3> points,
               const Progress& progress) {
  out << csv_header();
  for_each_block(scene.scene.field, points, progress, [&](const std::vector<FieldSample>& samples) {
    out << csv_lines(samples, scene.scene.field.members());
  });
}

void print_json(std::ostream& out, const SceneFile& scene, std::span<const Vec3> points,
                const Progress& progress) {
  std::string head = json_text(JsonValue::object({{"scene", scene.name},
                                                  {"source_hash", scene.source_hash},
                                                  {"solid", scene.spec.solid},
                                                  {"unit", name(scene.spec.unit)},
                                                  {"level", name(scene.scene.field.level())}}));
  head.erase(head.rfind('\n', head.size() - 2));  // its closing bracket comes after the points
  out << head << ",\n  \"points\": [";
  const char* before = "\n";
  for_each_block(scene.scene.field, points, progress, [&](const std::vector<FieldSample>& samples) {
    out << before << json_objects(samples, scene.scene.field.members());
    before = ",\n";
  });
  out << "\n]\n}\n";
}

void write_output(const EvalCommand& command, const SceneFile& scene, std::span<const Vec3> points,
                  const Progress& progress) {
  StagedFiles staged({command.output});
  const fs::path file = staged.of(command.output);
  try {
    if (lower_case_extension(file) == ".vtp") {
      std::vector<FieldSample> all;
      for_each_block(scene.scene.field, points, progress, [&](const std::vector<FieldSample>& samples) {
        all.insert(all.end(), samples.begin(), samples.end());
      });
      write_vtp(file, sample_cloud(scene, all));
    } else {
      std::ofstream out(file, std::ios::binary);
      print_csv(out, scene, points, progress);
      out.close();
      if (!out) throw IoError(command.output + ": cannot be written; is the disk full?");
    }
    static_cast<void>(staged.publish());
  } catch (const IoError& e) {
    throw staged.with_final_names(e);
  }
}

}  // namespace

int eval(const EvalCommand& command, const Console& console) {
  std::string subject = shown_name(command.scene);  // whose problems are told
  return guarded(console, subject, [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    require_sensible(command);
    const SceneFile scene = build_scene_file(command.scene, command.solid);
    if (!command.quiet)
      for (const Problem& w : scene.scene.warnings) console.warn(w.where + ": " + w.message);
    subject = shown_name(command.points);
    const std::vector<Vec3> points = points_of(command.points);
    subject = shown_name(command.scene);
    if (!command.output.empty())
      write_output(command, scene, points, run.progress());
    else if (command.json)
      print_json(console.out(), scene, points, run.progress());
    else
      print_csv(console.out(), scene, points, run.progress());
    run.clear();
    if (!command.output.empty() && !command.quiet)
      console.out() << with_seconds("wrote " + command.output + ", " + counted(points.size(), "point"),
                                    run.seconds());
    return exit_done;
  });
}

}  // namespace blendwright
