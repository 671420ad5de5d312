// Faces and edges of a STEP file as surfaces and trimlines. The parts are made here, so that their geometry
// is known.
#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>

#include <cstdlib>
#include <fstream>
#include <set>

#include "kernel/base/error.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/occt_session.hpp"
#include "kernel/brep/occt_surface.hpp"
#include "kernel/brep/step_part.hpp"
#include "kernel/geometry/curvature.hpp"
#include "kernel/geometry/project.hpp"
#include "tests/exchange/joints.hpp"
#include "tests/exchange/made_parts.hpp"
#include "tests/exchange/scratch_folder.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

/// A cylinder of radius 5, height 12, whose wall is two faces of half a turn each.
TopoDS_Shape halved_cylinder(const gp_Trsf& place = {}) {
  const opencascade::handle<Geom_Surface> wall = new Geom_CylindricalSurface(gp_Ax3(), 5.0);
  BRepBuilderAPI_Sewing sewing(1e-6);
  sewing.Add(BRepBuilderAPI_MakeFace(wall, 0.0, pi, 0.0, 12.0, 1e-7).Face());
  sewing.Add(BRepBuilderAPI_MakeFace(wall, pi, 2.0 * pi, 0.0, 12.0, 1e-7).Face());
  sewing.Perform();
  return BRepBuilderAPI_Transform(sewing.SewedShape(), place).Shape();
}

bool left_is_inside(const EdgeTrimline& t, const std::function<bool(const Vec3&)>& on_face) {
  const CurveDomain d = t.pcurve.domain();
  const CurveJet<2> c = t.pcurve.jet(d.v.at(0.37));
  const SurfaceJet s = t.surface.jet({c.C().x(), c.C().y()});
  const Vec3 tangent = s.Su * c.C1().x() + s.Sv * c.C1().y();
  const Vec3 left = s.Su.cross(s.Sv).cross(tangent).normalized();
  return on_face(s.S + (t.kept_left ? 1e-3 : -1e-3) * left);
}

/// The trimline runs by arc length and its speed is 1.
void expect_arc_length(const EdgeTrimline& t, double length) {
  const CurveDomain d = t.pcurve.domain();
  EXPECT_EQ(d.v.lo, 0.0);
  EXPECT_NEAR(d.v.hi, length, 1e-8 * length);
  for (int i = 0; i <= 40; ++i) {
    const CurveJet<2> c = t.pcurve.jet(d.v.at(i / 40.0));
    const SurfaceJet s = t.surface.jet({c.C().x(), c.C().y()});
    // Interpolation stops at 1e-10 of the length in position; its slope is 1e-10 / (1/64) at worst, times a
    // few.
    EXPECT_NEAR((s.Su * c.C1().x() + s.Sv * c.C1().y()).norm(), 1.0, 1e-7);
  }
}

TEST(StepPart, ListsFacesWithKindSizeAndAPointInside) {
  const StepPart part = part_of(plate());
  ASSERT_EQ(part.faces().size(), 9u);  // 6 of the box, hole, post wall, post top
  EXPECT_TRUE(part.valid());
  EXPECT_EQ(part.solids(), 1u);
  std::size_t cylinders = 0;
  for (const FaceInfo& f : part.faces()) {
    const Surface s = part.surface(f.index);
    EXPECT_LE(closest_point(s, f.anchor).distance, 1e-9);
    EXPECT_GT(f.area, 0.0);
    if (f.surface == "cylinder") ++cylinders;
    // The anchor selects the face it belongs to: it lies inside, not only on its surface.
    EXPECT_EQ(part.select(FaceSelector{f.surface, f.anchor}), f.index);
  }
  EXPECT_EQ(cylinders, 2u);
  EXPECT_NE(
      part.faces()[part.select(FaceSelector{"cylinder", Vec3(3, 0, 1)})].size.find("radius 3, length 4"),
      std::string::npos);
}

