#pragma once
// Property tests over seeded random cases. std distributions differ between libraries, so these are our own.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace blendwright::test {

/// splitmix64: the same sequence everywhere.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

inline double uniform(Rng& rng, double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(rng.next() >> 11) * 0x1.0p-53);
}
inline double log_uniform(Rng& rng, double lo, double hi) { return std::exp(uniform(rng, std::log(lo), std::log(hi))); }
inline int integer(Rng& rng, int lo, int hi) {
  return lo + static_cast<int>(rng.next() % static_cast<std::uint64_t>(hi - lo + 1));
}

/// `cases`, or ten times as many when BLENDWRIGHT_LONG is set (./dev long).
inline int bounded(int cases) { return std::getenv("BLENDWRIGHT_LONG") ? 10 * cases : cases; }

/// Runs `property(rng)` for `cases` fixed seeds; a failure prints its seed and stops the loop.
template <class Property>
void for_all(Property property, int cases = 200) {
  for (int seed = 1; seed <= bounded(cases); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(static_cast<std::uint64_t>(seed));
    property(rng);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace blendwright::test
