#pragma once
// The search that all relations between solids are decided by: is there a point that lies in several solids
// at once? Its answer can be trusted: proven either way, or undecided down to a stated size.
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/field/scalar_field.hpp"

namespace blendwright {

struct SearchOptions {
  double tolerance = 1e-9;  ///< boxes whose longest edge is at most this are left undecided (model units)
  std::size_t max_boxes = 2'000'000;  ///< the work limit; what is left then is undecided
  std::optional<Box> domain;          ///< where to look; none: where the bounds of the solids allow points
  bool combination = true;            ///< the convex-combination test
  bool keep_cells = false;            ///< record every box that was decided
};

/// A box of the subdivision and what became of it.
struct SearchCell {
  enum class Verdict { outside_first, outside_second, separated, witness, undecided } verdict{};
  Box box;
};
[[nodiscard]] std::string_view name(SearchCell::Verdict verdict);

/// What a search for a point found.
enum class Answer { proven, refuted, undecided };
[[nodiscard]] std::string_view name(Answer answer);

/// The answer to a statement "there is no such point": refuted by `witness`, undecided in `undecided`.
struct Proof {
  Answer answer = Answer::undecided;
  std::optional<Vec3> witness;   ///< refuted: such a point, proven by outward-rounded ranges at that point
  std::size_t boxes = 0;         ///< examined
  std::optional<Box> undecided;  ///< encloses every undecided box
  std::vector<SearchCell> cells;
};

}  // namespace blendwright
