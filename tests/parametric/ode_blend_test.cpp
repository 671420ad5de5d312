#include "parametric/ode/ode_blend.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/parametric/random_blend.hpp"

namespace blendwright::test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

double largest_difference(const SurfaceJet& a, const SurfaceJet& b) {
  return std::max({(a.S - b.S).norm(), (a.Su - b.Su).norm(), (a.Sv - b.Sv).norm(), (a.Suu - b.Suu).norm(),
                   (a.Suv - b.Suv).norm(), (a.Svv - b.Svv).norm()});
}
double size_of(const SurfaceJet& a) {
  return std::max({1.0, a.S.norm(), a.Su.norm(), a.Sv.norm(), a.Suu.norm(), a.Suv.norm(), a.Svv.norm()});
}
BlendShape common(const SweepOde& ode, BlendMode mode) {
  BlendShape shape;
  shape.mode = mode;
  shape.ode = {ode, ode, ode};
  return shape;
}

TEST(OdeBlend, MeetsItsEndsInEveryModeFrameFamilyAndRegime) {
  for_all([](Rng& rng) {
    const OdeBlend blend = random_blend(rng, random_shape(rng, 1e4).shape);
    for (int side = 0; side < 2; ++side) {
      const double v = uniform(rng, 0.0, two_pi);
      const EndSeries e = blend.end(side).series(v);
      const SurfaceJet at = blend.jet({static_cast<double>(side), v});
      EXPECT_LE((at.S - derivative(e.C, 0)).norm(), 1e-12 * derivative(e.C, 0).norm());
      EXPECT_LE((at.Sv - derivative(e.C, 1)).norm(), 1e-12 * derivative(e.C, 1).norm());
      EXPECT_LE((at.Su - derivative(e.T, 0)).norm(), 1e-12 * derivative(e.T, 0).norm());
      EXPECT_LE((at.Suv - derivative(e.T, 1)).norm(), 1e-12 * derivative(e.T, 0).norm());
      if (blend.end(side).continuity == Continuity::G2) {
        EXPECT_LE((at.Suu - derivative(e.D, 0)).norm(), 1e-12 * (1.0 + derivative(e.D, 0).norm()));
      }
    }
  });
}

TEST(OdeBlend, MeetsItsEndsOneUnitInTheLastPlaceInside) {
  // What separates it from the end is the step times the next derivative, and the functions' own error of
  // 1e-13 kappa times the data they multiply (positions and tangents of size 5 at most, 1e-12 in all).
  for_all([](Rng& rng) {
    const auto [shape, kappa] = random_shape(rng, 1e4);
    const OdeBlend blend = random_blend(rng, shape);
    for (int side = 0; side < 2; ++side) {
      const double v = uniform(rng, 0.0, two_pi), step = 0x1p-53, u = side == 0 ? step : 1.0 - step;
      const EndSeries e = blend.end(side).series(v);
      const SurfacePartials end = blend.partials({static_cast<double>(side), v});
      const SurfaceJet at = blend.jet({u, v});
      EXPECT_LE((at.S - derivative(e.C, 0)).norm(), 1e-12 * kappa + 2 * step * end(1, 0).norm());
      const double stiffness =
          std::max({1.0, blend.basis(0).stiffness(), blend.basis(1).stiffness(), blend.basis(2).stiffness()});
      EXPECT_LE((at.Su - derivative(e.T, 0)).norm(), 1e-12 * kappa * stiffness + 2 * step * end(2, 0).norm());
    }
  });
}

