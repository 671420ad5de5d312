#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/field/rigid_motion.hpp"

namespace blendwright {
namespace {

constexpr double round_off = std::numeric_limits<double>::epsilon();
/// How far R may be from a rotation: what a few products of rotations, or numbers with 10 digits, leave.
constexpr double rotation_tolerance = 1e-9;

double distance_from_rotation(const Eigen::Matrix3d& R) {
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

void check(const RigidMotion& motion) {
  if (!motion.R.allFinite() || !motion.t.allFinite())
    throw InputError("motion", "has a number that is not finite");
  if (!(distance_from_rotation(motion.R) <= rotation_tolerance))
    throw InputError("motion", "has axes that are not unit and perpendicular to 1e-9");
  if (motion.R.determinant() < 0.0) throw InputError("motion", "mirrors, must turn and move only");
}

/// Encloses { turn x + move : x in box }, `slack` being the relative uncertainty of the map.
Box image(const Box& box, const Eigen::Matrix3d& turn, const Vec3& move, double slack) {
  const Vec3 c = box.centre(), h = 0.5 * box.size();
  const Vec3 centre = turn * c + move, reach = turn.cwiseAbs() * h;
  const double size = c.cwiseAbs().sum() + h.sum() + move.cwiseAbs().sum();
  const Vec3 out = reach + Vec3::Constant(slack * size);
  return {centre - out, centre + out};
}

/// f at R^T (X - t).
class PlacedModel final : public ScalarField::Model {
 public:
  PlacedModel(std::shared_ptr<const Model> of, const RigidMotion& motion)
      : of_(std::move(of)), motion_(motion), back_(inverse(motion)) {}

  void evaluate(Order order, PointArrays points, std::span<double> out) const override {
    const Local local(*this, points);
    of_->evaluate(order, local.arrays(), out);
    if (order == Order::value) return;
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
      Vec3 g;
      for (std::size_t c = 0; c < 3; ++c) g[static_cast<Eigen::Index>(c)] = out[(1 + c) * n + i];
      g = (motion_.R * g).eval();
      for (std::size_t c = 0; c < 3; ++c) out[(1 + c) * n + i] = g[static_cast<Eigen::Index>(c)];
      if (order == Order::hessian) turn_hessian(out, n, i);
    }
  }

  [[nodiscard]] Range range(const Box& box) const override { return of_->range(local(box)); }

  /// Both bounds are of the form value + slope.t: with the half sizes k of the local box and h of this one,
  /// t_local = (R^T (h t)) / k + [-1, 1] slack / k.
  [[nodiscard]] LinearBound linear(const Box& box) const override {
    const Box at = local(box);
    const LinearBound found = of_->linear(at);
    if (!box.finite() || found.slope.isZero(0.0)) return found;
    const Vec3 k = 0.5 * at.size();
    Vec3 gradient = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      if (k[i] > 0.0) gradient[i] = found.slope[i] / k[i];
    const Vec3 slope = (0.5 * box.size()).cwiseProduct(motion_.R * gradient);
    if (!slope.allFinite()) return constant_bound(found.range());
    return LinearBound{found.value, slope, found.rest}.widened(2.0 * slack_of(box) * gradient.lpNorm<1>());
  }

  [[nodiscard]] Within within(const Box& box) const override {
    Within inner = of_->within(local(box));
    if (inner.model) inner.model = std::make_shared<PlacedModel>(std::move(inner.model), motion_);
    return inner;
  }

  [[nodiscard]] std::shared_ptr<const Model> placed(const RigidMotion& motion) const override {
    return std::make_shared<PlacedModel>(of_, RigidMotion{motion.R * motion_.R, motion(motion_.t)});
  }

  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override {
    const Local local(*this, points);
    of_->nearest_member(local.arrays(), out);
  }

 private:
  /// Points in the coordinates of the field that was placed.
  class Local {
   public:
    Local(const PlacedModel& model, PointArrays points) : n_(points.size()), xyz_(3 * n_) {
      for (std::size_t i = 0; i < n_; ++i) {
        const Vec3 y = model.back_(Vec3(points.x[i], points.y[i], points.z[i]));
        for (std::size_t c = 0; c < 3; ++c) xyz_[c * n_ + i] = y[static_cast<Eigen::Index>(c)];
      }
    }
    [[nodiscard]] PointArrays arrays() const {
      const std::span<const double> all(xyz_);
      return {all.subspan(0, n_), all.subspan(n_, n_), all.subspan(2 * n_, n_)};
    }

   private:
    std::size_t n_;
    std::vector<double> xyz_;
  };

  /// H = R H' R^T, components xx, yy, zz, xy, xz, yz.
  void turn_hessian(std::span<double> out, std::size_t n, std::size_t i) const {
    const auto at = [&](std::size_t c) -> double& { return out[(4 + c) * n + i]; };
    Eigen::Matrix3d H;
    H << at(0), at(3), at(4), at(3), at(1), at(5), at(4), at(5), at(2);
    H = (motion_.R * H * motion_.R.transpose()).eval();
    at(0) = H(0, 0);
    at(1) = H(1, 1);
    at(2) = H(2, 2);
    at(3) = H(0, 1);
    at(4) = H(0, 2);
    at(5) = H(1, 2);
  }

  /// What rounding can change of a local coordinate.
  [[nodiscard]] double slack_of(const Box& box) const {
    return 16.0 * round_off *
           (box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).sum() + motion_.t.cwiseAbs().sum());
  }
  [[nodiscard]] Box local(const Box& box) const {
    if (!box.finite())
      return {Vec3::Constant(Range::everything().lo), Vec3::Constant(Range::everything().hi)};
    const Vec3 slack = Vec3::Constant(slack_of(box));
    const Box turned = image(box, back_.R, back_.t, 0.0);
    return {turned.lo - slack, turned.hi + slack};
  }

  std::shared_ptr<const Model> of_;
  RigidMotion motion_, back_;
};

}  // namespace

ScalarField placed(const ScalarField& field, const RigidMotion& motion) {
  check(motion);
  if (motion.is_identity()) return field;
  std::shared_ptr<const ScalarField::Model> model = field.model().placed(motion);
  if (!model) model = std::make_shared<PlacedModel>(field.shared_model(), motion);
  std::optional<Box> bounds = field.bounds();
  if (bounds && bounds->finite())
    // R^T undoes R but for its distance from a rotation.
    bounds = image(*bounds, motion.R, motion.t, 32.0 * round_off + 4.0 * distance_from_rotation(motion.R));
  else
    bounds.reset();
  return {std::move(model), field.level(), bounds, field.members()};
}

}  // namespace blendwright
