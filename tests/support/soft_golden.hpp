#pragma once
// Golden data of soft objects, as scenes and plain numbers. The schema is described in
// tests/data/golden/README.md.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "implicit/scene/node_spec.hpp"

namespace blendwright::test {

struct SoftPoint {
  std::vector<double> at;        ///< the inputs: x, y, z, or the arguments of the function
  double value = 0.0;            ///< may be infinite
  std::vector<double> gradient;  ///< one partial per input
  bool smooth = true;            ///< false: the gradient is a convention, to be finite and no more
};

struct SoftCase {
  std::string id;
  std::string kind;                          ///< potential, range_map, vir_map, operator, distance, field
  std::string function;                      ///< a name of the schema
  std::map<std::string, double> numbers;     ///< scalar parameters, by the schema's names
  std::map<std::string, std::string> words;  ///< inner
  SceneSpec scene;  ///< of kinds distance and field: the node "case" and what it refers to; not strict
  std::vector<SoftPoint> points;
};

/// All cases of all soft-object files in `folder`. Throws std::runtime_error naming file and case: an unknown
/// key or function, a wrong shape, a file without a schema.
[[nodiscard]] std::vector<SoftCase> read_soft_golden(const std::filesystem::path& folder);

}  // namespace blendwright::test
