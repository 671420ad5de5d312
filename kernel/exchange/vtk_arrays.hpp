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
class vtkFieldData;
class vtkPoints;

namespace blendwright {

inline constexpr const char* name_key = "name";  ///< of what the file shows (field data) or of each line
inline constexpr const char* note_key = "note";  ///< of the file (field data): how it was made

/// "gap [mm]": the column's name in a file, with its unit; as it is without a unit or when the name ends with
/// the unit, as in "angle_deg". Escaped for XML, which VTK's writers leave to the caller.
[[nodiscard]] std::string array_name(const Column& column);
/// Room for `rows` of the column, with its name, its unit and its components.
[[nodiscard]] vtkSmartPointer<vtkDoubleArray> array_for(const Column& column, std::size_t rows);
/// The column with its values and its unit.
[[nodiscard]] vtkSmartPointer<vtkDoubleArray> array_of(const Column& column);
void append_points(vtkPoints& points, const std::vector<Vec3>& from);
/// Field data: one text under a key; nothing when the text is empty.
void add_text(vtkDataSet& data, const char* key, const std::string& text);
[[nodiscard]] std::string text_in(vtkDataSet& data, const char* key);
/// Field data "<column> labels": what the indices of a column stand for.
void add_labels(vtkDataSet& data, const Column& column);
/// Every array of numbers in point, cell or field data.
[[nodiscard]] std::vector<Column> columns_of(vtkDataSet& data, vtkFieldData& arrays);
/// Field data: each fact under its name.
void add_facts(vtkDataSet& data, const std::vector<Column>& facts);
/// The array's name (without the unit), unit, labels and components; no values.
[[nodiscard]] Column described_column(vtkDataSet& data, vtkDataArray& array);

}  // namespace blendwright
