#include "kernel/exchange/picture.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkLight.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTubeFilter.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "kernel/base/error.hpp"
#include "kernel/exchange/canvas.hpp"
#include "kernel/exchange/colour_map.hpp"
#include "kernel/exchange/mesh_formats.hpp"
#include "kernel/exchange/vtk_messages.hpp"

namespace blendwright {
namespace {

constexpr double title_height = 0.085, bar_column = 0.16;     // of the picture
constexpr double filled = 0.90;                               // of the free area, by the object
constexpr double surroundings = 5.0;                          // most that is shown, in sizes of the focus
constexpr double tube_radius = 0.0026, weld_distance = 1e-7;  // of the object's size
constexpr double key_swatch = 18.0, key_space = 9.0, key_line = 30.0;  // pixels
const TextStyle key_style{.size = 15};
const Vec3 default_view(1.0, -1.2, 0.8);
const Colour line_colour{0.10, 0.10, 0.12}, border_colour{0.42, 0.44, 0.48};

/// The camera's axes: `back` towards the eye.
struct Frame {
  Vec3 right, up, back;
};
Frame frame_of(const std::optional<Vec3>& view) {
  const Vec3 wanted = view.value_or(default_view);
  const double length = wanted.norm();
  if (!(length > 0.0) || !std::isfinite(length))
    throw InputError("view", "has no direction, must be a finite vector other than 0");
  const Vec3 back = wanted / length;
  const Vec3 upright = std::abs(back.z()) < 0.99 ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 right = upright.cross(back).normalized();
  return {right, back.cross(right), back};
}

/// Extent of the object along the camera's axes.
struct Extent {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::max()), hi = -lo;
  void add(const Frame& f, const Vec3& p) {
    const Vec3 q(f.right.dot(p), f.up.dot(p), f.back.dot(p));
    lo = lo.cwiseMin(q);
    hi = hi.cwiseMax(q);
  }
  [[nodiscard]] bool empty() const { return lo.x() > hi.x(); }
  [[nodiscard]] double size() const { return (hi - lo).norm(); }
};

/// `all`: of everything; `focus`: of what the picture is about, the lines and the coloured or opaque meshes.
struct Extents {
  Extent all, focus;
};
Extents extents_of(const Picture& picture, const Frame& frame) {
  Extents e;
  for (const PictureMesh& m : picture.meshes)
    for (const Vec3& p : m.mesh.points) {
      e.all.add(frame, p);
      if (m.coloured || m.opacity >= 1.0) e.focus.add(frame, p);
    }
  for (const PolyLine& line : picture.lines)
    for (const Vec3& p : line.points) {
      e.all.add(frame, p);
      e.focus.add(frame, p);
    }
  if (e.focus.empty()) e.focus = e.all;
  return e;
}

const Column& coloured_column(const Picture& picture, const TriMesh& mesh) {
  for (const Column& c : mesh.columns)
    if (c.name == picture.column && c.components == 1) return c;
  throw InputError("column",
                   "is \"" + picture.column + "\", which the mesh \"" + mesh.name + "\" does not have");
}

std::optional<ColourScale> bar_scale(const Picture& picture) {
  if (picture.column.empty()) return std::nullopt;
  std::vector<double> all;
  bool any = false;
  for (const PictureMesh& m : picture.meshes) {
    if (!m.coloured) continue;
    any = true;
    const Column& column = coloured_column(picture, m.mesh);
    all.insert(all.end(), column.values.begin(), column.values.end());
  }
  if (!any) return std::nullopt;
  return ColourScale::over(all, picture.logarithmic ? ScaleRule::logarithmic : ScaleRule::linear);
}

vtkSmartPointer<vtkPoints> points_of(const std::vector<Vec3>& from) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  for (const Vec3& p : from) points->InsertNextPoint(p.data());
  return points;
}

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

