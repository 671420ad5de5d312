#include "app/pipeline/output_plan.hpp"

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

}  // namespace blendwright
