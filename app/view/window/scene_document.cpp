#include "app/view/window/scene_document.hpp"

#include <algorithm>
#include <cmath>

#include "app/pipeline/field_section.hpp"

namespace blendwright {
namespace {

constexpr std::size_t comb_planes = 7, comb_hairs = 160;  // those of files
constexpr std::size_t section_cells = 240, coarse_section_cells = 80;
constexpr double section_margin = 0.18;  // around the solid, of its size: that of pictures

}  // namespace

SceneDocument::SceneDocument(std::filesystem::path file, const std::string& text, const Progress& progress,
                             SceneCells cells)
    : file_(std::move(file)),
      session_(text, file_, cells, progress),
      mesh_(session_.mesh()),
      first_shape_(shape()) {}

void SceneDocument::refresh() {
  mesh_ = DrawnMesh(session_.mesh());
  if (field_) cut();
}

void SceneDocument::choose(Show show) {
  field_ = show == Show::field;
  section_.reset();
  if (field_) cut();
}

void SceneDocument::cut() {
  const std::vector<Vec3>& points = session_.mesh().points;
  Box box{points.front(), points.front()};
  for (const Vec3& p : points) box = {box.lo.cwiseMin(p), box.hi.cwiseMax(p)};
  const Vec3 around = Vec3::Constant(section_margin * box.size().maxCoeff());
  box = {box.lo - around, box.hi + around};
  SectionPlane plane;
  box.size().minCoeff(&plane.k);
  plane.at = box.centre()[plane.k];
  FieldSection made = field_section(build_scene(session_.spec()).field, box, plane,
                                    session_.coarse() ? coarse_section_cells : section_cells);
  made.mesh.name = "field";
  const double most = made.most > 0.0 ? made.most : -made.least;
  section_ = Section{DrawnMesh(std::move(made.mesh)), std::move(made.outline), most};
}

std::vector<DrawnSurface> SceneDocument::surfaces() const {
  return {(section_ ? section_->plane : mesh_).drawn(DrawnSurface::Role::other)};
}

std::vector<PolyLine> SceneDocument::lines() const {
  return section_ ? section_->outline : std::vector<PolyLine>{};
}

std::vector<CombLine> SceneDocument::comb() const {
  return comb_of_sections({&mesh_.mesh()}, comb_planes, comb_hairs, nullptr);
}

std::vector<float> SceneDocument::values(std::size_t, Show show, const ShowOptions& options) const {
  if (!section_) return mesh_.values(show, options);
  std::vector<float> values = section_->plane.values(show, options);
  // The inside keeps half of the bar: values far outside may be any.
  const auto most = static_cast<float>(section_->most);
  for (float& x : values) x = std::isnan(x) ? -most : std::clamp(x, -most, most);
  return values;
}

PictureInput SceneDocument::shape() const {
  PictureInput input;
  input.name = file_.stem().string();
  input.unit = unit();
  input.parts.push_back({PicturePart::Role::other, mesh_.mesh(), std::nullopt});
  return input;
}

std::string SceneDocument::figures() const {
  return std::to_string(mesh_.mesh().points.size()) + " points, " +
         std::to_string(mesh_.mesh().triangles.size()) + " triangles" +
         (session_.coarse() ? ", coarse until released" : "");
}

/// A solid that stands in place has no name but its pointer.
std::vector<std::string> SceneDocument::groups() const {
  const std::string& solid = session_.spec().solid;
  return solid.front() == '/' ? std::vector<std::string>{} : std::vector<std::string>{solid};
}

Document::Outcome SceneDocument::set(std::size_t control, double value) {
  const double before = session_.controls().at(control).value;
  Outcome outcome = session_.set(control, value);
  if (session_.controls().at(control).value != before) refresh();
  return outcome;
}

Document::Outcome SceneDocument::commit() {
  if (!session_.coarse()) return session_.commit();
  Outcome outcome = session_.commit();
  refresh();
  return outcome;
}

bool SceneDocument::undo() {
  const bool done = session_.undo();
  if (done) refresh();
  return done;
}

bool SceneDocument::redo() {
  const bool done = session_.redo();
  if (done) refresh();
  return done;
}

std::string SceneDocument::saved_text() const {
  return controls().empty() ? Document::saved_text() : session_.saved_text();
}

}  // namespace blendwright
