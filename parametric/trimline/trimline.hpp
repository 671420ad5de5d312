#pragma once
// Trimlines: where the blend starts and ends on its primaries. A trimline is a curve in the parameters of its
// primary, hence lies on it exactly.
#include <optional>
#include <string>
#include <vector>

#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/series.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

class Trimline {
 public:
  /// The pcurve may run beyond a closed direction of the primary (unrolled), so that it stays continuous.
  /// Throws GeometryError when the curve leaves an open domain of the primary by more than 1e-9 of its length
  /// (names v, the point and how far) and by more than `slack` in space, and when a closed pcurve does not
  /// close on the primary to 1e-6 of the line's size. slack: model units, >= 0; for pcurves that are only as
  /// good as the tolerance of the part they come from. The line then runs where the primary is continued.
  Trimline(Surface primary, Curve2 pcurve, double slack = 0.0);

  [[nodiscard]] const Surface& primary() const { return primary_; }
  [[nodiscard]] const Curve2& pcurve() const { return pcurve_; }
  [[nodiscard]] CurveDomain domain() const { return domain_; }
  [[nodiscard]] CurveJet<3> jet(double v) const;  ///< in space, exact to order 3; any v on a closed line
  [[nodiscard]] double length() const;            ///< arc length, model units

 private:
  struct Checked {};
  Trimline(Surface primary, Curve2 pcurve, Checked);  ///< the same points as a line that was checked
  friend Trimline reparametrised(const Trimline& line, const Curve<1>& map);

  Surface primary_;
  Curve2 pcurve_;
  CurveDomain domain_;
};

/// Iso-parameter line u = value (it runs along v) or v = value (runs along u), over `range` or the whole
/// domain; closed when the range is the whole of a closed direction.
enum class IsoDirection { constant_u, constant_v };
[[nodiscard]] Trimline isoline(const Surface& primary, IsoDirection direction, double value,
                               std::optional<Interval> range = std::nullopt);

/// The space curve projected on the primary: to the closest point, or along `direction` when given. The
/// parameter v is the curve's own.
///   (S - q).Su = 0, (S - q).Sv = 0              closest point of q = curve(v) (1) (S - q).e1 = 0, (S - q).e2
///   = 0              e1, e2 perpendicular to `direction`                              (2)
/// Exact derivatives by Newton on the Taylor series of (1) or (2). The projection is followed continuously
/// from its first point. Throws GeometryError where a point of the curve has no projection within the domain
/// (names v, the point, the distance), where it is lost, and when a closed curve's projection does not close.
[[nodiscard]] Trimline projected(const Surface& primary, const Curve3& curve,
                                 std::optional<Vec3> direction = std::nullopt);

/// The same line run through by a new parameter: v_old = map(v_new), map monotone (a Curve<1> jet). On a
/// closed line the map may leave the old domain; the new line is closed when the map is (map(hi) = map(lo) +-
/// one period). Throws GeometryError when the map is not monotone or leaves an open domain.
[[nodiscard]] Trimline reparametrised(const Trimline& line, const Curve<1>& map);

/// A place where the trimline or its primary degenerates.
struct DegeneratePoint {
  enum class Kind { cusp, pole } kind;  ///< |C'| = 0, or |Su x Sv| = 0
  double v = 0.0;
  Vec3 point;
  double normal_turn = 0.0;   ///< angle between the limits of the normal from both sides, radians
  double tangent_turn = 0.0;  ///< the same of C'/|C'|
  /// Both limits agree to 1e-6 rad; otherwise the trimline has a corner here. Where a whole stretch
  /// degenerates there are no limits and both angles are pi.
  [[nodiscard]] bool harmless() const { return normal_turn <= 1e-6 && tangent_turn <= 1e-6; }
};
/// Scans 256 places and refines. At an end of an open line there is one limit only, and the angles are 0.
[[nodiscard]] std::vector<DegeneratePoint> degenerate_points(const Trimline& line);

}  // namespace blendwright
