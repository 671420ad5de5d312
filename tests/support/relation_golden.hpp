#pragma once
// Golden data of quadrics, perturbations, offsets, blends, rolling balls and relations. The schema is
// described in tests/data/golden/README.md.
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "implicit/scene/node_spec.hpp"

namespace blendwright::test {

/// A sample or the parameters of a case, by the schema's keys. Keys whose value is null stand in `nulls`
/// only.
struct RelationValues {
  std::map<std::string, double> numbers;
  std::map<std::string, bool> flags;
  std::map<std::string, std::string> words;
  std::map<std::string, std::vector<double>> lists;
  std::set<std::string> nulls;
};

struct RelationSample : RelationValues {
  /// Of collisions of freeforms: the node "body_1" and what it refers to.
  SceneSpec body;
  // The keys that most functions have.
  [[nodiscard]] const std::vector<double>& x() const { return lists.at("x"); }
  [[nodiscard]] double value() const { return numbers.at("value"); }
  /// Null where the gradient is not unique.
  [[nodiscard]] const std::vector<double>* gradient() const {
    const auto at = lists.find("gradient");
    return at == lists.end() ? nullptr : &at->second;
  }
};

struct RelationCase {
  std::string id;        ///< the function and the number of the case
  std::string function;  ///< a name of the schema
  RelationValues parameters;
  /// Of functions of a body in space (quadric, perturbation, freeform, offsets, exact distances, membership,
  /// boxes of a quadric): the node "case" is the body, without its offset. Empty for the others.
  SceneSpec scene;
  std::vector<RelationSample> samples;
};

/// All cases of all files of this schema in `folder`. Throws std::runtime_error naming file and case: an
/// unknown function or key, a missing key, a wrong shape.
[[nodiscard]] std::vector<RelationCase> read_relation_golden(const std::filesystem::path& folder);

/// The functions of the schema.
[[nodiscard]] std::set<std::string> relation_functions();

}  // namespace blendwright::test
