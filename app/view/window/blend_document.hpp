#pragma once
// Private: a job that is shaped in the viewer.
#include "app/view/window/file_document.hpp"

namespace blendwright {

class BlendDocument : public Document {
 public:
  /// Throws as read_job and run_job do.
  BlendDocument(std::filesystem::path file, const std::string& text);
  [[nodiscard]] std::filesystem::path file() const override { return file_; }
  [[nodiscard]] LengthUnit unit() const override { return session_.job().unit; }
  [[nodiscard]] std::vector<DrawnSurface> surfaces() const override;
  [[nodiscard]] std::vector<PolyLine> lines() const override;
  [[nodiscard]] std::vector<CombLine> comb() const override;
  [[nodiscard]] std::vector<float> values(std::size_t surface, Show show,
                                          const ShowOptions& options) const override;
  [[nodiscard]] PictureInput shape() const override;
  [[nodiscard]] const PictureInput* first_shape() const override { return &first_shape_; }
  [[nodiscard]] PickedPoint picked(const SurfaceHit& hit) const override;
  [[nodiscard]] std::string figures() const override;
  [[nodiscard]] std::optional<BlendSession::Errors> errors() const override;
  [[nodiscard]] std::vector<SessionControl> controls() const override { return session_.controls(); }
  [[nodiscard]] std::vector<SessionHandle> handles() const override { return session_.handles(); }
  [[nodiscard]] Vec3 foot_of(const SessionHandle& handle) const override;
  [[nodiscard]] std::vector<std::string> groups() const override;
  Outcome set(std::size_t control, double value) override { return session_.set(control, value); }
  Outcome drag(const SessionHandle& handle, const Vec3& target) override;
  Outcome commit() override;
  bool undo() override;
  bool redo() override;
  [[nodiscard]] bool changed() const override { return session_.changed(); }
  [[nodiscard]] std::string saved_text() const override { return session_.saved_text(); }
  void mark_saved() override { session_.mark_saved(); }
  void export_step(const std::filesystem::path& to) const override;

 private:
  void trim_primaries();
  [[nodiscard]] UV uv_of(const SurfaceHit& hit) const;
  [[nodiscard]] std::vector<float> curvature_values(std::size_t blend, Show show,
                                                    const ShowOptions& options) const;

  std::filesystem::path file_;
  BlendSession session_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;  ///< of every grid
  std::vector<TriMesh> whole_primaries_;
  std::vector<DrawnMesh> primaries_;  ///< what the blends keep of them
  PictureInput first_shape_;
  bool lines_moved_ = false;
};

}  // namespace blendwright