TEST(OdeBlend, JetAgreesWithDifferences) {
  // Central differences of step h over waves and layers of stiffness at most 20: truncation h^2/6 r^3 |S| per
  // order of u, rounding eps kappa |S| / h; h = 1e-5 leaves 1e-6 r^3 |S| and less.
  for_all([](Rng& rng) {
    const auto [shape, kappa] = random_shape(rng, 20.0);
    const OdeBlend blend = random_blend(rng, shape);
    const double h = 1e-5;
    const UV p{uniform(rng, 0.05, 0.95), uniform(rng, 0.1, 6.0)};
    const SurfaceJet at = blend.jet(p);
    const SurfaceJet u0 = blend.jet({p.u - h, p.v}), u1 = blend.jet({p.u + h, p.v});
    const SurfaceJet v0 = blend.jet({p.u, p.v - h}), v1 = blend.jet({p.u, p.v + h});
    double stiffness = 1.0;
    for (int x = 0; x < 3; ++x) stiffness = std::max(stiffness, blend.basis(x).stiffness());
    const double allowed = (h * h * std::pow(stiffness, 3) + 1e-14 * kappa / h) * 10.0 * kappa * size_of(at);
    EXPECT_LE(((u1.S - u0.S) / (2 * h) - at.Su).norm(), allowed);
    EXPECT_LE(((u1.Su - u0.Su) / (2 * h) - at.Suu).norm(), allowed * stiffness);
    EXPECT_LE(((v1.S - v0.S) / (2 * h) - at.Sv).norm(), allowed);
    EXPECT_LE(((v1.Su - v0.Su) / (2 * h) - at.Suv).norm(), allowed * stiffness);
    EXPECT_LE(((v1.Sv - v0.Sv) / (2 * h) - at.Svv).norm(), allowed);
  });
}

TEST(OdeBlend, PartialsExtendTheJet) {
  for_all([](Rng& rng) {
    const auto [shape, kappa] = random_shape(rng, 20.0);
    const OdeBlend blend = random_blend(rng, shape);
    const UV p{uniform(rng, 0.05, 0.95), uniform(rng, 0.1, 6.0)};
    const SurfacePartials P = blend.partials(p);
    EXPECT_EQ(largest_difference(blend.jet(p), {P(0, 0), P(1, 0), P(0, 1), P(2, 0), P(1, 1), P(0, 2)}), 0.0);
    const double h = 1e-5;
    const SurfaceJet u0 = blend.jet({p.u - h, p.v}), u1 = blend.jet({p.u + h, p.v});
    double stiffness = 1.0;
    for (int x = 0; x < 3; ++x) stiffness = std::max(stiffness, blend.basis(x).stiffness());
    const double allowed = (h * h * std::pow(stiffness, 3) + 1e-14 * kappa / h) * 10.0 * kappa *
                           size_of(blend.jet(p)) * stiffness;
    EXPECT_LE(((u1.Suu - u0.Suu) / (2 * h) - P(3, 0)).norm(), allowed * stiffness);
    EXPECT_LE(((u1.Svv - u0.Svv) / (2 * h) - P(1, 2)).norm(), allowed);
    EXPECT_LE(((u1.Suv - u0.Suv) / (2 * h) - P(2, 1)).norm(), allowed);
    EXPECT_EQ(P(4, 0), Vec3::Zero());
    EXPECT_EQ(P(0, 3), Vec3::Zero());
  });
}

TEST(OdeBlend, SectionIsWhatEquationOneSays) {
  for_all([](Rng& rng) {
    const auto [shape, kappa] = random_shape(rng, 1e3);
    const OdeBlend blend = random_blend(rng, shape);
    const UV p{uniform(rng, 0.0, 1.0), uniform(rng, 0.0, two_pi)};
    const BlendSection s = blend.section(p.v);
    const auto phi = blend.cardinals(p.u);
    Vec3 local = Vec3::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(blend.order()); ++k)
      for (std::size_t x = 0; x < 3; ++x)
        local[static_cast<Eigen::Index>(x)] += phi[x].value[0][k] * s.B[k][static_cast<Eigen::Index>(x)];
    const Vec3 S = (1.0 - p.u) * s.line0 + p.u * s.line1 + s.axes * local;
    EXPECT_LE((S - blend.jet(p).S).norm(), 1e-14 * kappa * 10.0);  // the same sum in another order
    EXPECT_EQ(blend.rows(p.v)[1], s.B[1]);
  });
}

