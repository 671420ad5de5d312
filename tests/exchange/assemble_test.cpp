// Blends joined with trimmed primaries. Every joint here is ruled between known trimlines, so that its area
// and its free edges are known in closed form.
#include <gtest/gtest.h>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>

#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/shape_impl.hpp"
#include "kernel/brep/shape_mesh.hpp"
#include "tests/exchange/joints.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

constexpr double tolerance = 1e-6;

/// What every joint must fulfil. The CAD kernel's area integration is asked for 1e-6 relative.
ShapeCheck expect_sound(const AssemblyResult& result, std::size_t faces, std::size_t free_edges,
                        double area) {
  const ShapeCheck c = check_shape(result.shape);
  EXPECT_TRUE(c.valid) << ::testing::PrintToString(c.problems);
  EXPECT_TRUE(result.warnings.empty()) << ::testing::PrintToString(result.warnings);
  EXPECT_LE(c.largest_tolerance, tolerance);
  EXPECT_LE(c.largest_edge_gap, tolerance);
  EXPECT_GE(c.largest_edge_gap, 0.0);
  EXPECT_EQ(c.faces, faces);
  EXPECT_EQ(c.free_edges, free_edges);
  EXPECT_EQ(c.unexpected_free_edges, 0u);
  if (area > 0.0) {
    EXPECT_NEAR(c.area, area, 1e-5 * area);
  }
  return c;
}

TEST(Assemble, ClosedBlendSharesItsTrimlinesWithBothPrimaries) {
  const ShapeCheck c = expect_sound(assemble(coaxial(), tolerance), 3, 2, coaxial_area);
  EXPECT_EQ(c.shells, 1u);
  EXPECT_EQ(c.solids, 0u);
}

TEST(Assemble, StartOfTheTrimlineNeedNotLieOnTheSeam) {
  for_all(
      [](Rng& rng) {
        expect_sound(assemble(coaxial(uniform(rng, -7.0, 7.0)), tolerance), 3, 2, coaxial_area);
      },
      12);
}

TEST(Assemble, WavyTrimlinesFollowTheirFormula) {
  const auto result = assemble(joint({"upper", cylinder(1.0, {4.0, 9.0}), wave(5.5, 0.4, 2.0, 0.7), false},
                                     {"lower", cylinder(2.0, {-2.0, 4.0}), wave(2.5, 0.5, 3.0, 0.7), true}),
                               tolerance);
  // A wave of whole periods leaves the mean height: areas 2 pi r h of the cylinders.
  const double bands = 2.0 * pi * 3.5 + 4.0 * pi * 4.5;
  const ShapeCheck c = expect_sound(result, 3, 2, 0.0);
  EXPECT_GT(c.area, bands);
}

TEST(Assemble, TwoTrimlinesOnOnePrimaryMayStartAtDifferentAngles) {
  Assembly a = coaxial(0.4);
  const Assembly b = joint({"lower", cylinder(2.0, {-2.0, 4.0}), line({-1.0, 2.9}, {0.0, 1.0}), false},
                           {"foot", cylinder(3.0, {-6.0, 0.0}), line({-2.5, 2.9}, {0.0, 1.0}), true});
  a.blends.push_back({"second", b.blends[0].surface, {}});
  for (PrimaryPatch p : b.primaries) {
    p.cuts[0].blend = 1;
    if (p.name == "lower")
      a.primaries[1].cuts.push_back(p.cuts[0]);
    else
      a.primaries.push_back(p);
  }
  const double area = 2.0 * pi * 4.0 + pi * 3.0 * std::sqrt(5.0) + 4.0 * pi * 4.0 +
                      pi * 5.0 * std::hypot(1.0, 1.5) + 6.0 * pi * 3.5;
  expect_sound(assemble(a, tolerance), 5, 2, area);
}

TEST(Assemble, TrimlineOnTheBorderKeepsTheWholePrimary) {
  const auto result =
      assemble(joint({"upper", cylinder(1.0, {5.0, 9.0}), line({5.0, 0.0}, {0.0, 1.0}), false},
                     {"lower", cylinder(2.0, {-2.0, 3.0}), line({3.0, 0.0}, {0.0, 1.0}), true}),
               tolerance);
  expect_sound(result, 3, 2, coaxial_area);
}

