#pragma once
// A scene being shaped by hand: what the viewer drags, without a window. Sliders move the numbers that the
// file marks under "adjust"; the mesh follows, coarse while one is dragged, fine when it is let go.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/json/scene_reader.hpp"
#include "app/pipeline/mesh_job.hpp"
#include "app/view/session/blend_session.hpp"

namespace blendwright {

/// Cells along the longest side of the solid's box.
struct SceneCells {
  std::size_t coarse = 48, fine = MeshJob{}.cells;
};

class SceneSession {
 public:
  using Outcome = BlendSession::Outcome;

  /// `text`: the scene file's own. Meshes the solid. Throws as build_scene_text and run_mesh_job do.
  SceneSession(std::string text, const std::filesystem::path& file, SceneCells cells = {},
               const Progress& progress = {});
  ~SceneSession();
  SceneSession(SceneSession&&) noexcept;
  SceneSession& operator=(SceneSession&&) noexcept;

  /// The adjustable numbers of the nodes that the solid uses, in the order of the file; they do not change.
  [[nodiscard]] std::vector<SessionControl> controls() const;
  [[nodiscard]] const SceneSpec& spec() const;
  [[nodiscard]] const TriMesh& mesh() const;
  [[nodiscard]] bool coarse() const;  ///< the mesh is that of a gesture that has not ended

  /// Sets control `index` of controls(), clamped to its range, and meshes coarsely; finely where the coarse
  /// grid finds nothing. What the scene refuses, or has no surface, leaves everything as it was and says why.
  Outcome set(std::size_t control, double value);
  /// Ends one gesture: everything since the last commit() is one step of undo, and the mesh becomes fine.
  /// When there is no fine mesh the coarse one stays and the message says why.
  Outcome commit();
  /// Fine meshes. They end a gesture too.
  bool undo();
  bool redo();
  [[nodiscard]] bool changed() const;  ///< since the last save, or since opening

  /// The scene's text with the changed numbers (comments and layout kept). Throws as scene_text does.
  [[nodiscard]] std::string saved_text() const;
  void mark_saved();  ///< once the text is where it shall be

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace blendwright
