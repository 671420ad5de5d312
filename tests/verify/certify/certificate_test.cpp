#include "verify/certify/certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "kernel/geometry/bspline.hpp"
#include "kernel/geometry/curvature.hpp"
#include "tests/verify/shapes.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

/// (u, v, h(u, v)) as a formula that can enclose itself.
template <class F>
struct Graph {
  std::shared_ptr<const F> h;  // captures make a lambda uncopyable by assignment
  SurfaceDomain d{{-1.0, 1.0}, {0.0, 1.0}};
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    return {u, v, (*h)(u, v)};
  }
  [[nodiscard]] SurfaceDomain domain() const { return d; }
};
template <class F>
Surface graph(F h, SurfaceDomain d = {{-1.0, 1.0}, {0.0, 1.0}}) {
  return FormulaSurface<Graph<F>>(Graph<F>{std::make_shared<const F>(h), d});
}
struct UpLine {
  template <class T>
  std::array<T, 2> operator()(const T& v) const {
    return {T(0.0), v};
  }
  [[nodiscard]] CurveDomain domain() const { return {{0.0, 1.0}, false}; }
};
Curve2 up_line() { return FormulaCurve<UpLine, 2>(UpLine{}); }

const auto flat = [](const auto& u, const auto& v) { return 0.0 * u + 0.0 * v; };

Seam seam_of(const Surface& blend, const Surface& primary) {
  Seam s{"blend/from", blend, 0};
  s.primary = primary;
  s.pcurve = up_line();
  return s;
}
SeamCertificate certified(const Seam& seam) { return certify_seam(seam, check_seam(seam)); }

/// z = a sin(k v) + b u cos(k v) + c u^2 on u in [0, 1]: gap |a|, slope and bend known by hand.
Surface wavy(double a, double b, double c, double k) {
  return graph(
      [=](const auto& u, const auto& v) { return a * sin(k * v) + b * (u * cos(k * v)) + c * (u * u); },
      {{0.0, 1.0}, {0.0, 1.0}});
}

TEST(Certificate, IsTheExactMaximumWithinTenPerCent) {
  // Against the plane: gap max |a sin|; k = 7 reaches its full amplitude, |a|. With a = 0 the plane is met in
  // position and left with slope b cos(k v), at most b at v = 0; then tan(angle) = |b| at v = 0, where
  // S_v = 0.
  const SeamCertificate gap = certified(seam_of(wavy(1e-7, 0.0, 0.0, 7.0), graph(flat)));
  EXPECT_TRUE(gap.gap.agreed()) << gap.gap.unproven;
  EXPECT_GE(gap.gap.proven, 1e-7);
  EXPECT_LE(gap.gap.proven, 1.1e-7 + gap.gap.floor);
  const SeamCertificate angle = certified(seam_of(wavy(0.0, 1e-5, 0.0, 7.0), graph(flat)));
  EXPECT_GE(angle.angle.proven, std::atan(1e-5));
  EXPECT_LE(angle.angle.proven, 1.1 * std::atan(1e-5) + angle.angle.floor);
  const SeamCertificate bend = certified(seam_of(wavy(0.0, 0.0, 0.25, 7.0), graph(flat)));
  EXPECT_GE(bend.curvature.proven, 0.5 * (1.0 - 1e-12));  // z'' = 2c across the line
  EXPECT_LE(bend.curvature.proven, 0.55);
  EXPECT_EQ(shortfall(angle, Continuity::G1, {}), "");
  EXPECT_NE(shortfall(bend, Continuity::G2, {}), "");
}

TEST(Certificate, OfTheSameSurfaceIsAtRounding) {
  const auto shape = [](const auto& u, const auto& v) { return sin(u + 2.0 * v) * exp(v); };
  const SeamCertificate c = certified(seam_of(graph(shape, {{0.0, 1.0}, {0.0, 1.0}}), graph(shape)));
  for (const ProvenFigure* f : {&c.gap, &c.angle, &c.curvature}) {
    EXPECT_TRUE(f->agreed()) << f->unproven;
    EXPECT_LE(f->proven, 1e-10);
  }
}

