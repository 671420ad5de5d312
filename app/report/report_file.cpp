#include "app/report/report_file.hpp"

#include <functional>

#include "app/pipeline/mesh_pictures.hpp"
#include "app/pipeline/picture_job.hpp"
#include "app/pipeline/result_meshes.hpp"
#include "app/pipeline/result_pictures.hpp"
#include "app/report/blend_page.hpp"
#include "app/report/fit_page.hpp"
#include "app/report/mesh_page.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_picture = std::size_t{64} << 20;

/// The bytes of a picture that is drawn beside the report and taken away again; empty when none was drawn.
std::string drawn(const fs::path& report, const std::function<void(const fs::path&)>& draw) {
  fs::path place = report;
  place.replace_extension(".picture.png");
  const UnfinishedFile unfinished(place);
  draw(unfinished.path());
  return fs::exists(unfinished.path()) ? read_text_file(unfinished.path(), largest_picture) : std::string();
}

std::string blend_picture(const fs::path& report, const JobResult& result, const JobOutputs* outputs,
                          std::vector<std::string>& notes) {
  if (outputs)
    for (const WrittenFile& f : outputs->files)
      if (f.kind == "png") return read_text_file(f.path, largest_picture);  // the first is the view
  return drawn(report, [&](const fs::path& png) {
    const Display display;
    if (!display.available()) {
      notes.push_back("the report has no picture: " + display.reason());
      return;
    }
    std::vector<TriMesh> blends;
    std::vector<PolyLine> lines;
    for (const BlendResult& b : result.blends) {
      blends.push_back(blend_mesh(b, result.job.unit));
      for (PolyLine& line : trimline_lines(b, result.job.unit)) lines.push_back(std::move(line));
    }
    write_picture(png, error_picture(result, blends, {}, lines), display);
  });
}

/// The fitted blends, coloured by how far they are from those that the fit started from.
void draw_change(const fs::path& png, const JobSpec& job, const FitJobResult& result,
                 std::vector<std::string>& notes) {
  const Display display;
  if (!display.available()) {
    notes.push_back("the report has no picture: " + display.reason());
    return;
  }
  PictureJob picture{.input = {}, .show = Show::deviation, .width = 1000, .height = 750};
  PictureInput start = picture_input(run_job(job));
  start.name = "the start";
  picture.other = std::make_shared<const PictureInput>(std::move(start));
  write_picture(png, *plan_picture(picture_input(result.verified), picture).picture, display);
}

}  // namespace

void require_report_place(const fs::path& file, bool overwrite) {
  if (file.extension() != ".html")
    throw InputError("--report", "is \"" + file.string() + "\", must end in .html");
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) throw IoError(folder.string() + ": no such folder for the report");
  StagingFolder::require_places({file});
  if (!overwrite) refuse_existing({file});
}

void write_blend_report(const fs::path& file, const JobResult& result, const JobOutputs* outputs,
                        const std::string& command, std::vector<std::string>& notes) {
  const std::string picture = blend_picture(file, result, outputs, notes);
  write_text_file(file, html(blend_page(result, outputs, picture, command)));
}

void write_fit_report(const fs::path& file, const JobSpec& job, const FitJobResult& result,
                      const std::vector<WrittenFile>& files, const std::string& command,
                      std::vector<std::string>& notes) {
  const std::string picture = drawn(file, [&](const fs::path& png) { draw_change(png, job, result, notes); });
  write_text_file(file, html(fit_page(job, result, files, picture, command)));
}

void write_mesh_report(const fs::path& file, const SceneFile& scene, const MeshResult& result,
                       const std::string& command, std::vector<std::string>& notes) {
  const std::string picture =
      drawn(file, [&](const fs::path& png) { write_mesh_picture(png, scene, result.made.mesh, "", notes); });
  write_text_file(file, html(mesh_page(scene, result, picture, command)));
}

}  // namespace blendwright
