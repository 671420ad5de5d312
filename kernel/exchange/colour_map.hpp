#pragma once
// Private: tables of the maps of colour_scale.hpp for VTK, and colours of curves.
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include "kernel/exchange/colour_scale.hpp"

namespace blendwright {

/// 256 colours over lo ... hi; grey for NaN.
[[nodiscard]] vtkSmartPointer<vtkLookupTable> colour_table(ColourMap map, double lo, double hi);

/// Distinct colours of curves (Okabe and Ito's set, made for colour-blind readers), repeating.
[[nodiscard]] Colour curve_colour(std::size_t index);

}  // namespace blendwright
