#include "kernel/exchange/vtk_arrays.hpp"

#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>

#include <algorithm>

namespace blendwright {
namespace {

constexpr const char* labels_suffix = " labels";

/// VTK's XML writers put names of arrays into attributes as they are.
std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '>':
        text += "&gt;";
        break;
      case '"':
        text += "&quot;";
        break;
      default:
        text += c;
    }
  return text;
}

}  // namespace

std::string array_name(const Column& column) {
  const std::string name = escaped(column.name);
  if (column.unit.empty() || column.name.ends_with("_" + column.unit)) return name;
  return name + " [" + column.unit + "]";
}

vtkSmartPointer<vtkDoubleArray> array_for(const Column& column, std::size_t rows) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(array_name(column).c_str());
  array->SetNumberOfComponents(column.components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(rows));
  if (!column.unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), column.unit);
  return array;
}

vtkSmartPointer<vtkDoubleArray> array_of(const Column& column) {
  auto array = array_for(column, column.values.size() / static_cast<std::size_t>(column.components));
  std::copy(column.values.begin(), column.values.end(), array->GetPointer(0));
  return array;
}

void append_points(vtkPoints& points, const std::vector<Vec3>& from) {
  for (const Vec3& p : from) points.InsertNextPoint(p.data());
}

void add_text(vtkDataSet& data, const char* key, const std::string& text) {
  if (text.empty()) return;
  vtkNew<vtkStringArray> array;
  array->SetName(key);
  array->InsertNextValue(text);
  data.GetFieldData()->AddArray(array);
}

std::string text_in(vtkDataSet& data, const char* key) {
  auto* array = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray(key));
  return array && array->GetNumberOfValues() > 0 ? std::string(array->GetValue(0)) : std::string();
}

void add_labels(vtkDataSet& data, const Column& column) {
  if (column.labels.empty()) return;
  vtkNew<vtkStringArray> labels;
  labels->SetName((array_name(column) + labels_suffix).c_str());
  for (const std::string& label : column.labels) labels->InsertNextValue(label);
  data.GetFieldData()->AddArray(labels);
}

void add_facts(vtkDataSet& data, const std::vector<Column>& facts) {
  for (const Column& fact : facts) {
    data.GetFieldData()->AddArray(array_of(fact));
    add_labels(data, fact);
  }
}

std::vector<Column> columns_of(vtkDataSet& data, vtkFieldData& arrays) {
  std::vector<Column> columns;
  for (int a = 0; a < arrays.GetNumberOfArrays(); ++a) {
    vtkDataArray* array = arrays.GetArray(a);
    if (!array || !array->GetName()) continue;
    Column& column = columns.emplace_back(described_column(data, *array));
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
      for (int k = 0; k < column.components; ++k) column.values.push_back(array->GetComponent(i, k));
  }
  return columns;
}

Column described_column(vtkDataSet& data, vtkDataArray& array) {
  Column column;
  column.name = array.GetName();
  column.components = array.GetNumberOfComponents();
  if (array.HasInformation() && array.GetInformation()->Has(vtkDataArray::UNITS_LABEL()))
    column.unit = array.GetInformation()->Get(vtkDataArray::UNITS_LABEL());
  auto* labels = vtkStringArray::SafeDownCast(
      data.GetFieldData()->GetAbstractArray((std::string(array.GetName()) + labels_suffix).c_str()));
  const std::string suffix = " [" + column.unit + "]";
  if (!column.unit.empty() && column.name.ends_with(suffix))
    column.name.resize(column.name.size() - suffix.size());
  for (vtkIdType i = 0; labels && i < labels->GetNumberOfValues(); ++i)
    column.labels.push_back(labels->GetValue(i));
  return column;
}

}  // namespace blendwright
