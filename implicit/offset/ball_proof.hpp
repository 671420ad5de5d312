#pragma once
// The proof that no point of a ball is above a limit; see ball_search.hpp.
#include "implicit/offset/local_points.hpp"

namespace blendwright::detail {

class BallProof {
 public:
  struct Ball {
    Vec3 centre;
    double radius;
    Box box;  ///< around it; the field is bounded in here only
  };
  /// What is bounded is sign * field.
  BallProof(const ScalarField::Model& field, double sign, const Ball& ball, std::size_t most_bounds)
      : field_(field), sign_(sign), ball_(ball), most_bounds_(most_bounds) {}

  struct Result {
    enum class Kind { proven, better, undecided } kind = Kind::undecided;
    Vec3 better = Vec3::Zero();  ///< a point of the ball above the limit
    double upper = 0.0;          ///< proven, undecided: nothing is above
  };
  /// peak: a local maximum, l: its Lagrange factor.
  [[nodiscard]] Result run(const Vec3& peak, double l, double limit);
  [[nodiscard]] std::size_t bounds() const { return bounds_; }

 private:
  struct Lagrangian;
  struct Cell;
  [[nodiscard]] Lagrangian bound(const Box& box, double l);
  [[nodiscard]] Cell cell(const Box& box, double l);
  [[nodiscard]] Result branch(std::vector<Cell> cells, double l, double limit, double passed);
  [[nodiscard]] Vec3 into_ball(const Vec3& p) const;

  const ScalarField::Model& field_;
  double sign_;
  Ball ball_;
  std::size_t most_bounds_, bounds_ = 0;
};

}  // namespace blendwright::detail
