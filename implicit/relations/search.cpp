#include "implicit/relations/search.hpp"

#include <array>

namespace blendwright {

std::string_view name(SearchCell::Verdict verdict) {
  constexpr std::array<std::string_view, 5> names{"outside first", "outside second", "separated", "witness",
                                                  "undecided"};
  return names[static_cast<std::size_t>(verdict)];
}

std::string_view name(Answer answer) {
  constexpr std::array<std::string_view, 3> names{"proven", "refuted", "undecided"};
  return names[static_cast<std::size_t>(answer)];
}

}  // namespace blendwright
