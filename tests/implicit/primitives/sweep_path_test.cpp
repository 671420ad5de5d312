// Trajectories of formulas: their pieces, frames and nearest points.
#include "implicit/primitives/sweep_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/base/error.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;
using detail::Foot;
using detail::Path;
using detail::PathFrame;
using detail::PathPiece;
constexpr double pi = std::numbers::pi;
using Texts = std::vector<std::string>;

const Texts helix{"3*cos(t)", "3*sin(t)", "0.8*t"};
const Texts knot{"sin(t)+2*sin(2*t)", "cos(t)-2*cos(2*t)", "-sin(3*t)"};
const Texts bent{"t", "t^3-t", "exp(t/2)"};

struct Case {
  const Texts* formulas;
  double t0, t1;
  Vec3 (*exact)(double);
};
std::vector<Case> cases() {
  return {{&helix, -2.0, 7.0, [](double t) { return Vec3(3 * std::cos(t), 3 * std::sin(t), 0.8 * t); }},
          {&knot, 0.0, 2.0 * pi,
           [](double t) {
             return Vec3(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t),
                         -std::sin(3 * t));
           }},
          {&bent, -1.5, 1.5, [](double t) { return Vec3(t, t * t * t - t, std::exp(t / 2)); }}};
}
Path path_of(const Case& c) { return {*c.formulas, c.t0, c.t1, std::nullopt}; }

TEST(Path, FollowsItsFormulas) {
  for (const Case& c : cases()) {
    const Path path = path_of(c);
    const double size = path.bounds().size().norm();
    for (const PathPiece& p : path.pieces())
      for (double x = -1.0; x <= 1.0; x += 0.125)
        // 1e-14 of the size is checked at three places of each piece; the error x (1 - x^2)^4 ... of degree 7
        // is nowhere more than twice what it is there.
        EXPECT_LE((p.jet(x)[0] - c.exact(p.t_middle + p.half * x)).norm(), 4e-14 * size);
  }
}

TEST(Path, JetsOfPiecesAreDerivatives) {
  const Path path = path_of(cases()[1]);
  const PathPiece& p = path.pieces()[3];
  constexpr double h = 1e-4, x = 0.3;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 difference = (p.jet(x + h)[k] - p.jet(x - h)[k]) / (2.0 * h);
    // h^2/6 of a derivative below 1, and eps 5/h.
    EXPECT_LE((p.jet(x)[k + 1] - difference).norm(), 2e-9 + 2e-11);
  }
}

TEST(Path, FramesAreOrthonormalAndMeetFromPieceToPiece) {
  for (const Case& c : cases()) {
    const Path path = path_of(c);
    for (std::size_t i = 0; i < path.pieces().size(); ++i) {
      const PathPiece& p = path.pieces()[i];
      for (const double x : {-1.0, -0.2, 0.7, 1.0}) {
        const PathFrame f = p.frame(x);
        EXPECT_NEAR(f.U[0].norm(), 1.0, 1e-14);
        EXPECT_NEAR(f.U[0].dot(f.W), 0.0, 1e-14);
        EXPECT_LE((f.V[0] - f.W.cross(f.U[0])).norm(), 1e-14);
        EXPECT_LE((f.W - p.jet(x)[1].normalized()).norm(), 1e-14);
      }
      if (i > 0) {
        EXPECT_LE((p.frame(-1.0).U[0] - path.pieces()[i - 1].frame(1.0).U[0]).norm(), 1e-12);
      }
    }
  }
}

