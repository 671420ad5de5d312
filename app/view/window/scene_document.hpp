#pragma once
// Private: a scene in the viewer: its solid's mesh, and a slider for every number that the file marks as
// adjustable.
#include "app/view/session/scene_session.hpp"
#include "app/view/window/file_document.hpp"

namespace blendwright {

class SceneDocument : public Document {
 public:
  /// Throws as build_scene_text and run_mesh_job do.
  SceneDocument(std::filesystem::path file, const std::string& text, const Progress& progress = {},
                SceneCells cells = {});
  [[nodiscard]] std::filesystem::path file() const override { return file_; }
  [[nodiscard]] LengthUnit unit() const override { return session_.spec().unit; }
  [[nodiscard]] std::vector<DrawnSurface> surfaces() const override;
  [[nodiscard]] std::vector<PolyLine> lines() const override;
  [[nodiscard]] std::vector<CombLine> comb() const override;
  void choose(Show show) override;
  [[nodiscard]] std::vector<float> values(std::size_t surface, Show show,
                                          const ShowOptions& options) const override;
  [[nodiscard]] PictureInput shape() const override;
  [[nodiscard]] const PictureInput* first_shape() const override { return &first_shape_; }
  [[nodiscard]] PickedPoint picked(const SurfaceHit& hit) const override {
    return section_ ? section_->plane.picked(hit) : mesh_.picked(hit);
  }
  [[nodiscard]] std::string figures() const override;
  [[nodiscard]] std::vector<SessionControl> controls() const override { return session_.controls(); }
  [[nodiscard]] std::vector<std::string> groups() const override;
  Outcome set(std::size_t control, double value) override;
  Outcome commit() override;
  bool undo() override;
  bool redo() override;
  [[nodiscard]] bool changed() const override { return session_.changed(); }
  [[nodiscard]] std::string saved_text() const override;
  void mark_saved() override { session_.mark_saved(); }

 private:
  /// The field on a plane through the middle of the solid, across its shortest side.
  struct Section {
    DrawnMesh plane;
    std::vector<PolyLine> outline;
    double most = 0.0;  ///< colours reach from -most to most; the solid is where it is >= 0
  };
  /// After the mesh of the session has changed.
  void refresh();
  void cut();

  std::filesystem::path file_;
  SceneSession session_;
  DrawnMesh mesh_;
  PictureInput first_shape_;
  bool field_ = false;
  std::optional<Section> section_;
};

}  // namespace blendwright
