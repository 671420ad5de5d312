#pragma once
// Private to the VTK files: columns, names and notes as arrays of a data set.
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "kernel/mesh/mesh.hpp"

class vtkAbstractArray;
class vtkDataArray;
class vtkDataSet;
class vtkDoubleArray;
class vtkPoints;

namespace blendwright {

inline constexpr const char* name_key = "name";  ///< of what the file shows (field data) or of each line
inline constexpr const char* note_key = "note";  ///< of the file (field data): how it was made

[[nodiscard]] vtkSmartPointer<vtkDoubleArray> array_of(const std::string& name, int components,
                                                       std::size_t rows);
/// The column with its values and its unit.
[[nodiscard]] vtkSmartPointer<vtkDoubleArray> array_of(const Column& column);
void append_points(vtkPoints& points, const std::vector<Vec3>& from);
/// Field data: one text under a key; nothing when the text is empty.
void add_text(vtkDataSet& data, const char* key, const std::string& text);
[[nodiscard]] std::string text_in(vtkDataSet& data, const char* key);
/// Field data "<column> labels": what the indices of a column stand for.
void add_labels(vtkDataSet& data, const Column& column);
/// The array's name, unit, labels and components; no values.
[[nodiscard]] Column described_column(vtkDataSet& data, vtkDataArray& array);

}  // namespace blendwright
