#pragma once
// What `offset`, `relate` and `collide` share: reading several scenes, and words for what was found.
#include <string>
#include <vector>

#include "app/cli/verbs.hpp"
#include "app/pipeline/bodies.hpp"
#include "implicit/relations/search.hpp"

namespace blendwright {

/// Throws InputError.
[[nodiscard]] SearchOptions search_options_of(const SearchCommand& command);
/// The scenes in one unit, with names that differ; `subject` is set to the file that is being read. Warns of
/// conversions and of what the scenes warn of, unless `quiet`.
[[nodiscard]] std::vector<Body> read_bodies(const std::vector<std::string>& scenes, bool convert_units,
                                            bool quiet, const Console& console, std::string& subject);
/// "a.json, b.json"; many are counted.
[[nodiscard]] std::string shown_names(const std::vector<std::string>& scenes);

/// "(1, 0, 2.5)", nine digits.
[[nodiscard]] std::string shown_point(const Vec3& p);
/// "below 1e-09 mm", or after how many boxes the search was given up.
[[nodiscard]] std::string undecided_text(std::size_t boxes, const std::optional<Box>& where,
                                         const SearchOptions& options, const std::string& unit);

}  // namespace blendwright