TEST(StepPart, NormalsPointOutOfTheMaterial) {
  const StepPart part = part_of(plate());
  bool hole_reversed = false;
  for (const FaceInfo& f : part.faces()) {
    const Surface s = part.surface(f.index);
    const Foot foot = closest_point(s, f.anchor);
    const Vec3 n = unit_normal(s.jet(foot.at)), out = f.anchor + 1e-3 * n;
    const bool in_box = std::abs(out.x()) < 10 && std::abs(out.y()) < 10 && out.z() > 0 && out.z() < 4 &&
                        std::hypot(out.x(), out.y()) > 3;
    const bool in_post = std::hypot(out.x() - 7, out.y() - 7) < 2 && out.z() > 2 && out.z() < 10;
    EXPECT_FALSE(in_box || in_post) << f.surface << " " << f.size;
    hole_reversed = hole_reversed || (f.surface == "cylinder" && f.reversed);
  }
  EXPECT_TRUE(hole_reversed);  // else the reversed case was not tested
}

/// All partials of all faces, against differences of the next lower ones.
void expect_consistent_partials(const TopoDS_Shape& shape) {
  const StepPart part = part_of(shape);
  for (const FaceInfo& f : part.faces()) {
    SCOPED_TRACE(f.surface);
    const Surface s = part.surface(f.index);
    const SurfaceDomain d = s.domain();
    const UV p{d.u.at(0.31), d.v.at(0.62)};
    const double h = 1e-3;
    const SurfacePartials P = s.partials(p), right = s.partials({p.u + h, p.v}),
                          left = s.partials({p.u - h, p.v}), up = s.partials({p.u, p.v + h}),
                          down = s.partials({p.u, p.v - h});
    for (int n = 0; n < 4; ++n)
      for (int j = 0; j <= n; ++j) {
        // Central differences: h^2/6 of a third derivative, which is at most the radius 3 here.
        EXPECT_LE((P(n - j + 1, j) - (right(n - j, j) - left(n - j, j)) / (2 * h)).norm(), 1e-6);
        EXPECT_LE((P(n - j, j + 1) - (up(n - j, j) - down(n - j, j)) / (2 * h)).norm(), 1e-6);
      }
    const SurfaceJet jet = s.jet(p);
    EXPECT_LE((jet.Suv - P(1, 1)).norm() + (jet.Svv - P(0, 2)).norm() + (jet.Sv - P(0, 1)).norm(), 1e-12);
  }
}

TEST(StepPart, PartialsAgreeWithDifferences) {
  expect_consistent_partials(plate());
  expect_consistent_partials(BRepPrimAPI_MakeCone(z_axis(0, 0, 0), 1.0, 2.0, 3.0).Shape());
  expect_consistent_partials(BRepPrimAPI_MakeSphere(gp_Pnt(0, 0, 0), 2.0).Shape());
  expect_consistent_partials(BRepPrimAPI_MakeTorus(2.0, 1.0).Shape());
}

TEST(StepPart, LocationIsApplied) {
  gp_Trsf place;
  place.SetTranslation(gp_Vec(100, 0, 0));
  const StepPart part = part_of(plate().Moved(TopLoc_Location(place)));
  const std::size_t hole = part.select(FaceSelector{"cylinder", Vec3(103, 0, 2)});
  const Vec3 p = part.surface(hole).point({0.3, 2.0});
  EXPECT_NEAR(std::hypot(p.x() - 100.0, p.y()), 3.0, 1e-12);
}

TEST(StepPart, UnitsAreConverted) {
  const StepPart part = part_of(plate(), LengthUnit::inch);
  const std::size_t hole = part.select(FaceSelector{"cylinder", Vec3(3, 0, 2) / 25.4});
  EXPECT_NEAR(part.faces()[hole].area, 2.0 * pi * 3.0 * 4.0 / (25.4 * 25.4), 1e-6);
}

