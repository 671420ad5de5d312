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

}  // namespace

vtkSmartPointer<vtkDoubleArray> array_of(const std::string& name, int components, std::size_t rows) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(rows));
  return array;
}

vtkSmartPointer<vtkDoubleArray> array_of(const Column& column) {
  auto array = array_of(column.name, column.components,
                        column.values.size() / static_cast<std::size_t>(column.components));
  std::copy(column.values.begin(), column.values.end(), array->GetPointer(0));
  if (!column.unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), column.unit);
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
  labels->SetName((column.name + labels_suffix).c_str());
  for (const std::string& label : column.labels) labels->InsertNextValue(label);
  data.GetFieldData()->AddArray(labels);
}

Column described_column(vtkDataSet& data, vtkDataArray& array) {
  Column column;
  column.name = array.GetName();
  column.components = array.GetNumberOfComponents();
  if (array.HasInformation() && array.GetInformation()->Has(vtkDataArray::UNITS_LABEL()))
    column.unit = array.GetInformation()->Get(vtkDataArray::UNITS_LABEL());
  auto* labels = vtkStringArray::SafeDownCast(
      data.GetFieldData()->GetAbstractArray((column.name + labels_suffix).c_str()));
  for (vtkIdType i = 0; labels && i < labels->GetNumberOfValues(); ++i)
    column.labels.push_back(labels->GetValue(i));
  return column;
}

}  // namespace blendwright
