#pragma once
// Trimlines: where the blend starts and ends on its primaries. A trimline is a curve in the parameters of its primary,
// hence lies on it exactly.
#include <optional>
#include <string>
#include <vector>

#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/series.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

class Trimline {
 public:
  /// Throws GeometryError when the curve leaves an open domain of the primary by more than 1e-9 of its length (names
  /// v, the point and how far).
  Trimline(Surface primary, Curve2 pcurve);

  [[nodiscard]] const Surface& primary() const { return primary_; }
  [[nodiscard]] const Curve2& pcurve() const { return pcurve_; }
  [[nodiscard]] CurveDomain domain() const { return pcurve_.domain(); }
  [[nodiscard]] CurveJet<3> jet(double v) const;  ///< in space, exact to order 3
  [[nodiscard]] double length() const;            ///< arc length, model units

 private:
  Surface primary_;
  Curve2 pcurve_;
};

/// Iso-parameter line u = value (it runs along v) or v = value (runs along u), over `range` or the whole domain; closed
/// when the range is the whole of a closed direction.
enum class IsoDirection { constant_u, constant_v };
[[nodiscard]] Trimline isoline(const Surface& primary, IsoDirection direction, double value,
                               std::optional<Interval> range = std::nullopt);

/// The space curve projected on the primary: to the closest point, or along `direction` when given. The parameter v is
/// the curve's own. Exact derivatives by Newton on series. Throws GeometryError where a point of the curve has no
/// projection within the domain (names v, the point, the distance).
[[nodiscard]] Trimline projected(const Surface& primary, const Curve3& curve,
                                 std::optional<Vec3> direction = std::nullopt);

/// The same line run through by a new parameter: v_old = map(v_new), map monotone (a Curve<1> jet).
[[nodiscard]] Trimline reparametrised(const Trimline& line, const Curve<1>& map);

/// A place where the trimline or its primary degenerates.
struct DegeneratePoint {
  enum class Kind { cusp, pole } kind;  ///< |C'| = 0, or |Su x Sv| = 0
  double v = 0.0;
  Vec3 point;
  double normal_turn = 0.0;             ///< angle between the limits of the normal from both sides, radians
};
/// Scans and refines; limits that agree to 1e-6 rad are harmless (normal_turn says so), others are corners.
[[nodiscard]] std::vector<DegeneratePoint> degenerate_points(const Trimline& line);

}  // namespace blendwright
