#pragma once
// The subdivision of a search for contact: as a file of boxes and as a picture.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/pipeline/bodies.hpp"
#include "implicit/relations/collision.hpp"
#include "kernel/exchange/box_cells.hpp"

namespace blendwright {

/// The cells with "verdict" (0 to 4, its names as labels) and "size" (longest edge); as facts "point",
/// "normal", "gap" and "undecided" (lower and upper corner) where they are known.
[[nodiscard]] BoxCells cells_of(std::span<const Body> bodies, const Collision& collision);

/// Both solids with the cells, cut open through the place of contact and coloured by verdict. `axis`: of the
/// bars of a projected subdivision. Without a display nothing is written and a note says so.
void write_cells_picture(const std::filesystem::path& png, std::span<const Body> bodies,
                         const Collision& collision, std::optional<int> axis, std::vector<std::string>& notes,
                         const Progress& progress = {});

}  // namespace blendwright
