#pragma once
// The objects of a scene file and their keys, as data, in the form that job_keys.hpp gives those of a job;
// the nodes' come from the rows of node_kinds().
#include "app/json/job_keys.hpp"
#include "implicit/scene/node.hpp"

namespace blendwright {

/// The scene itself.
[[nodiscard]] const ObjectInfo& scene_object();
/// A node of this kind, "node <kind>": "kind", then its parameters with what they take.
[[nodiscard]] ObjectInfo node_object(const NodeKind& kind);
/// What a value of the parameter is: "a number", "a point [x, y, z]", ""blanc" or "wyvill"".
[[nodiscard]] std::string type_text(const NodeParam& param);
[[nodiscard]] bool is_required(const NodeParam& param);

}  // namespace blendwright
