#include "kernel/exchange/colour_map.hpp"

#include <array>
#include <cstdint>

namespace blendwright {
namespace {

constexpr Colour rgb(std::uint32_t hex) {
  return {((hex >> 16) & 255u) / 255.0, ((hex >> 8) & 255u) / 255.0, (hex & 255u) / 255.0};
}

/// M. Okabe and K. Ito, Color Universal Design, 2008, without the yellow that vanishes on white.
constexpr std::array<std::uint32_t, 7> distinct{0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                                0xe69f00, 0x56b4e9, 0x000000};

}  // namespace

vtkSmartPointer<vtkLookupTable> colour_table(ColourMap map, double lo, double hi) {
  constexpr int colours = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(colours);
  for (int i = 0; i < colours; ++i) {
    const Colour c = colour_at(map, static_cast<double>(i) / (colours - 1));
    table->SetTableValue(i, c.r, c.g, c.b, 1.0);
  }
  table->SetNanColor(no_value_colour.r, no_value_colour.g, no_value_colour.b, 1.0);
  table->SetTableRange(lo, hi);
  return table;
}

Colour curve_colour(std::size_t index) { return rgb(distinct[index % distinct.size()]); }

}  // namespace blendwright