void add_surface(vtkRenderer& renderer, const PictureMesh& m, const Picture& picture,
                 const std::optional<ColourScale>& scale) {
  const vtkSmartPointer<vtkPolyData> data = surface_of(m.mesh);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->ScalarVisibilityOff();
  if (m.coloured && scale) {
    // Position on the bar, so that colours between points follow the bar's scale.
    vtkNew<vtkDoubleArray> values;
    for (const double v : coloured_column(picture, m.mesh).values)
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

void add_tube(vtkRenderer& renderer, const PolyLine& line, double radius) {
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
  shade(*actor->GetProperty(), line_colour, 1.0);
  renderer.AddActor(actor);
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

/// Half the height of a window of the area's shape around `extent`.
double half_height(const Extent& extent, const PixelBox& area) {
  const Vec3 half = 0.5 * (extent.hi - extent.lo);
  return std::max(half.y(), half.x() * area.height() / area.width()) / filled;
}

/// Middle of the window [c - half, c + half] that lies nearest to `wanted` without leaving [lo, hi] where it
/// fits in.
double middle_within(double wanted, double half, double lo, double hi) {
  return hi - lo <= 2.0 * half ? 0.5 * (lo + hi) : std::clamp(wanted, lo + half, hi - half);
}

/// Parallel projection: lengths compare across the picture. Everything is shown, or the surroundings of the
/// focus.
void aim(vtkRenderer& renderer, const Frame& frame, const Extents& extents, const PixelBox& area) {
  const Extent &all = extents.all, &focus = extents.focus;
  const double whole = half_height(all, area), near_focus = surroundings * half_height(focus, area);
  const double scale = near_focus > 0.0 ? std::min(whole, near_focus) : whole;
  const Vec3 wanted = 0.5 * (focus.lo + focus.hi);
  const double half_width = filled * scale * area.width() / area.height();
  const double x = middle_within(wanted.x(), half_width, all.lo.x(), all.hi.x());
  const double y = middle_within(wanted.y(), filled * scale, all.lo.y(), all.hi.y());
  const Vec3 target = x * frame.right + y * frame.up + 0.5 * (all.lo.z() + all.hi.z()) * frame.back;
  const double distance = 4.0 * all.size();
  const Vec3 eye = target + distance * frame.back;
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(target.data());
  camera.SetPosition(eye.data());
  camera.SetViewUp(frame.up.data());
  camera.SetParallelScale(scale);
  camera.SetClippingRange(distance - all.size(), distance + all.size());
}

/// The colour bar with its scale and its title, in the column right of the object.
void draw_bar(Canvas& canvas, const PixelBox& column, const ColourScale& scale, const std::string& title) {
  const Axis& axis = scale.axis();
  const double height = std::min(0.74 * column.height(), 26.0 * 20);
  const double bottom = column.bottom + 0.5 * (column.height() - height);
  const PixelBox bar{column.left + 10, bottom, column.left + 30, bottom + height};
  constexpr int steps = 128;
  for (int i = 0; i < steps; ++i)
    canvas.fill({bar.left, bar.bottom + height * i / steps, bar.right, bar.bottom + height * (i + 1) / steps},
                colour_at(scale.map(), (i + 0.5) / steps));
  canvas.frame(bar, border_colour, 1.0);
  const TextStyle label{.size = 15};
  double widest = 0.0;
  for (const Tick& tick : axis.ticks) {
    const double y = bar.bottom + height * (tick.value - axis.lo) / (axis.hi - axis.lo);
    canvas.line({{bar.right, y}, {bar.right + 5, y}}, border_colour, 1.0);
    canvas.text({bar.right + 9, y}, tick.label, label);
    widest = std::max(widest, Canvas::width_of(tick.label, label));
  }
  const TextStyle style =
      Canvas::fitting(title, {.size = 16, .align = Align::centre, .upward = true}, column.height() - 20);
  const double x = std::min(bar.right + 9 + widest + 20, column.right - 12);
  canvas.text({x, 0.5 * (bar.bottom + bar.top)}, title, style);
}

/// Width of the legend's column.
double key_width(const std::vector<PictureKey>& keys) {
  double widest = 0.0;
  for (const PictureKey& key : keys) widest = std::max(widest, Canvas::width_of(key.label, key_style));
  return keys.empty() ? 0.0 : widest + key_swatch + 3.0 * key_space;
}

/// The legend, in the middle of its column, first entry on top.
void draw_keys(Canvas& canvas, const PixelBox& column, const std::vector<PictureKey>& keys) {
  const double height = key_line * static_cast<double>(keys.size());
  double y = 0.5 * (column.bottom + column.top) + 0.5 * height - 0.5 * key_line;
  for (const PictureKey& key : keys) {
    const PixelBox swatch{column.left, y - 0.5 * key_swatch, column.left + key_swatch, y + 0.5 * key_swatch};
    canvas.fill(swatch, key.colour);
    canvas.frame(swatch, border_colour, 1.0);
    canvas.text({swatch.right + key_space, y}, key.label, key_style);
    y -= key_line;
  }
}

vtkSmartPointer<vtkRenderer> scene(const Picture& picture, const std::optional<ColourScale>& scale,
                                   const PixelBox& area) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(area.left / picture.width, area.bottom / picture.height, area.right / picture.width,
                        area.top / picture.height);
  renderer->SetBackground(1.0, 1.0, 1.0);
  const Frame frame = frame_of(picture.view);
  const Extents extents = extents_of(picture, frame);
  const Extent& extent = extents.all;
  if (extent.empty() || extent.size() == 0.0) return renderer;
  bool translucent = false;
  for (const PictureMesh& m : picture.meshes) {
    if (!m.edges.empty()) add_given_edges(*renderer, m);
    if (m.mesh.triangles.empty()) continue;
    add_surface(*renderer, m, picture, scale);
    if (!m.coloured && m.edges.empty()) add_border(*renderer, m.mesh, weld_distance * extent.size());
    translucent = translucent || m.opacity < 1.0;
  }
  for (const PolyLine& line : picture.lines)
    add_tube(*renderer, line, tube_radius * std::min(extent.size(), 4.0 * extents.focus.size()));
  renderer->AutomaticLightCreationOff();
  add_lights(*renderer);
  aim(*renderer, frame, extents, area);
  if (translucent) {
    renderer->SetUseDepthPeeling(1);
    renderer->SetMaximumNumberOfPeels(4);
    renderer->SetOcclusionRatio(0.0);
  }
  return renderer;
}

}  // namespace

void write_picture(const std::filesystem::path& png, const Picture& picture, const Display& display) {
  require_drawable(png, picture.width, picture.height, display);
  for (const PictureMesh& m : picture.meshes) {
    require_consistent(m.mesh);
    for (const auto& edge : m.edges)
      if (std::max(edge[0], edge[1]) >= m.mesh.points.size())
        throw InputError("edges", "names point " + std::to_string(std::max(edge[0], edge[1])) +
                                      ", must be below " + std::to_string(m.mesh.points.size()));
  }
  for (const PolyLine& line : picture.lines) require_consistent(line);
  const std::optional<ColourScale> scale = bar_scale(picture);

  const VtkMessages messages;
  RenderTarget target(picture.width, picture.height);
  const double right = scale ? picture.width * (1.0 - bar_column) : picture.width - key_width(picture.keys);
  const double top = picture.title.empty() ? picture.height : picture.height * (1.0 - title_height);
  Canvas canvas;
  const TextStyle style = Canvas::fitting(picture.title, {.size = 23, .align = Align::centre, .bold = true},
                                          0.96 * picture.width);
  canvas.text({0.5 * picture.width, 0.5 * (top + picture.height)}, picture.title, style);
  if (scale)
    draw_bar(canvas, {right, 0.0, static_cast<double>(picture.width), top}, *scale,
             picture.bar_title.empty() ? picture.column : picture.bar_title);
  else
    draw_keys(canvas, {right, 0.0, static_cast<double>(picture.width), top}, picture.keys);
  canvas.finish(target, 0);
  const vtkSmartPointer<vtkRenderer> renderer = scene(picture, scale, {0.0, 0.0, right, top});
  target.add(*renderer, 1);
  target.write_png(png);
}

}  // namespace blendwright
