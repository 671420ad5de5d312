#include "parametric/shape_fit/row_weights.hpp"

#include <cmath>

namespace blendwright::detail {
namespace {

/// P of (1) in cardinal_sensitivity.hpp for a component, and its derivatives by the unknowns.
struct Equation {
  EvenOperator a{};
  std::vector<EvenOperator> by{};
};

Equation sixth(SixthOrderFamily family, double l) {
  switch (family) {
    case SixthOrderFamily::quintic:
      return {{}, {{}}};
    case SixthOrderFamily::tension1:
      return {{0.0, 0.0, -l}, {{0.0, 0.0, -1.0}}};
    case SixthOrderFamily::tension2:
      return {{0.0, l * l, -2.0 * l}, {{0.0, 2.0 * l, -2.0}}};
    case SixthOrderFamily::triple:
      return {{-l * l * l, 3.0 * l * l, -3.0 * l}, {{-3.0 * l * l, 6.0 * l, -3.0}}};
  }
  return {};
}

/// dl/dx of x = log(1 + l).
Equation scaled(Equation e, std::initializer_list<double> l) {
  auto value = l.begin();
  for (EvenOperator& by : e.by) {
    for (double& c : by) c *= 1.0 + *value;
    ++value;
  }
  return e;
}

/// q^2 of the double root, or tau^2 of the tension spline.
double square_of(const SweepOde& ode) {
  const double p = -ode.c / ode.b;
  return is_tension_spline(ode) ? p : 0.5 * p;
}

Equation fourth(const SweepOde& ode, std::optional<double> root, ShapeUnknown unknown) {
  const double p = root ? 2.0 * *root * *root : -ode.c / ode.b;
  const double s = root ? std::pow(*root, 4.0) : ode.d / ode.b;
  Equation e{{s, -p, 0.0}, {}};
  if (unknown == ShapeUnknown::coefficients) {
    e.by = {{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}};
    return scaled(e, {p, s});
  }
  if (!root && is_tension_spline(ode)) {
    e.by = {{0.0, -1.0, 0.0}};
    return scaled(e, {p});
  }
  const double l = 0.5 * p;
  e.by = {{2.0 * l, -2.0, 0.0}};
  return scaled(e, {l});
}

}  // namespace

bool is_tension_spline(const SweepOde& ode) { return ode.d == 0.0 && ode.c / ode.b < 0.0; }

int count(ShapeUnknown unknown) {
  switch (unknown) {
    case ShapeUnknown::none:
      return 0;
    case ShapeUnknown::tension:
      return 1;
    case ShapeUnknown::tension_per_component:
      return 3;
    case ShapeUnknown::coefficients:
      return 2;
  }
  return 0;
}

std::vector<double> shape_values(const BlendShape& shape, int order, ShapeUnknown unknown) {
  const auto square = [&](std::size_t x) {
    if (order == 6) return shape.tension * shape.tension;
    return shape.repeated_root ? *shape.repeated_root * *shape.repeated_root : square_of(shape.ode[x]);
  };
  switch (unknown) {
    case ShapeUnknown::none:
      return {};
    case ShapeUnknown::tension:
      return {std::log1p(square(0))};
    case ShapeUnknown::tension_per_component:
      return {std::log1p(square(0)), std::log1p(square(1)), std::log1p(square(2))};
    case ShapeUnknown::coefficients:
      break;
  }
  if (shape.repeated_root) return {std::log1p(2.0 * square(0)), std::log1p(square(0) * square(0))};
  const SweepOde& ode = shape.ode[0];
  return {std::log1p(-ode.c / ode.b), std::log1p(ode.d / ode.b)};
}

BlendShape shape_with(const BlendShape& shape, int order, ShapeUnknown unknown, const double* x) {
  BlendShape s = shape;
  if (unknown == ShapeUnknown::none) return s;
  if (order == 6) {
    s.tension = std::sqrt(std::expm1(x[0]));
    return s;
  }
  if (unknown == ShapeUnknown::coefficients) {
    s.repeated_root.reset();
    s.ode.fill(SweepOde{1.0, -std::expm1(x[0]), std::expm1(x[1])});
    return s;
  }
  if (unknown == ShapeUnknown::tension && shape.repeated_root) {
    s.repeated_root = std::sqrt(std::expm1(x[0]));
    return s;
  }
  s.repeated_root.reset();
  for (std::size_t i = 0; i < 3; ++i) {
    const double root = std::sqrt(std::expm1(x[unknown == ShapeUnknown::tension ? 0 : i]));
    const bool spline = !shape.repeated_root && is_tension_spline(shape.ode[i]);
    s.ode[i] = spline ? SweepOde::tension(root) : SweepOde::repeated_root(root);
  }
  return s;
}

ShapeWeights::ShapeWeights(const BlendShape& shape, int order, std::array<bool, 2> second,
                           ShapeUnknown unknown)
    : shape_(shape), order_(order), second_(second), unknown_(unknown) {
  const bool varies = unknown != ShapeUnknown::none;
  const auto add = [&](const CardinalBasis& basis, const Equation& e) {
    basis_.push_back(basis);
    sensitivity_.emplace_back(basis, e.a, varies ? e.by : std::vector<EvenOperator>{});
  };
  if (order == 6) {
    const double l = shape.tension * shape.tension;
    add(CardinalBasis::sixth_order(shape.family, shape.tension), scaled(sixth(shape.family, l), {l}));
    if (second[0] && second[1]) return;
    const SweepOde lower = SweepOde::tension(shape.tension);
    const CardinalBasis basis = CardinalBasis::fourth_order(lower);
    const CardinalSensitivity by(basis, {0.0, -l, 0.0}, {{0.0, -(1.0 + l), 0.0}});
    for (std::size_t i = 0; i < 2; ++i) {
      const CardinalValues phi = basis(static_cast<double>(i));
      const CardinalValues W = by.at(0, modes_at(2, static_cast<double>(i)));
      for (std::size_t k = 0; k < 4; ++k) {
        completion_[i][k] = phi.value[2][k];
        completion_by_[i][k] = W.value[2][k];
      }
    }
    return;
  }
  if (shape.repeated_root) {
    add(CardinalBasis::repeated_root(*shape.repeated_root), fourth({}, shape.repeated_root, unknown));
    return;
  }
  const bool common = shape.isotropic() && unknown != ShapeUnknown::tension_per_component;
  for (std::size_t x = 0; x < (common ? 1u : 3u); ++x)
    add(CardinalBasis::fourth_order(shape.ode[x]), fourth(shape.ode[x], std::nullopt, unknown));
}

/// The weights of (1) for one component, or with `by` their derivative.
std::array<std::array<double, row_count>, 4> ShapeWeights::rows(const CardinalValues& phi,
                                                                const CardinalValues* by) const {
  std::array<std::array<double, row_count>, 4> w{};
  const CardinalValues& f = by ? *by : phi;
  const std::size_t half = static_cast<std::size_t>(order_) / 2;
  for (std::size_t a = 0; a < 4; ++a) {
    w[a][C0] = f.value[a][0];
    w[a][T0] = f.value[a][1];
    w[a][C1] = f.value[a][half];
    w[a][T1] = f.value[a][half + 1];
    if (shape_.mode == BlendMode::chord) {
      // The rows are C - line and T - De: what the positions get instead is the line less De (K0 + K1).
      const double slopes = w[a][T0] + w[a][T1];
      w[a][C0] = slopes;
      w[a][C1] = -slopes;
    } else if (shape_.mode == BlendMode::anchor) {
      w[a][anchor_row] = -w[a][C0] - w[a][C1];
    }
    if (order_ == 4) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t k = i == 0 ? 2 : 5;
      if (second_[i]) {
        w[a][i == 0 ? D0 : D1] = f.value[a][k];
        continue;
      }
      constexpr std::array<std::size_t, 4> data{C0, T0, C1, T1};
      for (std::size_t d = 0; d < 4; ++d) {
        w[a][data[d]] += f.value[a][k] * completion_[i][d];
        if (by) w[a][data[d]] += phi.value[a][k] * completion_by_[i][d];
      }
    }
  }
  return w;
}

