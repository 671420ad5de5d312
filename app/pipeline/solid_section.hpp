#pragma once
// Solids cut open, for pictures.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/field/scalar_field.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// Across axis k at x_k = at; what lies on the side `sense` of it is taken away.
struct Cut {
  int k = 2;
  double at = 0.0, sense = 1.0;
};

struct SolidSection {
  TriMesh surface;                                    ///< of the part that stays
  TriMesh section;                                    ///< the flat face in the cut
  std::vector<std::array<std::uint32_t, 2>> outline;  ///< of the face: indices of its points
};

/// What of `solid` lies in `box` behind the cut, meshed with about a hundred cells. Empty when no surface is
/// met there.
[[nodiscard]] SolidSection cut_open(const ScalarField& solid, Box box, const std::optional<Cut>& cut,
                                    const Progress& progress = {});

}  // namespace blendwright
