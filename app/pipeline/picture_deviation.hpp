#pragma once
// How far one input is from another, point by point.
#include <vector>

#include "app/pipeline/picture_input.hpp"

namespace blendwright {

struct DeviationFacts {
  double worst = 0.0;  ///< largest |distance|
  Vec3 at = Vec3::Zero();
  double rms = 0.0;     ///< over the points
  double facets = 0.0;  ///< distances may be wrong by this where the other input is known as triangles only
};

/// Adds the column "deviation" to the parts of `input`: the distance of each point to the nearest place of
/// `other`, positive on the side that its normals point to. Where the other has surfaces, the nearest place
/// is found on them, starting from the nearest triangle; near a scene's solid the field says it,
/// -inside/|gradient|. Throws InputError when `other` has no surface, no normals
/// or another unit.
DeviationFacts add_deviation(PictureInput& input, const PictureInput& other, const Progress& progress = {});

}  // namespace blendwright