TEST(Assemble, LoopCutsAHoleOrADisc) {
  const auto make = [](bool outside) {
    return assemble(joint({"post", cylinder(1.0, {0.5, 4.0}), line({1.0, 0.3}, {0.0, 1.0}), false},
                          {"floor", plane({-5.0, 5.0}, {-5.0, 5.0}), circle({0.0, 0.0}, 2.0), !outside}),
                    tolerance);
  };
  const double without_floor = 2.0 * pi * 3.0;
  const ShapeCheck hole = expect_sound(make(true), 3, 5, 0.0), disc = expect_sound(make(false), 3, 1, 0.0);
  // Same blend, the floor is 100 - 4 pi or 4 pi.
  EXPECT_NEAR(hole.area - disc.area, 100.0 - 8.0 * pi, 1e-3);
  EXPECT_GT(disc.area, without_floor + 4.0 * pi);
}

TEST(Assemble, SpheresJoinedByANeckAreASolid) {
  const Surface below = sphere(2.0), above = moved(sphere(1.0), {0.0, 0.0, 5.0});
  const auto result = assemble(joint({"below", below, line({0.25 * pi, 0.0}, {0.0, 1.0}), true},
                                     {"above", above, line({-0.25 * pi, 0.0}, {0.0, 1.0}), false}),
                               tolerance);
  const double q = std::sqrt(0.5);
  const double r0 = 2.0 * q, r1 = q, h = 5.0 - q - 2.0 * q;
  const double area =
      2.0 * pi * 4.0 * (1.0 + q) + 2.0 * pi * (1.0 + q) + pi * (r0 + r1) * std::hypot(h, r0 - r1);
  EXPECT_EQ(expect_sound(result, 3, 0, area).solids, 1u);
}

TEST(Assemble, SurfacesWithoutStepEntityBecomeSplines) {
  const auto result = assemble(
      joint({"egg", ellipsoid(2.0, 1.5, 1.2), line({0.3, 1.9}, {0.0, 1.0}), true},
            {"ring", moved(cylinder(1.0, {0.0, 3.0}), {0.0, 0.0, 2.0}), line({0.5, 1.9}, {0.0, 1.0}), false}),
      tolerance);
  expect_sound(result, 3, 1, 0.0);
}

TEST(Assemble, TorusMayBeCutByAHoleOrByTwoRings) {
  const Surface t = torus(4.0, 1.0);
  // A loop about (pi, 0) crosses the seam of the second direction: the seam must move out of its way.
  const auto hole =
      assemble(joint({"tube", t, circle({1.0, 0.0}, 0.4), false},
                     {"far", moved(torus(4.0, 1.0), {0.0, 0.0, 6.0}), circle({-1.0, 0.0}, 0.4), false}),
               tolerance);
  expect_sound(hole, 3, 0, 0.0);
  // Rings u = 0.5 and u = 2: the outer part of the tube between u = 2 and u = 0.5 + 2 pi stays.
  Assembly a =
      joint({"tube", t, line({0.5, 0.2}, {0.0, 1.0}), true},
            {"a", moved(cylinder(5.0, {2.0, 9.0}), Vec3::Zero()), line({2.5, 0.2}, {0.0, 1.0}), false});
  const Assembly b = joint({"tube", t, line({2.0, 0.2}, {0.0, 1.0}), false},
                           {"b", cylinder(3.0, {2.0, 9.0}), line({2.5, 0.2}, {0.0, 1.0}), false});
  a.blends.push_back({"inner", b.blends[0].surface, {}});
  a.primaries[0].cuts.push_back(b.primaries[0].cuts[0]);
  a.primaries[0].cuts[1].blend = 1;
  a.primaries.push_back(b.primaries[1]);
  a.primaries.back().cuts[0].blend = 1;
  expect_sound(assemble(a, tolerance), 5, 2, 0.0);
}

TEST(Assemble, OpenBlendFromBorderToBorderDividesItsPrimaries) {
  // Two planes at a right angle over x in [0, 6], rounded by a ruled strip.
  Eigen::Matrix3d up;
  up << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // takes (u, v, 0) to (u, 0, v)
  const CurveDomain v{{0.0, 6.0}, false};
  const auto result =
      assemble(joint({"floor", plane({0.0, 6.0}, {0.0, 5.0}), line({0.0, 1.0}, {1.0, 0.0}, v), true},
                     {"wall", placed(plane({0.0, 6.0}, {0.0, 4.0}), {up, Vec3::Zero()}),
                      line({0.0, 1.0}, {1.0, 0.0}, v), true}),
               tolerance);
  expect_sound(result, 3, 3 + 3 + 2, 6.0 * (4.0 + 3.0 + std::sqrt(2.0)));
}

