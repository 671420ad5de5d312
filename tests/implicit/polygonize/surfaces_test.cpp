// Meshes of solids whose measures are known.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "implicit/polygonize/polygonize.hpp"
#include "tests/implicit/polygonize/fields.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::ball;
using test::box_of;
using test::for_all;
using test::Rng;
using test::torus;
constexpr double pi = std::numbers::pi;

FieldMesh meshed(const ScalarField& field, double cell, std::optional<Box> box = std::nullopt,
                 MeshOptions::AtBox at_box = MeshOptions::AtBox::cap) {
  MeshOptions options;
  options.cell = cell;
  options.box = box;
  options.at_box = at_box;
  return polygonize(field, options);
}

void expect_no_defects(const FieldMesh& made, double cell) {
  const MeshDefects d = find_defects(made.mesh, cell);
  EXPECT_TRUE(d.none()) << d.open_edges << " open " << d.overused_edges << " overused " << d.flipped_edges
                        << " flipped " << d.degenerate_faces << " degenerate " << d.repeated_points
                        << " repeated";
}

const Column& column(const TriMesh& mesh, std::string_view name) {
  for (const Column& c : mesh.columns)
    if (c.name == name) return c;
  throw std::logic_error("no column " + std::string(name));
}

ScalarField double_torus() {
  return test::union_of({torus(Vec3(-1.2, 0, 0), 1.0, 0.35), torus(Vec3(1.2, 0, 0), 1.0, 0.35)});
}

TEST(MeshOfABall, HasItsTopologyAndLiesOnIt) {
  for_all(
      [](Rng& rng) {
        const double x = test::uniform(rng, -1.0, 1.0), y = test::uniform(rng, -1.0, 1.0),
                     z = test::uniform(rng, -1.0, 1.0), r = test::uniform(rng, 0.5, 2.0);
        const double cell = test::log_uniform(rng, 0.03, 0.4);
        const FieldMesh made = meshed(ball(Vec3(x, y, z), r), cell);
        expect_no_defects(made, cell);
        EXPECT_EQ(made.facts.euler_characteristic, 2);
        EXPECT_EQ(made.facts.components, 1u);
        EXPECT_FALSE(made.facts.cut_by_box);
        EXPECT_LE(made.facts.largest_distance, 1e-6 * cell);
        for (std::size_t v = 0; v < made.mesh.points.size(); ++v) {
          const Vec3 out = made.mesh.points[v] - Vec3(x, y, z);
          ASSERT_NEAR(out.norm(), r, 1e-6 * cell);
          ASSERT_NEAR(made.mesh.normals[v].dot(out) / out.norm(), 1.0, 1e-12);
          // The second derivatives are differences with step 1e-5: error of third derivatives 1e-10, rounding
          // 1e-16 / 1e-5 = 1e-11, both relative to curvatures of at most 2 and 4.
          ASSERT_NEAR(column(made.mesh, "mean_curvature").values[v], 1.0 / r, 1e-8);
          ASSERT_NEAR(column(made.mesh, "gaussian_curvature").values[v], 1.0 / (r * r), 1e-8);
        }
      },
      50);
}

TEST(MeshOfATorus, HasNoCharacteristicAndOneComponent) {
  const FieldMesh made = meshed(torus(Vec3(0.1, 0.2, 0.3), 1.0, 0.4), 0.1);
  expect_no_defects(made, 0.1);
  EXPECT_EQ(made.facts.euler_characteristic, 0);
  EXPECT_EQ(made.facts.components, 1u);
  EXPECT_LE(made.facts.largest_distance, 1e-7);
}

TEST(MeshOfADoubleTorus, HasCharacteristicMinusTwo) {
  const FieldMesh made = meshed(double_torus(), 0.07);
  expect_no_defects(made, 0.07);
  EXPECT_EQ(made.facts.euler_characteristic, -2);
  EXPECT_EQ(made.facts.components, 1u);
  EXPECT_LE(made.facts.largest_distance, 1e-2 * 0.07);
}

