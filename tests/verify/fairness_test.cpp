#include "verify/surface/fairness.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "kernel/base/error.hpp"
#include "kernel/base/parallel_for.hpp"
#include "tests/verify/shapes.hpp"
#include "verify/surface/deviation.hpp"

namespace blendwright {
namespace {

using namespace test;

const SurfaceDomain square{{0.0, 1.0}, {0.0, 1.0}, false, false};

/// A zone of a sphere about the origin; u is the latitude, v the longitude.
Surface zone(double radius, double from, double to) {
  return revolution(
      {{from, to}, {0.0, 2.0 * pi}, false, true}, [radius](const auto& u) { return radius * cos(u); },
      [radius](const auto& u) { return radius * sin(u); });
}

/// Simpson's rule, independent of the quadrature under test.
template <class F>
double simpson(F f, double lo, double hi, int n = 20000) {
  double sum = f(lo) + f(hi);
  for (int i = 1; i < n; ++i) sum += (i % 2 ? 4.0 : 2.0) * f(lo + (hi - lo) * i / n);
  return sum * (hi - lo) / (3.0 * n);
}

TEST(Fairness, SphereHasItsClosedForms) {
  const double R = 3.0, height = R * (std::sin(1.0) - std::sin(-0.5));
  const FairnessReport r = fairness(zone(R, -0.5, 1.0), {.pull = Vec3::UnitZ()});
  // Gauss points integrate these entire functions to rounding; 1e-12 leaves room for 25,000 terms.
  EXPECT_NEAR(r.area, 2.0 * pi * R * height, 1e-12 * r.area);
  EXPECT_NEAR(r.bending, 2.0 / (R * R) * r.area, 1e-12 * r.bending);
  // Differences of a constant: rounding of two curvatures over a step of 1e-3 cells, squared.
  EXPECT_LE(r.variation, 1e-18);
  EXPECT_EQ(r.turns.most, 0);
  EXPECT_EQ(r.turns.average, 0.0);
  EXPECT_NEAR(r.minimum_radius.value, R, 1e-13 * R);
  EXPECT_NEAR(r.largest.value - r.smallest.value, 0.0, 1e-13);
  EXPECT_NEAR(std::abs(r.largest.value), 1.0 / R, 1e-14);
  ASSERT_TRUE(r.draft);
  // The normal Su x Sv points inward, so latitudes change sign. 20 halvings of half a cell end 1e-8 from a
  // border extreme at the latest.
  EXPECT_NEAR((*r.draft)[0].value, -1.0, 1e-7);
  EXPECT_NEAR((*r.draft)[1].value, 0.5, 1e-7);
  EXPECT_NEAR((*r.draft)[0].at.u, 1.0, 1e-7);
  EXPECT_EQ(r.unmeasured, 0u);
}

TEST(Fairness, EnergiesOfAParabolicRampAreItsIntegrals) {
  const double a = 0.7;
  const Surface s = ramp([a](const auto& u) { return a * u * u; });  // u in [0, 1], v in [-1, 1]
  const FairnessReport r = fairness(s);
  const auto speed = [&](double u) { return std::sqrt(1.0 + 4.0 * a * a * u * u); };
  const auto k = [&](double u) { return 2.0 * a / std::pow(speed(u), 3); };
  const auto dk = [&](double u) { return -24.0 * a * a * a * u / std::pow(speed(u), 5); };  // dk/du
  EXPECT_NEAR(r.area, 2.0 * simpson(speed, 0, 1), 1e-11);
  EXPECT_NEAR(r.bending, 2.0 * simpson([&](double u) { return k(u) * k(u) * speed(u); }, 0, 1), 1e-10);
  EXPECT_NEAR(r.variation, 2.0 * simpson([&](double u) { return dk(u) * dk(u) / speed(u); }, 0, 1),
              1e-6 * r.variation);  // central differences over a cell's thousandth: h^2 k'''/6
  // Over the unit square v runs over 2: |Suu| = 2a, |Svv| = |Suv| = 0.
  EXPECT_NEAR(r.thin_plate, 4.0 * a * a, 1e-13);
  EXPECT_NEAR(r.minimum_radius.value, 1.0 / (2.0 * a), 1e-9);
  EXPECT_NEAR(r.minimum_radius.at.u, 0.0, 1e-4);
  EXPECT_EQ(r.turns.most, 0);
}

TEST(Fairness, CountsTheTurnsOfCurvature) {
  // Crests and troughs of a low sine at u = 1/6, 1/2, 5/6.
  const Surface wave = ramp([](const auto& u) { return 0.01 * sin(3.0 * pi * u); });
  const FairnessReport r = fairness(wave);
  EXPECT_EQ(r.turns.most, 3);
  EXPECT_EQ(r.turns.average, 3.0);
  // A plane has none, whatever rounding does to its curvature.
  const FairnessReport flat = fairness(plane_patch());
  EXPECT_EQ(flat.turns.most, 0);
  EXPECT_EQ(flat.bending, 0.0);
  EXPECT_TRUE(std::isinf(flat.minimum_radius.value));
}

TEST(Fairness, StaysTheSameWhenTheSurfaceMoves) {
  const FairnessReport r = fairness(flare(0.5));
  for_all(
      [&](Rng& rng) {
        const FairnessReport m = fairness(placed(flare(0.5), random_motion(rng)));
        EXPECT_NEAR(m.area, r.area, 1e-12 * r.area);
        EXPECT_NEAR(m.bending, r.bending, 1e-11 * r.bending);
        EXPECT_NEAR(m.thin_plate, r.thin_plate, 1e-11 * r.thin_plate);
        EXPECT_NEAR(m.variation, r.variation, 1e-8 * std::max(r.variation, 1.0));
        EXPECT_EQ(m.turns.most, r.turns.most);
        EXPECT_NEAR(m.minimum_radius.value, r.minimum_radius.value, 1e-10);
      },
      5);
}

TEST(Fairness, IsTheSameForAnyNumberOfThreads) {
  const FairnessReport many = fairness(flare(0.3));
  const ThreadLimit serial(1);
  const FairnessReport one = fairness(flare(0.3));
  EXPECT_EQ(one.bending, many.bending);
  EXPECT_EQ(one.variation, many.variation);
  EXPECT_EQ(one.largest.value, many.largest.value);
  EXPECT_EQ(one.turns.v, many.turns.v);
}

TEST(Fairness, TellsWhatCouldNotBeMeasured) {
  // A surface that does not depend on u has no normal anywhere.
  const Surface thread = surface(square, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{T(0.0) * u, v, T(0.0)};
  });
  const FairnessReport r = fairness(thread);
  EXPECT_EQ(r.unmeasured, std::size_t{16 * 4 * 96 * 4});
  EXPECT_EQ(r.area, 0.0);
  EXPECT_TRUE(std::isnan(r.minimum_radius.value));
  EXPECT_THROW((void)fairness(thread, {.pull = Vec3(0, 0, 2)}), InputError);
}

TEST(Deviation, OfConcentricSpheresIsTheDifferenceOfRadii) {
  const SurfaceDeviation d = deviation(zone(3.0, -0.5, 1.0), zone(2.8, -0.6, 1.1));
  EXPECT_NEAR(d.worst.value, 0.2, 1e-12);
  EXPECT_NEAR(d.rms, 0.2, 1e-12);
  const SurfaceDeviation none = deviation(zone(3.0, -0.5, 1.0), zone(3.0, -0.6, 1.1));
  EXPECT_LE(none.worst.value, 1e-12);
}

TEST(Deviation, FindsALoneBump) {
  const Surface flat = ramp([](const auto& u) { return 0.0 * u; });
  const Surface bumped = ramp([](const auto& u) { return 0.01 * exp(-400.0 * (u - 0.37) * (u - 0.37)); });
  const SurfaceDeviation d = deviation(bumped, flat);
  EXPECT_NEAR(d.worst.value, 0.01, 1e-9);
  EXPECT_NEAR(d.worst.at.u, 0.37, 1e-4);
  EXPECT_NEAR(d.other.u, 0.37, 1e-4);
  // A part is near the whole, the whole is not near the part: ask both ways.
  const Surface longer = surface({{0.0, 2.0}, {-1.0, 1.0}, false, false}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u, v, T(0.0)};
  });
  EXPECT_LE(deviation(flat, longer).worst.value, 1e-12);
  EXPECT_NEAR(deviation(longer, flat).worst.value, 1.0, 1e-12);
}

}  // namespace
}  // namespace blendwright