TEST(StepPart, SelectionFailsClosedAndListsWhatThereIs) {
  const StepPart part = part_of(plate());
  const auto message = [&](const FaceSelector& s) {
    try {
      (void)part.select(s);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string two = message({"cylinder", std::nullopt});
  EXPECT_NE(two.find("matches 2 cylinder faces"), std::string::npos) << two;
  EXPECT_NE(two.find("{\"surface\": \"cylinder\", \"near\": ["), std::string::npos) << two;
  EXPECT_NE(two.find("radius 2"), std::string::npos) << two;
  EXPECT_NE(message({"torus", std::nullopt}).find("matches no torus face"), std::string::npos);
  // On the edge between two faces, both are equally near.
  EXPECT_NE(message({"plane", Vec3(10, 10, 1)}).find("equally near"), std::string::npos);
  EXPECT_NE(message({"", std::nullopt}).find("9 faces"), std::string::npos);
  EXPECT_THROW((void)part.select(EdgeSelector{"ellipse", std::nullopt}), InputError);
}

TEST(StepPart, EdgesAreChosenByCurveAndPlace) {
  const StepPart part = part_of(plate());
  const std::size_t hole = part.select(FaceSelector{"cylinder", Vec3(3, 0, 2)});
  const std::size_t rim = part.select(EdgeSelector{"circle", Vec3(3, 0, 4)}, hole);
  EXPECT_EQ(part.edges()[rim].curve, "circle");
  EXPECT_TRUE(part.edges()[rim].closed);
  EXPECT_NEAR(part.edges()[rim].length, 6.0 * pi, 1e-9);
  EXPECT_EQ(part.edges()[rim].faces.size(), 2u);
}

TEST(StepTrimline, RimOfAHoleIsALineOnTheCylinderAndACircleOnThePlane) {
  const StepPart part = part_of(plate());
  const std::size_t hole = part.select(FaceSelector{"cylinder", Vec3(3, 0, 2)});
  const std::size_t top = part.select(FaceSelector{"plane", Vec3(-8, 0, 4)});
  const std::size_t rim = part.select(EdgeSelector{"circle", Vec3(3, 0, 4)}, hole);
  for (const std::size_t face : {hole, top}) {
    const EdgeTrimline t = part.trimline(face, rim, false);
    EXPECT_TRUE(t.pcurve.domain().closed);
    EXPECT_LE(t.edge_deviation, 1e-9);
    expect_arc_length(t, 6.0 * pi);
    EXPECT_TRUE(left_is_inside(t, [&](const Vec3& p) {
      return face == hole ? p.z() > 0.0 && p.z() < 4.0 : std::hypot(p.x(), p.y()) > 3.0;
    }));
    if (face == hole) {
      const CurveJet<2> a = t.pcurve.jet(0.0), b = t.pcurve.jet(7.3);
      EXPECT_EQ(a.C1(), b.C1());
      EXPECT_EQ(b.C2(), Vec2::Zero());
    }
  }
}

TEST(StepTrimline, OpenEdgeOfABoxRunsByArcLength) {
  const StepPart part = part_of(plate());
  const std::size_t top = part.select(FaceSelector{"plane", Vec3(-8, 0, 4)});
  const EdgeTrimline t = part.trimline(top, part.select(EdgeSelector{"line", Vec3(0, -10, 4)}, top), true);
  EXPECT_FALSE(t.pcurve.domain().closed);
  EXPECT_EQ(t.edges.size(), 1u);  // the neighbours turn by 90 degrees
  expect_arc_length(t, 20.0);
  EXPECT_TRUE(left_is_inside(t, [](const Vec3& p) { return p.y() > -10.0; }));
}

TEST(StepTrimline, HalvesOfACylinderAreOneSurfaceAndOneClosedLine) {
  gp_Trsf turned;
  turned.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 1, 0)), 0.7);
  const StepPart part = part_of(halved_cylinder(turned));
  ASSERT_EQ(part.faces().size(), 2u);
  const Vec3 top = detail::vec(gp_Pnt(0, 5, 12).Transformed(turned));
  const std::size_t face =
      part.select(FaceSelector{"cylinder", detail::vec(gp_Pnt(0, 5, 6).Transformed(turned))});
  const std::size_t edge = part.select(EdgeSelector{"circle", top}, face);
  const EdgeTrimline half = part.trimline(face, edge, false), full = part.trimline(face, edge, true);
  EXPECT_FALSE(half.pcurve.domain().closed);
  expect_arc_length(half, 5.0 * pi);
  EXPECT_TRUE(full.pcurve.domain().closed);
  EXPECT_EQ(full.edges.size(), 2u);
  EXPECT_EQ(full.faces.size(), 2u);
  EXPECT_TRUE(full.surface.domain().u_closed);
  EXPECT_NEAR(full.surface.domain().u.length(), 2.0 * pi, 1e-12);
  expect_arc_length(full, 10.0 * pi);
  EXPECT_LE(full.edge_deviation, 1e-9);
}

