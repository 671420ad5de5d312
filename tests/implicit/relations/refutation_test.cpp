// The proofs under the search: linear programmes and linear bounds of minima and maxima.
#include <gtest/gtest.h>

#include "implicit/relations/linear_parts.hpp"
#include "implicit/relations/linear_refutation.hpp"
#include "tests/implicit/moving/motions.hpp"
#include "tests/implicit/relations/bodies.hpp"

namespace blendwright::test {
namespace {

using detail::highest_point;
using detail::LinearPoint;

LinearBound random_bound(Rng& rng, double size) {
  const double rest = uniform(rng, 0.0, 0.3) * size;
  return {uniform(rng, -1.0, 1.0) * size, size * random_vector(rng, 1.0), {-rest, rest}};
}

double least_at(const std::vector<LinearBound>& bounds, const Vec3& t) {
  double least = std::numeric_limits<double>::infinity();
  for (const LinearBound& b : bounds) least = std::min(least, b.value + b.slope.dot(t) + b.rest.hi);
  return least;
}

// A refutation holds at every point, and is not missed: its other side is a point where all are >= 0.
TEST(LinearRefutation, HoldsAndMissesNothing) {
  std::size_t refuted = 0, kept = 0;
  for_all(
      [&](Rng& rng) {
        std::vector<LinearBound> bounds;
        const int count = integer(rng, 1, 14);
        for (int i = 0; i < count; ++i) bounds.push_back(random_bound(rng, log_uniform(rng, 1e-3, 1e3)));
        const LinearPoint p = highest_point(bounds, 1.0);
        for (int i = 0; i < 50; ++i) {
          const Vec3 t = random_vector(rng, 1.0);
          if (p.upper < 0.0) {
            ASSERT_LT(least_at(bounds, t), 0.0);
          }
        }
        EXPECT_LE(p.t.cwiseAbs().maxCoeff(), 1.0);
        // Strong duality: not refuted means that some point has all >= 0, to rounding of the tableau.
        if (p.upper < 0.0) {
          ++refuted;
          EXPECT_LT(least_at(bounds, p.t), 0.0);
        } else {
          ++kept;
          for (const LinearBound& b : bounds)
            EXPECT_GE(b.value + b.slope.dot(p.t) + b.rest.hi, -1e-9 * (1.0 + b.slope.lpNorm<1>()));
        }
      },
      2000);
  EXPECT_GT(refuted, 300u);
  EXPECT_GT(kept, 300u);
}

// Two bounds: the least of all convex combinations, here by trying many.
TEST(LinearRefutation, OfTwoIsTheBestConvexCombination) {
  for_all([](Rng& rng) {
    const LinearBound a = random_bound(rng, 1.0), b = random_bound(rng, 1.0);
    const std::vector<LinearBound> both{a, b};
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 2000; ++i) {
      const double mu = i / 2000.0;
      best = std::min(best, (mu * a + (1.0 - mu) * b).range().hi);
    }
    EXPECT_EQ(highest_point(both, 1.0).upper < 0.0, best < 0.0) << best;
  });
}

TEST(LinearRefutation, LeavesOutWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  const LinearBound no_bound{0.0, Vec3::Zero(), {-infinity, infinity}}, low{-1.0, Vec3::Zero(), {0.0, 0.0}};
  EXPECT_EQ(highest_point(std::vector{no_bound}, 1.0).upper, infinity);
  EXPECT_LT(highest_point(std::vector{no_bound, low}, 1.0).upper, 0.0);
  EXPECT_FALSE(highest_point(std::vector<LinearBound>{}, 1.0).upper < 0.0);
  // Exactly 0 at a point is no refutation; neither is what underflows.
  const LinearBound right{0.0, {1, 0, 0}, {0, 0}}, left{0.0, {-1, 0, 0}, {0, 0}};
  EXPECT_GE(highest_point(std::vector{right, left}, 1.0).upper, 0.0);
  const LinearBound tiny{-1e-320, Vec3(1e-320, 0, 0), {0, 0}};
  EXPECT_GE(highest_point(std::vector{tiny}, 1.0).upper, 0.0);
}

/// A random tree of minima, maxima and complements of spheres and planes.
std::string add_tree(std::vector<NodeSpec>& nodes, Rng& rng, int depth) {
  const std::string id = "n" + std::to_string(rng.next());
  const Vec3 v = random_vector(rng, 1.0);
  const int what = depth == 0 ? integer(rng, 0, 1) : integer(rng, 2, 4);
  if (what == 0) {
    nodes.push_back(part(id, "quadric",
                         {{"coefficients", std::vector<double>{0, 0, 0, 0, 0, 0, v[0], v[1], v[2], 0.3}}}));
  } else if (what == 1) {
    nodes.push_back(part(
        id, "quadric", {{"coefficients", std::vector<double>{-1, -1, -1, 0, 0, 0, v[0], v[1], v[2], 0.3}}}));
  } else {
    const std::string a = add_tree(nodes, rng, depth - 1), b = add_tree(nodes, rng, depth - 1);
    const std::string own = id + "t";
    if (what == 4) {
      nodes.push_back(part(own + "c", "complement", {{"of", ref(b)}}));
      nodes.push_back(part(own, "min", {{"of", refs({a, own + "c"})}}));
    } else {
      nodes.push_back(part(own, what == 2 ? "min" : "max", {{"of", refs({a, b})}}));
    }
    return own;
  }
  return id;
}

// f <= max over the alternatives of the min of their bounds, and the same of -f.
TEST(LinearParts, AreAboveTheField) {
  std::size_t several = 0;
  for_all([&](Rng& rng) {
    std::vector<NodeSpec> nodes;
    SceneSpec scene;
    scene.solid = add_tree(nodes, rng, integer(rng, 1, 4));
    scene.nodes = nodes;
    const ScalarField field = build_scene(scene).field;
    const Vec3 c = random_vector(rng, 1.0), h = 0.5 * (random_vector(rng, 0.5).array() + 0.6).matrix();
    const Box box{c - h, c + h};
    for (const double sign : {1.0, -1.0}) {
      const LinearParts parts = linear_parts(field.model(), box, sign);
      several += parts.bounds.size() > 1 ? 1 : 0;
      for (int i = 0; i < 30; ++i) {
        const Vec3 t = random_vector(rng, 1.0), x = box.centre() + 0.5 * box.size().cwiseProduct(t);
        double top = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < parts.alternatives(); ++k) {
          const auto bounds = parts.alternative(k);
          top = std::max(top, least_at({bounds.begin(), bounds.end()}, t));
        }
        EXPECT_LE(sign * field.value(x), top + 1e-14);
      }
    }
  });
  EXPECT_GT(several, 100u);
}

}  // namespace
}  // namespace blendwright::test