/// Both blends at some points; `motion` is x -> scale R x + shift applied to the first.
double motion_defect(const OdeBlend& a, const OdeBlend& b, const Eigen::Matrix3d& R, double scale,
                     const Vec3& shift) {
  double worst = 0.0;
  for (const double u : {0.1, 0.5, 0.8})
    for (const double v : {0.3, 2.0, 5.0})
      worst = std::max(worst, (scale * (R * a.jet({u, v}).S) + shift - b.jet({u, v}).S).norm());
  return worst / scale;
}

struct Moved {
  OdeBlend original, moved;
};
Moved moved_blend(Rng& rng, const BlendShape& shape, const Eigen::Matrix3d& R, double scale,
                  const Vec3& shift) {
  const EndCondition e0 = random_end(rng, 0.0, random_continuity(rng)),
                     e1 = random_end(rng, 2.0, random_continuity(rng));
  return {{e0, e1, shape}, {moved(e0, R, scale, shift), moved(e1, R, scale, shift), shape}};
}

// Sizes are at most 10 and shifts at most 10 * scale: 1e-12 is some hundred roundings times kappa <= 100.
constexpr double motion_tolerance = 1e-12;

TEST(OdeBlend, ChordModeFollowsRigidMotionAndScale) {
  for_all([](Rng& rng) {
    BlendShape shape = random_shape(rng, 100.0).shape;
    shape.mode = BlendMode::chord;
    shape.frame = BlendFrame::global;
    shape.ode[1] = shape.ode[2] = shape.ode[0];
    const Eigen::Matrix3d R = random_rotation(rng);
    const double scale = log_uniform(rng, 0.1, 10.0);
    const Vec3 shift = random_vector(rng, 10.0 * scale);
    const Moved m = moved_blend(rng, shape, R, scale, shift);
    EXPECT_LE(motion_defect(m.original, m.moved, R, scale, shift), 10 * motion_tolerance);
  });
}

TEST(OdeBlend, OriginModeFollowsRotationsAboutTheOriginOnly) {
  for_all(
      [](Rng& rng) {
        const Eigen::Matrix3d R = random_rotation(rng);
        const double q = uniform(rng, 0.5, 5.0);
        BlendShape shape;
        shape.mode = BlendMode::origin;
        shape.repeated_root = q;
        const auto g1_ends = [&](const Eigen::Matrix3d& rotation, const Vec3& shift) {
          Rng same(7);
          const EndCondition e0 = random_end(same, 0.0, Continuity::G1),
                             e1 = random_end(same, 2.0, Continuity::G1);
          return Moved{{e0, e1, shape},
                       {moved(e0, rotation, 1.0, shift), moved(e1, rotation, 1.0, shift), shape}};
        };
        const Moved turned = g1_ends(R, Vec3::Zero());
        EXPECT_LE(motion_defect(turned.original, turned.moved, R, 1.0, Vec3::Zero()), motion_tolerance);
        const Vec3 shift(1, 2, 3);
        const Moved shifted = g1_ends(Eigen::Matrix3d::Identity(), shift);
        // (1 - H0 - H1) |shift|: at q = 0.5 about 2e-4 times 3.7.
        EXPECT_GT(motion_defect(shifted.original, shifted.moved, Eigen::Matrix3d::Identity(), 1.0, shift),
                  1e-4);
      },
      50);
}

