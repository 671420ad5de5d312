#pragma once
// Solids to test.
#include "implicit/scene/node_spec.hpp"
#include "kernel/field/range.hpp"

namespace blendwright::test {

/// Every row of solid_kinds() has at least one.
struct SolidSample {
  std::string id, kind;
  SceneSpec scene;
  Box where;                   ///< around the surface
  double useless_share = 0.1;  ///< see EvaluatorSuite
};
[[nodiscard]] const std::vector<SolidSample>& solid_samples();

}  // namespace blendwright::test
