#pragma once
// Operators by the names of the golden schema.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "implicit/operators/combination.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

[[nodiscard]] inline std::vector<detail::OperatorId> all_operators() {
  std::vector<detail::OperatorId> all;
  for (std::size_t i = 0; i < detail::operator_count; ++i) all.push_back(static_cast<detail::OperatorId>(i));
  return all;
}

[[nodiscard]] inline std::optional<detail::OperatorId> operator_named(const std::string& name) {
  for (const detail::OperatorId id : all_operators())
    if (detail::operator_row(id).name == name) return id;
  return std::nullopt;
}

[[nodiscard]] inline detail::OperatorValues values_of(const std::map<std::string, double>& numbers) {
  detail::OperatorValues v;
  const auto read = [&](const char* key, double& to) {
    if (const auto at = numbers.find(key); at != numbers.end()) to = at->second;
  };
  read("n", v.n);
  read("r1", v.r1);
  read("r2", v.r2);
  read("p", v.p);
  return v;
}

/// Parameters from all over their domain.
[[nodiscard]] inline detail::OperatorValues random_values(Rng& rng, detail::OperatorId id) {
  detail::OperatorValues v;
  v.n = integer(rng, 0, 2) == 0 ? integer(rng, 1, 20) : log_uniform(rng, 0.3, 30.0);
  const double most = std::min(detail::operator_row(id).largest_r, 2.0);
  v.r1 = integer(rng, 0, 4) == 0 ? most : log_uniform(rng, 0.05, most);
  v.r2 = integer(rng, 0, 4) == 0 ? most : log_uniform(rng, 0.05, most);
  const double share = integer(rng, 0, 3) == 0   ? 1.0 - log_uniform(rng, 1e-6, 1.0)
                       : integer(rng, 0, 1) == 0 ? uniform(rng, -1.0, 0.9)
                                                 : -log_uniform(rng, 1.0, 100.0);
  v.p = std::min(share, 1.0 - 1e-6) * v.r1 * v.r2;
  return v;
}

/// Where the arguments of an operator usually are; not at 0, where fields >= 0 have no slope but coordinates
/// do.
[[nodiscard]] inline Box usual_arguments(detail::OperatorId id) {
  const auto level = detail::operator_row(id).level;
  if (level == Level::half) return {Vec3::Constant(1e-3), Vec3::Constant(1.1)};
  if (level == Level::one) return {Vec3::Constant(1e-3), Vec3::Constant(3.0)};
  return {Vec3::Constant(-1.5), Vec3::Constant(2.0)};
}

}  // namespace blendwright::test
