#include "kernel/exchange/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace blendwright {
namespace {

constexpr Colour rgb(std::uint32_t hex) {
  return {((hex >> 16) & 255u) / 255.0, ((hex >> 8) & 255u) / 255.0, (hex & 255u) / 255.0};
}

/// Equidistant values of viridis (S. van der Walt and N. Smith, 2015; CC0).
constexpr std::array<std::uint32_t, 16> viridis_nodes{
    0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e,
    0x1f988b, 0x22a884, 0x35b779, 0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725};
/// M. Okabe and K. Ito, Color Universal Design, 2008, without the yellow that vanishes on white.
constexpr std::array<std::uint32_t, 7> distinct{0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                                0xe69f00, 0x56b4e9, 0x000000};

}  // namespace

Colour viridis(double t) {
  const double x = std::clamp(t, 0.0, 1.0) * (viridis_nodes.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), viridis_nodes.size() - 2);
  const double w = x - static_cast<double>(i);
  const Colour a = rgb(viridis_nodes[i]), b = rgb(viridis_nodes[i + 1]);
  return {a.r + w * (b.r - a.r), a.g + w * (b.g - a.g), a.b + w * (b.b - a.b)};
}

vtkSmartPointer<vtkLookupTable> viridis_table(double lo, double hi) {
  constexpr int colours = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(colours);
  for (int i = 0; i < colours; ++i) {
    const Colour c = viridis(static_cast<double>(i) / (colours - 1));
    table->SetTableValue(i, c.r, c.g, c.b, 1.0);
  }
  table->SetNanColor(0.6, 0.6, 0.6, 1.0);
  table->SetTableRange(lo, hi);
  return table;
}

Colour curve_colour(std::size_t index) { return rgb(distinct[index % distinct.size()]); }

}  // namespace blendwright
