#pragma once
// Scalar functions as interpolating splines of degree 5 (C4), evaluated on numbers and on Taylor series.
// Private to this module.
#include <array>
#include <vector>

#include "kernel/geometry/bspline.hpp"
#include "kernel/geometry/enclosure.hpp"
#include "kernel/geometry/series.hpp"

namespace blendwright {

class ScalarSpline {
 public:
  static constexpr int degree = 5;
  /// breaks t_0 < .. < t_n, n >= 6; value i at t_i, i < n; the period is t_n - t_0.
  [[nodiscard]] static ScalarSpline closed(std::vector<double> breaks, const std::vector<double>& values);
  /// breaks t_0 < .. < t_n, n >= 1; value i at t_i, i <= n; first and second derivatives at both ends.
  [[nodiscard]] static ScalarSpline open(std::vector<double> breaks, const std::vector<double>& values,
                                         std::array<double, 2> start, std::array<double, 2> end);
  /// The same; the end derivatives are those of the polynomial through the nearest 5 points (all, if fewer):
  /// two points make a straight line, three a parabola.
  [[nodiscard]] static ScalarSpline open(std::vector<double> breaks, const std::vector<double>& values);

  [[nodiscard]] double operator()(double t) const;
  [[nodiscard]] Series operator()(const Series& t) const;
  /// Encloses the polynomial pieces over the range of t; unbounded where they are more than four.
  [[nodiscard]] ModelJet operator()(const ModelJet& t) const;

 private:
  ScalarSpline(const BSplineBasis& basis, const std::vector<double>& control);
  /// The span of t and the place in it, in [0, 1].
  struct Place {
    std::size_t span;
    double x;
  };
  [[nodiscard]] Place place(double t) const;

  // Kept as polynomials: in span k, f = sum_j c_j x^j with x = (t - t_k)/(t_{k+1} - t_k).
  std::vector<double> breaks_;
  std::vector<std::array<double, degree + 1>> polynomials_;
  bool closed_ = false;
};

}  // namespace blendwright
