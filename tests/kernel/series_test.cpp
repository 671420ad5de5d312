#include "kernel/geometry/series.hpp"

#include <gtest/gtest.h>

#include "kernel/primitives/quadrics.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

Series random_series(Rng& rng) {
  Series s;
  for (double& c : s.c) c = uniform(rng, -1.0, 1.0);
  return s;
}

TEST(Along, IsTheSurfaceEvaluatedOnTheSeriesOfTheCurve) {
  const TorusShape torus{{}, 3.0, 1.0};
  for_all([&](Rng& rng) {
    const Series2 uv{random_series(rng), random_series(rng)};
    const SurfacePartials P = Torus(torus).partials({uv[0].value(), uv[1].value()});
    const Series3 composed = along(P, 0, 0, uv), direct = torus(uv[0], uv[1]);
    // Sums of some 20 terms below 4 each.
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t k = 0; k < 4; ++k)
        ASSERT_NEAR(composed[d].c[k], direct[d].c[k], 2e-14 * 10) << d << ", " << k;
  });
}

/// S = exp(a u + b v) (1, 2, 3): its partials are a^i b^j S.
struct Exponential : ShapeDomain {
  double a = 0.8, b = -1.1;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const T s = exp(a * u + b * v);
    return {s, 2.0 * s, 3.0 * s};
  }
};

TEST(Along, IsExactToTheOrderThatThePartialsDetermineAndZeroAbove) {
  const Exponential shape;
  for_all(
      [&](Rng& rng) {
        const Series2 uv{random_series(rng), random_series(rng)};
        const SurfacePartials P = FormulaSurface<Exponential>(shape).partials({uv[0].value(), uv[1].value()});
        for (int i = 0; i <= 4; ++i)
          for (int j = 0; i + j <= 4; ++j) {
            const Series3 F = along(P, i, j, uv), S = shape(uv[0], uv[1]);
            const int order = std::min(3, 4 - i - j);
            const double factor = std::pow(shape.a, i) * std::pow(shape.b, j);
            for (std::size_t d = 0; d < 3; ++d)
              for (int k = 0; k <= 3; ++k) {
                const double c = F[d].c[static_cast<std::size_t>(k)];
                if (k > order)
                  ASSERT_EQ(c, 0.0);
                else
                  ASSERT_NEAR(c, factor * S[d].c[static_cast<std::size_t>(k)], 1e-12)
                      << i << j << k;  // values below 1e3
              }
          }
      },
      50);
}

TEST(Series, AJetGoesToSeriesAndBack) {
  CurveJet<3> jet;
  for (std::size_t k = 0; k < 4; ++k) jet.D[k] = Vec3(1.0, 2.0, -3.0) * (1.0 + static_cast<double>(k));
  const CurveJet<3> back = to_jet(to_series(jet));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LE((back.D[k] - jet.D[k]).norm(), 1e-15);
  EXPECT_EQ(to_series(jet)[2].c[3], -12.0 / 6.0);  // c[k] = D[k] / k!
}

TEST(Series, NormalizedVectorsHaveConstantLengthOne) {
  for_all([](Rng& rng) {
    const Series3 a{random_series(rng) + 3.0, random_series(rng), random_series(rng)};
    const Series3 n = normalized(a);
    const Series length = norm(n);
    EXPECT_NEAR(length.c[0], 1.0, 1e-15);
    for (std::size_t k = 1; k < 4; ++k) ASSERT_NEAR(length.c[k], 0.0, 1e-14);
    const Series3 c = cross(a, n);  // parallel
    for (std::size_t d = 0; d < 3; ++d)
      for (const double x : c[d].c) ASSERT_NEAR(x, 0.0, 1e-14);
  });
}

}  // namespace
}  // namespace blendwright
