// VTK XML poly data (.vtp): doubles, appended and zlib-compressed, so nothing is rounded.
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <limits>

#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/mesh_formats.hpp"
#include "kernel/exchange/vtk_arrays.hpp"
#include "kernel/exchange/vtk_messages.hpp"

namespace blendwright {
namespace {

constexpr const char* closed_key = "closed";  // of each line
constexpr const char* normals_key = "Normals";

void write(const std::filesystem::path& file, vtkPolyData& data, const VtkMessages& messages) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&data);
  writer->SetDataModeToAppended();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (!writer->Write() || writer->GetErrorCode() != 0)
    throw IoError(file.string() + ": cannot be written (" + messages.first_error() + ")");
  write_text_file(file, writer->GetOutputString());
}

vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& file, const VtkMessages& messages) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(
      read_text_file(file, largest_mesh_file));  // VTK would not say why a file cannot be opened
  reader->Update();
  const std::string error = messages.first_error();
  if (!error.empty() || reader->GetErrorCode() != 0)
    fail_reading(file, error.empty() ? "it is not VTK XML poly data" : error);
  return reader->GetOutput();
}

/// Every numeric point array but the normals, for the points `ids`.
std::vector<Column> columns_of(vtkPolyData& data, const std::vector<vtkIdType>& ids) {
  std::vector<Column> columns;
  vtkPointData& arrays = *data.GetPointData();
  for (int a = 0; a < arrays.GetNumberOfArrays(); ++a) {
    vtkDataArray* array = arrays.GetArray(a);
    if (!array || !array->GetName() || array == arrays.GetNormals()) continue;
    Column& column = columns.emplace_back(described_column(data, *array));
    column.values.reserve(ids.size() * static_cast<std::size_t>(column.components));
    for (const vtkIdType i : ids)
      for (int k = 0; k < column.components; ++k) column.values.push_back(array->GetComponent(i, k));
  }
  return columns;
}

Vec3 point_of(vtkPolyData& data, vtkIdType i) {
  Vec3 p;
  data.GetPoint(i, p.data());
  return p;
}

/// Columns of all lines by name, in order of appearance; NaN where a line lacks one.
std::vector<vtkSmartPointer<vtkDoubleArray>> joined_columns(std::span<const PolyLine> lines,
                                                            std::size_t points) {
  std::vector<vtkSmartPointer<vtkDoubleArray>> arrays;
  std::size_t first = 0;
  for (const PolyLine& line : lines) {
    for (const Column& column : line.columns) {
      vtkSmartPointer<vtkDoubleArray> array;
      for (const auto& known : arrays)
        if (array_name(column) == known->GetName()) array = known;
      if (!array) {
        array = arrays.emplace_back(array_for(column, points));
        array->Fill(std::numeric_limits<double>::quiet_NaN());
      }
      if (array->GetNumberOfComponents() != column.components)
        throw InputError(line.name + "/columns/" + column.name,
                         "has " + std::to_string(column.components) + " components, must have " +
                             std::to_string(array->GetNumberOfComponents()) + " as on the lines before");
      std::copy(column.values.begin(), column.values.end(),
                array->GetPointer(static_cast<vtkIdType>(first) * column.components));
    }
    first += line.points.size();
  }
  return arrays;
}

/// `shown` becomes the active array.
void show(vtkPolyData& data, const std::vector<Column>& columns, const std::string& shown) {
  for (const Column& column : columns)
    if (column.name == shown) data.GetPointData()->SetActiveScalars(array_name(column).c_str());
}

std::vector<vtkIdType> all_points(vtkPolyData& data) {
  std::vector<vtkIdType> ids(static_cast<std::size_t>(data.GetNumberOfPoints()));
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<vtkIdType>(i);
  return ids;
}

}  // namespace

void write_vtp(const std::filesystem::path& file, const TriMesh& mesh) {
  require_consistent(mesh);
  const VtkMessages messages;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  append_points(*points, mesh.points);
  data->SetPoints(points);

  vtkNew<vtkCellArray> triangles;
  for (const auto& t : mesh.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});
  data->SetPolys(triangles);
  if (mesh.triangles.empty()) {
    vtkNew<vtkCellArray> vertices;
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) vertices->InsertNextCell({i});
    data->SetVerts(vertices);
  }

  if (!mesh.normals.empty()) {
    const auto normals = array_for({normals_key, "", 3, {}}, mesh.normals.size());
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
      normals->SetTuple(static_cast<vtkIdType>(i), mesh.normals[i].data());
    data->GetPointData()->SetNormals(normals);
  }
  for (const Column& column : mesh.columns) {
    data->GetPointData()->AddArray(array_of(column));
    add_labels(*data, column);
  }
  show(*data, mesh.columns, mesh.shown);
  add_facts(*data, mesh.facts);
  add_text(*data, name_key, mesh.name);
  add_text(*data, note_key, mesh.note);
  write(file, *data, messages);
}

