// Ranges of distance primitives over boxes: they hold every sample, and are attained where they are exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/implicit/primitives/made_primitive.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright {
namespace {

using namespace test;

/// Of samples in a box, those with values outside of a range.
std::size_t misses(const Tape& tape, const std::vector<Vec3>& points, Range range) {
  const std::vector<double> values = values_at(tape, points);
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [&](double v) { return !range.contains(v); }));
}

/// Random points of the box, its corners, and its points in the coordinate planes.
std::vector<Vec3> samples_of(Rng& rng, const Box& box, int random) {
  std::vector<Vec3> points;
  for (int i = 0; i < random; ++i) points.push_back(suite::point_in(rng, box));
  const Vec3 middle = Vec3::Zero().cwiseMax(box.lo).cwiseMin(box.hi);
  for (int k = 0; k < 27; ++k) {
    const int digit[] = {k % 3, k / 3 % 3, k / 9};
    Vec3 p;
    for (int i = 0; i < 3; ++i) p[i] = digit[i] == 0 ? box.lo[i] : digit[i] == 1 ? middle[i] : box.hi[i];
    points.push_back(p);
  }
  return points;
}

TEST(DistanceRanges, HoldAMillionSamplesOfEveryPrimitive) {
  constexpr int boxes = 1000, points = 1000;
  for (const PrimitiveSample& sample : primitive_samples()) {
    SCOPED_TRACE(sample.id);
    const auto tape = make_primitive(sample.scene).tape;
    ASSERT_TRUE(tape);
    Rng rng(7);
    for (int b = 0; b < bounded(boxes); ++b) {
      const Box box = suite::box_in(rng, sample.where);
      EXPECT_EQ(misses(*tape, samples_of(rng, box, points), tape->range(box)), 0u)
          << suite::text(box) << suite::text(tape->range(box).lo, tape->range(box).hi);
    }
  }
}

/// The least distance from the segment to the box: a convex function of the place on the segment, so the
/// golden section finds it.
double least_distance(const Vec3& p0, const Vec3& p1, const Box& box) {
  const auto at = [&](double s) {
    const Vec3 p = p0 + s * (p1 - p0);
    return (p - p.cwiseMax(box.lo).cwiseMin(box.hi)).norm();
  };
  double lo = 0.0, hi = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double a = lo + 0.381966 * (hi - lo), b = lo + 0.618034 * (hi - lo);
    (at(a) < at(b) ? hi : lo) = at(a) < at(b) ? b : a;
  }
  return std::min({at(lo), at(0.0), at(1.0)});
}

Vec3 point_of(const NodeSpec& spec, const char* key) {
  const auto& p = std::get<std::vector<double>>(spec.values.at(key));
  return {p.at(0), p.at(1), p.at(2)};
}

/// The exact range of a primitive over a box, by other means than its own.
Range exact_range(const NodeSpec& spec, const Tape& tape, const Box& box, Rng& rng) {
  const auto candidates = samples_of(rng, box, 0);
  if (spec.kind == "plane" || spec.kind == "slab" || spec.kind == "half_space") {
    const Vec3 n = point_of(spec, "normal") / std::get<double>(spec.values.at("a"));
    Range f{n.dot(box.lo), n.dot(box.lo)};
    for (const Vec3& p : candidates) f = {std::min(f.lo, n.dot(p)), std::max(f.hi, n.dot(p))};
    if (spec.kind == "slab") return magnitude(f);
    return spec.kind == "plane" ? f : Range{std::max(0.0, f.lo), std::max(0.0, f.hi)};
  }
  const std::vector<double> values = values_at(tape, candidates);
  Range r{*std::min_element(values.begin(), values.end()), *std::max_element(values.begin(), values.end())};
  if (spec.kind == "segment_skeleton")
    r.lo = least_distance(point_of(spec, "p0"), point_of(spec, "p1"), box) /
           std::get<double>(spec.values.at("radius"));
  return r;
}

bool exact_kind(const std::string& kind) {
  for (const char* k : {"plane", "half_space", "slab", "lp_metric", "superquadric",
                        "asymmetric_superellipsoid", "segment_skeleton", "capsule_gauge"})
    if (kind == k) return true;
  return false;
}

TEST(DistanceRanges, ThatAreTooNarrowAreFound) {
  for (const PrimitiveSample& sample : primitive_samples()) {
    if (!exact_kind(solid_of(sample.scene).kind)) continue;  // others need not be attained
    SCOPED_TRACE(sample.id);
    const auto tape = make_primitive(sample.scene).tape;
    Rng rng(11);
    const auto points = samples_of(rng, sample.where, 100);
    const Range range = tape->range(sample.where);
    EXPECT_GT(misses(*tape, points, {range.lo, range.lo + 0.9 * (range.hi - range.lo)}), 0u);
  }
}

TEST(DistanceRanges, AreAttainedWhereTheyAreExact) {
  int seen = 0;
  for (const PrimitiveSample& sample : primitive_samples()) {
    const NodeSpec& spec = solid_of(sample.scene);
    if (!exact_kind(spec.kind)) continue;
    ++seen;
    SCOPED_TRACE(sample.id);
    const auto tape = make_primitive(sample.scene).tape;
    for_all([&](Rng& rng) {
      const Box box = suite::box_in(rng, sample.where);
      const Range range = tape->range(box), exact = exact_range(spec, *tape, box, rng);
      const double slack = 1e-9 * std::max(1.0, std::abs(exact.hi));
      EXPECT_NEAR(range.lo, exact.lo, slack) << suite::text(box);
      EXPECT_NEAR(range.hi, exact.hi, slack) << suite::text(box);
    });
  }
  EXPECT_GE(seen, 20);
}

TEST(DistanceRanges, OfGeneralizedDistancesAreAtLeastAsTightAsTheirTerms) {
  int tighter = 0, seen = 0;
  for (const PrimitiveSample& sample : primitive_samples()) {
    const NodeSpec& spec = solid_of(sample.scene);
    if (spec.kind != "generalized_distance") continue;
    SCOPED_TRACE(sample.id);
    const auto tape = make_primitive(sample.scene).tape;
    const double n = std::get<double>(spec.values.at("n"));
    for_all([&](Rng& rng) {
      const Box box = suite::box_in(rng, sample.where);
      double lo = 0.0, hi = 0.0;
      for (const auto& row : std::get<std::vector<std::vector<double>>>(spec.values.at("normals"))) {
        const Vec3 normal = Vec3(row[0], row[1], row[2]).normalized();
        const double middle = std::abs(normal.dot(box.centre())),
                     reach = 0.5 * normal.cwiseAbs().dot(box.size());
        lo += std::pow(std::max(0.0, middle - reach), n);
        hi += std::pow(middle + reach, n);
      }
      const Range range = tape->range(box), terms{std::pow(lo, 1.0 / n), std::pow(hi, 1.0 / n)};
      EXPECT_GE(range.lo, terms.lo - 1e-12 * terms.hi);
      EXPECT_LE(range.hi, terms.hi * (1.0 + 1e-12));
      const auto values = values_at(*tape, samples_of(rng, box, 0));
      EXPECT_NEAR(range.hi, *std::max_element(values.begin(), values.end()), 1e-9 * range.hi);
      ++seen;
      if (range.lo > terms.lo + 1e-3 * terms.hi) ++tighter;
    });
  }
  EXPECT_GT(seen, 0);
  EXPECT_GT(tighter, seen / 10);  // the tangent plane counts
}

}  // namespace
}  // namespace blendwright
