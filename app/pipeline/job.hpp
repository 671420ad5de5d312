#pragma once
// A job: primaries, blends, tolerances and outputs, as plain structs. app/json fills them from a file; C++
// users may fill them by hand. Angles are radians here, lengths model units.
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kernel/brep/step_part.hpp"
#include "kernel/exchange/step_file.hpp"
#include "kernel/primitives/primary.hpp"
#include "parametric/blend.hpp"
#include "parametric/trimline/shifted.hpp"

namespace blendwright {

/// A face of a STEP file as a primary.
struct StepFaceSpec {
  std::filesystem::path file{};  ///< relative to the job file's folder when not absolute
  FaceSelector select{};
  RigidMotion placement{};
};

struct PrimaryEntry {
  std::string name;
  std::variant<PrimarySpec, StepFaceSpec> spec;
};

/// A curve typed as formulas of v, or through points.
struct CurveSpec {
  std::vector<std::string> formulas{};  ///< 2 (parameters) or 3 (space) texts in v
  std::vector<Vec3> points{};           ///< third coordinate unused for parameter curves
  bool closed = false;
  Interval v{0.0, 1.0};  ///< formulas: the range; points: ignored, chord length on [0, 1]
};

struct TrimlineSpec {
  enum class Kind { isoline, parameters, projected, edge, edge_chain } kind = Kind::isoline;
  IsoDirection direction = IsoDirection::constant_u;  ///< isoline
  double value = 0.0;                                 ///< isoline
  std::optional<Interval> range{};                    ///< isoline
  CurveSpec curve{};                                  ///< parameters, projected
  std::optional<Vec3> along{};                        ///< projected: direction; empty: closest point
  EdgeSelector edge{};                                ///< edge, edge_chain
  std::vector<ShiftPoint> shift{};                    ///< any kind: moved along the primary by this law
};

struct BlendSideEntry {
  std::string primary{};                   ///< name; may be empty for literal data
  std::optional<TrimlineSpec> trimline{};  ///< required unless literal
  std::optional<LiteralEnd> literal{};
  SideSpec side{};
};

/// What a fit may ask for; the alternatives of FitObjective, in their order.
enum class ObjectiveKind {
  thin_plate,
  curvature_variation,
  rolling_ball,
  pass_through,
  largest_curvature,
  clearance,
  no_fold,
  scanned_points
};

struct FitSpec;  // app/pipeline/fit_spec.hpp

struct BlendEntry {
  std::string name{};
  std::array<BlendSideEntry, 2> sides{};  ///< from (u = 0), to (u = 1)
  CorrespondenceSpec correspondence{};
  BlendShape shape{};
  std::optional<CurveDomain> v{};  ///< literal data: range, and whether it closes
  std::shared_ptr<const FitSpec> fit{};  ///< what is wanted of the shape; building the blend ignores it
  [[nodiscard]] bool literal() const { return sides[0].literal.has_value(); }
};

enum class OutputFormat { step, vtp, png, stl, obj };

struct OutputSpec {
  std::vector<OutputFormat> formats{OutputFormat::step, OutputFormat::vtp, OutputFormat::png};
  StepSchema step_schema = StepSchema::AP242;
};

struct JobSpec {
  std::string name{};              ///< stem of the output files; the job file's stem
  std::string source_hash{};       ///< of the job text
  std::filesystem::path folder{};  ///< that relative STEP paths start from
  LengthUnit unit = LengthUnit::millimetre;
  std::map<std::string, double> constants{};  ///< "let"
  std::vector<PrimaryEntry> primaries{};
  std::vector<BlendEntry> blends{};
  Tolerance tolerance{};
  OutputSpec output{};
};

}  // namespace blendwright
