#pragma once
// A pipe between two cylinders, and what its report is judged to be.
#include <set>
#include <string>

#include "tests/verify/shapes.hpp"
#include "verify/report/blend_report.hpp"

namespace blendwright::test {

constexpr std::array<Continuity, 2> g2{Continuity::G2, Continuity::G2};

// From the unit cylinder at z = 1 to the same cylinder continued from z = 3; `blend` goes from the one to the
// other.
inline BlendUnderTest between_cylinders(const Surface& blend) {
  const Surface upper = revolution(
      turn, [](const auto&) { return 1.0; }, [](const auto& u) { return 3.0 + u; });
  const Seam from{"pipe/from", blend, 0, unit_cylinder(), isoline_u(1.0, turn_line), true};
  const Seam to{"pipe/to", blend, 1, upper, isoline_u(0.0, turn_line), false};
  return {"pipe", blend, {from, to}, true};
}
// A pipe with z = 1 + 2u + lift(u) and radius 1 + bulge(u).
template <class R>
Surface pipe(R bulge) {
  return revolution(
      turn, [bulge](const auto& u) { return 1.0 + bulge(u); }, [](const auto& u) { return 1.0 + 2.0 * u; });
}

inline std::vector<Finding> failures(const BlendUnderTest& blend, std::array<Continuity, 2> asked = g2,
                                     const Tolerance& tolerance = {}) {
  std::vector<Finding> found = judge(verify_blend(blend, "formula"), asked, tolerance);
  std::erase_if(found, [](const Finding& f) { return !f.failed; });
  return found;
}
inline std::set<std::string> failed_checks(const BlendUnderTest& blend,
                                           std::array<Continuity, 2> asked = g2) {
  std::set<std::string> names;
  for (const Finding& f : failures(blend, asked)) names.insert(f.check);
  return names;
}
using Names = std::set<std::string>;

}  // namespace blendwright::test
