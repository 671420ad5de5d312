#include "app/view/window/pane_scene.hpp"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/window/overlay.hpp"
#include "kernel/exchange/picture_pattern.hpp"
#include "kernel/exchange/picture_scene.hpp"

namespace blendwright {
namespace {

constexpr double primary_opacity = 0.34;
constexpr double surroundings = 0.35;  // of the size of what is looked at
constexpr float line_width = 3.0f, arrow_width = 2.0f, knob_size = 12.0f, hair_width = 1.0f,
                envelope_width = 2.0f;
const Colour blend_colour{0.90, 0.55, 0.15}, primary_colour{0.72, 0.75, 0.80};  // as in STEP files
const Colour trimline_colour{0.10, 0.10, 0.12}, light_trimline_colour{0.93, 0.93, 0.90};
const Colour trimline_knob{0.13, 0.40, 0.70}, magnitude_knob{0.0, 0.55, 0.40}, held_knob{0.85, 0.20, 0.10};
const Colour hair_colour{0.13, 0.35, 0.62}, envelope_colour{0.80, 0.15, 0.15};
const Vec3 default_light(-0.45, 0.6, 1.0);  // in the camera's axes, as in pictures

void set_array(vtkFloatArray& array, std::span<const float> values) {
  array.SetNumberOfComponents(3);
  // VTK only reads them; the memory stays the document's.
  array.SetArray(const_cast<float*>(values.data()), static_cast<vtkIdType>(values.size()), 1);
  array.Modified();
}

unsigned char byte_of(double x) { return static_cast<unsigned char>(std::lround(255.0 * x)); }

}  // namespace

PaneScene::Strokes::Strokes(vtkRenderer& renderer, float width, float point_size) {
  mapper->SetInputData(data);
  // They lie in surfaces and are drawn over these.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -6.0);
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(-12.0);
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLineWidth(width);
  actor->GetProperty()->SetPointSize(point_size);
  actor->GetProperty()->SetRenderPointsAsSpheres(true);
  actor->GetProperty()->SetLighting(point_size > 1.0f);
  actor->GetProperty()->SetAmbient(0.4);
  actor->GetProperty()->SetDiffuse(0.6);
  renderer.AddActor(actor);
}

void PaneScene::Strokes::fill(const std::vector<Vec3>& points,
                              const std::vector<std::array<std::uint32_t, 2>>& lines, bool as_points,
                              const std::vector<Colour>& colours) {
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (const Vec3& p : points) places->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> segments, marks;
  for (const auto& [a, b] : lines) segments->InsertNextCell({a, b});
  for (std::size_t i = 0; as_points && i < points.size(); ++i)
    marks->InsertNextCell({static_cast<vtkIdType>(i)});
  vtkNew<vtkUnsignedCharArray> rgb;
  rgb->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Colour& c = colours[std::min(i, colours.size() - 1)];
    const std::array<unsigned char, 3> bytes{byte_of(c.r), byte_of(c.g), byte_of(c.b)};
    rgb->InsertNextTypedTuple(bytes.data());
  }
  data->SetPoints(places);
  data->SetLines(segments);
  data->SetVerts(marks);
  data->GetPointData()->SetScalars(rgb);
  actor->SetVisibility(!points.empty());
}

PaneScene::PaneScene()
    : trimlines_(*renderer_, line_width, 1.0f),
      arrows_(*handles_, arrow_width, 1.0f),
      knobs_(*handles_, 1.0f, knob_size),
      hairs_(*renderer_, hair_width, 1.0f),
      envelope_(*renderer_, envelope_width, 1.0f) {
  renderer_->AutomaticLightCreationOff();
  add_lights(*renderer_);
  renderer_->GetActiveCamera()->ParallelProjectionOn();
  handles_->SetActiveCamera(renderer_->GetActiveCamera());
  handles_->AutomaticLightCreationOff();
  add_lights(*handles_);
  renderer_->SetUseFXAA(true);
}

