#include <vtkDataSetSurfaceFilter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "app/json/json_value.hpp"
#include "app/view/window/blend_document.hpp"
#include "app/view/window/scene_document.hpp"
#include "kernel/base/error.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/vtk_messages.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

/// What the text is when it is JSON: a scene has nodes or a solid, a report says which program made it.
enum class JsonKind { job, scene, report };
JsonKind kind_of(const std::string& text) {
  try {
    const JsonValue document = parse_json(text);
    if (document.find("nodes") || document.find("solid")) return JsonKind::scene;
    if (document.find("verified")) return JsonKind::report;
  } catch (const InputError&) {
    return JsonKind::job;  // whose reader says what is wrong
  }
  return JsonKind::job;
}

TriMesh mesh_of(vtkPolyData& data) {
  TriMesh mesh;
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    Vec3 p;
    data.GetPoint(i, p.data());
    mesh.points.push_back(p);
  }
  for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c) {
    if (data.GetCellType(c) != VTK_TRIANGLE) continue;
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    data.GetCellPoints(c, count, corners);
    mesh.triangles.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[1]),
                              static_cast<std::uint32_t>(corners[2])});
  }
  return mesh;
}

}  // namespace

std::string Document::saved_text() const {
  throw InputError("", "can only be looked at, must be a job or a scene with \"adjust\" to be saved");
}

void Document::export_step(const fs::path&) const {
  throw InputError("", "has no surfaces that STEP could hold, must be a job");
}

TriMesh read_cells(const fs::path& file) {
  if (!fs::exists(file)) throw IoError(file.string() + ": cannot be read (no such file)");
  const VtkMessages messages;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkDataSetSurfaceFilter> outside;
  outside->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(outside->GetOutputPort());
  triangles->Update();
  if (reader->GetErrorCode() != 0 || !messages.first_error().empty())
    throw IoError(file.string() + ": cannot be read (" + messages.first_error() + ")");
  TriMesh mesh = mesh_of(*triangles->GetOutput());
  mesh.name = file.stem().string();
  if (mesh.triangles.empty()) throw InputError("", "has no cells, must have some to be seen");
  return mesh;
}

std::unique_ptr<Document> open_document(const std::string& file, const Progress& progress) {
  const std::string extension = lower_case_extension(file);
  if (extension == ".vtu") {
    PictureInput input;
    input.name = fs::path(file).stem().string();
    input.parts.push_back({PicturePart::Role::other, read_cells(file), {}});
    return std::make_unique<FileDocument>(file, std::move(input));
  }
  if (file == "-" || extension == ".json") {
    const std::string text = read_json_text(file);
    const JsonKind kind = kind_of(text);
    if (kind == JsonKind::report)
      throw InputError("", "is a report, must be the job or the scene that it reports on");
    if (kind == JsonKind::job) return std::make_unique<BlendDocument>(file, text);
    return std::make_unique<SceneDocument>(file, text, progress);
  }
  return std::make_unique<FileDocument>(file, read_picture_input(file, {}, progress));
}

}  // namespace blendwright
