#pragma once
// A blend as a sum over the rows of its boundary data, with weights that depend on u and the shape only.
// Private to this module.
//
//   d^a/du^a S_x = sum_r weight[a][r]_x R_r,x,  R = (C0, T0, D0, C1, T1, D1, anchor)                      (1)
// The chord, the anchor and the second derivatives that nobody gave (completion) are part of the weights.
#include <vector>

#include "parametric/ode/ode_blend.hpp"
#include "parametric/shape_fit/cardinal_sensitivity.hpp"

namespace blendwright::detail {

enum Row : std::size_t { C0, T0, D0, C1, T1, D1, anchor_row, row_count };

/// weight[a][r], a = 0..3.
using RowWeights = std::array<std::array<Vec3, row_count>, 4>;

/// The unknowns of the shape. Each is x = log(1 + l), l = q^2, or -c and d of the pair (c, d): smooth and
/// with a slope at l = 0, unlike q itself.
enum class ShapeUnknown { none, tension, tension_per_component, coefficients };

struct WeightsAt {
  RowWeights value;
  std::vector<RowWeights> by;  ///< by each unknown x
};

class ShapeWeights {
 public:
  /// `shape` is one that shape_with made for these unknowns; order 4 or 6; second: the ends that give D.
  ShapeWeights(const BlendShape& shape, int order, std::array<bool, 2> second, ShapeUnknown unknown);
  [[nodiscard]] WeightsAt at(double u, bool with_derivatives) const;

 private:
  [[nodiscard]] std::array<std::array<double, row_count>, 4> rows(const CardinalValues& phi,
                                                                  const CardinalValues* by) const;

  BlendShape shape_;
  int order_;
  std::array<bool, 2> second_;
  ShapeUnknown unknown_;
  std::vector<CardinalBasis> basis_;                      ///< one, or one per component
  std::vector<CardinalSensitivity> sensitivity_;          ///< likewise
  std::array<std::array<double, 4>, 2> completion_{};     ///< D of end i from (C0, T0, C1, T1)
  std::array<std::array<double, 4>, 2> completion_by_{};  ///< its derivative by the unknown
};

/// How many unknowns x there are.
[[nodiscard]] int count(ShapeUnknown unknown);
/// The values of the unknowns in a shape.
[[nodiscard]] std::vector<double> shape_values(const BlendShape& shape, int order, ShapeUnknown unknown);
/// The shape with these values.
[[nodiscard]] BlendShape shape_with(const BlendShape& shape, int order, ShapeUnknown unknown,
                                    const double* x);
/// Whether (b, c, d) is the tension spline with d = 0 and c < 0, whose tension is tau.
[[nodiscard]] bool is_tension_spline(const SweepOde& ode);

}  // namespace blendwright::detail
