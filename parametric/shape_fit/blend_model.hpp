#pragma once
// The blend as a function of the unknowns: positions and derivatives at a point, and their derivatives by x.
// Private to this module.
#include <memory>

#include "parametric/shape_fit/boundary_rows.hpp"

namespace blendwright::detail {

/// S, Su, Sv, Suu, Suv, Svv, Suuu at a point; v stands for the fraction t of the range.
constexpr Eigen::Index jet_size = 21;
using JetVector = Eigen::Matrix<double, jet_size, 1>;
using JetMatrix = Eigen::Matrix<double, jet_size, Eigen::Dynamic>;
enum JetPlace : Eigen::Index {
  at_S = 0,
  at_Su = 3,
  at_Sv = 6,
  at_Suu = 9,
  at_Suv = 12,
  at_Svv = 15,
  at_Suuu = 18
};

struct JetAt {
  JetVector value;
  JetMatrix by;  ///< one column per unknown; empty when not asked for
  [[nodiscard]] Vec3 part(JetPlace p) const { return value.segment<3>(p); }
};

class BlendModel {
 public:
  BlendModel(std::shared_ptr<const BoundaryRows> rows, const BlendShape& start, int order, Layout layout);

  /// The blend for one x.
  class At {
   public:
    At(const BlendModel& model, const double* x);
    [[nodiscard]] WeightsAt weights(double u, bool with_derivatives) const {
      return shape_.at(u, with_derivatives);
    }
    [[nodiscard]] Section section(double t, bool with_derivatives) const;
    [[nodiscard]] JetAt jet(const Section& section, const WeightsAt& weights, bool with_derivatives) const;
    [[nodiscard]] JetAt jet(double u, double t, bool with_derivatives) const {
      return jet(section(t, with_derivatives), weights(u, with_derivatives), with_derivatives);
    }

   private:
    const BlendModel& model_;
    const double* x_;
    ShapeWeights shape_;
  };

  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] const BoundaryRows& rows() const { return *rows_; }
  [[nodiscard]] std::size_t unknowns() const { return layout_.size(); }
  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] bool closed() const { return rows_->closed(); }
  [[nodiscard]] BlendShape shape(const double* x) const {
    return shape_with(start_, order_, layout_.shape, x);
  }

 private:
  std::shared_ptr<const BoundaryRows> rows_;
  BlendShape start_;
  int order_;
  Layout layout_;
  bool rotated_;  ///< own coefficients per component of a fixed frame
};

}  // namespace blendwright::detail
