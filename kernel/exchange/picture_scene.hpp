#pragma once
// Private: the actors of a picture, also for windows.
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <optional>

#include "kernel/exchange/picture_view.hpp"

class vtkPolyData;
class vtkProperty;

namespace blendwright {

/// Points, triangles and normals of a mesh.
[[nodiscard]] vtkSmartPointer<vtkPolyData> surface_of(const TriMesh& mesh);
/// How surfaces of this colour reflect light.
void shade(vtkProperty& property, const Colour& colour, double opacity);
/// A key light over the left shoulder, a weak one from the right and one from the eye: no side is black.
void add_lights(vtkRenderer& renderer);

/// One view of the picture; its viewport is `area` of the picture.
[[nodiscard]] vtkSmartPointer<vtkRenderer> view_scene(const Picture& picture,
                                                      const std::optional<ColourScale>& scale,
                                                      const ViewFrame& frame, const PixelBox& area);

}  // namespace blendwright