TEST(MeshOfSeparateBalls, CountsThem) {
  const FieldMesh made = meshed(
      test::union_of({ball(Vec3(-2, 0, 0), 1.0), ball(Vec3(2, 0, 0), 1.0), ball(Vec3(0, 3, 0), 0.5)}), 0.1);
  expect_no_defects(made, 0.1);
  EXPECT_EQ(made.facts.components, 3u);
  EXPECT_EQ(made.facts.euler_characteristic, 6);
  // Every vertex is nearest to the ball that it lies on.
  const auto& member = column(made.mesh, "member").values;
  for (std::size_t v = 0; v < member.size(); ++v) {
    const Vec3& p = made.mesh.points[v];
    const double expected = p.y() > 2.0 ? 2.0 : p.x() > 0.0 ? 1.0 : 0.0;
    ASSERT_EQ(member[v], expected);
  }
}

// A mesh with vertices on a surface of curvature k is within k cell^2 of it and its measures are wrong by
// that: halving the cell divides errors by 4. Errors are means over many faces, so the ratio scatters little;
// 3 and 5 tell second order from first (2) and third (8).
TEST(MeasuresOfMeshes, ConvergeWithTheSquareOfTheCell) {
  struct Case {
    ScalarField field;
    double area, volume;
  };
  const Case cases[] = {{ball(Vec3(0.01, 0.02, 0.03), 1.0), 4.0 * pi, 4.0 / 3.0 * pi},
                        {torus(Vec3(0.01, 0.02, 0.03), 1.0, 0.4), 4.0 * pi * pi * 0.4, 2.0 * pi * pi * 0.16}};
  for (const Case& c : cases) {
    const FieldMesh coarse = meshed(c.field, 0.08), fine = meshed(c.field, 0.04);
    const double area_ratio = (c.area - coarse.facts.area) / (c.area - fine.facts.area);
    const double volume_ratio = (c.volume - coarse.facts.volume) / (c.volume - fine.facts.volume);
    EXPECT_GT(area_ratio, 3.0);
    EXPECT_LT(area_ratio, 5.0);
    EXPECT_GT(volume_ratio, 3.0);
    EXPECT_LT(volume_ratio, 5.0);
    EXPECT_NEAR(fine.facts.area, c.area, 0.04 * 0.04 * c.area / 0.16);
  }
}

TEST(MeshOfACube, FollowsItsCreases) {
  for_all(
      [](Rng& rng) {
        const double a = test::uniform(rng, 0.3, 1.0), b = test::uniform(rng, 0.3, 1.0),
                     c = test::uniform(rng, 0.3, 1.0);
        const double cell = test::log_uniform(rng, 0.02, 0.2);
        const FieldMesh made = meshed(test::cube(Vec3(a, b, c)), cell);
        expect_no_defects(made, cell);
        EXPECT_EQ(made.facts.euler_characteristic, 2);
        EXPECT_LE(made.facts.largest_distance, 1e-2 * cell);
        // Faces lie on the cube except those across an edge, which cut it by at most half a cell squared.
        EXPECT_NEAR(made.facts.volume, 8 * a * b * c, 0.5 * cell * cell * 8 * (a + b + c));
      },
      50);
}

TEST(MeshOfRandomFields, IsClosedAndOnTheSurface) {
  for_all(
      [](Rng& rng) {
        const ScalarField field = test::random_balls(rng.next(), test::integer(rng, 1, 12));
        const double cell = test::log_uniform(rng, 0.08, 0.4);
        const FieldMesh made = meshed(field, cell);
        expect_no_defects(made, cell);
        EXPECT_LE(made.facts.largest_distance, 1e-6 * cell);
        EXPECT_EQ(made.facts.without_normal, 0u);
        // Blobs have radii of about 0.5: cells of a quarter of that leave no face turned.
        if (cell < 0.12) {
          EXPECT_EQ(made.facts.turned_faces, 0u);
        }
        EXPECT_EQ(made.facts.euler_characteristic % 2, 0);
      },
      100);
}