TEST(Certificate, IsNeverExceededByRandomSamples) {
  for_all(
      [](Rng& rng) {
        const Surface blend = wavy(uniform(rng, -1e-4, 1e-4), uniform(rng, -1e-2, 1e-2),
                                   uniform(rng, -1.0, 1.0), uniform(rng, 1.0, 40.0));
        const double p = uniform(rng, -1.0, 1.0), q = uniform(rng, -1e-2, 1e-2);
        const Surface primary =
            graph([=](const auto& u, const auto& v) { return p * (u * u) + q * (u * v * v); });
        const Seam seam = seam_of(blend, primary);
        const SeamCertificate c = certified(seam);
        EXPECT_TRUE(c.gap.agreed() && c.angle.agreed() && c.curvature.agreed());
        for (int i = 0; i < 2000; ++i) {
          const double v = uniform(rng, 0.0, 1.0);
          const SurfaceJet S = blend.jet({0.0, v}), P = primary.jet({0.0, v});
          const Vec3 nS = unit_normal(S), nP = unit_normal(P), across = nP.cross(P.Sv);
          EXPECT_LE((S.S - P.S).norm(), c.gap.proven + c.gap.floor);
          EXPECT_LE(plane_angle(nS, nP).value, c.angle.proven + 1e-14);
          EXPECT_LE(std::abs(normal_curvature(S, across, nS) - normal_curvature(P, across, nP)),
                    c.curvature.proven + 1e-13);
        }
      },
      20);
}

/// A flat patch with knots so dense around `at` that one control point makes a bump narrower than a sampling
/// step.
BSplineSurface bumped(double at, double width, double height) {
  std::vector<double> breaks;
  for (int i = 0; i <= 16; ++i) breaks.push_back(i / 16.0);
  for (int i = -3; i <= 3; ++i) breaks.push_back(at + width * i / 6.0);
  std::sort(breaks.begin(), breaks.end());
  const BSplineBasis u = BSplineBasis::clamped(5, {0.0, 1.0}), v = BSplineBasis::clamped(5, breaks);
  const std::vector<double> gu = u.greville(), gv = v.greville();
  std::vector<Vec3> control;
  for (const double x : gu)
    for (const double y : gv) control.emplace_back(x, y, 0.0);
  // Of the functions of row u = 0, the one whose support is the seven dense knots has the middle at `at`.
  std::size_t middle = 0;
  for (std::size_t j = 0; j < gv.size(); ++j)
    if (std::abs(gv[j] - at) < std::abs(gv[middle] - at)) middle = j;
  control[middle].z() = height;
  return {u, v, control};
}

TEST(Certificate, FindsABumpBetweenTheSamples) {
  // 2048 samples: at (i - 1 + 0.618)/2046. The bump lies in the middle between two of them and is a third of
  // a step wide; the quintic function's maximum is 0.55 for uniform knots.
  constexpr double step = 1.0 / 2046.0, height = 1e-6 / 0.55;
  const double at = (1000.0 + 0.618 - 0.5) * step;
  const Seam seam = seam_of(bumped(at, step / 3.0, height), graph(flat));
  const SeamReport sampled = check_seam(seam);
  EXPECT_LT(sampled.gap.worst, 1e-14);  // the control: sampling misses it
  const SeamCertificate c = certify_seam(seam, sampled);
  EXPECT_FALSE(c.gap.agreed());
  EXPECT_NE(c.gap.unproven.find("between the samples"), std::string::npos) << c.gap.unproven;
  EXPECT_GE(c.gap.proven, 0.9e-6);
  EXPECT_LE(c.gap.proven, 1.3e-6);
  EXPECT_GE(c.gap.found, 0.8e-6);
  EXPECT_NEAR(c.gap.v, at, step / 3.0);
  EXPECT_NE(shortfall(c, Continuity::G0, {}), "");
  // Without the bump there is nothing to find.
  EXPECT_TRUE(certified(seam_of(bumped(at, step / 3.0, 0.0), graph(flat))).gap.agreed());
}

