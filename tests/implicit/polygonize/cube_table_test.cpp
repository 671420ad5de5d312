#include "implicit/polygonize/cube_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace blendwright::detail {
namespace {

using Corner = std::array<int, 3>;
using Key = std::array<int, 4>;                                   ///< a grid edge: axis and its lower corner
using Uses = std::map<std::pair<Key, Key>, std::pair<int, int>>;  ///< of an edge: forwards, backwards

Key key(const Corner& cell, int edge) {
  const CubeEdge& e = cube_edges[static_cast<std::size_t>(edge)];
  return {e.axis, cell[0] + e.low[0], cell[1] + e.low[1], cell[2] + e.low[2]};
}

void add(Uses& uses, const Corner& cell, unsigned inside) {
  for (const CubeTriangle& t : cube_triangles(inside))
    for (std::size_t n = 0; n < 3; ++n) {
      const Key a = key(cell, t[n]), b = key(cell, t[(n + 1) % 3]);
      if (a < b) {
        ++uses[{a, b}].first;
      } else {
        ++uses[{b, a}].second;
      }
    }
}

/// Twice the midpoint of a grid edge.
Corner twice_middle(const Key& k) {
  Corner p{2 * k[1], 2 * k[2], 2 * k[3]};
  ++p[static_cast<std::size_t>(k[0])];
  return p;
}
/// Both vertices lie in the plane where twice the coordinate is `at`.
bool in_plane(const std::pair<Key, Key>& edge, std::size_t axis, int at) {
  return twice_middle(edge.first)[axis] == at && twice_middle(edge.second)[axis] == at;
}
bool in_a_face_of_unit_cell(const std::pair<Key, Key>& edge) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (in_plane(edge, axis, 0) || in_plane(edge, axis, 2)) return true;
  return false;
}

TEST(CubeTable, UsesEveryCrossedEdgeAndNoOther) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    std::set<int> used, crossed;
    for (const CubeTriangle& t : cube_triangles(inside)) used.insert(t.begin(), t.end());
    for (int a = 0; a < 8; ++a)
      for (int axis = 0; axis < 3; ++axis) {
        const int b = a | 1 << axis;
        if (b != a && (inside >> a & 1u) != (inside >> b & 1u)) crossed.insert(cube_edge_between(a, b));
      }
    EXPECT_EQ(used, crossed) << inside;
  }
}

TEST(CubeTable, OneCornerIsCutOffByATriangleThatFacesAwayFromIt) {
  const auto triangles = cube_triangles(1u);
  ASSERT_EQ(triangles.size(), 1u);
  // Edges 0, 4, 8 start at corner 0 along x, y, z; in this order they turn left seen from (1, 1, 1).
  const CubeTriangle& t = triangles[0];
  const std::set<CubeTriangle> turned_left{{0, 4, 8}, {4, 8, 0}, {8, 0, 4}};
  EXPECT_TRUE(turned_left.count(t) == 1);
}

TEST(CubeTable, EdgesInACellAreUsedTwiceAndEdgesInItsFacesOnce) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    Uses uses;
    add(uses, {0, 0, 0}, inside);
    for (const auto& [edge, count] : uses) {
      if (in_a_face_of_unit_cell(edge)) {
        EXPECT_EQ(count.first + count.second, 1) << "a chord lies in a face, case " << inside;
      } else {
        EXPECT_EQ(count, std::pair(1, 1)) << inside;
      }
    }
  }
}

// Two cells that share a face have 12 corners: all 4096 choices along each axis.
TEST(CubeTable, NeighboursMeetInTheirCommonFace) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (unsigned corners = 0; corners < 4096; ++corners) {
      Uses uses;
      for (int cell = 0; cell < 2; ++cell) {
        unsigned inside = 0;
        for (unsigned c = 0; c < 8; ++c) {
          const unsigned along = (c >> axis & 1u) + static_cast<unsigned>(cell);
          const unsigned u = c >> (axis + 1) % 3 & 1u, v = c >> (axis + 2) % 3 & 1u;
          inside |= (corners >> (along * 4 + u * 2 + v) & 1u) << c;
        }
        Corner at{};
        at[axis] = cell;
        add(uses, at, inside);
      }
      for (const auto& [edge, count] : uses)
        if (in_plane(edge, axis, 2)) {
          ASSERT_EQ(count, std::pair(1, 1)) << "axis " << axis << ", corners " << corners;
        }
    }
}

TEST(CubeTable, SquaresAreCoveredWhereTheirCornersAreInside) {
  // With crossings at the middles: a corner has a quarter of the square's half... areas by the runs' lengths.
  const std::array<std::array<double, 2>, 8> place{
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}}};
  for (unsigned inside = 0; inside < 16; ++inside) {
    double area = 0.0;
    for (const CubeTriangle& t : square_triangles(inside)) {
      const auto &a = place[t[0]], &b = place[t[1]], &c = place[t[2]];
      const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      EXPECT_GT(twice, 0.0) << inside;
      area += 0.5 * twice;
    }
    const int count = std::popcount(inside);
    const bool apart = inside == 5u || inside == 10u;
    const double expected = count == 0   ? 0.0
                            : count == 1 ? 0.125
                            : apart      ? 0.25
                            : count == 2 ? 0.5
                            : count == 3 ? 0.875
                                         : 1.0;
    EXPECT_DOUBLE_EQ(area, expected) << inside;
  }
}

}  // namespace
}  // namespace blendwright::detail