TEST(OdeBlend, AnchorModeIsOriginModeSeenFromTheAnchor) {
  for_all([](Rng& rng) {
    const EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G1);
    BlendShape shape = random_shape(rng, 20.0).shape;
    shape.mode = BlendMode::origin;
    const Vec3 a = random_vector(rng, 3.0);
    BlendShape anchored = shape;
    anchored.mode = BlendMode::anchor;
    anchored.anchor = a;
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    const OdeBlend at_origin(moved(e0, I, 1.0, -a), moved(e1, I, 1.0, -a), shape),
        at_anchor(e0, e1, anchored);
    EXPECT_LE(motion_defect(at_origin, at_anchor, I, 1.0, a), 10 * motion_tolerance);
  });
}

TEST(OdeBlend, DifferentParametersPerComponentDependOnTheAxes) {
  // Documented: per-component (b, c, d) in the global frame do not follow a rotation or a mirror through a
  // slanted plane; in the moving frame they do, because the frame moves with the part.
  const std::array<SweepOde, 3> ode{SweepOde{1, -3, 2.25}, SweepOde{1, -30, 225}, SweepOde{1, -200, 10000}};
  for_all(
      [&](Rng& rng) {
        const Eigen::Matrix3d R = random_rotation(rng);
        const Vec3 n = Vec3(1, 1, 0.5).normalized();
        const Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity() - 2.0 * n * n.transpose();
        const EndCondition e0 = random_end(rng, 0.0, Continuity::G1),
                           e1 = random_end(rng, 2.0, Continuity::G1);
        for (const BlendFrame frame : {BlendFrame::global, BlendFrame::moving}) {
          BlendShape shape;
          shape.ode = ode;
          shape.frame = frame;
          const OdeBlend blend(e0, e1, shape);
          const Vec3 zero = Vec3::Zero();
          const double turned =
              motion_defect(blend, {moved(e0, R, 1.0, zero), moved(e1, R, 1.0, zero), shape}, R, 1.0, zero);
          const double mirrored = motion_defect(
              blend, {moved(e0, mirror, 1.0, zero), moved(e1, mirror, 1.0, zero), shape}, mirror, 1.0, zero);
          if (frame == BlendFrame::moving) {
            EXPECT_LE(turned, motion_tolerance);
            EXPECT_LE(mirrored, motion_tolerance);
          } else {
            EXPECT_GT(turned, 1e-6);
            EXPECT_GT(mirrored, 1e-6);
          }
        }
      },
      50);
}

TEST(OdeBlend, EqualParametersMakeTheFrameIrrelevant) {
  for_all([](Rng& rng) {
    BlendShape shape = common(random_ode(rng, Regime::A, 0.1, 10.0), BlendMode::chord);
    shape.axes = random_rotation(rng);
    const EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G1);
    const UV p{uniform(rng, 0.0, 1.0), uniform(rng, 0.0, two_pi)};
    const SurfaceJet plain = OdeBlend(e0, e1, shape).jet(p);
    for (const BlendFrame f : {BlendFrame::fixed, BlendFrame::moving}) {
      shape.frame = f;
      EXPECT_LE(largest_difference(plain, OdeBlend(e0, e1, shape).jet(p)), 1e-12 * size_of(plain));
    }
  });
}

TEST(OdeBlend, ReversalSwapsTheEnds) {
  for_all([](Rng& rng) {
    const auto [shape, kappa] = random_shape(rng, 100.0);
    const EndCondition e0 = random_end(rng, 0.0, random_continuity(rng)),
                       e1 = random_end(rng, 2.0, random_continuity(rng));
    const auto reversed = [](EndCondition e) {
      e.series = [series = e.series](double v) {
        const EndSeries s = series(v);
        return EndSeries{s.C, -1.0 * s.T, s.D};
      };
      return e;
    };
    const UV p{uniform(rng, 0.0, 1.0), uniform(rng, 0.0, two_pi)};
    const OdeBlend there(e0, e1, shape), back(reversed(e1), reversed(e0), shape);
    EXPECT_LE((there.jet(p).S - back.jet({1.0 - p.u, p.v}).S).norm(), 1e-12 * kappa);
  });
}

