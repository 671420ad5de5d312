// Fields given by formulas: derivatives, bounds over boxes and enclosures along curves.
#include "kernel/field/formula_field.hpp"

#include <gtest/gtest.h>

#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

struct Wavy {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return sin(x + 2.0 * y) * exp(0.5 * z) + x * y * z - z * z;
  }
};
ScalarField wavy() { return formula_field(Wavy{}, Level::zero); }

Vec3 random_point(Rng& rng) { return {uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)}; }

TEST(FormulaField, DerivativesAreThoseOfItsFormula) {
  for_all([](Rng& rng) {
    const Vec3 p = random_point(rng);
    const std::array<Vec3, 1> at{p};
    const FieldValues f = wavy().evaluate(Order::hessian, at);
    const double x = p.x(), y = p.y(), z = p.z(), s = std::sin(x + 2 * y), c = std::cos(x + 2 * y),
                 e = std::exp(0.5 * z);
    EXPECT_NEAR(f.value(0), s * e + x * y * z - z * z, 1e-14);
    const Vec3 gradient(c * e + y * z, 2 * c * e + x * z, 0.5 * s * e + x * y - 2 * z);
    EXPECT_LE((f.gradient(0) - gradient).norm(), 1e-14);
    const std::array<double, 6> hessian{-s * e,         -4 * s * e,      0.25 * s * e - 2,
                                        -2 * s * e + z, 0.5 * c * e + y, c * e + x};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(f.hessian(0)[k], hessian[k], 1e-14) << k;
  });
}

TEST(FormulaField, BoundsContainTheValuesOfTheBox) {
  for_all([](Rng& rng) {
    const Vec3 lo = random_point(rng);
    const Box box{lo, lo + Vec3::Constant(test::log_uniform(rng, 1e-6, 0.5))};
    const Range range = wavy().range(box);
    const LinearBound linear = wavy().linear(box);
    const Vec3 half = 0.5 * box.size();
    for (int i = 0; i < 20; ++i) {
      const Vec3 t(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
      const double f = wavy().value(box.centre() + half.cwiseProduct(t));
      EXPECT_TRUE(range.contains(f));
      const double rest = f - linear.value - linear.slope.dot(t);
      EXPECT_LE(linear.rest.lo - 1e-15, rest);  // rounding of this sum
      EXPECT_GE(linear.rest.hi + 1e-15, rest);
    }
    EXPECT_LE(linear.rest.hi - linear.rest.lo, range.hi - range.lo);
    // Of second order: |H| stays below 12 here, so that the gradient turns by less than 12 sqrt(3) half.
    EXPECT_LE(linear.rest.hi, 3.0 * 24.0 * half.squaredNorm() + 1e-13);
  });
}

TEST(FormulaField, EnclosuresContainValuesAndDerivativesAlongACurve) {
  for_all([](Rng& rng) {
    const Vec3 p = random_point(rng), d = random_point(rng);
    const double width = 0.05;
    const TaylorModel t = TaylorModel::parameter(0.0, width);
    FieldEnclosure e;
    const auto* field = dynamic_cast<const EnclosedField*>(&wavy().model());
    ASSERT_NE(field, nullptr);
    field->enclose(constant_model(p) + t * constant_model(d), e);
    for (int i = 0; i < 10; ++i) {
      const double x = uniform(rng, -1.0, 1.0);
      const std::array<Vec3, 1> at{p + 0.5 * width * (1.0 + x) * d};
      const FieldValues f = wavy().evaluate(Order::hessian, at);
      const auto near = [&](const TaylorModel& m, double y) {
        const Bounds b = m.at(x);
        EXPECT_LE(b.lo - 1e-13, y);  // rounding of the values in doubles
        EXPECT_GE(b.hi + 1e-13, y);
        EXPECT_LE(b.hi - b.lo, 1e-10);
      };
      near(e.value, f.value(0));
      for (std::size_t k = 0; k < 3; ++k) near(e.gradient[k], f.gradient(0)[static_cast<Eigen::Index>(k)]);
      for (std::size_t k = 0; k < 6; ++k) near(e.hessian[k], f.hessian(0)[k]);
    }
  });
}

}  // namespace
}  // namespace blendwright
