// VTK XML unstructured grids (.vtu) of boxes: doubles, appended and zlib-compressed, so nothing is rounded.
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>

#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/box_cells.hpp"
#include "kernel/exchange/mesh_formats.hpp"
#include "kernel/exchange/vtk_arrays.hpp"
#include "kernel/exchange/vtk_messages.hpp"

namespace blendwright {
namespace {

constexpr int corners = 8;

/// VTK's voxel: corner i has the upper end of axis k where bit k of i is set.
vtkSmartPointer<vtkUnstructuredGrid> grid_of(const std::vector<Box>& boxes) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(boxes.size()) * corners);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->AllocateExact(static_cast<vtkIdType>(boxes.size()), static_cast<vtkIdType>(boxes.size()) * corners);
  vtkIdType next = 0;
  for (const Box& box : boxes) {
    std::array<vtkIdType, corners> ids{};
    for (int i = 0; i < corners; ++i, ++next) {
      ids[static_cast<std::size_t>(i)] = next;
      points->SetPoint(next, (i & 1 ? box.hi : box.lo).x(), (i & 2 ? box.hi : box.lo).y(),
                       (i & 4 ? box.hi : box.lo).z());
    }
    grid->InsertNextCell(VTK_VOXEL, corners, ids.data());
  }
  grid->SetPoints(points);
  return grid;
}

void require_consistent(const BoxCells& cells) {
  for (std::size_t i = 0; i < cells.boxes.size(); ++i)
    if (!cells.boxes[i].finite())
      throw InputError("boxes/" + std::to_string(i), "is not finite, must have six finite numbers");
  for (const Column& c : cells.columns)
    if (c.components < 1 || c.values.size() != cells.boxes.size() * static_cast<std::size_t>(c.components))
      throw InputError("columns/" + c.name, "has " + std::to_string(c.values.size()) +
                                                " values, must have a row for each of " +
                                                std::to_string(cells.boxes.size()) + " boxes");
  for (const Column& c : cells.facts)
    if (c.components < 1 || c.values.size() % static_cast<std::size_t>(c.components) != 0)
      throw InputError("facts/" + c.name, "has " + std::to_string(c.values.size()) +
                                              " values, must have whole rows of " +
                                              std::to_string(c.components));
}

}  // namespace

void write_vtu(const std::filesystem::path& file, const BoxCells& cells) {
  require_consistent(cells);
  const VtkMessages messages;
  const vtkSmartPointer<vtkUnstructuredGrid> grid = grid_of(cells.boxes);
  for (const Column& column : cells.columns) {
    grid->GetCellData()->AddArray(array_of(column));
    add_labels(*grid, column);
  }
  add_facts(*grid, cells.facts);
  add_text(*grid, name_key, cells.name);
  add_text(*grid, note_key, cells.note);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (!writer->Write() || writer->GetErrorCode() != 0)
    throw IoError(file.string() + ": cannot be written (" + messages.first_error() + ")");
  write_text_file(file, writer->GetOutputString());
}

BoxCells read_vtu(const std::filesystem::path& file) {
  const VtkMessages messages;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(read_text_file(file, largest_mesh_file));
  reader->Update();
  const std::string error = messages.first_error();
  if (!error.empty() || reader->GetErrorCode() != 0)
    fail_reading(file, error.empty() ? "it is no VTK XML unstructured grid" : error);
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  BoxCells cells{text_in(grid, name_key), {}, {}, {}, text_in(grid, note_key)};
  for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    grid.GetCellPoints(i, count, ids);
    if (grid.GetCellType(i) != VTK_VOXEL || count != corners)
      fail_reading(file, "cell " + std::to_string(i) + " is no box along the axes");
    Box& box = cells.boxes.emplace_back();
    grid.GetPoint(ids[0], box.lo.data());
    grid.GetPoint(ids[corners - 1], box.hi.data());
  }
  cells.columns = columns_of(grid, *grid.GetCellData());
  cells.facts = columns_of(grid, *grid.GetFieldData());
  return cells;
}

}  // namespace blendwright
