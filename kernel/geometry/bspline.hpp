#pragma once
// B-spline curves and surfaces of any degree, clamped or periodic.
//
// Knots are distinct `breaks` t_0 < ... < t_n with a multiplicity each. Clamped: end multiplicities are
// degree + 1 and there are sum(mult) - degree - 1 control values. Periodic with period t_n - t_0:
// mult.front() == mult.back() counts once and there are sum(mult) - mult.back() control values, which wrap.
// The flat knot vector of a periodic basis is unrolled so that the functions that do not vanish on the first
// span are 0..degree (modulo their number), the convention of OpenCASCADE and STEP: an exporter copies
// breaks, multiplicities and control values unchanged. Evaluation: Piegl and Tiller, The NURBS Book,
// algorithms A2.2 and A2.3.
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// The B-spline basis of one parameter.
class BSplineBasis {
 public:
  static constexpr int max_degree = 25;
  /// Throws InputError: degree in [1, 25], breaks finite and strictly increasing, one multiplicity per break
  /// in [1, degree] (ends of a clamped basis: degree + 1).
  BSplineBasis(int degree, std::vector<double> breaks, std::vector<int> multiplicities, bool periodic);
  /// All interior multiplicities 1.
  [[nodiscard]] static BSplineBasis clamped(int degree, std::vector<double> breaks);
  [[nodiscard]] static BSplineBasis closed(int degree, std::vector<double> breaks);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] int count() const { return count_; }  ///< number of control values
  [[nodiscard]] bool periodic() const { return periodic_; }
  [[nodiscard]] const std::vector<double>& breaks() const { return breaks_; }
  [[nodiscard]] const std::vector<int>& multiplicities() const { return multiplicities_; }
  [[nodiscard]] Interval domain() const { return {breaks_.front(), breaks_.back()}; }

  /// Basis functions that do not vanish at t, with derivatives: value(k, i) = k-th derivative of the i-th of
  /// them, i = 0..degree, k = 0..order (rows beyond the degree are 0). Their control index is `index(first +
  /// i)`. t is wrapped into a periodic domain and clamped to an open one.
  struct Local {
    int first = 0;
    std::array<std::array<double, max_degree + 1>, 5> value{};
  };
  [[nodiscard]] Local evaluate(double t, int order) const;  ///< order in [0, 4]
  [[nodiscard]] int index(int i) const { return periodic_ ? ((i % count_) + count_) % count_ : i; }
  /// The 2 degree knots around span i of the breaks: knots [span - degree + 1, span + degree] of the flat
  /// vector; the functions that do not vanish on it begin with index(first_function(i)).
  [[nodiscard]] std::span<const double> span_knots(std::size_t i) const {
    return std::span(flat_).subspan(static_cast<std::size_t>(span_[i] - degree_ + 1),
                                    2 * static_cast<std::size_t>(degree_));
  }
  [[nodiscard]] int first_function(std::size_t i) const { return span_[i] - degree_; }
  /// Greville abscissae (means of `degree` knots), one per control value, wrapped into the domain of a
  /// periodic basis.
  [[nodiscard]] std::vector<double> greville() const;

 private:
  int degree_ = 1, count_ = 0;
  bool periodic_ = false;
  std::vector<double> breaks_;
  std::vector<int> multiplicities_;
  std::vector<double> flat_;
  std::vector<int> span_;  ///< flat index of the last copy of break i: the knot span that starts there
  [[nodiscard]] double inside(double t) const;
};

template <int Dim>
class BSplineCurve {
 public:
  using Point = Eigen::Matrix<double, Dim, 1>;
  /// Throws InputError when the number of control points is not basis.count() or a coordinate is not finite.
  BSplineCurve(BSplineBasis basis, std::vector<Point> control);
  [[nodiscard]] CurveJet<Dim> jet(double v) const;
  void enclose(const TaylorModel& v, CurveEnclosure& out) const;
  [[nodiscard]] CurveDomain domain() const { return {basis_.domain(), basis_.periodic()}; }
  [[nodiscard]] const BSplineBasis& basis() const { return basis_; }
  [[nodiscard]] const std::vector<Point>& control() const { return control_; }

 private:
  BSplineBasis basis_;
  std::vector<Point> control_;
};

class BSplineSurface {
 public:
  /// control[i * basis_v.count() + j] belongs to u-function i and v-function j.
  BSplineSurface(BSplineBasis basis_u, BSplineBasis basis_v, std::vector<Vec3> control);
  [[nodiscard]] SurfaceJet jet(UV p) const;
  [[nodiscard]] SurfacePartials partials(UV p) const;
  [[nodiscard]] SurfaceDomain domain() const;
  void enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const;
  [[nodiscard]] const BSplineBasis& basis_u() const { return basis_u_; }
  [[nodiscard]] const BSplineBasis& basis_v() const { return basis_v_; }
  [[nodiscard]] const std::vector<Vec3>& control() const { return control_; }
  [[nodiscard]] const Vec3& control(int i, int j) const {
    return control_[static_cast<std::size_t>(i) * static_cast<std::size_t>(basis_v_.count()) +
                    static_cast<std::size_t>(j)];
  }
  /// The boundary curve at u = lo (side 0) or u = hi (side 1) of a surface clamped in u: v -> S(u_side, v).
  /// Throws GeometryError when u is periodic.
  [[nodiscard]] BSplineCurve<3> edge_u(int side) const;

 private:
  [[nodiscard]] SurfacePartials partials_to(UV p, int order) const;
  BSplineBasis basis_u_, basis_v_;
  std::vector<Vec3> control_;
};

}  // namespace blendwright
