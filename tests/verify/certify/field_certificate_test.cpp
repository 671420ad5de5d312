// Certificates of edges on implicit surfaces.
#include "verify/certify/field_certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernel/field/formula_field.hpp"
#include "kernel/geometry/bspline.hpp"
#include "kernel/geometry/curvature.hpp"
#include "tests/verify/shapes.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

struct Sphere {
  double R;
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return x * x + y * y + z * z - R * R;
  }
};
struct Torus {
  double A, r;
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T d = sqrt(x * x + y * y) - A;
    return d * d + z * z - r * r;
  }
};
/// Two potentials (1 - |X -+ d e_z|^2)^3, of which the level 1/2 is the surface.
struct SoftPair {
  double d;
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T across = x * x + y * y, up = z - d, down = z + d;
    const T p = 1.0 - (across + up * up), q = 1.0 - (across + down * down);
    return p * p * p + q * q * q;
  }
};

/// A strip along the circle of radius rho at height z0, whose edge is off by a sin(5 v) along the normal n of
/// inclination phi and which leaves at the slope b cos(3 v) against the tangent plane.
struct Strip {
  double rho, z0, phi, a, b;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const T c = cos(v), s = sin(v), off = a * sin(5.0 * v) + b * (u * cos(3.0 * v));
    const double cp = std::cos(phi), sp = std::sin(phi);
    return {rho * c + cp * (off * c) - sp * (u * c), rho * s + cp * (off * s) - sp * (u * s),
            z0 + sp * off + cp * u};
  }
  [[nodiscard]] SurfaceDomain domain() const { return {{0.0, 0.5}, {0.0, 2.0 * std::numbers::pi}}; }
};

struct Case {
  const char* name;
  ScalarField field;
  double rho, z0, phi;
  [[nodiscard]] FieldSeam seam(double a, double b) const {
    return {name, FormulaSurface<Strip>(Strip{rho, z0, phi, a, b}), 0, field};
  }
};

std::vector<Case> cases() {
  // The soft pair at z = 0: 2 (1 - d^2 - rho^2)^3 = 1/2.
  const double d = 0.3, rho = std::sqrt(1.0 - std::cbrt(0.25) - d * d);
  return {{"sphere", formula_field(Sphere{1.3}, Level::zero), 1.3 * std::cos(0.4), 1.3 * std::sin(0.4), 0.4},
          {"torus", formula_field(Torus{1.0, 0.35}, Level::zero), 1.0 + 0.35 * std::cos(1.1),
           0.35 * std::sin(1.1), 1.1},
          {"soft object", formula_field(SoftPair{d}, Level::half), rho, 0.0, 0.0}};
}

TEST(FieldCertificate, IsTheExactMaximumWithinTenPerCent) {
  for (const Case& test : cases()) {
    SCOPED_TRACE(test.name);
    // The edge is 1e-6 off along the normal; to first order that is the gap, up to 1e-6 / radius of itself.
    const SeamCertificate gap = certify_on_field(test.seam(1e-6, 0.0));
    EXPECT_TRUE(gap.gap.agreed()) << gap.gap.unproven;
    EXPECT_GE(gap.gap.proven, 1e-6 * (1.0 - 1e-4));
    EXPECT_LE(gap.gap.proven, 1.1e-6 + gap.gap.floor);
    EXPECT_LE(gap.gap.floor, 1e-13);
    // On the surface, at the slope b cos(3 v): the angle is its arc tangent.
    const SeamCertificate angle = certify_on_field(test.seam(0.0, 1e-5));
    EXPECT_TRUE(angle.angle.agreed()) << angle.angle.unproven;
    EXPECT_GE(angle.angle.proven, std::atan(1e-5) * (1.0 - 1e-9));
    EXPECT_LE(angle.angle.proven, 1.1 * std::atan(1e-5) + angle.angle.floor);
    EXPECT_TRUE(angle.curvature.agreed()) << angle.curvature.unproven;
    EXPECT_GE(angle.curvature.proven, angle.curvature.sampled - angle.curvature.floor);
    EXPECT_NE(shortfall(angle, Continuity::G2, {}), "");  // a straight strip does not bend with the surface
  }
}

TEST(FieldCertificate, OfTheCurvatureJumpOfAStraightStripIsThatOfTheSphere) {
  // The strip is straight across the edge: its normal curvature there is 0, the sphere's 1/R.
  const SeamCertificate c = certify_on_field(cases()[0].seam(0.0, 0.0));
  EXPECT_NEAR(c.curvature.sampled, 1.0 / 1.3, 1e-12);
  EXPECT_GE(c.curvature.proven, (1.0 - 1e-12) / 1.3);
  EXPECT_LE(c.curvature.proven, 1.1 / 1.3);
}

/// The same field, of which only values and their bounds over boxes are known.
class BoxesOnly final : public ScalarField::Model {
 public:
  explicit BoxesOnly(ScalarField of) : of_(std::move(of)) {}
  void evaluate(Order order, PointArrays points, std::span<double> out) const override {
    of_.model().evaluate(order, points, out);
  }
  [[nodiscard]] Range range(const Box& box) const override { return of_.range(box); }
  [[nodiscard]] LinearBound linear(const Box& box) const override { return of_.linear(box); }
  [[nodiscard]] Within within(const Box& box) const override { return of_.model().within(box); }
  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override {
    of_.model().nearest_member(points, out);
  }