// Radii and planes of whole cells: the field is exactly 0 on grid points.
TEST(ZeroOnGridPoints, MakesNoDegenerateFace) {
  for (const int cells : {1, 2, 3, 5, 9, 13, 25}) {
    const FieldMesh made = meshed(ball(Vec3::Zero(), 0.25 * cells), 0.25);
    expect_no_defects(made, 0.25);
    EXPECT_EQ(made.facts.euler_characteristic, 2) << cells;
    EXPECT_LE(made.facts.largest_distance, 1e-6 * 0.25);
  }
  for (const int cells : {1, 2, 8, 9}) {
    const FieldMesh made = meshed(test::cube(Vec3::Constant(0.25 * cells)), 0.25);
    expect_no_defects(made, 0.25);
    EXPECT_EQ(made.facts.euler_characteristic, 2) << cells;
  }
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(1, 1, 0), Vec3(1, -1, 1), Vec3(1, 2, 0)}) {
    const FieldMesh made = meshed(test::half_space(normal, 0.0), 0.25, box_of(2.0));
    expect_no_defects(made, 0.25);
    EXPECT_TRUE(made.facts.cut_by_box);
    // The plane through the centre halves the box; the mesh of a plane is exact.
    EXPECT_NEAR(made.facts.volume, 32.0, 1e-9) << normal.transpose();
  }
}

TEST(ZeroIsOutside, ForFieldsThatAreZeroInAVolume) {
  // max(0, ball) as a solid > 0: zero outside of the ball, in whole blocks.
  const auto base = ball(Vec3::Zero(), 1.0).shared_model();
  const auto flat = std::make_shared<test::SlopeField>(
      [base](const Vec3& p) {
        const double r = p.norm();
        return r < 1.0 ? test::ValueAndGradient{1.0 - r, r > 0.0 ? Vec3(-p / r) : Vec3(Vec3::Zero())}
                       : test::ValueAndGradient{};
      },
      1.0);
  const FieldMesh made = meshed(ScalarField(flat, Level::function, box_of(2.0)), 0.1);
  expect_no_defects(made, 0.1);
  EXPECT_EQ(made.facts.euler_characteristic, 2);
}

TEST(LevelsOfOneSolid, GiveTheSameTriangles) {
  const FieldMesh reference = meshed(ball(Vec3::Zero(), 1.0), 0.2);
  struct Convention {
    Level level;
    double scale;  ///< value = surface value + scale * (1 - r)
  };
  for (const auto& [level, scale] : {Convention{Level::zero, -1.0}, {Level::one, -1.0}, {Level::half, 1.0}}) {
    const double at_surface = surface_value(level), factor = scale;
    const auto model = std::make_shared<test::SlopeField>(
        [=](const Vec3& p) {
          const double r = p.norm();
          return test::ValueAndGradient{at_surface + factor * (1.0 - r),
                                        r > 0.0 ? Vec3(-factor * p / r) : Vec3(Vec3::Zero())};
        },
        1.0);
    const FieldMesh made = meshed(ScalarField(model, level, box_of(1.0)), 0.2);
    EXPECT_EQ(made.mesh.triangles, reference.mesh.triangles) << name(level);
    EXPECT_GT(made.facts.volume, 0.0);
    EXPECT_LE(made.facts.largest_distance, 1e-6 * 0.2);
  }
}

TEST(ACutSolid, IsCappedInTheSidesOfTheBox) {
  const Box box{Vec3(-0.5, -2.0, -2.0), Vec3(2.0, 0.25, 2.0)};
  const FieldMesh made = meshed(ball(Vec3::Zero(), 1.0), 0.1, box);
  expect_no_defects(made, 0.1);
  EXPECT_TRUE(made.facts.cut_by_box);
  EXPECT_EQ(made.facts.euler_characteristic, 2);
  const auto& distance = column(made.mesh, "distance_error").values;
  std::size_t on_cap = 0;
  for (std::size_t v = 0; v < made.mesh.points.size(); ++v) {
    const Vec3& p = made.mesh.points[v];
    ASSERT_TRUE(box.contains(p));
    if (std::isnan(distance[v])) {
      ++on_cap;
      EXPECT_TRUE(p.x() == -0.5 || p.y() == 0.25);
      EXPECT_LT(p.norm(), 1.0);
    } else {
      EXPECT_NEAR(p.norm(), 1.0, 1e-7);
    }
  }
  EXPECT_GT(on_cap, 100u);
}