void PaneScene::update_part(Part& part, const DrawnSurface& surface, const ViewState& state) {
  set_array(*part.positions, surface.positions);
  if (part.points != surface.positions.size() / 3 || part.triangles != surface.triangles.data()) {
    part.points = surface.positions.size() / 3;
    part.triangles = surface.triangles.data();
    vtkNew<vtkCellArray> cells;
    for (const auto& t : surface.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
    part.data->SetPolys(cells);
  }
  vtkNew<vtkPoints> points;
  points->SetData(part.positions);
  part.data->SetPoints(points);
  if (!surface.normals.empty()) {
    set_array(*part.normals, surface.normals);
    part.data->GetPointData()->SetNormals(part.normals);
  }
  part.actor->SetPosition(surface.origin.x(), surface.origin.y(), surface.origin.z());
  const bool primary = surface.role == DrawnSurface::Role::primary;
  const Colour colour = surface.role == DrawnSurface::Role::blend ? blend_colour : primary_colour;
  shade(*part.actor->GetProperty(), colour, primary ? primary_opacity : 1.0);
  part.actor->SetVisibility(!primary || state.primaries);
  if (!primary) return;
  // Facets of a primary lie in front of or behind the blend where the two meet: the blend is what is meant.
  // Layers of one colour look the same in any order: no depth peeling.
  part.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  part.mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(4.0, 8.0);
}

void PaneScene::update_clipping(const std::vector<DrawnSurface>& surfaces) {
  lo_ = Vec3::Constant(std::numeric_limits<double>::max());
  hi_ = -lo_;
  for (const DrawnSurface& s : surfaces)
    for (std::size_t i = 0; s.role != DrawnSurface::Role::primary && 3 * i + 2 < s.positions.size(); ++i) {
      const Vec3 p = s.origin + Vec3(s.positions[3 * i], s.positions[3 * i + 1], s.positions[3 * i + 2]);
      lo_ = lo_.cwiseMin(p);
      hi_ = hi_.cwiseMax(p);
    }
  clipping_->RemoveAllItems();
  if (!(lo_.x() <= hi_.x())) {
    lo_ = Vec3::Constant(-1.0);
    hi_ = Vec3::Constant(1.0);
  }
  const double margin = surroundings * (hi_ - lo_).norm();
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) {
      Vec3 normal = Vec3::Zero();
      normal[axis] = side;
      const Vec3 origin = side > 0.0 ? Vec3(lo_.array() - margin) : Vec3(hi_.array() + margin);
      vtkNew<vtkPlane> plane;
      plane->SetNormal(normal.data());
      plane->SetOrigin(origin.data());
      clipping_->AddItem(plane);
    }
  middle_ = 0.5 * (lo_ + hi_);
  reach_ = (hi_ - lo_).norm() + 2.0 * margin;
}

void PaneScene::update_shapes(const Document& document, const ViewState& state,
                              const std::vector<SessionHandle>& handles) {
  const std::vector<DrawnSurface> surfaces = document.surfaces();
  while (parts_.size() > surfaces.size()) {
    renderer_->RemoveActor(parts_.back()->actor);
    parts_.pop_back();
  }
  while (parts_.size() < surfaces.size()) {
    auto part = std::make_unique<Part>();
    part->mapper->SetInputData(part->data);
    part->mapper->ScalarVisibilityOff();
    part->actor->SetMapper(part->mapper);
    renderer_->AddActor(part->actor);
    parts_.push_back(std::move(part));
  }
  roles_.clear();
  update_clipping(surfaces);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    update_part(*parts_[i], surfaces[i], state);
    roles_.push_back(surfaces[i].role);
    const bool primary = surfaces[i].role == DrawnSurface::Role::primary;
    parts_[i]->mapper->SetClippingPlanes(primary ? clipping_.Get() : nullptr);
  }
  const ViewTheme theme = view_theme(state.dark);
  renderer_->SetBackground(theme.background.r, theme.background.g, theme.background.b);
  update_lines(document, state);
  update_handles(document, state, handles);
  update_comb(document, state);
}