TEST(Assemble, OpenTrimlineThatEndsInsideIsContinuedAndSaidSo) {
  const CurveDomain v{{0.0, 4.0}, false};
  Eigen::Matrix3d up;
  up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const auto result =
      assemble(joint({"floor", plane({-1.0, 7.0}, {0.0, 5.0}), line({1.0, 1.0}, {1.0, 0.0}, v), true},
                     {"wall", placed(plane({1.0, 5.0}, {0.0, 4.0}), {up, Vec3::Zero()}),
                      line({1.0, 1.0}, {1.0, 0.0}, v), true}),
               tolerance);
  ASSERT_EQ(result.warnings.size(), 2u);
  EXPECT_NE(result.warnings[0].find("primary floor: the trimline of blend blend (from) ends inside"),
            std::string::npos);
  const ShapeCheck c = check_shape(result.shape);
  EXPECT_TRUE(c.valid) << ::testing::PrintToString(c.problems);
  EXPECT_EQ(c.unexpected_free_edges, 0u);
  // The nearest border is v = 0, one unit away: the floor loses the rectangle 4 x 1 between the line and it.
  EXPECT_NEAR(c.area, 8.0 * 5.0 - 4.0 + 4.0 * 3.0 + 4.0 * std::sqrt(2.0), 1e-4);
}

TEST(Assemble, OpenTrimlineOnAFullCylinderIsContinuedAlongItsRulings) {
  const CurveDomain v{{0.0, 2.0}, false};
  const auto result =
      assemble(joint({"post", cylinder(1.0, {0.0, 4.0}), line({1.0, 0.5}, {0.0, 1.0}, v), false},
                     {"shell", cylinder(2.0, {0.0, 1.0}, {0.5, 2.5}), line({0.5, 0.5}, {0.0, 1.0}, v), true}),
               tolerance);
  EXPECT_EQ(result.warnings.size(), 2u) << ::testing::PrintToString(result.warnings);
  const ShapeCheck c = check_shape(result.shape);
  EXPECT_TRUE(c.valid) << ::testing::PrintToString(c.problems);
  EXPECT_EQ(c.unexpected_free_edges, 0u);
  EXPECT_LE(c.largest_tolerance, tolerance);
}

TEST(Assemble, OpenTrimlineWhoseEndsMeetIsALoop) {
  const CurveDomain v{{0.0, 2.0 * pi}, false};
  const auto result =
      assemble(joint({"post", cylinder(1.0, {0.5, 4.0}), line({1.0, 0.0}, {0.0, 1.0}, v), false},
                     {"floor", plane({-5.0, 5.0}, {-5.0, 5.0}), circle({0.0, 0.0}, 2.0, v), false}),
               tolerance);
  expect_sound(result, 3, 5, 0.0);
}

TEST(Assemble, ExportedSplineIsTheSameSurface) {
  const BSplineSurface ours = coaxial(0.3).blends[0].surface;
  const auto theirs = detail::to_occt(ours);
  const auto back = detail::from_occt(theirs);
  ASSERT_TRUE(back);
  EXPECT_TRUE(theirs->IsVPeriodic());
  for_all([&](Rng& rng) {
    const UV p{uniform(rng, 0.0, 1.0), uniform(rng, 0.0, 2.0 * pi)};
    const Vec3 S = ours.jet(p).S;
    // Both evaluate 36 products of magnitude <= 10 by different recurrences.
    EXPECT_LE((detail::vec(theirs->Value(p.u, p.v)) - S).norm(), 1e-13 * 100.0);
    EXPECT_LE((back->jet(p).S - S).norm(), 0.0);
  });
}

TEST(Assemble, TrimlineOffTheBlendIsRefused) {
  Assembly a = coaxial();
  a.primaries[0].cuts[0].pcurve = line({5.0 + 1e-4, 0.0}, {0.0, 1.0});
  EXPECT_THROW(
      {
        try {
          (void)assemble(a, tolerance);
        } catch (const GeometryError& e) {
          EXPECT_NE(std::string(e.what()).find("primary upper: the trimline of blend blend (from)"),
                    std::string::npos);
          throw;
        }
      },
      GeometryError);
}

