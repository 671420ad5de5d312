#pragma once
// A trajectory in space given by formulas, with a rotation-minimising frame, made ready for many searches of
// the nearest point.
//
// The curve is kept as pieces of degree 7 in x in [-1, 1], t = t_middle + half x, which agree with the
// formulas' values and first three derivatives at both ends and to 1e-14 of the curve's size between. On a
// piece the tangent turns by less than 0.26 rad and |C'| > 0 is proven. The frame of a piece is
//
//   W = C'/|C'|,  A = (e - (e.W) W)/|e - (e.W) W|,  B = W x A,  U = A cos theta + B sin theta,  V = W x U (1)
//   theta' = (e.W) (W'.B)/|e - (e.W) W|                                                                   (2)
//
// with e fixed, perpendicular to W at the middle. (2) is what U'.V = 0 (Bishop 1975: no rotation about W)
// says of theta; it is interpolated at eight Chebyshev points and integrated, to 1e-13 per piece. So U is
// the same smooth function in values and derivatives, and continuous from piece to piece.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kernel/field/range.hpp"

namespace blendwright::detail {

/// C, C', C'', C''' by x.
using PathJet = std::array<Vec3, 4>;
/// U, V and their first two derivatives by x; W.
struct PathFrame {
  std::array<Vec3, 3> U, V;
  Vec3 W;
};

struct PathPiece {
  double t_middle = 0.0, half = 0.0;
  std::array<Vec3, 8> c{};        ///< C = sum c_k x^k
  Vec3 e = Vec3::UnitX();         ///< of (1)
  std::array<double, 9> theta{};  ///< of (1), by powers of x
  double radius = 0.0;            ///< of a ball about c_0 that holds the piece
  double most[4] = {0, 0, 0, 0};  ///< [k]: bound of |d^k C/dx^k|, k = 1, 2, 3

  [[nodiscard]] PathJet jet(double x) const;
  [[nodiscard]] PathFrame frame(double x) const;  ///< U[0], V[0], W
  [[nodiscard]] PathFrame frame_jet(double x) const;
  [[nodiscard]] Box box() const;             ///< encloses the piece
  [[nodiscard]] Vec3 least_tangent() const;  ///< lower bounds of |W_i|, in [0, 1]
};

/// A nearest point of the path.
struct Foot {
  std::size_t piece = 0;
  double x = 0.0;
  double distance = 0.0;
  int end = 0;  ///< -1, 1: the start, the end, and the point lies beyond it; else 0
};

class Path {
 public:
  /// Throws InputError ("curve", "curve/1", "t", "u"): a formula does not parse; t0 < t1 does not hold; the
  /// curve is not finite, has a point with C' = 0 or is not twice continuously differentiable; `u` (the start
  /// direction, U(t0) when made perpendicular to W) is parallel to C'(t0). Without `u` it is the coordinate
  /// axis that is most nearly perpendicular.
  Path(const std::vector<std::string>& formulas, double t0, double t1, std::optional<Vec3> u);

  [[nodiscard]] double t0() const { return t0_; }
  [[nodiscard]] double t1() const { return t1_; }
  [[nodiscard]] double t(const Foot& foot) const;
  [[nodiscard]] const std::vector<PathPiece>& pieces() const { return pieces_; }
  /// C and C' agree at both ends, to 1e-9.
  [[nodiscard]] bool closed() const { return closed_; }
  /// The angle from U(t0) to U(t1) about W of a closed path.
  [[nodiscard]] double closing_angle() const { return closing_angle_; }
  [[nodiscard]] const Box& bounds() const { return bounds_; }

  /// The globally nearest point (of several, any one). Its distance is right to 1e-13. Cost: some ten
  /// evaluations of a piece; hundreds near a centre of curvature.
  [[nodiscard]] Foot nearest(const Vec3& point) const;

  /// Where all feet of the points of a ball lie, if that is one stretch on which each of them has one foot:
  /// |t(X) - t(Y)| <= rate |X - Y|.
  struct Stretch {
    double rate = 0.0;
  };
  /// Null when that is not so, or not sure. `foot`: that of the centre; wraps: a stretch may lead through the
  /// seam of a closed path.
  [[nodiscard]] std::optional<Stretch> stretch(const Vec3& centre, double radius, const Foot& foot,
                                               bool wraps) const;

 private:
  struct Ball {
    Vec3 centre;
    double radius;
    std::size_t first, count;  ///< pieces
    std::size_t right;         ///< its second half; the first half is the next ball
  };
  class Search;
  class Survey;
  [[nodiscard]] Foot polished(const Vec3& point, Foot foot) const;
  std::size_t add_balls(std::size_t first, std::size_t count);
  void add_frames(std::optional<Vec3> u);

  double t0_, t1_;
  std::vector<PathPiece> pieces_;
  std::vector<Ball> balls_;
  bool closed_ = false;
  double closing_angle_ = 0.0;
  Box bounds_;
};

}  // namespace blendwright::detail
