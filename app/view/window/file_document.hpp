#pragma once
// Private: a file that is looked at and not changed: STEP, meshes, cells, a folder of results.
#include "app/pipeline/picture_input.hpp"
#include "app/view/window/document.hpp"

namespace blendwright {

/// A mesh as floats, relative to its middle.
class DrawnMesh {
 public:
  explicit DrawnMesh(TriMesh mesh);
  [[nodiscard]] DrawnSurface drawn(DrawnSurface::Role role) const;
  [[nodiscard]] const TriMesh& mesh() const { return mesh_; }
  /// Of the mode's column; empty when the mesh does not have it and it cannot be computed.
  [[nodiscard]] std::vector<float> values(Show show, const ShowOptions& options) const;
  [[nodiscard]] PickedPoint picked(const SurfaceHit& hit) const;

 private:
  TriMesh mesh_;
  Vec3 origin_ = Vec3::Zero();
  std::vector<float> positions_, normals_;
};

class FileDocument : public Document {
 public:
  FileDocument(std::filesystem::path file, PictureInput input);
  [[nodiscard]] std::filesystem::path file() const override { return file_; }
  [[nodiscard]] LengthUnit unit() const override { return unit_; }
  [[nodiscard]] std::vector<DrawnSurface> surfaces() const override;
  [[nodiscard]] std::vector<PolyLine> lines() const override { return lines_; }
  [[nodiscard]] std::vector<CombLine> comb() const override;
  [[nodiscard]] std::vector<float> values(std::size_t surface, Show show,
                                          const ShowOptions& options) const override;
  [[nodiscard]] PictureInput shape() const override;
  [[nodiscard]] PickedPoint picked(const SurfaceHit& hit) const override;
  [[nodiscard]] std::string figures() const override;
  [[nodiscard]] std::optional<BlendSession::Errors> errors() const override;

 private:
  std::filesystem::path file_;
  LengthUnit unit_ = LengthUnit::millimetre;
  std::optional<LengthUnit> named_unit_;  ///< none: the file says nothing of it
  std::vector<DrawnMesh> meshes_;
  std::vector<DrawnSurface::Role> roles_;
  std::vector<std::optional<Surface>> known_;  ///< what the meshes are of
  std::vector<PolyLine> lines_;
};

/// The outside of the cells of a .vtu file, with their points' columns. Throws IoError.
[[nodiscard]] TriMesh read_cells(const std::filesystem::path& file);

}  // namespace blendwright
