// Profiles and polar bars: radii, derivatives at tips, bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "implicit/primitives/polar_bar.hpp"
#include "tests/implicit/primitives/sweep_parts.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright {
namespace {

using namespace test;
using detail::PlanePart;
using detail::Profile;
constexpr double pi = std::numbers::pi;

std::vector<Profile> profiles() {
  return {Profile::lp(3, 2, 4),          Profile::lp(3, 2, 2),       Profile::lp(2, 2, 2),
          Profile::lp(1, 4, 1),          Profile::lp(3, 2, 0.7),     Profile::rose(6, 8, 0.35),
          Profile::rose(3, 2, 0.9),      Profile::rose(64, 2, 0.1),  Profile::rose(2, 2, 0.0),
          Profile::star(5, 13, 1.2, 1),  Profile::star(4, 3, 2, 1),  Profile::star(5, 13, 1.2, 2),
          Profile::star(8, 2, 0.5, 3.5), Profile::star(2, 2, 3, 1.5)};
}

MadePrimitive bar(NodeSpec profile, double c, double n) {
  profile.name = "profile";
  return make_primitive(
      scene_of({profile, part("bar", "polar_bar", {{"profile", ref("profile")}, {"c", c}, {"n", n}})}));
}

/// rho at an angle by (3) and (4) of profile.hpp, in plain trigonometry.
double radius_at(const Profile& p, double theta) {
  if (p.kind == Profile::Kind::rose) return p.a * (1.0 + p.eps * std::cos(p.k * theta)) / (1.0 + p.eps);
  if (p.kind == Profile::Kind::star)
    return p.a / (1.0 + p.sigma * std::pow(std::abs(std::sin(0.5 * p.k * theta)), p.m.exponent));
  const double c = std::abs(std::cos(theta)) / p.a, s = std::abs(std::sin(theta)) / p.b;
  return std::pow(std::pow(c, p.n.exponent) + std::pow(s, p.n.exponent), -1.0 / p.n.exponent);
}

// cos k theta by k-fold products of unit numbers is off by about k ulp, 2e-14 for k = 64; q follows with
// eps k/(1 - eps) of it at most, 200 here.
TEST(Profile, HasItsRadiusInEveryDirection) {
  for (const Profile& p : profiles())
    for_all([&](Rng& rng) {
      const double theta = uniform(rng, -pi, pi), r = log_uniform(rng, 1e-3, 1e3);
      const double g = p.gauge(r * std::cos(theta), r * std::sin(theta));
      EXPECT_NEAR(g, r / radius_at(p, theta), 2e-12 * g);
    });
}

TEST(Profile, KnowsItsRadiiAndExtent) {
  for (const Profile& p : profiles()) {
    Range seen{1e300, 0.0};
    double u = 0.0, v = 0.0;
    constexpr int n = 200000;
    for (int i = 0; i < n; ++i) {
      const double theta = 2.0 * pi * i / n, r = radius_at(p, theta);
      seen = {std::min(seen.lo, r), std::max(seen.hi, r)};
      u = std::max(u, r * std::abs(std::cos(theta)));
      v = std::max(v, r * std::abs(std::sin(theta)));
    }
    // Samples are 3e-5 apart; rho'' is below 1e4 where rho is smooth, rho' is small at its extremes else (a
    // sharp tip and the cusps of n = 0.7 lie on samples or have slopes below 30).
    EXPECT_NEAR(p.radius().lo, seen.lo, 1e-3);
    EXPECT_NEAR(p.radius().hi, seen.hi, 1e-3);
    EXPECT_LE(u, p.extent().first * (1.0 + 1e-12));
    EXPECT_LE(v, p.extent().second * (1.0 + 1e-12));
  }
}

TEST(Profile, ItsLipschitzConstantBoundsEverySlope) {
  for (const Profile& p : profiles()) {
    if (!std::isfinite(p.lipschitz())) continue;
    double steepest = 0.0;
    constexpr int n = 20000;
    constexpr double h = 1e-5;
    for (int i = 0; i < n; ++i) {
      const double theta = 2.0 * pi * (i + 0.37) / n;
      const double q = 1.0 / radius_at(p, theta);
      const double slope = (1.0 / radius_at(p, theta + h) - 1.0 / radius_at(p, theta - h)) / (2.0 * h);
      steepest = std::max(steepest, std::hypot(q, slope));
    }
    // The bound takes the largest q and the largest q' together, which are at different angles: at most
    // sqrt(2) too much. Differences are off by h^2 |q'''| < 1e-4 of it.
    EXPECT_LE(steepest, p.lipschitz() * (1.0 + 1e-4));
    EXPECT_GE(steepest, p.lipschitz() / std::sqrt(2.0) * (1.0 - 1e-3));
  }
}

TEST(Profile, TurnsOntoItselfByItsSymmetryOnly) {
  EXPECT_TRUE(Profile::star(5, 1, 1, 1).same_after_turn(2.0 * pi / 5.0));
  EXPECT_FALSE(Profile::star(5, 1, 1, 1).same_after_turn(pi / 5.0));
  EXPECT_TRUE(Profile::lp(2, 2, 4).same_after_turn(0.5 * pi));
  EXPECT_FALSE(Profile::lp(2, 3, 4).same_after_turn(0.5 * pi));
  EXPECT_TRUE(Profile::lp(2, 3, 4).same_after_turn(-3.0 * pi));
  EXPECT_TRUE(Profile::lp(2, 2, 2).same_after_turn(0.123));
  EXPECT_FALSE(Profile::lp(2, 3, 2).same_after_turn(0.123));
}

TEST(PolarBar, FootprintsHaveTheRadiiOfTheProfile) {
  const auto star = bar(part("", "star", {{"k", 5.0}, {"a", 14.0}, {"sigma", 1.2}, {"m", 1.0}}), 24, 20);
  const auto rose = bar(part("", "rose", {{"k", 6.0}, {"a", 8.0}, {"eps", 0.35}}), 24, 20);
  ASSERT_TRUE(star.tape && rose.tape);
  const auto at = [](double r, double theta) { return Vec3(r * std::cos(theta), r * std::sin(theta), 0.0); };
  for (int j = 0; j < 5; ++j) {
    // The direction of a tip is off by an ulp or two of its angle, a slope of sigma k/2 = 3.
    EXPECT_NEAR(value_at(*star.tape, at(14.0, 2.0 * pi * j / 5.0)), 1.0, 1e-14);
    EXPECT_NEAR(value_at(*star.tape, at(14.0 / 2.2, 2.0 * pi * (j + 0.5) / 5.0)), 1.0, 1e-14);
  }
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(value_at(*rose.tape, at(8.0, pi * j / 3.0)), 1.0, 1e-14);
    EXPECT_NEAR(value_at(*rose.tape, at(8.0 * 0.65 / 1.35, pi * (j + 0.5) / 3.0)), 1.0, 1e-14);
  }
  EXPECT_NEAR(value_at(*rose.tape, {0, 0, 12}), 0.5, 1e-15);
}