TEST(StepTrimline, EdgeOfAnotherFaceIsRefused) {
  const StepPart part = part_of(plate());
  const std::size_t hole = part.select(FaceSelector{"cylinder", Vec3(3, 0, 2)});
  const std::size_t far = part.select(EdgeSelector{"line", Vec3(0, -10, 4)});
  EXPECT_THROW((void)part.trimline(hole, far, false), InputError);
  EXPECT_THROW((void)part.trimline(99, 0, false), InputError);
  EXPECT_THROW((void)part.surface(99), InputError);
}

TEST(StepTrimline, CurvedIntersectionFollowsTheEdge) {
  // A bore of radius 1 through a ball of radius 4, off centre: its rim is a space curve of degree 4.
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(4.0).Shape();
  const StepPart part = part_of(
      BRepAlgoAPI_Cut(ball, BRepPrimAPI_MakeCylinder(z_axis(1.5, 0.4, -9), 1.0, 18.0).Shape()).Shape());
  const std::size_t bore = part.select(FaceSelector{"cylinder", Vec3(2.5, 0.4, 0.0)});
  std::set<std::size_t> rims;  // first edges of closed chains
  for (const EdgeInfo& e : part.edges()) {
    if (std::find(e.faces.begin(), e.faces.end(), bore) == e.faces.end() || e.curve == "line") continue;
    for (const std::size_t face : e.faces) {
      const EdgeTrimline t = part.trimline(face, e.index, true);
      ASSERT_TRUE(t.pcurve.domain().closed);
      rims.insert(*std::min_element(t.edges.begin(), t.edges.end()));
      EXPECT_LE(t.edge_deviation, 10.0 * part.tolerance() + 1e-6);
      expect_arc_length(t, t.pcurve.domain().v.hi);
      EXPECT_TRUE(left_is_inside(t, [&](const Vec3& p) {
        return face == bore ? p.norm() < 4.0 : std::hypot(p.x() - 1.5, p.y() - 0.4) > 1.0;
      }));
    }
  }
  EXPECT_EQ(rims.size(), 2u);
}

TEST(StepTrimline, CarriesABlend) {
  const StepPart part = part_of(halved_cylinder());
  const std::size_t face = part.select(FaceSelector{"cylinder", Vec3(0, 5, 6)});
  const EdgeTrimline t = part.trimline(face, part.select(EdgeSelector{"circle", Vec3(0, 5, 12)}, face), true);
  // A ring of radius 3, height 15, run through by the same arc-length parameter and direction.
  const CurveJet<2> c = t.pcurve.jet(0.0);
  const Vec3 start = t.surface.point({c.C().x(), c.C().y()});
  const Vec3 next = t.surface.point({t.pcurve.point(1.0).x(), t.pcurve.point(1.0).y()});
  const double angle = std::atan2(start.y(), start.x());
  const double sense = start.cross(next).z() > 0.0 ? 1.0 : -1.0;
  const Side ring{"ring", cylinder(3.0, {15.0, 20.0}),
                  line({16.0, angle}, {0.0, sense / 5.0}, t.pcurve.domain()), sense < 0.0};
  const auto result = assemble(joint({"wall", t.surface, t.pcurve, t.kept_left}, ring), 1e-6);
  const ShapeCheck check = check_shape(result.shape);
  EXPECT_TRUE(check.valid) << ::testing::PrintToString(check.problems);
  EXPECT_TRUE(result.warnings.empty()) << ::testing::PrintToString(result.warnings);
  EXPECT_EQ(check.free_edges, 2u);
  EXPECT_EQ(check.unexpected_free_edges, 0u);
  EXPECT_LE(check.largest_tolerance, 1e-6);
  EXPECT_NEAR(check.area, 10.0 * pi * 12.0 + 6.0 * pi * 4.0 + pi * 8.0 * std::hypot(4.0, 2.0), 1e-2);
}

