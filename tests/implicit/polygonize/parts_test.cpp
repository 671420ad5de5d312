// The parts that polygonize() is made of.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "implicit/polygonize/block_tree.hpp"
#include "implicit/polygonize/edge_roots.hpp"
#include "implicit/polygonize/mesh_flips.hpp"
#include "tests/implicit/polygonize/fields.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::detail {
namespace {

using test::box_of;
using test::for_all;
using test::Rng;

TEST(CellGrid, AroundBoundsHasMultiplesOfTheCellAndAMargin) {
  const CellGrid grid = CellGrid::around({Vec3(-1.0, 0.3, 0.25), Vec3(1.0, 0.9, 0.5)}, 0.25);
  EXPECT_EQ(grid.box(), (Box{Vec3(-1.25, 0.0, 0.0), Vec3(1.25, 1.25, 0.75)}));
  EXPECT_EQ(grid.cells(0), 10u);
  EXPECT_EQ(grid.cells(1), 5u);
  EXPECT_EQ(grid.cells(2), 3u);
  EXPECT_EQ(grid.at(0, 5), 0.0);
  EXPECT_EQ(grid.cell(), 0.25);
}

TEST(CellGrid, OfABoxMeetsItsSidesWithCellsOfAtMostTheEdgeAsked) {
  for_all([](Rng& rng) {
    const double lo = test::uniform(rng, -9.0, 9.0), length = test::log_uniform(rng, 0.01, 50.0),
                 cell = test::log_uniform(rng, 0.05, 5.0);
    const CellGrid grid = CellGrid::in({Vec3::Constant(lo), Vec3::Constant(lo + length)}, cell);
    const std::uint32_t n = grid.cells(0);
    EXPECT_EQ(grid.at(0, 0), lo);
    EXPECT_EQ(grid.at(0, n), lo + length);
    EXPECT_LE(grid.cell(), cell * (1.0 + 1e-11));  // a quotient is a whole number up to 1e-12
    if (n > 1) {
      EXPECT_GT(length / (n - 1), cell * (1.0 - 1e-11));  // one cell less would be too few
    }
    for (std::uint32_t i = 0; i < n; ++i) EXPECT_LT(grid.at(0, i), grid.at(0, i + 1));
  });
}

TEST(CellGrid, OfASymmetricBoxIsSymmetric) {
  const CellGrid grid = CellGrid::in(box_of(0.7), 0.1);
  for (std::uint32_t i = 0; i <= grid.cells(0); ++i) EXPECT_EQ(grid.at(0, i), -grid.at(0, grid.cells(0) - i));
}

/// Blocks with corners on both sides, found one by one.
std::set<GridIndex> blocks_with_sign_change(const ScalarField& field, const CellGrid& grid) {
  std::set<GridIndex> found;
  for (std::uint32_t z = 0; z < grid.blocks(2); ++z)
    for (std::uint32_t y = 0; y < grid.blocks(1); ++y)
      for (std::uint32_t x = 0; x < grid.blocks(0); ++x) {
        const BlockPlace place(grid, {x, y, z});
        const Points corners = corner_points(grid, place);
        std::vector<double> values(corners.size());
        field.model().evaluate(Order::value, corners.arrays(), values);
        const auto positive = std::count_if(values.begin(), values.end(), [](double v) { return v > 0.0; });
        if (positive != 0 && positive != static_cast<std::ptrdiff_t>(values.size())) found.insert({x, y, z});
      }
  return found;
}

TEST(LiveBlocks, HaveEverySignChangeAndComeInTheOrderOfTheirKeys) {
  std::size_t kept = 0, all = 0;
  for_all(
      [&](Rng& rng) {
        std::vector<ScalarField> balls;
        for (int n = test::integer(rng, 1, 4); n > 0; --n) {
          const double x = test::uniform(rng, -2.0, 2.0), y = test::uniform(rng, -2.0, 2.0);
          balls.push_back(test::ball(Vec3(x, y, 0.5 * (x + y)), test::uniform(rng, 0.3, 1.5)));
        }
        const ScalarField field = test::union_of(balls);
        const CellGrid grid = CellGrid::around(*field.bounds(), test::log_uniform(rng, 0.03, 0.1));
        const LiveBlocks live = find_live_blocks(field, grid, true, std::size_t{1} << 30, {});
        EXPECT_TRUE(std::is_sorted(live.keys.begin(), live.keys.end(), std::less_equal<>{}));
        for (std::size_t n = 0; n < live.blocks.size(); ++n) EXPECT_EQ(live.find(live.blocks[n].at), n);
        const auto needed = blocks_with_sign_change(field, grid);
        EXPECT_FALSE(needed.empty());
        for (const GridIndex& at : needed) EXPECT_TRUE(live.find(at).has_value());
        kept += live.blocks.size();
        all += std::size_t{grid.blocks(0)} * grid.blocks(1) * grid.blocks(2);
      },
      30);
  EXPECT_LT(kept, all);  // some are dropped
}

TEST(LiveBlocks, InsideTheSolidAreKeptAtTheBoxOnly) {
  const ScalarField field = test::ball(Vec3::Zero(), 10.0);
  const CellGrid grid = CellGrid::in({Vec3(-4, -4, -4), Vec3(12, 4, 4)}, 0.25);  // 8 x 4 x 4 blocks
  const LiveBlocks with = find_live_blocks(field, grid, true, std::size_t{1} << 30, {});
  const LiveBlocks without = find_live_blocks(field, grid, false, std::size_t{1} << 30, {});
  EXPECT_TRUE(with.inside_at_side);
  EXPECT_TRUE(without.inside_at_side);
  EXPECT_EQ(with.crossed, without.blocks.size());
  EXPECT_GT(with.blocks.size(), with.crossed);
  for (const LiveBlock& block : with.blocks)
    if (block.inside) {
      EXPECT_TRUE(BlockPlace(grid, block.at).at_side());
    }
}

// Corners on the surface: a range that ends at the surface's value on the outer side is dead, on the inner
// side it is not.
TEST(LiveBlocks, AreDeadWhereTheRangeOnlyTouchesTheSurfaceFromOutside) {
  const auto constant = [](double value) {
    return std::make_shared<test::SlopeField>(
        [=](const Vec3&) {
          return test::ValueAndGradient{value, Vec3::Zero()};
        },
        0.0);
  };
  const CellGrid grid = CellGrid::in(box_of(1.0), 0.25);
  // The ranges of SlopeField have a margin of 1e-14.
  for (const auto& [value, count] : {std::pair(-1e-14, 0u), {0.0, 1u}, {1e-14, 1u}, {3e-14, 0u}}) {
    const ScalarField field(constant(value), Level::function);
    EXPECT_EQ(find_live_blocks(field, grid, false, std::size_t{1} << 30, {}).blocks.size(), count) << value;
  }
}

TEST(LinearCrossing, StaysWithinItsMarginsForAnyValues) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(linear_crossing(1.0, -3.0), 0.25);
  EXPECT_DOUBLE_EQ(linear_crossing(-3.0, 1.0), 0.75);
  EXPECT_EQ(linear_crossing(1.0, 0.0), 1.0 - edge_margin);
  EXPECT_EQ(linear_crossing(0.0, 1e-300), edge_margin);
  EXPECT_EQ(linear_crossing(inf, -inf), 0.5);
  EXPECT_EQ(linear_crossing(inf, -1.0), 1.0 - edge_margin);
  EXPECT_EQ(linear_crossing(1.0, -inf), edge_margin);
  EXPECT_DOUBLE_EQ(linear_crossing(1.7e308, -1.7e308), 0.5);
}