TEST(PolarBar, IsRayLinearAndTellsItsBox) {
  const auto star = bar(part("", "star", {{"k", 4.0}, {"a", 3.0}, {"sigma", 2.0}, {"m", 1.0}}), 5, 3);
  const auto oval = bar(part("", "lp_profile", {{"a", 1.0}, {"b", 4.0}, {"n", 2.0}}), 2, 4);
  for (const MadePrimitive* made : {&star, &oval}) {
    const Node& node = made->node;
    EXPECT_TRUE(node.distance && node.ray_linear && node.positive);
    const double value = 0.7;
    const Box box = *node.region(value);
    Vec3 reach = Vec3::Zero();
    for_all(
        [&](Rng& rng) {
          const Vec3 p(uniform(rng, -5, 5), uniform(rng, -5, 5), uniform(rng, -5, 5));
          const double s = log_uniform(rng, 1e-3, 1e3), d = value_at(*made->tape, p);
          EXPECT_NEAR(value_at(*made->tape, s * p), s * d, 1e-13 * s * d);
          const Vec3 on = p * (value / d);
          EXPECT_TRUE(box.contains(on * (1.0 - 1e-12))) << on.transpose();
          reach = reach.cwiseMax(on.cwiseAbs());
        },
        5000);
    // 5000 directions come near every side (the tips of the star take up a few per cent of all directions).
    EXPECT_TRUE((reach.array() > 0.8 * box.hi.array()).all()) << reach.transpose();
  }
}

