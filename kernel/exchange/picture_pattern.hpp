#pragma once
// Private: zebra stripes and isophotes, evaluated per pixel from the interpolated normals of a mesh.
#include "kernel/exchange/picture.hpp"

class vtkActor;

namespace blendwright {

/// Lets the actor's fragments show the pattern; its mesh must have point normals. The actor may be given
/// another pattern later.
/// @param stripes   zebra: light and dark pairs over half a turn
/// @param to_light  isophotes: in the camera's axes (right, up, towards the eye)
void set_pattern(vtkActor& actor, SurfacePattern pattern, double stripes, const Vec3& to_light);

}  // namespace blendwright