/// The root of f(x) on the edge from x = 0 to 1.
double root_of(const std::function<double(double)>& f) {
  const auto model = std::make_shared<test::SlopeField>(
      [f](const Vec3& p) {
        return test::ValueAndGradient{f(p.x()), Vec3::Zero()};
      },
      1.0);
  const CellGrid grid = CellGrid::in({Vec3::Zero(), Vec3::Ones()}, 1.0);
  const GridEdge edge{0, 0, 0, 0};
  std::size_t evaluated = 0;
  const auto roots =
      edge_roots(grid, *model, Level::function, BlockPlace(grid, {0, 0, 0}), std::span(&edge, 1), evaluated);
  EXPECT_LE(evaluated, 120u);  // every third step halves: 3 log2(1e10) = 100
  return roots.front();
}

TEST(EdgeRoots, AreExactForSmoothSteepAndDiscontinuousFields) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(root_of([](double x) { return 0.3 - x; }), 0.3, 1e-10);
  EXPECT_NEAR(root_of([](double x) { return x * x * x - 0.125; }), 0.5, 1e-10);
  EXPECT_NEAR(root_of([](double x) { return std::cbrt(x - 0.7); }), 0.7, 1e-10);
  EXPECT_NEAR(root_of([](double x) { return std::pow(x - 0.6, 9); }), 0.6, 1e-10);
  EXPECT_NEAR(root_of([](double x) { return x < 0.123 ? 1.0 : -1e6; }), 0.123, 1e-10);
  EXPECT_NEAR(root_of([=](double x) { return x < 0.9 ? inf : -inf; }), 0.9, 1e-10);
  EXPECT_EQ(root_of([](double x) { return x - 1e-3; }), edge_margin);
}

// Point 2 belongs below the diagonal 0-1, but has moved above it.
TEST(Flips, TurnAFoldedPairIntoTwoGoodFaces) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}, {0.5, 1, 0}};
  std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}};
  const auto area = [&](const Triangle& t) {
    return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).z();
  };
  ASSERT_LT(area(triangles[0]), 0.0);
  const double whole = area(triangles[0]) + area(triangles[1]);
  flip_unacceptable_faces(triangles, points.size(), {0},
                          [&](std::size_t, const Triangle& t) { return area(t) > 0.0; });
  EXPECT_GT(area(triangles[0]), 0.0);
  EXPECT_GT(area(triangles[1]), 0.0);
  EXPECT_DOUBLE_EQ(area(triangles[0]) + area(triangles[1]), whole);
}

TEST(Flips, NeverMakeAnEdgeThatIsThere) {
  // A tetrahedron: every other diagonal is an edge of it.
  const std::vector<Triangle> tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  std::vector<Triangle> triangles = tetrahedron;
  flip_unacceptable_faces(triangles, 4, {0},
                          [&](std::size_t, const Triangle& t) { return t != tetrahedron[0]; });
  EXPECT_EQ(triangles, tetrahedron);
}

TEST(Flips, LeaveFacesWithoutABetterDiagonal) {
  std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}};
  flip_unacceptable_faces(triangles, 4, {0, 1}, [](std::size_t, const Triangle&) { return false; });
  EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}}));
}

}  // namespace
}  // namespace blendwright::detail