void write_vtp(const std::filesystem::path& file, std::span<const PolyLine> lines) {
  const VtkMessages messages;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkStringArray> names;
  names->SetName(name_key);
  vtkNew<vtkUnsignedCharArray> closed;
  closed->SetName(closed_key);
  for (const PolyLine& line : lines) {
    require_consistent(line);
    const vtkIdType first = points->GetNumberOfPoints(), count = static_cast<vtkIdType>(line.points.size());
    append_points(*points, line.points);
    cells->InsertNextCell(static_cast<int>(count) + (line.closed ? 1 : 0));
    for (vtkIdType i = 0; i < count; ++i) cells->InsertCellPoint(first + i);
    if (line.closed) cells->InsertCellPoint(first);  // the first point again: drawn closed by every viewer
    names->InsertNextValue(line.name);
    closed->InsertNextValue(line.closed ? 1 : 0);
  }
  data->SetPoints(points);
  data->SetLines(cells);
  for (const auto& array : joined_columns(lines, static_cast<std::size_t>(points->GetNumberOfPoints())))
    data->GetPointData()->AddArray(array);
  data->GetCellData()->AddArray(names);
  data->GetCellData()->AddArray(closed);
  if (!lines.empty()) {
    show(*data, lines.front().columns, lines.front().shown);
    add_facts(*data, lines.front().facts);
    add_text(*data, note_key, lines.front().note);
  }
  write(file, *data, messages);
}

TriMesh read_vtp(const std::filesystem::path& file) {
  const VtkMessages messages;
  const vtkSmartPointer<vtkPolyData> data = read(file, messages);
  if (data->GetNumberOfStrips() > 0) fail_reading(file, "it has triangle strips, must have triangles");
  TriMesh mesh;
  mesh.name = text_in(*data, name_key);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) mesh.points.push_back(point_of(*data, i));
  if (vtkDataArray* normals = data->GetPointData()->GetNormals()) {
    mesh.normals.resize(mesh.points.size());
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
      normals->GetTuple(static_cast<vtkIdType>(i), mesh.normals[i].data());
  }
  const auto cell = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell()) {
    vtkIdType corners = 0;
    const vtkIdType* ids = nullptr;
    cell->GetCurrentCell(corners, ids);
    if (corners != 3)
      fail_reading(file, "polygon " + std::to_string(cell->GetCurrentCellId()) + " has " +
                             std::to_string(corners) + " corners, must have 3");
    for (int k = 0; k < 3; ++k)
      if (ids[k] < 0 || ids[k] >= data->GetNumberOfPoints())
        fail_reading(file, "polygon " + std::to_string(cell->GetCurrentCellId()) + " names no point");
    mesh.triangles.push_back({static_cast<std::uint32_t>(ids[0]), static_cast<std::uint32_t>(ids[1]),
                              static_cast<std::uint32_t>(ids[2])});
  }
  mesh.columns = columns_of(*data, all_points(*data));
  mesh.note = text_in(*data, note_key);
  mesh.facts = columns_of(*data, *data->GetFieldData());
  if (vtkDataArray* active = data->GetPointData()->GetScalars(); active && active->GetName())
    mesh.shown = described_column(*data, *active).name;
  return mesh;
}

std::vector<Vec3> read_vtp_points(const std::filesystem::path& file) {
  const VtkMessages messages;
  const vtkSmartPointer<vtkPolyData> data = read(file, messages);
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) points.push_back(point_of(*data, i));
  return points;
}

std::vector<PolyLine> read_polylines(const std::filesystem::path& file) {
  const VtkMessages messages;
  const vtkSmartPointer<vtkPolyData> data = read(file, messages);
  auto* names = vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray(name_key));
  const vtkIdType first_line =
      data->GetNumberOfVerts();  // cell data count vertices, lines, polygons in this order
  std::vector<PolyLine> lines;
  const auto cell = vtk::TakeSmartPointer(data->GetLines()->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell()) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cell->GetCurrentCell(count, ids);
    std::vector<vtkIdType> points(ids, ids + count);
    for (const vtkIdType i : points)
      if (i < 0 || i >= data->GetNumberOfPoints())
        fail_reading(file, "line " + std::to_string(lines.size()) + " names no point");
    PolyLine& line = lines.emplace_back();
    line.closed = points.size() > 2 && points.front() == points.back();
    if (line.closed) points.pop_back();
    const vtkIdType cell_id = first_line + cell->GetCurrentCellId();
    if (names && cell_id < names->GetNumberOfValues()) line.name = names->GetValue(cell_id);
    for (const vtkIdType i : points) line.points.push_back(point_of(*data, i));
    line.columns = columns_of(*data, points);
    line.note = text_in(*data, note_key);
    line.facts = columns_of(*data, *data->GetFieldData());
  }
  return lines;
}

}  // namespace blendwright
