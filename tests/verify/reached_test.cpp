#include <gtest/gtest.h>

#include <limits>

#include "verify/continuity/seam.hpp"

namespace blendwright {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SeamReport sound_report() {
  SeamReport r;
  r.samples = 10;
  r.transverse.worst = 1.0;
  r.fold.worst = -1.0;
  return r;
}

TEST(Reached, NeedsSamplesAndNumbers) {
  EXPECT_EQ(reached(sound_report(), Tolerance{}), Continuity::G2);
  SeamReport r = sound_report();
  r.samples = 0;
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::none);
  const auto with_nan = [](Deviation SeamReport::*member) {
    SeamReport broken = sound_report();
    (broken.*member).worst = nan;
    return reached(broken, Tolerance{});
  };
  EXPECT_EQ(with_nan(&SeamReport::gap), Continuity::none);
  EXPECT_EQ(with_nan(&SeamReport::surface_gap), Continuity::none);
  EXPECT_EQ(with_nan(&SeamReport::angle), Continuity::G0);
  EXPECT_EQ(with_nan(&SeamReport::transverse), Continuity::G0);
  EXPECT_EQ(with_nan(&SeamReport::fold), Continuity::G0);
  EXPECT_EQ(with_nan(&SeamReport::curvature), Continuity::G1);
}

TEST(Reached, DropsOneGradeWithEachDefect) {
  SeamReport r = sound_report();
  r.curvature.worst = 1.0;
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::G1);
  r.angle.worst = 0.1;
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::G0);
  r.gap.worst = 0.1;
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::none);
}

}  // namespace
}  // namespace blendwright
