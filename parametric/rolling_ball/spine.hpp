#pragma once
// The spine of a rolling ball: the curve of the centres of a ball that touches two primaries.
//
// Signed radii r1, r2, |r1| = |r2| = r: +r, the ball is outside of the primary (fillet); -r, inside (round).
//   E_i(c) = (c - p_i(c)).n_i - r_i = 0, p_i the foot of c, n_i the outward normal there (1) T = n1 x n2/|n1
//   x n2|, spine tangent;  d_i = (p_i - c)/r = -sign(r_i) n_i                               (2) X = c + r
//   (d_1 turned towards d_2 about d_1 x d_2), arc angle acos(d_1.d_2) in (0, pi): the shorter arc (3)
// Traced by prediction along T and the shortest correction; seeds from the edge where the primaries meet and
// from a subdivision of a box of centres, since components need not be near any edge. Sources: Rossignac and
// Requicha 1984; Hoffmann, Geometric and Solid Modeling, 1989, chs 6 and 7; Patrikalakis and Maekawa 2002.
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "parametric/rolling_ball/ball_primary.hpp"

namespace blendwright {

/// Two primaries and the signed radii of a ball between them.
struct BallPair {
  std::array<BallPrimary, 2> primaries;
  std::array<double, 2> radius{1.0, 1.0};  ///< model units
};

/// Why there is no ball, or none from some place on.
struct BallFailure {
  enum class Cause {
    tangent,       ///< the normals of both feet are parallel: the spine is singular, or the blend vanishes
    curvature,     ///< 1 + r kappa <= 0 at a foot: the ball is larger than the hollow there
    no_spine,      ///< no ball in the box touches both
    interference,  ///< the ball meets a primary, or another part, elsewhere
    domain,        ///< a foot leaves the domain of its surface
    lost           ///< no foot or no centre was reached, for none of these reasons
  } cause = Cause::lost;
  Vec3 at = Vec3::Zero();  ///< centre of the ball
  double depth = 0.0;      ///< interference: how deep the ball is in there, model units
  std::string message;     ///< one sentence
};
[[nodiscard]] const char* name(BallFailure::Cause cause);

/// How a spine ends; closed spines have no ends.
struct SpineEnd {
  enum class Kind { closed, box, domain, failure } kind = Kind::closed;
  std::optional<BallFailure> failure{};  ///< of Kind::failure
};

struct SpinePoint {
  double s = 0.0;        ///< arc length from the start, model units
  Vec3 centre;           ///< c
  Vec3 tangent;          ///< T
  double speed = 1.0;    ///< |dc/ds|: 1 but for the interpolation of s between traced points
  double curvature = 0;  ///< of the spine
  std::array<BallFoot, 2> feet;
  Radians arc{};          ///< of the section (3)
  double residual = 0.0;  ///< largest |E_i|
};

struct SpineSpec {
  Box box;                       ///< of centres
  double chord_tolerance = 0.0;  ///< between chords and spine, model units; 0: r/1000
  double seed_size = 0.0;  ///< components of this extent are found, model units; 0: r/4, or 1/100 of the
                           ///< box's diagonal where that is more
  /// edge: only along the edge where the primaries meet, which is faster and misses components away from it;
  /// box: everywhere, edges too.
  enum class Seeds { edge, box, both } seeds = Seeds::box;
  std::vector<BallPrimary> others{};  ///< parts that the ball must not meet, besides the two
};

/// One component of the spine. Between the traced points centres and feet are corrected again, not
/// interpolated.
class Spine {
 public:
  /// `points`: at least two, s increasing; a closed spine does not repeat its first point. Used by the
  /// tracer.
  Spine(BallPair pair, std::vector<SpinePoint> points, bool closed, std::array<Vec2, 2> turns,
        std::array<SpineEnd, 2> ends);

  [[nodiscard]] const BallPair& pair() const { return pair_; }
  [[nodiscard]] double radius() const { return std::abs(pair_.radius[0]); }
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] double length() const { return length_; }
  /// Traced points, in the direction of T. Neighbours' tangents differ by at most 4 deg.
  [[nodiscard]] const std::vector<SpinePoint>& points() const { return points_; }
  /// What (u, v) of foot i gains in one turn of a closed spine.
  [[nodiscard]] const std::array<Vec2, 2>& turns() const { return turns_; }
  /// At the start and at the end of an open spine.
  [[nodiscard]] const std::array<SpineEnd, 2>& ends() const { return ends_; }

  /// The ball at arc length s: (1) solved in the plane across the interpolating curve. Any s on a closed
  /// spine; clamped on an open one. Throws ConvergenceError when the ball cannot be put there.
  [[nodiscard]] SpinePoint at(double s) const;
  /// s of the spine's point nearest to c.
  [[nodiscard]] double nearest(const Vec3& c) const;

  /// The ball meets a primary or another part elsewhere; the deepest of the traced points.
  std::optional<BallFailure> interference{};

 private:
  class Base;
  void measure();
  BallPair pair_;
  std::vector<SpinePoint> points_;
  bool closed_;
  std::array<Vec2, 2> turns_;
  std::array<SpineEnd, 2> ends_;
  double length_ = 0.0;
  std::shared_ptr<const Base> base_;
};

struct SpineSet {
  std::vector<Spine> spines;          ///< in the order of their first seeds
  std::vector<BallFailure> failures;  ///< why there is none, or why some end
  double seed_size = 0.0;             ///< that was used
};

/// All components whose centres are in the box; a part of one that leaves the box is a component, and ends
/// there. For fields no box with a part of a spine is given up wrongly (bounds of the field, and the distance
/// to a surface changes by no more than the centre moves); surfaces are covered by samples. A component along
/// which the ball meets a primary elsewhere all the way is none. Throws InputError
/// ("radius", "box", "chord_tolerance", "seed_size").
[[nodiscard]] SpineSet find_spines(const BallPair& pair, const SpineSpec& spec);

/// The component that is reached from a ball near c. Throws GeometryError, one sentence with the cause, when
/// none is.
[[nodiscard]] Spine spine_near(const BallPair& pair, const Vec3& c, const SpineSpec& spec);

/// The largest ball, of the same sides, for which spine_near succeeds without interference and without a
/// failure at an end; radii up to `limit` are tried, to 1 %. nullopt: none.
[[nodiscard]] std::optional<double> largest_radius(const BallPair& pair, const Vec3& c,
                                                   const SpineSpec& spec);

}  // namespace blendwright