void PaneScene::update_lines(const Document& document, const ViewState& state) {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 2>> lines;
  for (const PolyLine& line : document.lines()) {
    const auto first = static_cast<std::uint32_t>(points.size());
    const auto count = static_cast<std::uint32_t>(line.points.size());
    points.insert(points.end(), line.points.begin(), line.points.end());
    for (std::uint32_t i = 0; i + 1 < count; ++i) lines.push_back({first + i, first + i + 1});
    if (line.closed && count > 2) lines.push_back({first + count - 1, first});
  }
  trimlines_.fill(points, lines, false,
                  {state.dark && state.show != Show::field ? light_trimline_colour : trimline_colour});
  trimlines_.mapper->SetScalarVisibility(true);
}

void PaneScene::update_handles(const Document& document, const ViewState& state,
                               const std::vector<SessionHandle>& handles) {
  std::vector<Vec3> knobs, ends;
  std::vector<std::array<std::uint32_t, 2>> arrows;
  std::vector<Colour> colours;
  for (const SessionHandle& h : handles) {
    if (!state.handles || h.blend != state.group) continue;
    const bool held = state.held && state.held->kind == h.kind && state.held->side == h.side &&
                      state.held->index == h.index && state.held->blend == h.blend;
    const bool magnitude = h.kind == SessionHandle::Kind::magnitude;
    knobs.push_back(h.position);
    colours.push_back(held ? held_knob : magnitude ? magnitude_knob : trimline_knob);
    if (!magnitude) continue;
    arrows.push_back({static_cast<std::uint32_t>(ends.size()), static_cast<std::uint32_t>(ends.size() + 1)});
    ends.push_back(document.foot_of(h));
    ends.push_back(h.position);
  }
  knobs_.fill(knobs, {}, true, colours);
  arrows_.fill(ends, arrows, false, {magnitude_knob});
}

void PaneScene::update_comb(const Document& document, const ViewState& state) {
  Comb comb;
  if (state.comb) comb = comb_of(document.comb(), (hi_ - lo_).norm());
  hairs_.fill(comb.hairs.mesh.points, comb.hairs.edges, false, {hair_colour});
  envelope_.fill(comb.envelope.mesh.points, comb.envelope.edges, false, {envelope_colour});
}

void PaneScene::update_colours(const ViewState& state, const std::vector<std::vector<float>>& values,
                               const std::optional<ColourScale>& scale) {
  const bool zebra = state.show == Show::zebra, isophotes = state.show == Show::isophotes;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = *parts_[i];
    const bool patterned = (zebra || isophotes) && roles_[i] != DrawnSurface::Role::primary &&
                           part.data->GetPointData()->GetNormals();
    set_pattern(*part.actor,
                !patterned ? SurfacePattern::none
                : zebra    ? SurfacePattern::zebra
                           : SurfacePattern::isophotes,
                state.options.stripes, default_light);
    const bool coloured = !patterned && scale && i < values.size() && values[i].size() == part.points;
    part.mapper->SetScalarVisibility(coloured);
    part.actor->GetProperty()->SetLighting(state.show != Show::field || !coloured);  // as on the bar
    if (!coloured) continue;
    part.colours->SetNumberOfComponents(3);
    part.colours->SetNumberOfTuples(static_cast<vtkIdType>(part.points));
    scale->colour(values[i], {part.colours->GetPointer(0), 3 * part.points});
    part.colours->Modified();
    part.data->GetPointData()->SetScalars(part.colours);
    part.data->Modified();
  }
}

void PaneScene::aim(const ViewCamera& camera, const PixelBox& pane, int width, int height) {
  renderer_->SetViewport(pane.left / width, pane.bottom / height, pane.right / width, pane.top / height);
  handles_->SetViewport(renderer_->GetViewport());
  vtkCamera& eye = *renderer_->GetActiveCamera();
  const double depth = reach_ + (camera.focus - middle_).norm();
  const Vec3 position = camera.focus + depth * camera.back;
  eye.SetFocalPoint(camera.focus.x(), camera.focus.y(), camera.focus.z());
  eye.SetPosition(position.x(), position.y(), position.z());
  eye.SetViewUp(camera.up.x(), camera.up.y(), camera.up.z());
  eye.SetParallelScale(camera.half_height);
  eye.SetClippingRange(1e-4 * depth, 2.0 * depth);
}

}  // namespace blendwright
