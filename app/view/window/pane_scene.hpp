#pragma once
// Private: the objects of one pane of the viewer, kept between frames and filled anew.
#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <memory>
#include <optional>
#include <vector>

#include "app/view/window/controller.hpp"

namespace blendwright {

class PaneScene {
 public:
  PaneScene();
  [[nodiscard]] vtkRenderer& renderer() { return *renderer_; }
  /// Handles, over everything else.
  [[nodiscard]] vtkRenderer& handle_renderer() { return *handles_; }
  /// Points, normals, lines, handles. `handles`: of this document; none when it is not the active one.
  void update_shapes(const Document& document, const ViewState& state,
                     const std::vector<SessionHandle>& handles);
  /// `values`: per surface, as Document::values() gives them.
  void update_colours(const ViewState& state, const std::vector<std::vector<float>>& values,
                      const std::optional<ColourScale>& scale);
  void aim(const ViewCamera& camera, const PixelBox& pane, int width, int height);

 private:
  struct Part {
    vtkNew<vtkFloatArray> positions, normals;
    vtkNew<vtkUnsignedCharArray> colours;
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;
    const void* triangles = nullptr;
    std::size_t points = 0;
    bool coloured = false;
  };
  struct Strokes {
    Strokes(vtkRenderer& renderer, float width, float point_size);
    void fill(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 2>>& lines,
              bool as_points, const std::vector<Colour>& colours);
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;
  };
  void update_part(Part& part, const DrawnSurface& surface, const ViewState& state);
  void update_lines(const Document& document, const ViewState& state);
  void update_handles(const Document& document, const ViewState& state,
                      const std::vector<SessionHandle>& handles);
  void update_comb(const Document& document, const ViewState& state);
  /// Primaries are cut off where they reach far beyond what is looked at.
  void update_clipping(const std::vector<DrawnSurface>& surfaces);

  vtkNew<vtkRenderer> renderer_, handles_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<DrawnSurface::Role> roles_;
  Strokes trimlines_, arrows_, knobs_, hairs_, envelope_;
  vtkNew<vtkPlaneCollection> clipping_;
  Vec3 lo_ = Vec3::Zero(), hi_ = Vec3::Zero();  ///< of what is looked at
  double reach_ = 1.0;                          ///< radius of everything about its middle
  Vec3 middle_ = Vec3::Zero();
};

}  // namespace blendwright