// On a helix the angle from the principal normal to a frame that does not rotate falls by the torsion per
// length: tau = c/(a^2 + c^2), |C'| = sqrt(a^2 + c^2).
TEST(Path, FramesDoNotRotateAboutAHelix) {
  const double a = 3.0, c = 0.8, l2 = a * a + c * c, l = std::sqrt(l2);
  const Path path(helix, 0.0, 40.0, Vec3(-1, 0, 0));  // starts along the principal normal
  double worst = 0.0;
  for (const PathPiece& p : path.pieces())
    for (const double x : {-1.0, 0.0, 0.5}) {
      const double t = p.t_middle + p.half * x, angle = -c / l2 * l * t;
      const Vec3 N(-std::cos(t), -std::sin(t), 0.0), W(-a * std::sin(t) / l, a * std::cos(t) / l, c / l);
      const Vec3 U = std::cos(angle) * N + std::sin(angle) * W.cross(N);
      worst = std::max(worst, (p.frame(x).U[0] - U).norm());
    }
  EXPECT_LE(worst, 1e-11);  // 1e-13 for each of the 400 pieces at most, and far less by what is left of them
}

TEST(Path, FrameJetsAreDerivativesThatDoNotRotate) {
  for (const Case& c : cases()) {
    const Path path = path_of(c);
    const PathPiece& p = path.pieces()[2];
    constexpr double h = 1e-4, x = -0.4;
    const PathFrame f = p.frame_jet(x), before = p.frame_jet(x - h), after = p.frame_jet(x + h);
    for (std::size_t k = 0; k < 2; ++k) {
      // h^2/6 of derivatives below 1, and eps/h.
      EXPECT_LE((f.U[k + 1] - (after.U[k] - before.U[k]) / (2.0 * h)).norm(), 2e-9 + 1e-11);
      EXPECT_LE((f.V[k + 1] - (after.V[k] - before.V[k]) / (2.0 * h)).norm(), 2e-9 + 1e-11);
    }
    EXPECT_NEAR(f.U[1].dot(f.V[0]), 0.0, 2e-13);
    EXPECT_LE((f.U[0] - p.frame(x).U[0]).norm(), 1e-15);
  }
}

/// The integral of the torsion of the knot over its whole length: -integral det(C', C'', C''')/|C' x C''|^2
/// |C'|.
double total_torsion() {
  constexpr int n = 4000;  // the trapezoid rule converges faster than any power for a periodic integrand
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double t = 2.0 * pi * i / n;
    const Vec3 d1(std::cos(t) + 4 * std::cos(2 * t), -std::sin(t) + 4 * std::sin(2 * t),
                  -3 * std::cos(3 * t));
    const Vec3 d2(-std::sin(t) - 8 * std::sin(2 * t), -std::cos(t) + 8 * std::cos(2 * t),
                  9 * std::sin(3 * t));
    const Vec3 d3(-std::cos(t) - 16 * std::cos(2 * t), std::sin(t) - 16 * std::sin(2 * t),
                  27 * std::cos(3 * t));
    const Vec3 b = d1.cross(d2);
    sum += b.dot(d3) / b.squaredNorm() * d1.norm();
  }
  return sum * 2.0 * pi / n;
}

TEST(Path, ClosedPathsKnowHowFarTheirFrameTurns) {
  const Path path = path_of(cases()[1]);
  EXPECT_TRUE(path.closed());
  EXPECT_NEAR(std::remainder(path.closing_angle() + total_torsion(), 2.0 * pi), 0.0, 1e-10);
  EXPECT_GT(std::abs(path.closing_angle()), 0.1);
  const Path ring({"cos(t)", "sin(t)", "0"}, 0.0, 2.0 * pi, std::nullopt);
  EXPECT_TRUE(ring.closed());
  EXPECT_NEAR(ring.closing_angle(), 0.0, 1e-13);
}

TEST(Path, IsClosedOnlyWhenPlacesAndDirectionsAgree) {
  EXPECT_FALSE(path_of(cases()[0]).closed());
  EXPECT_FALSE(Path({"cos(t)", "sin(t)", "0"}, 0.0, 2.0 * pi - 1e-6, std::nullopt).closed());
  // A drop: ends at one point in two directions.
  EXPECT_FALSE(Path({"sin(2*t)", "sin(t)", "0"}, 0.0, pi, std::nullopt).closed());
}

Foot sampled_foot(const Path& path, const Vec3& X) {
  Foot best{0, 0.0, 1e300, 0};
  for (std::size_t i = 0; i < path.pieces().size(); ++i)
    for (int k = 0; k <= 20; ++k) {
      const double x = -1.0 + 0.1 * k, d = (path.pieces()[i].jet(x)[0] - X).norm();
      if (d < best.distance) best = {i, x, d, 0};
    }
  return best;
}

