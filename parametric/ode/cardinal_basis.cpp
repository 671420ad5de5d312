#include "parametric/ode/cardinal_basis.hpp"

#include <cmath>

#include "kernel/base/number_text.hpp"
#include "parametric/ode/cardinal_routes.hpp"

namespace blendwright {
namespace {

void check_root(const char* where, double q) {
  if (!std::isfinite(q) || q < 0.0)
    throw InputError(where, number_text(q) + " is not a root: it must be finite and not negative");
}

detail::Route fourth_order_route(const detail::Characteristic& ch) {
  if (ch.size() <= 4.0) return detail::series_route(ch);
  if (ch.s > 0.0 && std::sqrt(ch.s) > 0.05 * std::abs(ch.p)) return detail::product_route(ch);
  return detail::split_route(ch);
}

}  // namespace

const char* name(SixthOrderFamily f) {
  switch (f) {
    case SixthOrderFamily::quintic:
      return "quintic";
    case SixthOrderFamily::tension1:
      return "tension1";
    case SixthOrderFamily::tension2:
      return "tension2";
    case SixthOrderFamily::triple:
      return "triple";
  }
  return "?";
}

CardinalBasis CardinalBasis::fourth_order(const SweepOde& ode) {
  return CardinalBasis(fourth_order_route(detail::characteristic(ode)));
}

CardinalBasis CardinalBasis::repeated_root(double q) {
  check_root("repeated_root", q);
  return CardinalBasis(detail::repeated_root_route(q));
}

CardinalBasis CardinalBasis::sixth_order(SixthOrderFamily family, double q) {
  if (family == SixthOrderFamily::quintic) return CardinalBasis(detail::sixth_series_route(family, 0.0));
  check_root("tension", q);
  return CardinalBasis(q <= 3.0 ? detail::sixth_series_route(family, q)
                                : detail::sixth_layer_route(family, q));
}

int CardinalBasis::count() const { return impl_->count; }
double CardinalBasis::kappa() const { return impl_->kappa; }
double CardinalBasis::stiffness() const { return impl_->stiffness; }

CardinalValues CardinalBasis::operator()(double u) const { return (*this)(u, 1.0 - u); }

CardinalValues CardinalBasis::operator()(double u, double w) const {
  CardinalValues all = impl_->at(u, w);
  // At the ends the data are met exactly, not to rounding.
  const std::size_t functions = static_cast<std::size_t>(impl_->count), data = functions / 2;
  if (u == 0.0 || w == 0.0)
    for (std::size_t j = 0; j < data; ++j)
      for (std::size_t k = 0; k < functions; ++k)
        all.value[j][k] = k == j + (u == 0.0 ? 0 : data) ? 1.0 : 0.0;
  return all;
}

}  // namespace blendwright
