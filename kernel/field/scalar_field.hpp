#pragma once
// A scalar field f(x, y, z) with derivatives and bounds, as a value: all that meshing, verification and
// collision know of an implicit surface. Copies share one immutable model.
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kernel/field/level.hpp"
#include "kernel/field/linear_bound.hpp"
#include "kernel/field/range.hpp"

namespace blendwright {

/// Points as three arrays of the same length (model units).
struct PointArrays {
  std::span<const double> x, y, z;
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// What is asked of a field at a point.
enum class Order { value = 0, gradient = 1, hessian = 2 };
/// Numbers per point: f; fx, fy, fz; fxx, fyy, fzz, fxy, fxz, fyz.
[[nodiscard]] constexpr std::size_t components(Order order) {
  return order == Order::value ? 1 : order == Order::gradient ? 4 : 10;
}

/// Results of a batch: component c (in the order of components()) of point i is at c * size + i. Where a
/// derivative does not exist it is 0 or a one-sided one, never NaN or infinite; a value may be infinite.
struct FieldValues {
  Order order = Order::value;
  std::size_t size = 0;
  std::vector<double> data;
  [[nodiscard]] double value(std::size_t i) const { return data[i]; }
  [[nodiscard]] Vec3 gradient(std::size_t i) const {
    return {data[size + i], data[2 * size + i], data[3 * size + i]};
  }
  /// xx, yy, zz, xy, xz, yz.
  [[nodiscard]] std::array<double, 6> hessian(std::size_t i) const {
    std::array<double, 6> h{};
    for (std::size_t c = 0; c < 6; ++c) h[c] = data[(4 + c) * size + i];
    return h;
  }
};

struct RigidMotion;

class ScalarField {
 public:
  /// What a model of a field must do; all const, callable from several threads at once.
  class Model {
   public:
    virtual ~Model() = default;
    /// Writes components(order) * points.size() numbers, component c of point i at c * points.size() + i.
    virtual void evaluate(Order order, PointArrays points, std::span<double> out) const = 0;
    /// Contains every value that evaluate() returns for a point of the box.
    [[nodiscard]] virtual Range range(const Box& box) const = 0;
    /// Contains the same values, to first order; the rest is no wider than range(box), which it is when a
    /// model knows no better.
    [[nodiscard]] virtual LinearBound linear(const Box& box) const { return constant_bound(range(box)); }
    /// range(box), and an equal but cheaper model for points of the box (bit for bit the same values); null
    /// when there is none.
    struct Within {
      Range range;
      std::shared_ptr<const Model> model;
    };
    [[nodiscard]] virtual Within within(const Box& box) const = 0;
    /// An equal model of the moved solid; null: the points are moved back instead (see placed()).
    [[nodiscard]] virtual std::shared_ptr<const Model> placed(const RigidMotion& motion) const {
      (void)motion;
      return nullptr;
    }
    /// For each point the index of the primitive whose own surface is nearest to first order (see
    /// ScalarField::members); 0 when there is one or none.
    virtual void nearest_member(PointArrays points, std::span<std::uint32_t> out) const = 0;
  };

  /// `bounds` encloses the solid; nullopt: the solid is unbounded or nobody knows. `members`: names of the
  /// primitives.
  ScalarField(std::shared_ptr<const Model> model, Level level, std::optional<Box> bounds = std::nullopt,
              std::vector<std::string> members = {})
      : model_(std::move(model)), level_(level), bounds_(bounds), members_(std::move(members)) {}

  [[nodiscard]] const Model& model() const { return *model_; }
  [[nodiscard]] const std::shared_ptr<const Model>& shared_model() const { return model_; }
  [[nodiscard]] Level level() const { return level_; }
  [[nodiscard]] const std::optional<Box>& bounds() const { return bounds_; }
  [[nodiscard]] const std::vector<std::string>& members() const { return members_; }

  [[nodiscard]] FieldValues evaluate(Order order, PointArrays points) const;
  [[nodiscard]] FieldValues evaluate(Order order, std::span<const Vec3> points) const;
  [[nodiscard]] double value(const Vec3& point) const;
  [[nodiscard]] Range range(const Box& box) const { return model_->range(box); }
  [[nodiscard]] LinearBound linear(const Box& box) const { return model_->linear(box); }

 private:
  std::shared_ptr<const Model> model_;
  Level level_;
  std::optional<Box> bounds_;
  std::vector<std::string> members_;
};

/// Curvatures of the level surface through a point, from the field's derivatives there; positive where the
/// solid is convex (a ball of radius R: mean 1/R, Gaussian 1/R^2). Units 1/length, 1/length^2.
///   mean = -sense (|g|^2 tr H - g.H g) / (2 |g|^3), Gaussian = g.adj(H) g / |g|^4      (Goldman 2005,
///   eqs 4.1, 4.2)
/// nullopt where the gradient vanishes or a number is not finite.
struct LevelCurvature {
  double mean = 0.0, gaussian = 0.0;
};
[[nodiscard]] std::optional<LevelCurvature> level_curvature(const Vec3& gradient,
                                                            const std::array<double, 6>& hessian,
                                                            Level level);

}  // namespace blendwright
