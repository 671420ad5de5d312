#pragma once
// What pictures and the viewer colour surfaces by: one table of modes, the columns they need, and the scale
// of their colours. No VTK. Everything here may be called for each frame: some nanoseconds per point.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/base/units.hpp"
#include "kernel/exchange/colour_scale.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

enum class Show { plain, gap, angle, curvature, zebra, isophotes, comb, draft, radius, deviation, field };

/// Which curvature `curvature` and `comb` mean.
enum class CurvatureFigure {
  mean,      ///< (k1 + k2) / 2, signed by the normal
  gaussian,  ///< k1 k2
  largest,   ///< of k1 and k2, signed
  least,     ///< of k1 and k2, signed
  jump       ///< of the normal curvature across the trimlines
};

struct ShowOptions {
  LengthUnit unit = LengthUnit::millimetre;
  CurvatureFigure curvature = CurvatureFigure::mean;
  Vec3 pull = Vec3::UnitZ();      ///< draft: unit vector along which a mould opens
  Vec3 to_eye = Vec3::UnitZ();    ///< zebra: unit vector from the object to the eye
  Vec3 up = Vec3::UnitY();        ///< zebra: unit vector across the strips of light, perpendicular to to_eye
  Vec3 to_light = Vec3::UnitZ();  ///< isophotes: unit vector from the object to the light
  double stripes = 16.0;          ///< zebra: light and dark pairs over half a turn
  bool logarithmic = false;       ///< of the magnitude, whatever the mode prefers
};

/// A row of show_table().
struct ShowRow {
  Show show;
  std::string_view name;         ///< on the command line and in menus
  std::string_view description;  ///< one phrase
  /// Drawn per pixel from interpolated exact normals; the column is for what cannot do that.
  bool from_normals;
};
/// In the order of the enumeration.
[[nodiscard]] std::span<const ShowRow> show_table();
[[nodiscard]] const ShowRow& row_of(Show show);
[[nodiscard]] std::optional<Show> show_named(std::string_view name);

struct CurvatureRow {
  CurvatureFigure figure;
  std::string_view name, description;
};
[[nodiscard]] std::span<const CurvatureRow> curvature_table();
[[nodiscard]] std::optional<CurvatureFigure> curvature_named(std::string_view name);

/// The column that a mode colours by: "gap", "angle_deg", "curvature_jump", "mean_curvature",
/// "gaussian_curvature", "largest_curvature", "least_curvature", "zebra", "light_angle_deg", "draft_deg",
/// "least_radius", "deviation", "value"; empty: plain.
[[nodiscard]] std::string column_of(Show show, const ShowOptions& options);
/// "mm", "deg", "1/mm", "1/mm^2"; empty without a unit.
[[nodiscard]] std::string unit_of(Show show, const ShowOptions& options);
/// "gap (mm)", for the colour bar; empty: no bar (plain, zebra).
[[nodiscard]] std::string bar_title(Show show, const ShowOptions& options);
/// Gap, angle, jump, radius: by decades; signed figures: diverging about 0; else linear. `logarithmic` wins.
[[nodiscard]] ScaleRule scale_rule(Show show, const ShowOptions& options);
/// The scale for these values of the mode's column.
[[nodiscard]] ColourScale colour_scale(Show show, const ShowOptions& options,
                                       const std::vector<double>& values);

/// Adds the mode's column unless the mesh has it: draft, isophotes and zebra from `normals`, largest and
/// least curvature and the radius from "mean_curvature" and "gaussian_curvature" (comb colours as curvature
/// does). A figure that the mesh cannot give (gap of a mesh without seams, no normals) leaves it without the
/// column; returns whether the mesh has it now.
bool add_column(TriMesh& mesh, Show show, const ShowOptions& options);
/// nullptr: the mesh has no such column.
[[nodiscard]] const Column* find_column(const TriMesh& mesh, std::string_view name);

// Single values.
//
// n unit normal (its sign matters for the draft only), e to the eye, r = 2 (n.e) n - e the reflected line of
// sight, a across the strips of light:
//   phase = stripes (arccos(r.a) / pi - 1/2) + 1/4; light where its fraction is below 1/2; straight ahead is
//   the middle of a light strip, so that walls along the strips do not lie on the border of one         (1)
//   angle to the light = arccos(|n.l|)                                                                  (2)
//   draft = arcsin(n.pull): 0 where the wall stands along the pull                                      (3)
//   least radius = 1/(|H| + sqrt(H^2 - K)), infinite for a plane                                        (4)
/// (1)
[[nodiscard]] double zebra_phase(const Vec3& normal, const ShowOptions& options);
/// 1 in light, 0 in the dark.
[[nodiscard]] double zebra_value(const Vec3& normal, const ShowOptions& options);
/// (2), degrees in [0, 90].
[[nodiscard]] double light_angle_deg(const Vec3& normal, const ShowOptions& options);
/// (3), degrees in [-90, 90].
[[nodiscard]] double draft_deg(const Vec3& normal, const ShowOptions& options);
/// (4), model units.
[[nodiscard]] double least_radius(double mean, double gaussian);
/// Principal curvatures from H and K: H + sqrt(H^2 - K), H - sqrt(H^2 - K).
[[nodiscard]] double largest_curvature(double mean, double gaussian);
[[nodiscard]] double least_curvature(double mean, double gaussian);

/// zebra, isophotes or draft of many normals (3 floats each) at once, for frames; other modes throw
/// InputError.
void values_of_normals(Show show, const ShowOptions& options, std::span<const float> normals,
                       std::span<float> out);

}  // namespace blendwright