 private:
  ScalarField of_;
};

Case boxes_only(Case of) {
  of.field = ScalarField(std::make_shared<const BoxesOnly>(of.field), of.field.level());
  return of;
}

TEST(FieldCertificate, BoundsTheDistanceThroughBoxesAndNoDerivative) {
  for (const Case& test : cases()) {
    SCOPED_TRACE(test.name);
    const SeamCertificate c = certify_on_field(boxes_only(test).seam(1e-4, 0.0));
    EXPECT_TRUE(c.gap.agreed()) << c.gap.unproven << " " << c.gap.proven;
    EXPECT_GE(c.gap.proven, 1e-4 * (1.0 - 1e-4));
    EXPECT_LE(c.gap.proven, 1.1e-4 + c.gap.floor);
    for (const ProvenFigure* f : {&c.angle, &c.curvature}) {
      EXPECT_TRUE(std::isinf(f->proven));
      EXPECT_EQ(f->unproven, "the field gives no bounds of its derivatives");
    }
    EXPECT_NE(shortfall(c, Continuity::G1, {}), "");
  }
}

TEST(FieldCertificate, OfAnExactEdgeThroughBoxesIsABoundThatSaysHowFarItCame) {
  const SeamCertificate c = certify_on_field(boxes_only(cases()[0]).seam(0.0, 0.0));
  EXPECT_FALSE(c.gap.agreed());
  EXPECT_LE(c.gap.proven, 1e-5);
  EXPECT_NE(c.gap.unproven, "");
}

TEST(FieldCertificate, IsNeverExceededByRandomSamples) {
  for_all(
      [](Rng& rng) {
        for (const Case& exact : cases())
          for (const Case& test : {exact, boxes_only(exact)}) {
            const FieldSeam seam =
                test.seam(test::log_uniform(rng, 1e-5, 1e-3), test::log_uniform(rng, 1e-6, 1e-2));
            const SeamCertificate c = certify_on_field(seam, {}, 256);
            EXPECT_TRUE(c.gap.agreed()) << c.gap.unproven;
            for (int i = 0; i < 500; ++i) {
              const double v = uniform(rng, 0.0, 2.0 * std::numbers::pi);
              const SurfaceJet S = seam.blend.jet({0.0, v});
              const std::array<Vec3, 1> at{S.S};
              const FieldValues f = seam.field.evaluate(Order::gradient, at);
              const double off = std::abs(f.value(0) - surface_value(seam.field.level()));
              // The distance and (1) differ by gap^2 / 2 times a curvature, below 20 here.
              const double gap = off / f.gradient(0).norm();
              EXPECT_LE(gap, c.gap.proven + c.gap.floor + 10.0 * gap * gap);
              EXPECT_LE(plane_angle(unit_normal(S), f.gradient(0)).value, c.angle.proven + 1e-13);
            }
          }
      },
      4);
}

/// z (1 + x^2): the plane z = 0.
struct Plane {
  template <class T>
  T operator()(const T& x, const T&, const T& z) const {
    return z * (1.0 + x * x);
  }
};

/// A flat patch with a bump of about 1e-6 on its edge, a third of a sampling step wide.
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
  std::size_t middle = 0;
  for (std::size_t j = 0; j < gv.size(); ++j)
    if (std::abs(gv[j] - at) < std::abs(gv[middle] - at)) middle = j;
  control[middle].z() = height;
  return {u, v, control};
}

TEST(FieldCertificate, FindsABumpBetweenTheSamples) {
  // As in certificate_test.cpp: midway between two of 2048 samples; the quintic function's maximum is 0.55.
  constexpr double step = 1.0 / 2046.0, at = (1000.0 + 0.618 - 0.5) * step;
  const Case plane{"plane", formula_field(Plane{}, Level::zero), 0.0, 0.0, 0.0};
  for (const Case& test : {plane, boxes_only(plane)})
    for (const double height : {0.0, 1e-6 / 0.55}) {
      const SeamCertificate c =
          certify_on_field({"patch", bumped(at, step / 3.0, height), 0, test.field}, {}, 2048);
      EXPECT_LT(c.gap.sampled, 1e-14);  // the control: sampling misses it
      if (height == 0.0) {
        EXPECT_LE(c.gap.proven, 1e-13);  // without the bump there is nothing to find
        continue;
      }
      EXPECT_FALSE(c.gap.agreed());
      EXPECT_NE(c.gap.unproven.find("between the samples"), std::string::npos) << c.gap.unproven;
      EXPECT_GE(c.gap.proven, 0.9e-6);
      EXPECT_LE(c.gap.proven, 1.3e-6);
      EXPECT_NEAR(c.gap.v, at, step / 3.0);
    }
}

TEST(FieldCertificate, IsRefusedWithoutAnEnclosureOfTheBlend) {
  const Surface plain = test::surface({{0.0, 1.0}, {0.0, 1.0}}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u, v, T(0.0)};
  });
  const SeamCertificate c = certify_on_field({"patch", plain, 0, formula_field(Plane{}, Level::zero)});
  EXPECT_TRUE(std::isinf(c.gap.proven));
  EXPECT_NE(c.gap.unproven.find("no enclosure"), std::string::npos);
}

}  // namespace
}  // namespace blendwright