TEST(PolarBar, SharpTipsHaveTheSymmetricDerivative) {
  const auto star = bar(part("", "star", {{"k", 5.0}, {"a", 13.0}, {"sigma", 1.2}, {"m", 1.0}}), 24, 20);
  const Vec3 g = gradient_at(*star.tape, {6.0, 0.0, 0.0});
  EXPECT_NEAR(g.x(), 1.0 / 13.0, 1e-16);
  EXPECT_EQ(g.y(), 0.0);
  // Beside the tip the slope is sigma k/(2 a) on either side.
  EXPECT_NEAR(gradient_at(*star.tape, {6.0, 1e-9, 0.0}).y(), 1.2 * 5.0 / 26.0, 1e-9);
  EXPECT_NEAR(gradient_at(*star.tape, {6.0, -1e-9, 0.0}).y(), -1.2 * 5.0 / 26.0, 1e-9);
}

TEST(PolarBar, SmoothTipsHaveTheirCurvature) {
  // g_vv = (q + q'')/r on a tip, q = 1/a, q'' = 2 sigma (k/2)^2/a for m = 2.
  const auto star = bar(part("", "star", {{"k", 5.0}, {"a", 13.0}, {"sigma", 1.2}, {"m", 2.0}}), 24, 20);
  const double x[] = {6.0}, zero[] = {0.0};
  double out[10];
  star.tape->evaluate(Order::hessian, {x, zero, zero}, out);
  const double expected = (1.0 + 2.0 * 1.2 * 6.25) / 13.0 / 6.0;
  EXPECT_NEAR(out[5], expected, 1e-14);
  EXPECT_NEAR(out[4], 0.0, 1e-16);
}

/// A part of the plane, and a point of it.
struct Sampled {
  PlanePart part;
  std::vector<std::pair<double, double>> points;
};
Sampled random_part(Rng& rng) {
  const double u = uniform(rng, -4, 4), v = uniform(rng, -4, 4), size = log_uniform(rng, 1e-4, 4.0);
  Sampled s;
  if (integer(rng, 0, 1) == 0) {
    const double a = size * uniform(rng, 0, 1), b = size * uniform(rng, 0, 1);
    s.part = detail::plane_box({u - a, u + a}, {v - b, v + b});
    for (int i = 0; i < 30; ++i)
      s.points.emplace_back(uniform(rng, u - a, u + a), uniform(rng, v - b, v + b));
    for (const double i : {-1.0, 1.0})
      for (const double j : {-1.0, 1.0}) s.points.emplace_back(u + i * a, v + j * b);
  } else {
    s.part = detail::plane_disk(u, v, size);
    for (int i = 0; i < 30; ++i) {
      const double r = size * std::sqrt(uniform(rng, 0, 1)), t = uniform(rng, -pi, pi);
      s.points.emplace_back(u + r * std::cos(t), v + r * std::sin(t));
    }
  }
  return s;
}

TEST(GaugeRange, HoldsEverySampleAndNarrowsWithThePart) {
  for (const Profile& p : profiles())
    for_all([&](Rng& rng) {
      const Sampled s = random_part(rng);
      const double t = uniform(rng, -7, 7),
                   wide = integer(rng, 0, 2) == 0 ? 0.0 : log_uniform(rng, 1e-4, 3.0);
      const Range range = detail::gauge_range(p, s.part, {t, t + wide});
      Range seen{1e300, 0.0};
      for (const auto& [u, v] : s.points) {
        const double phi = uniform(rng, t, t + wide), c = std::cos(phi), w = std::sin(phi);
        const double g = p.gauge(c * u + w * v, c * v - w * u);
        EXPECT_TRUE(range.contains(g)) << g << " in " << range.lo << ", " << range.hi;
        seen = {std::min(seen.lo, g), std::max(seen.hi, g)};
      }
      // The points reach out to |(u, v)| <= far; g varies with the place by L reach and with the turn by L
      // far wide, each end at most, and the product of two ranges at most doubles this.
      const double far = s.part.r.hi, reach = s.part.reach + far * wide;
      if (std::isfinite(p.lipschitz())) {
        EXPECT_LE(range.hi - range.lo, 8.0 * p.lipschitz() * reach + 1e-11 * range.hi);
      }
    });
}