TEST(Path, NearestPointsAreNearestOfAll) {
  for (const Case& c : cases()) {
    const Path path = path_of(c);
    const Box box{path.bounds().lo - Vec3::Constant(2.0), path.bounds().hi + Vec3::Constant(2.0)};
    int ends = 0;
    for_all(
        [&](Rng& rng) {
          Vec3 X;
          for (int i = 0; i < 3; ++i) X[i] = uniform(rng, box.lo[i], box.hi[i]);
          if (integer(rng, 0, 4) == 0) {  // beside the curve
            const PathPiece& p = path.pieces()[rng.next() % path.pieces().size()];
            X = p.jet(uniform(rng, -1, 1))[0] + 1e-3 * X;
          }
          const Foot foot = path.nearest(X);
          const auto j = path.pieces()[foot.piece].jet(foot.x);
          const Vec3 w = X - j[0];
          EXPECT_NEAR(foot.distance, w.norm(), 1e-14 * (1.0 + w.norm()));
          EXPECT_LE(foot.distance, sampled_foot(path, X).distance * (1.0 + 1e-13));
          // At the foot w is across the curve; rounding of w is 1e-15 of the coordinates, below 20.
          if (foot.end == 0) {
            EXPECT_NEAR(w.dot(j[1].normalized()), 0.0, 2e-14 * 20.0);
          }
          if (foot.end != 0) {
            ++ends;
            EXPECT_FALSE(path.closed());
            EXPECT_GT(foot.end * w.dot(j[1]), 0.0);
            EXPECT_NEAR(path.t(foot), foot.end < 0 ? path.t0() : path.t1(), 1e-15);
          }
        },
        1000);
    EXPECT_EQ(ends > 20, !path.closed());
  }
}

// Where pieces meet the distance is flat: rounding alone would leave feet 1e-8 off.
TEST(Path, NearestPointsAreExactWherePiecesMeet) {
  for (const Case& c : cases()) {
    const Path path = path_of(c);
    for (const PathPiece& p : path.pieces())
      for (const double off : {0.0, 1e-12, -1e-10, 1e-9, -1e-8, 3e-8}) {
        const double x = (off < 0.0 ? -1.0 : 1.0) + off;
        const auto j = p.jet(x);
        const PathFrame f = p.frame(x);
        const Vec3 X = j[0] + 0.05 * f.U[0] + 0.02 * f.V[0];
        const Foot foot = path.nearest(X);
        if (foot.end != 0) continue;
        const auto at = path.pieces()[foot.piece].jet(foot.x);
        // Rounding of points with coordinates below 10, once for X and once for the foot.
        EXPECT_NEAR((X - at[0]).dot(at[1].normalized()), 0.0, 2.0 * 10.0 * 2.2e-16);
      }
  }
}

TEST(Path, NearestPointsOfACentreAreOnTheCircle) {
  const Path ring({"2*cos(t)", "2*sin(t)", "0"}, 0.0, 2.0 * pi, std::nullopt);
  for (const Vec3& X : {Vec3(0, 0, 0), Vec3(1e-9, 0, 0), Vec3(1e-3, 1e-3, 0), Vec3(0, 0, 5)}) {
    const double r = std::hypot(X.x(), X.y());
    EXPECT_NEAR(ring.nearest(X).distance, std::hypot(r - 2.0, X.z()), 2e-13);
  }
}

