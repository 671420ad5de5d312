#pragma once
// How two solids lie to each other, and where points lie, as text.
#include <span>
#include <string>
#include <vector>

#include "app/pipeline/bodies.hpp"
#include "implicit/relations/membership.hpp"
#include "implicit/relations/set_relation.hpp"

namespace blendwright {

/// One of the statements that a relation is made of.
struct RelationStatement {
  std::string text;  ///< "ball is inside box"
  const Proof& proof;
};
/// In the order of SetRelation; they refer to `relation`.
[[nodiscard]] std::vector<RelationStatement> statements(const SetRelation& relation,
                                                        std::span<const Body> bodies);
/// "ball is inside box", "undecided below 1e-09 mm".
[[nodiscard]] std::string relation_text(const SetRelation& relation, std::span<const Body> bodies);

/// Lines of comma separated values: x, y, z, then s2, s3, phi, distance of every solid; with two solids these
/// end in _a and _b. What is not finite is empty.
[[nodiscard]] std::string membership_header(std::size_t solids);
[[nodiscard]] std::string membership_lines(std::span<const Vec3> points,
                                           std::span<const std::vector<Membership>> of_solids);

/// The report as JSON text.
[[nodiscard]] std::string relation_report_json(const SetRelation& relation, std::span<const Body> bodies,
                                               const SearchOptions& options);

}  // namespace blendwright
