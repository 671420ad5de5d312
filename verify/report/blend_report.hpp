#pragma once
// Everything measured on one blend at one stage, and its verdict.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "verify/continuity/seam.hpp"
#include "verify/surface/surface_checks.hpp"

namespace blendwright {

/// The blend and its primaries as surfaces; what verify works on.
struct BlendUnderTest {
  std::string name;
  Surface blend;
  std::array<Seam, 2> seams;
  bool closed = false;
};

struct BlendReport {
  std::string name;
  std::string stage;                                      ///< "formula", "fitted", "step"
  std::array<SeamReport, 2> seams;
  std::optional<ClosingReport> closing;
  FoldReport fold;
  Extreme minimum_radius;
  std::array<std::optional<PenetrationReport>, 2> penetration;
  SelfIntersectionReport self_intersection;
};

struct VerifyOptions {
  SeamOptions seam;
  bool surface_checks = true;   ///< fold, radius, penetration, self-intersection
};

[[nodiscard]] BlendReport verify_blend(const BlendUnderTest& blend, const std::string& stage,
                                       const VerifyOptions& options = {}, const Progress& progress = {});

/// One row of the checks table: a named defect, found or not.
struct Finding {
  std::string check;      ///< name in the checks table
  std::string text;       ///< sentence with value, limit and place
  bool failed = false;    ///< false: a note or warning
};
/// Verdict of a report: every check of the table that fails or warns, given what each side was asked to reach.
[[nodiscard]] std::vector<Finding> judge(const BlendReport& report, const std::array<Continuity, 2>& asked,
                                         const Tolerance& tolerance);

struct CheckInfo {
  std::string_view name, description;
};
[[nodiscard]] std::vector<CheckInfo> checks_table();

}  // namespace blendwright