TEST(Certificate, IsRefusedWithTheReason) {
  const Surface plain = test::surface({{0.0, 1.0}, {0.0, 1.0}}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u, v, T(0.0)};
  });
  const SeamCertificate points = certified(seam_of(plain, graph(flat)));
  EXPECT_TRUE(std::isinf(points.gap.proven));
  EXPECT_NE(points.gap.unproven.find("no enclosure"), std::string::npos);
  Seam loose = seam_of(wavy(0.0, 0.0, 0.0, 1.0), graph(flat));
  loose.pcurve.reset();
  EXPECT_NE(certified(loose).gap.unproven.find("no trimline"), std::string::npos);
  Seam alone = seam_of(wavy(0.0, 0.0, 0.0, 1.0), graph(flat));
  alone.primary.reset();
  EXPECT_FALSE(certified(alone).measured);
}

/// (u, (v - 1/2)^3, 0): no normal at v = 1/2.
struct Cusp {
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const T w = v - 0.5;
    return {u, w * w * w, T(0.0)};
  }
  [[nodiscard]] SurfaceDomain domain() const { return {{0.0, 1.0}, {0.0, 1.0}}; }
};

TEST(Certificate, DoesNotBoundTheAngleAtAPole) {
  const Surface s = FormulaSurface<Cusp>(Cusp{});
  const SeamCertificate c = certified(seam_of(s, s));
  EXPECT_TRUE(c.gap.agreed()) << c.gap.unproven;
  EXPECT_LE(c.gap.proven, 1e-12);
  EXPECT_FALSE(c.angle.agreed());
  EXPECT_NEAR(c.angle.v, 0.5, 1e-4);
  EXPECT_LE(c.angle.floor, 1e-6);
}

/// (u, v^2, b u cos(k v)): the trimline u = 0 stops at v = 0.
struct Stopping {
  double b, k;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    return {u, v * v, b * (u * cos(k * v))};
  }
  [[nodiscard]] SurfaceDomain domain() const { return {{0.0, 1.0}, {0.0, 1.0}}; }
};
Surface stopping(double b, double k) { return FormulaSurface<Stopping>(Stopping{b, k}); }

TEST(Certificate, BoundsTheAngleWhereTheTrimlineStops) {
  // nS = 2 v (-b cos(k v), 0, 1): the angle with z = 0 is atan(b |cos(k v)|), atan b in the limit v -> 0.
  for (const double b : {1e-7, 1e-3, 0.5}) {
    const SeamCertificate c = certified(seam_of(stopping(b, 7.0), stopping(0.0, 0.0)));
    EXPECT_TRUE(c.angle.agreed()) << c.angle.unproven;
    EXPECT_GE(c.angle.proven, std::atan(b) * (1.0 - 1e-12));
    EXPECT_LE(c.angle.proven, 1.1 * std::atan(b) + c.angle.floor);
    EXPECT_LE(c.angle.floor, 1e-12);
  }
  const SeamCertificate same = certified(seam_of(stopping(0.0, 0.0), stopping(0.0, 0.0)));
  EXPECT_TRUE(same.angle.agreed()) << same.angle.unproven;
  EXPECT_LE(same.angle.proven, 1e-12);
  EXPECT_NE(same.curvature.unproven.find("the trimline stops there"), std::string::npos);
}

/// A surface whose jets are not quite what its enclosure says.
struct Misread {
  Surface of;
  double factor;  ///< of Suu
  [[nodiscard]] SurfaceJet jet(UV p) const {
    SurfaceJet j = of.jet(p);
    j.Suu *= factor;
    return j;
  }
  [[nodiscard]] SurfacePartials partials(UV p) const { return of.partials(p); }
  [[nodiscard]] SurfaceDomain domain() const { return of.domain(); }
  void enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const {
    (void)of.enclose(u, v, out);
  }
};

TEST(Certificate, NoticesASecondDerivativeThatIsOffByABillionth) {
  const Surface bent = wavy(0.0, 0.0, 0.25, 7.0);
  for (const double factor : {1.0, 1.0 + 1e-9, 1.0 - 1e-9}) {
    const SeamCertificate c = certified(seam_of(Surface(Misread{bent, factor}), graph(flat)));
    EXPECT_TRUE(c.gap.agreed() && c.angle.agreed());
    EXPECT_EQ(c.curvature.agreed(), factor == 1.0) << c.curvature.unproven;
    if (factor != 1.0) {
      EXPECT_NE(c.curvature.unproven.find("not evaluated as it is defined"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace blendwright