WeightsAt ShapeWeights::at(double u, bool with_derivatives) const {
  WeightsAt result;
  const std::size_t unknowns = with_derivatives ? static_cast<std::size_t>(count(unknown_)) : 0;
  RowWeights zero;
  for (auto& a : zero) a.fill(Vec3::Zero());
  result.by.assign(unknowns, zero);
  const Modes modes = unknowns > 0 ? modes_at(order_ / 2, u) : Modes();
  for (std::size_t x = 0; x < 3; ++x) {
    const std::size_t b = basis_.size() == 1 ? 0 : x;
    const auto axis = static_cast<Eigen::Index>(x);
    const auto put = [&](RowWeights& to, const std::array<std::array<double, row_count>, 4>& from) {
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t r = 0; r < row_count; ++r) to[a][r][axis] = from[a][r];
    };
    if (b < x) {  // as component 0
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t r = 0; r < row_count; ++r) {
          result.value[a][r][axis] = result.value[a][r][0];
          for (RowWeights& by : result.by) by[a][r][axis] = by[a][r][0];
        }
      continue;
    }
    const CardinalValues phi = basis_[b](u);
    put(result.value, rows(phi, nullptr));
    for (std::size_t i = 0; i < unknowns; ++i) {
      if (unknown_ == ShapeUnknown::tension_per_component && i != x) continue;
      const std::size_t own = unknown_ == ShapeUnknown::tension_per_component ? 0 : i;
      const CardinalValues W = sensitivity_[b].at(own, modes);
      put(result.by[i], rows(phi, &W));
    }
  }
  if (shape_.mode == BlendMode::chord) {
    result.value[0][C0].array() += 1.0 - u;
    result.value[0][C1].array() += u;
    result.value[1][C0].array() -= 1.0;
    result.value[1][C1].array() += 1.0;
  } else if (shape_.mode == BlendMode::anchor) {
    result.value[0][anchor_row].array() += 1.0;
  }
  return result;
}

}  // namespace blendwright::detail