TEST(GaugeRange, IsMissedByItsSamplesWhenItIsNarrowed) {
  for (const Profile& p : profiles()) {
    Rng rng(3);
    int missed = 0;
    for (int i = 0; i < 50; ++i) {
      const Sampled s = random_part(rng);
      const Range r = detail::gauge_range(p, s.part), half{r.lo, 0.5 * (r.lo + r.hi)};
      missed += std::any_of(s.points.begin(), s.points.end(),
                            [&](const auto& q) { return !half.contains(p.gauge(q.first, q.second)); });
    }
    EXPECT_GT(missed, 40);
  }
}

TEST(PolarBar, ObeysTheLawsOfEvaluationForEveryProfile) {
  const std::vector<NodeSpec> shapes{part("", "lp_profile", {{"a", 1.0}, {"b", 0.6}, {"n", 3.0}}),
                                     part("", "rose", {{"k", 7.0}, {"a", 1.2}, {"eps", 0.3}}),
                                     part("", "rose", {{"k", 64.0}, {"a", 1.2}, {"eps", 0.05}}),
                                     part("", "star", {{"k", 4.0}, {"a", 1.5}, {"sigma", 0.8}, {"m", 2.0}}),
                                     part("", "star", {{"k", 3.0}, {"a", 1.5}, {"sigma", 0.8}, {"m", 1.0}}),
                                     part("", "star", {{"k", 3.0}, {"a", 1.5}, {"sigma", 0.8}, {"m", 2.5}})};
  for (const NodeSpec& shape : shapes) {
    const auto made = bar(shape, 1.0, 4.0);
    ASSERT_TRUE(made.tape);
    EXPECT_EQ(evaluator_faults(*made.tape), no_faults) << shape.kind;
  }
}

TEST(PolarBar, RefusesBrokenParameters) {
  const NodeSpec round = part("", "lp_profile", {{"a", 1.0}, {"b", 1.0}, {"n", 2.0}});
  EXPECT_EQ(problem_of(bar(round, 1.0, 1.0)), "");
  EXPECT_EQ(problem_of(bar(round, 1.0, 0.9)).find("n: InvalidParameter: is 0.9, must be"), 0u);
  EXPECT_EQ(problem_of(bar(round, 0.0, 2.0)).find("c: InvalidParameter: is 0, must be"), 0u);
}

TEST(Profile, RefusesBrokenParameters) {
  const auto rose = [](double k, double eps) {
    return problem_of(make_primitive(scene_of({part("p", "rose", {{"k", k}, {"a", 1.0}, {"eps", eps}})})));
  };
  EXPECT_EQ(rose(3.0, 0.3), "");
  for (const double k : {1.0, 2.5, 65.0}) EXPECT_EQ(rose(k, 0.3).find("k: InvalidParameter"), 0u) << k;
  for (const double eps : {1.0, -0.1}) EXPECT_EQ(rose(3.0, eps).find("eps: InvalidParameter"), 0u) << eps;
  const auto star = [](double sigma, double m) {
    const Values values{{"k", 3.0}, {"a", 1.0}, {"sigma", sigma}, {"m", m}};
    return problem_of(make_primitive(scene_of({part("p", "star", values)})));
  };
  EXPECT_EQ(star(1.0, 1.0), "");
  for (const double sigma : {0.0, -1.0}) EXPECT_EQ(star(sigma, 1.0).find("sigma: InvalidParameter"), 0u);
  EXPECT_EQ(star(1.0, 0.5).find("m: InvalidParameter"), 0u);
}

}  // namespace
}  // namespace blendwright
