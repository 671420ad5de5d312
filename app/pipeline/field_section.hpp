#pragma once
// Values of a field on a plane, for pictures.
#include <optional>

#include "kernel/base/progress.hpp"
#include "kernel/exchange/picture.hpp"
#include "kernel/field/scalar_field.hpp"

namespace blendwright {

/// The plane x_k = at.
struct SectionPlane {
  int k = 2;
  double at = 0.0;
};

struct FieldSection {
  /// Column "value": the field's value minus that of its surface, negated where larger values are outside, so
  /// that the solid is where it is >= 0; NaN where the field is not finite.
  TriMesh mesh;
  std::vector<PolyLine> outline;  ///< where it is 0
  double least = 0.0, most = 0.0;
};
/// On a grid of about `cells` cells along the longer side of the box's face. The grid is refined by one exact
/// value in the middle of each cell.
[[nodiscard]] FieldSection field_section(const ScalarField& field, const Box& box, const SectionPlane& plane,
                                         std::size_t cells, const Progress& progress = {});

}  // namespace blendwright
