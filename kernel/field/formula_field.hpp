#pragma once
// Fields given by templates over the number type: one body, exact derivatives, bounds and enclosures.
#include <algorithm>

#include "kernel/field/field_enclosure.hpp"
#include "kernel/field/scalar_field.hpp"
#include "kernel/math/taylor.hpp"

namespace blendwright {

/// Makes a model of a field of a Shape with
///     template <class T> T operator()(const T& x, const T& y, const T& z) const;
/// Second-order jets in two variables at a time give all derivatives: (x, y), (y, z) and (x, z).
template <class Shape>
class FormulaField final : public ScalarField::Model, public EnclosedField {
 public:
  explicit FormulaField(Shape shape) : shape_(std::move(shape)) {}

  void evaluate(Order order, PointArrays p, std::span<double> out) const override {
    using J = Taylor2<2>;
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double x = p.x[i], y = p.y[i], z = p.z[i];
      const J xy = shape_(J::u_variable(x), J::v_variable(y), J(z));
      out[i] = xy.value();
      if (order == Order::value) continue;
      const J yz = shape_(J(x), J::u_variable(y), J::v_variable(z));
      out[n + i] = xy.derivative(1, 0);
      out[2 * n + i] = xy.derivative(0, 1);
      out[3 * n + i] = yz.derivative(0, 1);
      if (order == Order::gradient) continue;
      const J xz = shape_(J::u_variable(x), J(y), J::v_variable(z));
      const std::array<double, 6> second{xy.derivative(2, 0), xy.derivative(0, 2), yz.derivative(0, 2),
                                         xy.derivative(1, 1), xz.derivative(1, 1), yz.derivative(1, 1)};
      for (std::size_t c = 0; c < 6; ++c) out[(4 + c) * n + i] = second[c];
    }
  }
  void enclose(const ModelVector& at, FieldEnclosure& out) const override {
    using J = ModelJet;
    const J xy = shape_(J::u_variable(at[0]), J::v_variable(at[1]), J(at[2]));
    const J yz = shape_(J(at[0]), J::u_variable(at[1]), J::v_variable(at[2]));
    const J xz = shape_(J::u_variable(at[0]), J(at[1]), J::v_variable(at[2]));
    out.value = xy.c[0];
    out.gradient = {xy.c[1], xy.c[2], yz.c[2]};
    out.hessian = {2.0 * xy.c[3], 2.0 * xy.c[5], 2.0 * yz.c[5], xy.c[4], xz.c[4], yz.c[4]};
  }
  [[nodiscard]] Range range(const Box& box) const override {
    const Bounds b =
        shape_(ModelJet(over(box, 0)), ModelJet(over(box, 1)), ModelJet(over(box, 2))).c[0].range();
    return {b.lo, b.hi};
  }
  /// The mean value form about the centre, when the gradient is bounded.
  [[nodiscard]] LinearBound linear(const Box& box) const override {
    const Vec3 centre = box.centre(), half = (box.hi - centre).cwiseMax(centre - box.lo);
    FieldEnclosure all, middle;
    enclose({over(box, 0), over(box, 1), over(box, 2)}, all);
    enclose(constant_model(centre), middle);
    const Bounds value = middle.value.range();
    LinearBound bound{value.middle(), Vec3::Zero(), {-value.radius(), value.radius()}};
    for (int i = 0; i < 3; ++i) {
      const Bounds g = all.gradient[static_cast<std::size_t>(i)].range();
      bound.slope[i] = half[i] * g.middle();
      // The slope as a double is off by a rounding; so are the half sizes.
      bound = bound.widened(rounded_up(half[i] * g.radius()) + 8.0 * 0x1p-52 * half[i] * g.magnitude());
    }
    const Range plain = range(box);
    const bool better = std::isfinite(bound.rest.hi) && bound.rest.hi - bound.rest.lo <= plain.hi - plain.lo;
    return better ? bound : constant_bound(plain);
  }
  [[nodiscard]] Within within(const Box& box) const override { return {range(box), nullptr}; }
  void nearest_member(PointArrays, std::span<std::uint32_t> out) const override {
    std::fill(out.begin(), out.end(), 0u);
  }

 private:
  static TaylorModel over(const Box& box, int i) { return TaylorModel(Bounds(box.lo[i], box.hi[i])); }
  Shape shape_;
};

template <class Shape>
[[nodiscard]] ScalarField formula_field(Shape shape, Level level, std::optional<Box> bounds = std::nullopt) {
  return ScalarField(std::make_shared<const FormulaField<Shape>>(std::move(shape)), level, bounds);
}

}  // namespace blendwright