TEST(OdeBlend, ModesCoincideForTheTensionSpline) {
  for_all([](Rng& rng) {
    const EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G1);
    const UV p{uniform(rng, 0.0, 1.0), uniform(rng, 0.0, two_pi)};
    const double tau = log_uniform(rng, 1e-8, 1e3);
    BlendShape origin = common(SweepOde::tension(tau), BlendMode::origin), chord = origin, anchor = origin;
    chord.mode = BlendMode::chord;
    anchor.mode = BlendMode::anchor;
    anchor.anchor = Vec3(5, -3, 2);
    const Vec3 S = OdeBlend(e0, e1, origin).jet(p).S;
    EXPECT_LE((S - OdeBlend(e0, e1, chord).jet(p).S).norm(), 1e-12);
    EXPECT_LE((S - OdeBlend(e0, e1, anchor).jet(p).S).norm(), 1e-12);
  });
}

TEST(OdeBlend, ChordModeTendsToTheRuledStripAndOriginModeToTheOrigin) {
  Rng rng(3);
  const EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G1);
  BlendShape shape;
  shape.repeated_root = 1e4;
  const Vec3 C0 = derivative(e0.series(1.0).C, 0), C1 = derivative(e1.series(1.0).C, 0);
  EXPECT_LE((OdeBlend(e0, e1, shape).jet({0.3, 1.0}).S - (0.7 * C0 + 0.3 * C1)).norm(),
            1e-14);  // layers exp(-3000)
  shape.mode = BlendMode::origin;
  EXPECT_LE(OdeBlend(e0, e1, shape).jet({0.3, 1.0}).S.norm(), 1e-14);
}

TEST(OdeBlend, SmallRootsGiveTheCubicHermiteBlend) {
  for_all([](Rng& rng) {
    const EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G1);
    BlendShape shape;
    shape.mode = static_cast<BlendMode>(integer(rng, 0, 2));
    shape.repeated_root = 1e-8;
    const double u = uniform(rng, 0.0, 1.0), w = 1.0 - u, v = uniform(rng, 0.0, two_pi);
    const EndSeries a = e0.series(v), b = e1.series(v);
    const Vec3 S = (2 * u * u * u - 3 * u * u + 1) * derivative(a.C, 0) + u * w * w * derivative(a.T, 0) +
                   (3 * u * u - 2 * u * u * u) * derivative(b.C, 0) - u * u * w * derivative(b.T, 0);
    EXPECT_LE((OdeBlend(e0, e1, shape).jet({u, v}).S - S).norm(), 1e-13);  // O(q^2) = 1e-16 and rounding
  });
}

TEST(OdeBlend, IsOfOrderSixWhenASideAsksForCurvature) {
  Rng rng(5);
  const EndCondition g1 = random_end(rng, 0.0, Continuity::G1), g2 = random_end(rng, 2.0, Continuity::G2);
  BlendShape shape;
  shape.tension = 4.0;
  EXPECT_EQ(OdeBlend(g1, g1, shape).order(), 4);
  const OdeBlend blend(g1, g2, shape);
  EXPECT_EQ(blend.order(), 6);
  EXPECT_EQ(blend.basis(0).count(), 6);
}

TEST(OdeBlend, AFreeEndBendsLikeTheTensionSpline) {
  for_all(
      [](Rng& rng) {
        EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G2);
        BlendShape shape = random_shape(rng, 50.0).shape;
        const double v = uniform(rng, 0.0, two_pi);
        const OdeBlend blend(e0, e1, shape);
        e1.continuity = Continuity::G1;
        const OdeBlend lower(e0, e1, common(SweepOde::tension(shape.tension), BlendMode::origin));
        const SurfaceJet expected = lower.jet({0.0, v});
        EXPECT_LE((blend.jet({0.0, v}).Suu - expected.Suu).norm(), 1e-12 * (1.0 + expected.Suu.norm()));
        EXPECT_GT((blend.jet({1.0, v}).Suu - lower.jet({1.0, v}).Suu).norm(), 1e-3);
      },
      50);
}

