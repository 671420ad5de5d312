// Power-series route of the fourth-order cardinal functions.
#include <algorithm>
#include <cmath>

#include "parametric/ode/cardinal_routes.hpp"

namespace blendwright::detail {
namespace {

double horner(const std::array<double, CauchySeries::terms>& a, double x) {
  double sum = 0.0;
  for (std::size_t m = a.size(); m-- > 0;) sum = sum * x + a[m];
  return sum;
}

class SeriesRoute final : public CardinalBasis::Impl {
 public:
  SeriesRoute(const Characteristic& ch, const CauchySeries& series)
      : Impl(4, condition(series), ch.stiffness()), series_(series) {}
  CardinalValues at(double u, double w) const override {
    return reflected(2, series_.end_functions(u), series_.end_functions(w));
  }

 private:
  /// Cancellation in W, relative to that of the cubic (f2(1)^2 = 3 W there).
  static double condition(const CauchySeries& series) {
    const double f2 = series.at_one().f2;
    return std::max(1.0, f2 * f2 / (3.0 * std::abs(series.wronskian())));
  }
  CauchySeries series_;
};

}  // namespace

CauchySeries::CauchySeries(const std::array<double, terms>& g) {
  double factorial = 1.0;  // (2m)!
  for (std::size_t i = 0; i < terms; ++i) {
    const double m = static_cast<double>(i + 1);
    factorial *= (2.0 * m - 1.0) * (2.0 * m);
    f2_[i] = g[i] / factorial;          // times u^(2m)
    f3_[i] = f2_[i] / (2.0 * m + 1.0);  // times u^(2m + 1)
    d1_[i] = f2_[i] * (2.0 * m);        // times u^(2m - 1)
    d2_[i] = d1_[i] * (2.0 * m - 1.0);  // times u^(2m - 2)
    d3_[i] = d2_[i] * (2.0 * m - 2.0);  // times u^(2m - 3); 0 for m = 1
  }
  one_ = at(1.0);
  W_ = one_.f2 * one_.f2 - one_.f3 * one_.d1;
}

CauchySeries::Values CauchySeries::at(double u) const {
  const double x = u * u;
  double d3 = 0.0;
  for (std::size_t m = terms; m-- > 1;) d3 = d3 * x + d3_[m];
  return {horner(f3_, x) * x * u, horner(f2_, x) * x, horner(d1_, x) * u, horner(d2_, x), d3 * u};
}

EndFunctions CauchySeries::end_functions(double u) const {
  const Values f = at(u);
  const std::array<double, 5> derivative{f.f3, f.f2, f.d1, f.d2, f.d3};  // f3^(j), and f2^(j) = f3^(j + 1)
  EndFunctions end{};
  for (std::size_t j = 0; j < 4; ++j) {
    const double f3 = derivative[j], f2 = derivative[j + 1];
    end[j][0] = (f2 * one_.f2 - f3 * one_.d1) / W_;
    end[j][1] = (f3 * one_.f2 - f2 * one_.f3) / W_;
  }
  return end;
}

Route series_route(const Characteristic& ch) {
  // G'''' = p G'' - s G gives g_(m + 2) = p g_(m + 1) - s g_m for the even Maclaurin derivatives of f2.
  std::array<double, CauchySeries::terms> g{};
  g[0] = 1.0;
  g[1] = ch.p;
  for (std::size_t m = 2; m < g.size(); ++m) g[m] = ch.p * g[m - 1] - ch.s * g[m - 2];
  return std::make_shared<SeriesRoute>(ch, CauchySeries(g));
}

}  // namespace blendwright::detail