// The law that ranges rely on: over a ball where stretch() answers, feet move at most as fast as it says.
TEST(Path, StretchesBoundHowFarFeetMove) {
  int answered = 0, all = 0;
  for (const Case& c : cases()) {
    const Path path = path_of(c);
    for_all(
        [&](Rng& rng) {
          Vec3 X;
          for (int i = 0; i < 3; ++i)
            X[i] = uniform(rng, path.bounds().lo[i] - 1.0, path.bounds().hi[i] + 1.0);
          const double radius = log_uniform(rng, 1e-4, 1.0);
          const Foot foot = path.nearest(X);
          const auto stretch = path.stretch(X, radius, foot, true);
          ++all;
          if (!stretch) return;
          ++answered;
          for (int k = 0; k < 20; ++k) {
            const Vec3 direction =
                Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)).normalized();
            const double step = radius * uniform(rng, 0, 1);
            double moved = path.t(path.nearest(X + step * direction)) - path.t(foot);
            if (path.closed()) moved = std::remainder(moved, path.t1() - path.t0());
            EXPECT_LE(std::abs(moved), stretch->rate * step + 1e-12);
          }
        },
        400);
  }
  EXPECT_GT(answered, all / 3);
  EXPECT_LT(answered, all);
}

// The parabola y = x^2 has its centre of curvature (0, 1/2): points beyond have two feet.
TEST(Path, StretchesReachToTheCentreOfCurvatureAtMost) {
  const Path parabola({"t", "t^2", "0"}, -2.0, 2.0, std::nullopt);
  const Vec3 X(0.0, 0.2, 0.0);
  const Foot foot = parabola.nearest(X);
  EXPECT_TRUE(parabola.stretch(X, 0.2, foot, false).has_value());
  EXPECT_FALSE(parabola.stretch(X, 0.31, foot, false).has_value());
}

TEST(Path, NeedsFewPieces) {
  // Degree 7 reaches 1e-14 with some 10 pieces per radian.
  EXPECT_LE(Path(helix, 0.0, 40.0, std::nullopt).pieces().size(), 512u);
  EXPECT_LE(Path({"2*t", "t", "1"}, 0.0, 40.0, std::nullopt).pieces().size(), 8u);
}

Problem refusal(const Texts& formulas, double t0, double t1, std::optional<Vec3> u = std::nullopt) {
  try {
    const Path path(formulas, t0, t1, u);
    return {};
  } catch (const InputError& e) {
    return e.problems().front();
  }
}

TEST(Path, RefusesWhatIsNoRegularCurve) {
  const auto says = [](const Problem& p, const char* where, const char* what) {
    return p.where == where && p.message.find(what) != std::string::npos &&
           p.message.find("must be") != std::string::npos;
  };
  EXPECT_EQ(refusal({"t", "t^2", "abs(t)^3"}, -1, 1), Problem{});  // C2 is enough
  EXPECT_TRUE(says(refusal({"t^2", "t^3", "0"}, -1, 1), "curve", "C' = 0"));
  EXPECT_TRUE(says(refusal({"t^2", "t^2", "0"}, 0, 1), "curve", "C' = 0"));
  EXPECT_TRUE(says(refusal({"t", "abs(t-0.3)", "0"}, -1, 1), "curve", "corner"));
  EXPECT_TRUE(says(refusal({"t", "abs(t-0.3)*(t-0.3)", "0"}, -1, 1), "curve", "jump of curvature"));
  EXPECT_TRUE(says(refusal({"t", "1/t", "0"}, -1, 1), "curve", "not finite"));
  EXPECT_TRUE(says(refusal({"1", "2", "3"}, 0, 1), "curve", "one point"));
  const Problem syntax = refusal({"t", "t+", "0"}, 0, 1);
  EXPECT_EQ(syntax.where, "curve/1");
  EXPECT_FALSE(syntax.message.empty());
  EXPECT_EQ(refusal({"t", "s", "0"}, 0, 1).where, "curve/1");
  EXPECT_EQ(refusal({"t", "0", "0"}, 1, 1).where, "t");
  EXPECT_EQ(refusal({"t", "0", "0"}, 1, 0).message, "goes from 1 to 0, must go up");
  EXPECT_EQ(refusal({"t", "0", "0"}, 0, 1, Vec3(2, 0, 0)).where, "u");
  EXPECT_EQ(refusal({"t", "0", "0"}, 0, 1, Vec3(2, 1, 0)), Problem{});
}

}  // namespace
}  // namespace blendwright