TEST(OdeBlend, IsClosedWhenBothEndsAre) {
  Rng rng(5);
  EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G1);
  EXPECT_TRUE(OdeBlend(e0, e1, {}).domain().v_closed);
  EXPECT_EQ(OdeBlend(e0, e1, {}).domain().v, e0.domain.v);
  e0.domain.closed = false;
  EXPECT_FALSE(OdeBlend(e0, e1, {}).domain().v_closed);
}

TEST(OdeBlend, RefusesEndsThatDoNotFit) {
  Rng rng(5);
  const EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G1);
  EndCondition longer = e1;
  longer.domain.v.hi += 1e-6;
  EXPECT_THROW(OdeBlend(e0, longer, {}), GeometryError);
  EndCondition gap = e1;
  gap.series = [series = e1.series](double v) {
    EndSeries s = series(v);
    s.C[2].c[0] += 1e-8 * v;  // does not close by 6e-8, 2e-8 of the size
    return s;
  };
  EXPECT_THROW(OdeBlend(e0, gap, {}), GeometryError);
  gap.domain.closed = false;
  EXPECT_NO_THROW(OdeBlend(e0, gap, {}));
  EndCondition empty0 = e0, empty1 = e1;
  empty0.domain.v = empty1.domain.v = {1.0, 1.0};
  EXPECT_THROW(OdeBlend(empty0, empty1, {}), GeometryError);
}

TEST(OdeBlend, RefusesAMovingFrameWithoutDirections) {
  Rng rng(5);
  const EndCondition e0 = random_end(rng, 0.0, Continuity::G1), e1 = random_end(rng, 2.0, Continuity::G1);
  BlendShape shape;
  shape.frame = BlendFrame::moving;
  EXPECT_NO_THROW(OdeBlend(e0, e1, shape));
  EXPECT_THROW(OdeBlend(e0, e0, shape), GeometryError);  // De = 0
  EndCondition along = e1;
  along.series = [series = e1.series](double v) {
    EndSeries s = series(v);
    s.T = differentiated(s.C);
    return s;
  };
  EXPECT_THROW(OdeBlend(e0, along, shape), GeometryError);
}

TEST(OdeBlend, NamesTheBadParameterOfItsShape) {
  Rng rng(5);
  const EndCondition g1 = random_end(rng, 0.0, Continuity::G1), g2 = random_end(rng, 2.0, Continuity::G2);
  const auto where = [&](const BlendShape& shape, const EndCondition& end1) -> std::string {
    try {
      OdeBlend(g1, end1, shape);
    } catch (const InputError& e) {
      return e.problems().at(0).where;
    }
    return "accepted";
  };
  BlendShape bad;
  bad.ode[1].b = 0.0;
  EXPECT_EQ(where(bad, g1), "ode/1/b");
  EXPECT_EQ(where(bad, g2), "accepted");  // the sixth order does not use it
  bad = {};
  bad.repeated_root = -1.0;
  EXPECT_EQ(where(bad, g1), "repeated_root");
  bad = {};
  bad.tension = std::nan("");
  EXPECT_EQ(where(bad, g2), "tension");
  bad = {};
  bad.frame = BlendFrame::fixed;
  bad.axes(0, 1) = 1e-6;
  EXPECT_EQ(where(bad, g1), "axes");
  bad = {};
  bad.mode = BlendMode::anchor;
  bad.anchor.y() = std::nan("");
  EXPECT_EQ(where(bad, g1), "anchor");
  bad = common({1.0, 4.0 * std::numbers::pi * std::numbers::pi, 0.0}, BlendMode::chord);
  EXPECT_THROW(OdeBlend(g1, g1, bad), ResonanceError);
}

}  // namespace
}  // namespace blendwright::test
