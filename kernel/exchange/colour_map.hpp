#pragma once
// Private: viridis, perceptually uniform and readable in grey and by colour-blind people.
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include "kernel/brep/shape.hpp"

namespace blendwright {

/// t in [0, 1].
[[nodiscard]] Colour viridis(double t);
/// 256 colours of viridis over lo ... hi; grey for NaN.
[[nodiscard]] vtkSmartPointer<vtkLookupTable> viridis_table(double lo, double hi);

/// Distinct colours of curves (Okabe and Ito's set, made for colour-blind readers), repeating.
[[nodiscard]] Colour curve_colour(std::size_t index);

}  // namespace blendwright
