#pragma once
// The door to FCL (the Flexible Collision Library), which is there or not: nothing else needs it.
#include <memory>

#include "tests/bench/relation_models.hpp"

namespace blendwright::bench {

[[nodiscard]] bool fcl_is_here();

enum class FclSolver { libccd, own };

/// A pair as FCL wants it.
class FclPair {
 public:
  explicit FclPair(const Pair& pair);
  ~FclPair();
  FclPair(FclPair&&) noexcept;
  FclPair& operator=(FclPair&&) noexcept;
  [[nodiscard]] bool in_contact(FclSolver solver) const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace blendwright::bench
