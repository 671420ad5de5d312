#include "app/view/window/scene_document.hpp"

namespace blendwright {
namespace {

constexpr std::size_t comb_planes = 7, comb_hairs = 160;  // those of files

}  // namespace

SceneDocument::SceneDocument(std::filesystem::path file, const std::string& text, const Progress& progress,
                             SceneCells cells)
    : file_(std::move(file)),
      session_(text, file_, cells, progress),
      mesh_(session_.mesh()),
      first_shape_(shape()) {}

std::vector<DrawnSurface> SceneDocument::surfaces() const { return {mesh_.drawn(DrawnSurface::Role::other)}; }

std::vector<CombLine> SceneDocument::comb() const {
  return comb_of_sections({&mesh_.mesh()}, comb_planes, comb_hairs, nullptr);
}

std::vector<float> SceneDocument::values(std::size_t, Show show, const ShowOptions& options) const {
  return mesh_.values(show, options);
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
  if (session_.controls().at(control).value != before) mesh_ = DrawnMesh(session_.mesh());
  return outcome;
}

Document::Outcome SceneDocument::commit() {
  if (!session_.coarse()) return session_.commit();
  Outcome outcome = session_.commit();
  mesh_ = DrawnMesh(session_.mesh());
  return outcome;
}

bool SceneDocument::undo() {
  const bool done = session_.undo();
  if (done) mesh_ = DrawnMesh(session_.mesh());
  return done;
}

bool SceneDocument::redo() {
  const bool done = session_.redo();
  if (done) mesh_ = DrawnMesh(session_.mesh());
  return done;
}

std::string SceneDocument::saved_text() const {
  return controls().empty() ? Document::saved_text() : session_.saved_text();
}

}  // namespace blendwright
