#pragma once
// How the cardinal functions change with the parameters of their equation. Private to this module.
//
//   P G = 0,  P = D^2n + a_{n-1} D^{2n-2} + .. + a_0, n = 2 (fourth order) or 3 (sixth order)            (1)
//   W = dG/dx:  P W = -(dP/dx) G,  W^(i) = 0 at u = 0 and 1 for i < n                                    (2)
// (2) is solved by the Galerkin method in the n-fold integrals of Legendre polynomials, which meet the end
// conditions and make the leading term the identity: A c = f with
//   A = 1 + sum_{j<n} (-1)^{j+n} a_j <psi^(j), psi^(j)>,  f = -sum_j (-1)^{j+n} a_j' <psi^(j), G^(j)>    (3)
// The functions are entire, so the error falls faster than any power: below rounding for roots up to 70.
// Source: Shen, Efficient spectral-Galerkin method I, SIAM J. Sci. Comput. 15 (1994).
#include <Eigen/Core>
#include <array>
#include <vector>

#include "parametric/ode/cardinal_basis.hpp"

namespace blendwright::detail {

/// a_0, a_1, a_2 of (1), the coefficients of D^0, D^2, D^4; fourth order: the last is 0 and not used.
using EvenOperator = std::array<double, 3>;

/// Values of psi_m^(j) at one u: row j = 0..3, column m.
using Modes = Eigen::Matrix<double, 4, Eigen::Dynamic>;
[[nodiscard]] Modes modes_at(int half_order, double u);

class CardinalSensitivity {
 public:
  /// `by`: dP/dx for each parameter x.
  CardinalSensitivity(const CardinalBasis& basis, const EvenOperator& a, const std::vector<EvenOperator>& by);
  /// dphi_k^(j)/dx of parameter i, from the modes at u.
  [[nodiscard]] CardinalValues at(std::size_t i, const Modes& modes) const;
  [[nodiscard]] int half_order() const { return half_order_; }

 private:
  int half_order_;
  std::vector<Eigen::MatrixXd> coefficients_;  ///< modes x functions, of each parameter
};

}  // namespace blendwright::detail