TEST(ACutSolid, IsLeftOpenInTheSidesOfTheBox) {
  const Box box{Vec3(-0.5, -2.0, -2.0), Vec3(2.0, 0.25, 2.0)};
  const FieldMesh made = meshed(ball(Vec3::Zero(), 1.0), 0.1, box, MeshOptions::AtBox::open);
  EXPECT_TRUE(made.facts.cut_by_box);
  EXPECT_EQ(made.facts.euler_characteristic, 1);  // a disc
  const MeshDefects d = find_defects(made.mesh, 0.1);
  EXPECT_EQ(d.overused_edges + d.flipped_edges + d.degenerate_faces + d.repeated_points, 0u);
  EXPECT_GT(d.open_edges, 0u);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : made.mesh.triangles)
    for (std::size_t n = 0; n < 3; ++n) ++uses[std::minmax(t[n], t[(n + 1) % 3])];
  for (const auto& [edge, count] : uses) {
    if (count != 1) continue;
    const Vec3 &p = made.mesh.points[edge.first], &q = made.mesh.points[edge.second];
    EXPECT_TRUE((p.x() == -0.5 && q.x() == -0.5) || (p.y() == 0.25 && q.y() == 0.25));
  }
}

TEST(AGyroid, IsClosedByItsCap) {
  const FieldMesh made = meshed(test::gyroid(2.0), 0.1, box_of(2.0));
  expect_no_defects(made, 0.1);
  EXPECT_TRUE(made.facts.cut_by_box);
  EXPECT_EQ(made.facts.turned_faces, 0u);
  // The surface passes through some corners of the box: there the mesh has a vertex at the corner that cannot
  // move, and next to it vertices that keep their distance from it.
  const auto& distance = column(made.mesh, "distance_error").values;
  for (std::size_t v = 0; v < distance.size(); ++v) {
    const bool at_box_corner = (made.mesh.points[v].cwiseAbs() - Vec3::Constant(2.0)).norm() < 0.001;
    ASSERT_TRUE(std::isnan(distance[v]) || std::abs(distance[v]) <= (at_box_corner ? 5e-3 * 0.1 : 1e-7));
  }
  // Odd in p: the gyroid and its complement are mirror images, so each fills half of a symmetric box.
  EXPECT_NEAR(made.facts.volume, 32.0, 32.0 * 0.1 * 0.1);
}

TEST(ABoxThatIsNoMultipleOfTheCell, IsMetExactly) {
  const Box box{Vec3(-0.33, -0.71, -0.2), Vec3(0.57, 0.4, 0.91)};
  const FieldMesh made = meshed(test::half_space(Vec3(0, 0, 1), 0.3), 0.1, box);
  expect_no_defects(made, 0.1);
  const Vec3 size = box.size();
  EXPECT_NEAR(made.facts.volume, size.x() * size.y() * 0.5, 1e-12);
  EXPECT_NEAR(made.facts.area, 2 * size.x() * size.y() + 2 * 0.5 * (size.x() + size.y()), 1e-12);
}

TEST(Projection, StaysInTheBoxesOfShortenedModels) {
  const ScalarField field = double_torus();
  const Box whole = box_of(4.0);
  auto strays = std::make_shared<std::atomic<int>>(0);
  const auto guarded = std::make_shared<test::Guarded>(field.shared_model(), whole, strays);
  const FieldMesh made = meshed(ScalarField(guarded, Level::function, field.bounds()), 0.1);
  EXPECT_EQ(strays->load(), 0);
  (void)guarded->within(box_of(1.0)).model->range(box_of(1.5));  // the guard does count
  EXPECT_EQ(strays->load(), 1);
  const FieldMesh plain = meshed(field, 0.1);
  EXPECT_EQ(made.mesh.triangles, plain.mesh.triangles);
  EXPECT_EQ(made.mesh.points, plain.mesh.points);
}

}  // namespace
}  // namespace blendwright
