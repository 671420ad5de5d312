#pragma once
// Solids and their offsets, to test.
#include "implicit/scene/node_spec.hpp"
#include "kernel/field/range.hpp"

namespace blendwright::test {

/// A freeform of `bumps` bumps and dents on an ellipsoid of about the size 2; the node "solid".
[[nodiscard]] SceneSpec bumpy(int bumps);

/// Every row of offset_kinds(), and every route of ball offsets.
struct OffsetSample {
  std::string id, kind;
  SceneSpec scene;
  Box where;
  double useless_share;  ///< see EvaluatorSuite
  bool slow = false;     ///< two searches in each other
  bool edges = false;    ///< searched for on edges: derivatives are known to the tolerance only
};
[[nodiscard]] const std::vector<OffsetSample>& offset_samples();

}  // namespace blendwright::test