TEST(StepPart, WhatIsNoPartIsRefused) {
  const ScratchFolder folder;
  std::ofstream(folder / "text.step") << "no STEP at all";
  EXPECT_THROW((void)StepPart::read(folder / "text.step"), IoError);
  EXPECT_THROW((void)StepPart::read(folder / "none.step"), IoError);
  EXPECT_THROW((void)StepPart::read("/tmp"), IoError);
}

/// Parts made by commercial systems.
class RealParts : public ::testing::TestWithParam<const char*> {};

TEST_P(RealParts, AnchorsSelectTheirFacesAndEdgesBecomeTrimlines) {
  const char* folder = std::getenv("BLENDWRIGHT_STEP_DIR");
  if (!folder) GTEST_SKIP() << "BLENDWRIGHT_STEP_DIR names no folder with real parts";
  const StepPart part = StepPart::read(std::filesystem::path(folder) / GetParam());
  EXPECT_TRUE(part.valid());
  ASSERT_FALSE(part.faces().empty());
  std::size_t closed_chains = 0, covered = 0;
  for (const FaceInfo& f : part.faces()) {
    SCOPED_TRACE("face " + std::to_string(f.index) + " " + f.surface + " " + f.size);
    const Surface s = part.surface(f.index);
    EXPECT_LE(closest_point(s, f.anchor).distance, 1e-6);
    // Solids of an assembly may touch: a face that is covered by one of its kind cannot be told from it by a
    // point. Then nothing is chosen; never is another face chosen.
    try {
      EXPECT_EQ(part.select(FaceSelector{f.surface, f.anchor}), f.index);
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("equally near"), std::string::npos) << e.what();
      ++covered;
    }
    for (const EdgeInfo& e : part.edges()) {
      if (std::find(e.faces.begin(), e.faces.end(), f.index) == e.faces.end()) continue;
      SCOPED_TRACE("edge " + std::to_string(e.index) + " " + e.curve + " " + e.size);
      const EdgeTrimline t = part.trimline(f.index, e.index, true);
      EXPECT_LE(t.edge_deviation, 2.0 * part.tolerance() + 1e-6);
      closed_chains += t.pcurve.domain().closed;
      const CurveDomain d = t.pcurve.domain();
      double worst = 0.0;
      for (int i = 0; i < 20; ++i) {
        const CurveJet<2> c = t.pcurve.jet(d.v.at((i + 0.5) / 20.0));
        const SurfaceJet j = t.surface.jet({c.C().x(), c.C().y()});
        worst = std::max(worst, std::abs((j.Su * c.C1().x() + j.Sv * c.C1().y()).norm() - 1.0));
      }
      EXPECT_LE(worst, 1e-4);
    }
  }
  EXPECT_GT(closed_chains, 0u);
  EXPECT_LT(covered, part.faces().size() / 2);
}

INSTANTIATE_TEST_SUITE_P(Files, RealParts,
                         ::testing::Values("MAINBODY_BACK.stp", "HEAD_BACK.stp", "sg1-c5-214.stp",
                                           "dm1-id-214.stp", "screw.step"));

}  // namespace
}  // namespace blendwright::test
