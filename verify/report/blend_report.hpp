#pragma once
// Everything measured on one blend at one stage, and its verdict.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verify/certify/certificate.hpp"
#include "verify/continuity/seam.hpp"
#include "verify/second/second_path.hpp"
#include "verify/surface/fairness.hpp"
#include "verify/surface/surface_checks.hpp"

namespace blendwright {

/// The blend and its primaries as surfaces; what verify works on.
struct BlendUnderTest {
  std::string name;
  Surface blend;
  std::array<Seam, 2> seams;
  bool closed = false;  ///< the blend is meant to close: S(u, v.lo) = S(u, v.hi)
  /// The same surfaces as other code knows them; empty: nothing is measured twice.
  struct Second {
    SecondSurface blend;
    std::array<SecondSurface, 2> primaries;
  };
  std::optional<Second> second{};
};

struct BlendReport {
  std::string name;
  std::string stage;  ///< "formula", "fitted", "step"
  double size =
      0.0;  ///< of the blend: longest side of a box around it; places are told to a thousandth of it
  std::array<SeamReport, 2> seams;
  std::optional<std::array<SeamCertificate, 2>> proven{};  ///< bounds between the samples, when asked for
  std::optional<ClosingReport> closing;                    ///< closed blends
  bool surface_checked = true;  ///< false: the four below were not asked for and are empty
  FoldReport fold;
  Extreme minimum_radius;
  std::array<std::optional<PenetrationReport>, 2> penetration;  ///< per side that has a primary
  SelfIntersectionReport self_intersection;
  std::optional<FairnessReport> fairness{};  ///< when asked for
  /// Gaps and angles measured again, where there were other surfaces to measure them on.
  struct Second {
    std::array<SecondSeam, 2> seams;
    std::optional<SecondClosing> closing{};
  };
  std::optional<Second> second{};
};

struct VerifyOptions {
  SeamOptions seam{};
  bool certify = false;                       ///< prove bounds of both seams
  std::optional<FairnessOptions> fairness{};  ///< measure it
  bool surface_checks = true;                 ///< fold, radius, penetration, self-intersection
  int nu = 32,
      nv = 128;  ///< cells of the grid that the surface checks share; penetration uses every second line
};

/// Measures everything. The same report for any number of threads.
[[nodiscard]] BlendReport verify_blend(const BlendUnderTest& blend, const std::string& stage,
                                       const VerifyOptions& options = {}, const Progress& progress = {});

/// "(1000.12, 0, -3)": a point as the tables and findings tell it, to a thousandth of the blend's size.
[[nodiscard]] std::string place_text(const Vec3& point, double size, std::string_view separator = ", ");

/// One row of the checks table: a named defect, found or not.
struct Finding {
  std::string check;  ///< name in the checks table
  std::string text;   ///< sentence with value, limit and place: "fillet/to: angle 0.31 deg exceeds 0.001 deg
                      ///< at v = ..."
  bool failed = false;  ///< false: a note or warning
};
/// Verdict of a report: every check of the table that fails or warns, in the order of the table, given what
/// each side was asked to reach. A value that is not a number fails its check, asked or not.
[[nodiscard]] std::vector<Finding> judge(const BlendReport& report, const std::array<Continuity, 2>& asked,
                                         const Tolerance& tolerance,
                                         LengthUnit unit = LengthUnit::millimetre);

/// Where the two measurements of a figure disagree: a defect of the program, not of the blend. One sentence
/// each: which figure, where, both values, and by how much they may differ.
[[nodiscard]] std::vector<std::string> disagreements(const BlendReport& report,
                                                     LengthUnit unit = LengthUnit::millimetre);

struct CheckInfo {
  std::string_view name, description;
};
/// The checks in the order in which `judge` walks them.
[[nodiscard]] std::vector<CheckInfo> checks_table();

}  // namespace blendwright
