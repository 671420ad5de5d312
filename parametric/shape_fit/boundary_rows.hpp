#pragma once
// The rows of boundary data along v with their derivatives by the unknowns of the sides. Private to this
// module.
//
//   T_i = f_i U_i,  U_i = rho_i d_i,  d_i = cos psi_i k_i + sin psi_i c_i                                 (1)
//   D_i = f_i^2 V_i,  V_i = rho_i^2 II(d_i, d_i) n_i                                                      (2)
// f_i: factor law, linear in its values. rho_i: |De|, 2/(1 + cos(theta/2)) |De| or 1, by the magnitude rule.
// k, c, n: conormal, unit tangent, normal. The data of line 1 are taken at g(t), t the fraction of the range;
// all derivatives are by t.
#include <memory>
#include <vector>

#include "parametric/blend.hpp"
#include "parametric/shape_fit/row_weights.hpp"
#include "parametric/shape_fit/unknown_layout.hpp"

namespace blendwright::detail {

/// R[b][row]: b-th derivative by t, b = 0..2.
using RowsAt = std::array<std::array<Vec3, row_count>, 3>;

struct Section {
  RowsAt R;
  /// by[p]: derivative by unknown p of the sides (p counts from the start of x; those of the shape are
  /// empty).
  struct Change {
    std::array<std::size_t, 5> rows{};
    std::size_t count = 0;  ///< rows in use
    std::array<std::array<Vec3, 3>, 5> R{};
  };
  std::vector<Change> by;
  double least_law = 0.0;  ///< the smaller of both factor laws here
  double map_slope = 1.0;  ///< g'
  double cos_theta = 1.0;  ///< of the cross directions, where a magnitude rule needs their angle
};

class BoundaryRows {
 public:
  virtual ~BoundaryRows() = default;
  [[nodiscard]] virtual Section at(double t, const double* x, bool with_derivatives) const = 0;
  [[nodiscard]] virtual bool closed() const = 0;
  [[nodiscard]] virtual std::array<Continuity, 2> continuity() const = 0;
  /// How far the tables are from the lines, model units.
  [[nodiscard]] virtual double table_error() const { return 0.0; }
};

/// Rows that nothing but the shape changes.
[[nodiscard]] std::shared_ptr<const BoundaryRows> literal_rows(const EndCondition& end0,
                                                               const EndCondition& end1, const Vec3& anchor);

/// Line data in tables: quintic splines, refined until they are as close as rounding allows or 1024 spans are
/// used. `kept_left` and `lines` are those of the start; the sides' rules must be chord, circle_like or
/// constant.
[[nodiscard]] std::shared_ptr<const BoundaryRows> line_rows(const Correspondence& lines,
                                                            std::array<bool, 2> kept_left,
                                                            const std::array<SideSpec, 2>& sides,
                                                            const Layout& layout, const Vec3& anchor);

}  // namespace blendwright::detail
