// Enclosures of a blend along its ends contain its jets there, whatever its mode, frame and equations.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/parametric/random_blend.hpp"

namespace blendwright::test {
namespace {

struct Row {
  const ModelVector& model;
  const Vec3& value;
  const char* name;
};

/// Largest distance of a value from its bounds at x, relative to the largest coordinate of the row.
double outside(const Row& row, double x) {
  double most = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    const Bounds b = row.model[d].at(x);
    const double y = row.value[static_cast<Eigen::Index>(d)];
    most = std::max({most, b.lo - y, y - b.hi});
  }
  return most / std::max(1.0, row.value.cwiseAbs().maxCoeff());
}

/// Jets round: phi'' to 5e-14 kappa of the largest (cardinal_ends_test.cpp), of data that cancel by a factor
/// below 10 here; kappa is at most 100.
constexpr double jet_rounding = 1e-10;

TEST(BlendEnclosure, ContainsTheJetsAtBothEnds) {
  for_all([](Rng& rng) {
    const Continuity c0 = static_cast<Continuity>(integer(rng, 1, 2)),
                     c1 = static_cast<Continuity>(integer(rng, 1, 2));
    const RandomShape shape = random_shape(rng, 30.0);
    const OdeBlend blend(random_end(rng, 0.0, c0), random_end(rng, 1.5, c1), shape.shape);
    const double lo = uniform(rng, 0.0, 6.0), width = 0.05;
    for (const double u : {0.0, 1.0}) {
      SurfaceEnclosure e;
      blend.enclose(TaylorModel(u), TaylorModel::parameter(lo, lo + width), e);
      ASSERT_EQ(e.unproven, "");
      for (int i = 0; i < 10; ++i) {
        const double x = uniform(rng, -1.0, 1.0);
        const SurfaceJet j = blend.jet({u, lo + 0.5 * width * (1.0 + x)});
        for (const Row& row : {Row{e.S, j.S, "S"}, Row{e.Su, j.Su, "Su"}, Row{e.Sv, j.Sv, "Sv"},
                               Row{e.Suu, j.Suu, "Suu"}, Row{e.Suv, j.Suv, "Suv"}, Row{e.Svv, j.Svv, "Svv"}})
          EXPECT_LE(outside(row, x), jet_rounding) << row.name << " u " << u << " order " << blend.order();
        // The control: the bounds are narrow enough to notice a second derivative that is wrong.
        const Vec3 wrong = (1.0 + 1e-4) * j.Suu;
        EXPECT_GT(outside({e.Suu, wrong, "Suu"}, x), jet_rounding);
      }
    }
  });
}

TEST(BlendEnclosure, OfSecondDerivativesNoticesPartsInABillion) {
  // At a single v the bounds contain roundings only.
  for_all([](Rng& rng) {
    RandomShape shape = random_shape(rng, 10.0);
    shape.shape.frame = BlendFrame::global;
    const OdeBlend blend(random_end(rng, 0.0, Continuity::G1), random_end(rng, 1.5, Continuity::G1),
                         shape.shape);
    const double v = uniform(rng, 0.0, 6.0);
    for (const double u : {0.0, 1.0}) {
      SurfaceEnclosure e;
      blend.enclose(TaylorModel(u), TaylorModel(v), e);
      const Vec3 right = blend.jet({u, v}).Suu, wrong = (1.0 + 1e-9) * right;
      const double slack = 1e-12 * std::max(1.0, shape.kappa);
      EXPECT_LE(outside({e.Suu, right, "Suu"}, 0.0), slack);
      if (shape.kappa < 10.0) {
        EXPECT_GT(outside({e.Suu, wrong, "Suu"}, 0.0), slack);
      }
    }
  });
}

TEST(BlendEnclosure, IsOfTheEndsOnly) {
  Rng rng(1);
  const OdeBlend blend(random_end(rng, 0.0, Continuity::G1), random_end(rng, 1.5, Continuity::G1), {});
  SurfaceEnclosure e;
  blend.enclose(TaylorModel(0.5), TaylorModel(0.0), e);
  EXPECT_NE(e.unproven, "");
}

}  // namespace
}  // namespace blendwright::test
