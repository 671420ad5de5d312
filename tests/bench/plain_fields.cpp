// What the field benchmarks are compared with: the formulas of each model in one scalar function, written as
// one writes them from the papers, with the C++ library's functions, no work that the model does not need,
// and the early return where the influence ends. Compiled like everything else, -O3.
#include "tests/bench/plain_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace blendwright::bench {
namespace {

/// Blanc and Schlick's potential, softness 0.
inline double potential(double d) {
  if (d >= 1.0) return 0.0;
  const double u = d * d;
  return d <= 0.5 ? 1.0 - 2.0 * u : (1.0 - u) * (1.0 - u) / (0.75 + 1.5 * u);
}

inline double plate(double x, double y, double z) {
  return std::pow(std::pow(std::abs(x / 30.0), 20.0) + std::pow(std::abs(y / 30.0), 20.0) +
                      std::pow(std::abs(z / 12.0), 20.0),
                  1.0 / 20.0);
}
/// A bar with a section of exponent 1.
inline double bar(double x, double y, double z) {
  const double q = std::abs(x / 8.0) + std::abs(y / 8.0);
  return std::pow(std::pow(q, 20.0) + std::pow(std::abs(z / 24.0), 20.0), 1.0 / 20.0);
}
inline double contour(double n, double x, double y, double z) {
  const double q = std::pow(std::pow(std::abs(x / 8.0), n) + std::pow(std::abs(y / 8.0), n), 1.0 / n);
  return std::pow(std::pow(q, 20.0) + std::pow(std::abs(z / 24.0), 20.0), 1.0 / 20.0);
}

/// The distance after the variable influential radius, with its guard; w2 = 1, floor 0.02.
inline double variable_range(double d, double fc) {
  constexpr double floor = 0.02;
  if (d < 0.5) return d;
  const double a = 2.0 * d / fc - 1.0;
  const double w = a <= 0.0 ? floor : a < 2.0 * floor ? floor + a * a / (4.0 * floor) : a;
  return std::min(1.0, 0.5 + (d - 0.5) / w);
}

/// Scale union of two fields, r1 = r2 = r, p = 0.
inline double scale_union(double x1, double x2) {
  constexpr double r = 0.5, r2 = r * r;
  if (!(x1 > (1.0 - r) * x2 && x2 > (1.0 - r) * x1)) return std::max(x1, x2);
  constexpr double a = (1.0 - 2.0 * r) * r2 + (1.0 - r) * (1.0 - r) * r2;
  const double b = -2.0 * (x2 * (1.0 - r) * r2 + x1 * (1.0 - r) * r2);
  const double c = r2 * (x1 * x1 + x2 * x2);
  return 2.0 * c / (std::sqrt(b * b - 4.0 * a * c) - b);  // b < 0: the stable form of (-b - sqrt(D)) / (2 a)
}

template <class F>
PlainLoop loop(F field) {
  return [field](const double* x, const double* y, const double* z, std::size_t count, double* out) {
    for (std::size_t i = 0; i < count; ++i) out[i] = field(x[i], y[i], z[i]);
  };
}

}  // namespace

PlainLoop plain_blend() {
  return loop(
      [](double x, double y, double z) { return potential(bar(x, y, z)) + potential(plate(x, y, z)); });
}

PlainLoop plain_vir(double n) {
  return loop([n](double x, double y, double z) {
    return potential(variable_range(bar(x, y, z), contour(n, x, y, z))) + potential(plate(x, y, z));
  });
}

PlainLoop plain_ring() {
  struct Cylinder {
    double c, s;  ///< of the angle of the side's normal
  };
  std::array<Cylinder, 6> cylinders{};
  for (std::size_t k = 0; k < 6; ++k) {
    const double t = std::numbers::pi / 6.0 + std::numbers::pi / 3.0 * static_cast<double>(k);
    cylinders[k] = {std::cos(t), std::sin(t)};
  }
  return loop([cylinders](double x, double y, double z) {
    const double apothem = 6.0 * std::numbers::sqrt3;
    const auto cylinder = [&](const Cylinder& k) {
      const double across = k.c * x + k.s * y - apothem, along = k.c * y - k.s * x;
      const double q = std::sqrt(across * across + z * z) / 5.0;
      return potential(std::pow(std::pow(q, 20.0) + std::pow(std::abs(along / 14.0), 20.0), 1.0 / 20.0));
    };
    double f = cylinder(cylinders[0]);
    for (std::size_t k = 1; k < 6; ++k) f = scale_union(f, cylinder(cylinders[k]));
    return f;
  });
}

PlainLoop plain_sixball() {
  return loop([](double x, double y, double z) {
    const double r = std::sqrt(x * x + y * y + z * z);
    if (r == 0.0) return 1.0;
    const double T = std::pow(
        std::pow(std::abs(x), 7.0) + std::pow(std::abs(y), 7.0) + std::pow(std::abs(z), 7.0), 1.0 / 7.0);
    const double k = r / T;
    return potential(r / 30.0 * (k * k * k));
  });
}

PlainLoop plain_soft_sum(const std::vector<Ellipsoid>& ellipsoids) {
  struct Member {
    double m[3][4];  ///< scaled local coordinates
  };
  std::vector<Member> members;
  for (const Ellipsoid& e : ellipsoids) {
    Member m{};
    for (int i = 0; i < 3; ++i) {
      const Vec3 row = e.axes.row(i).transpose() / e.radii[i];
      for (int j = 0; j < 3; ++j) m.m[i][j] = row[j];
      m.m[i][3] = -row.dot(e.centre);
    }
    members.push_back(m);
  }
  return loop([members](double x, double y, double z) {
    double sum = 0.0;
    for (const Member& e : members) {
      double u = 0.0;
      for (const auto& row : e.m) {
        const double t = row[0] * x + row[1] * y + row[2] * z + row[3];
        u += t * t;
      }
      sum += potential(std::sqrt(u));
    }
    return sum;
  });
}

PlainLoop plain_freeform(const Freeform& freeform) {
  const auto value = [](const std::array<double, 10>& a, double x, double y, double z) {
    return x * (a[0] * x + a[3] * y + a[4] * z + a[6]) + y * (a[1] * y + a[5] * z + a[7]) +
           z * (a[2] * z + a[8]) + a[9];
  };
  return loop([freeform, value](double x, double y, double z) {
    double f = value(freeform.base, x, y, z);
    for (const Freeform::Bump& bump : freeform.bumps)
      if (const double q = value(bump.q, x, y, z); q > 0.0) f += bump.weight * q * q * q;
    return f;
  });
}

}  // namespace blendwright::bench