TEST(Assemble, CutMustNameABlendAndASide) {
  Assembly a = coaxial();
  a.primaries[0].cuts[0].blend = 7;
  EXPECT_THROW((void)assemble(a, tolerance), InputError);
}

/// A shape whose first shared edge has its curve moved by `by`.
Shape with_moved_edge(const Shape& shape, double by) {
  auto impl = std::make_shared<Shape::Impl>();
  BRepBuilderAPI_Copy copy(shape.impl().shape);
  impl->shape = copy.Shape();
  TopExp_Explorer e(impl->shape, TopAbs_EDGE);
  const TopoDS_Edge edge = TopoDS::Edge(e.Current());
  double a = 0, b = 0;
  const auto curve = BRep_Tool::Curve(edge, a, b);
  curve->Translate(gp_Vec(0.0, 0.0, by));
  return Shape(impl);
}

TEST(CheckShape, SeesAnEdgeThatWasMoved) {
  const Shape good = assemble(coaxial(), tolerance).shape;
  EXPECT_NEAR(check_shape(with_moved_edge(good, 1e-4)).largest_edge_gap, 1e-4, 1e-7);
  EXPECT_LE(check_shape(with_moved_edge(good, 0.0)).largest_edge_gap, tolerance);
  EXPECT_FALSE(check_shape(with_moved_edge(good, 1e-4)).valid);
  EXPECT_FALSE(check_shape(with_moved_edge(good, 1e-4)).problems.empty());
}

TEST(CheckShape, SeesAMissingFace) {
  const Shape good = assemble(coaxial(), tolerance).shape;
  auto impl = std::make_shared<Shape::Impl>();
  TopoDS_Shell shell;
  BRep_Builder().MakeShell(shell);
  for (const ShapeFace& f : good.impl().faces) {
    if (f.name == "upper") continue;
    BRep_Builder().Add(shell, f.face);
    impl->faces.push_back(f);
  }
  impl->shape = shell;
  const ShapeCheck c = check_shape(Shape(impl));
  EXPECT_EQ(c.faces, 2u);
  EXPECT_EQ(c.unexpected_free_edges, 1u);
}

TEST(CheckShape, TrimlinesWithoutPrimaryAreNoDefect) {
  Assembly a = coaxial();
  a.primaries.erase(a.primaries.begin());
  const ShapeCheck c = check_shape(assemble(a, tolerance).shape);
  EXPECT_EQ(c.free_edges, 2u);
  EXPECT_EQ(c.unexpected_free_edges, 0u);
}

TEST(ShapeMesh, IsWatertightAlongSharedEdges) {
  const Surface below = sphere(2.0), above = moved(sphere(1.0), {0.0, 0.0, 5.0});
  const Shape shape = assemble(joint({"below", below, line({0.25 * pi, 0.0}, {0.0, 1.0}), true},
                                     {"above", above, line({-0.25 * pi, 0.0}, {0.0, 1.0}), false}),
                               tolerance)
                          .shape;
  const std::vector<TriMesh> meshes = tessellate(shape, 0.01, degrees(6.0));
  ASSERT_EQ(meshes.size(), 3u);
  // The divergence theorem on the triangles: they enclose the solid's volume from inside, so normals point
  // outwards and nothing is missing. Sphere caps of height R (1 + q) and a frustum; chords of 0.01 lose at
  // most 0.01 * area.
  double volume = 0.0;
  for (const TriMesh& m : meshes)
    for (const auto& t : m.triangles)
      volume += m.points[t[0]].dot(m.points[t[1]].cross(m.points[t[2]])) / 6.0;
  const double q = std::sqrt(0.5), r0 = 2.0 * q, r1 = q, h = 5.0 - 3.0 * q;
  const auto cap = [&](double r) {
    return pi * std::pow(r * (1.0 + q), 2) * (3.0 * r - r * (1.0 + q)) / 3.0;
  };
  const double exact = cap(2.0) + cap(1.0) + pi * h / 3.0 * (r0 * r0 + r0 * r1 + r1 * r1);
  EXPECT_LT(volume, exact);
  EXPECT_GT(volume, exact - 0.01 * check_shape(shape).area);
}

}  // namespace
}  // namespace blendwright::test
