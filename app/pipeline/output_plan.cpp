#include "app/pipeline/output_plan.hpp"

#include <unistd.h>

#include <algorithm>

namespace blendwright {

namespace fs = std::filesystem;

bool wants(const JobResult& result, OutputFormat format) {
  const auto& formats = result.job.output.formats;
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

std::vector<fs::path> OutputPlan::all() const {
  std::vector<fs::path> files{step, picture, plots, stl, obj, report};
  for (const auto* list : {&blend_meshes, &primary_meshes, &trimlines})
    files.insert(files.end(), list->begin(), list->end());
  std::erase(files, fs::path());
  return files;
}

OutputPlan plan_outputs(const JobResult& result, const Assembly& assembly, const fs::path& folder) {
  const std::string stem = result.job.name;
  OutputPlan plan;
  plan.report = folder / (stem + ".report.json");
  if (wants(result, OutputFormat::step)) plan.step = folder / (stem + ".step");
  if (wants(result, OutputFormat::png)) {
    plan.picture = folder / (stem + ".png");
    plan.plots = folder / (stem + ".errors.png");
  }
  if (wants(result, OutputFormat::stl)) plan.stl = folder / (stem + ".stl");
  if (wants(result, OutputFormat::obj)) plan.obj = folder / (stem + ".obj");
  if (wants(result, OutputFormat::vtp)) {
    for (const BlendPatch& b : assembly.blends) {
      plan.blend_meshes.push_back(folder / (stem + "." + b.name + ".vtp"));
      plan.trimlines.push_back(folder / (stem + "." + b.name + ".trimlines.vtp"));
    }
    for (const PrimaryPatch& p : assembly.primaries)
      plan.primary_meshes.push_back(folder / (stem + "." + p.name + ".vtp"));
  }
  return plan;
}

void refuse_existing(const OutputPlan& plan) {
  for (const fs::path& file : plan.all())
    if (fs::exists(file))
      throw IoError(file.string() + ": already exists; use --force to replace it or another folder");
}

StagingFolder::StagingFolder(const fs::path& folder)
    : folder_(folder), path_(folder / (".unfinished-" + std::to_string(::getpid()))) {
  std::error_code error;
  made_ = !fs::exists(folder_, error);
  fs::create_directories(folder_, error);
  if (error || !fs::is_directory(folder_))
    throw IoError(folder_.string() + ": cannot be made a folder (" +
                  (error ? error.message() : "it is a file") + "); choose another output folder");
  fs::create_directories(path_, error);
  if (error)
    throw IoError(folder_.string() + ": cannot be written to (" + error.message() +
                  "); choose another output folder");
}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (made_ && !published_) fs::remove(folder_, ignored);  // only when empty
}

void StagingFolder::publish(const std::vector<fs::path>& files) {
  for (const fs::path& file : files)
    if (fs::exists(file) && !fs::is_regular_file(file))
      throw IoError(file.string() + ": is not a regular file; choose another name");
  for (const fs::path& file : files) {
    std::error_code error;
    fs::rename(of(file), file, error);
    if (error) throw IoError(file.string() + ": cannot be written (" + error.message() + ")");
    published_ = true;
  }
}

}  // namespace blendwright
