#include "kernel/exchange/picture_scene.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkLight.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "kernel/exchange/colour_map.hpp"
#include "kernel/exchange/picture_pattern.hpp"

namespace blendwright {
namespace {

constexpr double tube_radius = 0.0026, weld_distance = 1e-7;  // of the object's size
const Colour line_colour{0.10, 0.10, 0.12}, border_colour{0.42, 0.44, 0.48};

const std::vector<double>* column_values(const TriMesh& mesh, const std::string& name) {
  for (const Column& c : mesh.columns)
    if (c.name == name && c.components == 1) return &c.values;
  return nullptr;
}

vtkSmartPointer<vtkPoints> points_of(const std::vector<Vec3>& from) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  for (const Vec3& p : from) points->InsertNextPoint(p.data());
  return points;
}

void add_surface(vtkRenderer& renderer, const PictureMesh& m, const Picture& picture,
                 const std::optional<ColourScale>& scale, const ViewFrame& frame) {
  const vtkSmartPointer<vtkPolyData> data = surface_of(m.mesh);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->ScalarVisibilityOff();
  const bool patterned = m.coloured && picture.pattern != SurfacePattern::none;
  if (m.coloured && scale && !patterned) {
    // Position on the bar, so that colours between points follow the bar's scale.
    vtkNew<vtkDoubleArray> values;
    for (const double v : *column_values(m.mesh, picture.column))
      values->InsertNextValue(std::isnan(v) ? v : scale->axis().position(v));
    data->GetPointData()->SetScalars(values);
    mapper->ScalarVisibilityOn();
    mapper->SetLookupTable(colour_table(scale->map(), 0.0, 1.0));
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();
  }
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  shade(*actor->GetProperty(), m.colour, m.opacity);
  if (m.unlit) actor->GetProperty()->SetLighting(false);
  if (patterned) {
    const Vec3 light = picture.to_light.value_or(frame.back);
    set_pattern(*actor, picture.pattern, picture.stripes,
                {frame.right.dot(light), frame.up.dot(light), frame.back.dot(light)});
  }
  renderer.AddActor(actor);
}

/// For each point the first one at the same place: the two sides of a seam are one.
std::vector<std::uint32_t> welded(const std::vector<Vec3>& points, double distance) {
  std::map<std::array<long long, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> first(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::array<long long, 3> place{};
    for (int k = 0; k < 3; ++k) place[static_cast<std::size_t>(k)] = std::llround(points[i][k] / distance);
    first[i] = places.try_emplace(place, i).first->second;
  }
  return first;
}

/// `in_surface`: lines that lie in a surface are drawn over it.
void add_edges(vtkRenderer& renderer, const TriMesh& mesh, vtkCellArray& cells, const Colour& colour,
               double width, bool in_surface) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(mesh.points));
  data->SetLines(&cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  if (in_surface) {
    mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -4.0);
    mapper->SetResolveCoincidentTopologyToPolygonOffset();
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width * RenderTarget::oversampling));
  renderer.AddActor(actor);
}

/// Edges of one triangle only: thin lines that give translucent surfaces a border.
void add_border(vtkRenderer& renderer, const TriMesh& mesh, double distance) {
  const std::vector<std::uint32_t> point = welded(mesh.points, distance);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(point[t[i]], point[t[(i + 1) % 3]])];
  vtkNew<vtkCellArray> cells;
  for (const auto& [edge, count] : uses)
    if (count == 1) cells->InsertNextCell({edge.first, edge.second});
  add_edges(renderer, mesh, *cells, border_colour, 1.2, false);
}

void add_given_edges(vtkRenderer& renderer, const PictureMesh& m) {
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b] : m.edges) cells->InsertNextCell({a, b});
  add_edges(renderer, m.mesh, *cells, m.edge_colour, m.edge_width, true);
}

void add_tube(vtkRenderer& renderer, const PolyLine& line, double radius, const Colour& colour) {
  std::vector<Vec3> points;
  for (const Vec3& p : line.points)  // a tube has no direction between equal points
    if (points.empty() || (p - points.back()).norm() > 1e-3 * radius) points.push_back(p);
  if (line.closed && points.size() > 2) points.push_back(points.front());
  if (points.size() < 2) return;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) cells->InsertCellPoint(static_cast<vtkIdType>(i));
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(points));
  data->SetLines(cells);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(data);
  tube->SetRadius(radius);
  tube->SetNumberOfSides(10);
  tube->SetCapping(line.closed ? 0 : 1);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tube->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  shade(*actor->GetProperty(), colour, 1.0);
  renderer.AddActor(actor);
}

}  // namespace

vtkSmartPointer<vtkPolyData> surface_of(const TriMesh& mesh) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points_of(mesh.points));
  vtkNew<vtkCellArray> cells;
  for (const auto& t : mesh.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  data->SetPolys(cells);
  if (!mesh.normals.empty()) {
    vtkNew<vtkDoubleArray> normals;
    normals->SetNumberOfComponents(3);
    for (const Vec3& n : mesh.normals) normals->InsertNextTuple(n.data());
    data->GetPointData()->SetNormals(normals);
  }
  return data;
}

void shade(vtkProperty& property, const Colour& colour, double opacity) {
  property.SetColor(colour.r, colour.g, colour.b);
  property.SetOpacity(opacity);
  property.SetAmbient(0.26);
  property.SetDiffuse(0.80);
  property.SetSpecular(0.10);
  property.SetSpecularPower(30.0);
  property.SetInterpolationToPhong();
}

/// A key light over the left shoulder, a weak one from the right and one from the eye: no side is black.
void add_lights(vtkRenderer& renderer) {
  struct Lamp {
    double x, y, z, intensity;
  };
  for (const Lamp& lamp :
       {Lamp{-0.6, 0.9, 1.0, 0.62}, Lamp{0.9, -0.2, 0.6, 0.30}, Lamp{0.0, 0.0, 1.0, 0.36}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(lamp.x, lamp.y, lamp.z);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetIntensity(lamp.intensity);
    renderer.AddLight(light);
  }
}

vtkSmartPointer<vtkRenderer> view_scene(const Picture& picture, const std::optional<ColourScale>& scale,
                                        const ViewFrame& frame, const PixelBox& area) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(area.left / picture.width, area.bottom / picture.height, area.right / picture.width,
                        area.top / picture.height);
  const ViewExtents extents = extents_of(picture, frame);
  const ViewExtent& extent = extents.all;
  if (extent.empty() || extent.size() == 0.0) return renderer;
  bool translucent = false;
  for (const PictureMesh& m : picture.meshes) {
    if (!m.edges.empty()) add_given_edges(*renderer, m);
    if (m.mesh.triangles.empty()) continue;
    add_surface(*renderer, m, picture, scale, frame);
    if (!m.coloured && m.edges.empty()) add_border(*renderer, m.mesh, weld_distance * extent.size());
    translucent = translucent || m.opacity < 1.0;
  }
  for (const PolyLine& line : picture.lines)
    add_tube(*renderer, line, tube_radius * std::min(extent.size(), 4.0 * extents.focus.size()), line_colour);
  renderer->AutomaticLightCreationOff();
  add_lights(*renderer);
  aim(*renderer, frame, extents, window_of(extents, area));
  if (translucent) {
    renderer->SetUseDepthPeeling(1);
    renderer->SetMaximumNumberOfPeels(4);
    renderer->SetOcclusionRatio(0.0);
  }
  return renderer;
}

}  // namespace blendwright
