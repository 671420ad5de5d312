#pragma once
// Private: what the viewer shows and changes: a job, a scene, or a file that can only be looked at. No VTK.
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/pipeline/picture_comb.hpp"
#include "app/pipeline/picture_input.hpp"
#include "app/pipeline/show.hpp"
#include "app/view/session/blend_session.hpp"

namespace blendwright {

/// One surface as it is drawn and met by rays; the memory is the document's, until its next change.
struct DrawnSurface {
  enum class Role { blend, primary, other } role = Role::other;
  std::string name;
  Vec3 origin = Vec3::Zero();
  std::span<const float> positions;  ///< 3 per point, relative to `origin`
  std::span<const float> normals;    ///< 3 per point, or none
  std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// A place on a drawn surface.
struct SurfaceHit {
  std::size_t surface = 0, triangle = 0;
  Vec3 point;
  std::array<double, 3> weights{};  ///< of the triangle's corners
  double distance = 0.0;            ///< along the ray
};

class Document {
 public:
  using Outcome = BlendSession::Outcome;
  Document() = default;
  virtual ~Document() = default;
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  [[nodiscard]] virtual std::filesystem::path file() const = 0;
  [[nodiscard]] virtual LengthUnit unit() const = 0;
  [[nodiscard]] virtual std::vector<DrawnSurface> surfaces() const = 0;
  [[nodiscard]] virtual std::vector<PolyLine> lines() const = 0;
  [[nodiscard]] virtual std::vector<CombLine> comb() const = 0;
  /// Which mode is chosen: some show other surfaces for it.
  virtual void choose(Show) {}
  /// What a mode colours by, one value per point; empty: this surface has no such figure.
  [[nodiscard]] virtual std::vector<float> values(std::size_t surface, Show show,
                                                  const ShowOptions& options) const = 0;
  /// What deviations are measured of and to, a part for each of surfaces() (primaries that stand back, and
  /// what comes after the parts, have no triangles), with the surfaces that are known.
  [[nodiscard]] virtual PictureInput shape() const { return {}; }
  /// The shape as it was opened; nullptr: it cannot be changed.
  [[nodiscard]] virtual const PictureInput* first_shape() const { return nullptr; }
  [[nodiscard]] virtual PickedPoint picked(const SurfaceHit& hit) const = 0;
  /// The worst figures, for the status line.
  [[nodiscard]] virtual std::string figures() const = 0;
  /// Worst gap and angle; none: nothing is joined.
  [[nodiscard]] virtual std::optional<BlendSession::Errors> errors() const { return std::nullopt; }

  // Changes. A file that can only be looked at has no controls.
  [[nodiscard]] virtual std::vector<SessionControl> controls() const { return {}; }
  [[nodiscard]] virtual std::vector<SessionHandle> handles() const { return {}; }
  /// Where the arrow of a magnitude handle begins.
  [[nodiscard]] virtual Vec3 foot_of(const SessionHandle& handle) const { return handle.position; }
  [[nodiscard]] virtual std::vector<std::string> groups() const { return {}; }  ///< names of the blends
  virtual Outcome set(std::size_t, double) { return {}; }
  virtual Outcome drag(const SessionHandle&, const Vec3&) { return {}; }
  virtual Outcome commit() { return {}; }
  virtual bool undo() { return false; }
  virtual bool redo() { return false; }
  [[nodiscard]] virtual bool changed() const { return false; }
  /// Throws InputError for a file that cannot be changed.
  [[nodiscard]] virtual std::string saved_text() const;
  virtual void mark_saved() {}  ///< once the text has been written
  /// Throws InputError when there is nothing that STEP could hold.
  virtual void export_step(const std::filesystem::path& to) const;
};

/// "worst gap 1.0e-09 mm, angle ..., curvature jump ...".
[[nodiscard]] std::string error_text(const BlendSession::Errors& worst, LengthUnit unit);

/// Opens a job, a scene, or any file that the program writes. Throws InputError and IoError about it.
[[nodiscard]] std::unique_ptr<Document> open_document(const std::string& file, const Progress& progress = {});

}  // namespace blendwright
