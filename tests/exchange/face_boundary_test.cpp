// A face of a part that becomes a primary keeps its own edges: outer border, holes, notches.
#include <gtest/gtest.h>

#include "kernel/exchange/step_file.hpp"
#include "kernel/geometry/project.hpp"
#include "tests/exchange/joints.hpp"
#include "tests/exchange/made_parts.hpp"

namespace blendwright::test {
namespace {

constexpr double tolerance = 1e-6;

double frustum(double r0, double r1, double height) { return pi * (r0 + r1) * std::hypot(r0 - r1, height); }

/// The shape, and what is read back from its STEP file, are sound and have the exact area.
void expect_sound(const Assembly& assembly, std::size_t free_edges, double area) {
  const AssemblyResult result = assemble(assembly, tolerance);
  EXPECT_TRUE(result.warnings.empty()) << ::testing::PrintToString(result.warnings);
  const ScratchFolder folder;
  write_step(folder / "out.step", result.shape, {StepSchema::AP242, LengthUnit::millimetre, "out"});
  for (const ShapeCheck& c : {check_shape(result.shape), read_step(folder / "out.step").check}) {
    EXPECT_TRUE(c.valid) << ::testing::PrintToString(c.problems);
    EXPECT_LE(c.largest_tolerance, tolerance);
    EXPECT_EQ(c.faces, 3u);
    EXPECT_EQ(c.shells, 1u);
    EXPECT_EQ(c.free_edges, free_edges);
    EXPECT_EQ(c.unexpected_free_edges, 0u);
    EXPECT_NEAR(c.area, area, 1e-6 * area);
  }
}

/// A pipe about the axis through (x, y), kept above z0, whose trimline starts next to `start` and has the
/// turn and the range of the other side's closed line.
Side pipe(double radius, double x, double y, double z0, double z1, const Vec3& start, double turn,
          const CurveDomain& range) {
  const double angle = std::atan2(start.y() - y, start.x() - x);
  return {"pipe", moved(cylinder(radius, {z0 - 1.0, z1}), {x, y, 0}),
          line({z0, angle}, {0.0, turn * 2.0 * pi / range.v.length()}, range), turn < 0.0};
}

/// +1 when the line turns counter-clockwise about (x, y), seen from above.
double turn_of(const Surface& surface, const Curve2& pcurve, double x, double y) {
  const auto at = [&](double v) { return surface.point({pcurve.point(v).x(), pcurve.point(v).y()}); };
  const Vec3 c(x, y, 0), a = at(pcurve.domain().v.lo) - c, b = at(pcurve.domain().v.at(0.1)) - c;
  return a.cross(b).z() > 0.0 ? 1.0 : -1.0;
}

Assembly pipe_on_edge(const StepPart& part, std::size_t face, std::size_t edge, double radius, double x,
                      double y, double z0, double z1) {
  const EdgeTrimline t = part.trimline(face, edge, false);
  const Vec2 first = t.pcurve.point(0.0);
  const Vec3 start = t.surface.point({first.x(), first.y()});
  return joint({"part", t.surface, t.pcurve, t.kept_left},
               pipe(radius, x, y, z0, z1, start, turn_of(t.surface, t.pcurve, x, y), t.pcurve.domain()));
}

/// A circle about (x, y) on the plate's top, its outside kept, joined with a pipe.
Assembly pipe_on_circle(const StepPart& part, double r, double radius, double x, double y, double z0,
                        double z1) {
  const Surface top = part.surface(part.select(FaceSelector{"plane", Vec3(-8, 0, 4)}));
  const UV centre = closest_point(top, {x, y, 4}).at;
  const Curve2 around = circle({centre.u, centre.v}, r);
  const Vec3 start = top.point({centre.u + r, centre.v});
  const double turn = turn_of(top, around, x, y);
  return joint({"part", top, around, turn < 0.0}, pipe(radius, x, y, z0, z1, start, turn, whole_turn));
}

TEST(FaceBoundary, CircleAroundABossLeavesOuterEdgesAndHoles) {
  const StepPart part = part_of(plate());
  // The rim of the boss (radius 2) lies in what the circle removes.
  expect_sound(pipe_on_circle(part, 2.5, 1.5, 7, 7, 10, 14), 4 + 1 + 1,
               400.0 - pi * 9.0 - pi * 6.25 + frustum(2.5, 1.5, 6.0) + 2.0 * pi * 1.5 * 4.0);
}

TEST(FaceBoundary, RimOfAHoleIsReplacedByTheTrimline) {
  const StepPart part = part_of(plate());
  const std::size_t top = part.select(FaceSelector{"plane", Vec3(-8, 0, 4)});
  const std::size_t rim = part.select(EdgeSelector{"circle", Vec3(3, 0, 4)}, top);
  // The rim of the boss stays.
  expect_sound(pipe_on_edge(part, top, rim, 2.0, 0, 0, 8, 11), 4 + 1 + 1,
               400.0 - pi * 9.0 - pi * 4.0 + frustum(3.0, 2.0, 4.0) + 2.0 * pi * 2.0 * 3.0);
}

TEST(FaceBoundary, TopOfABossIsJoinedWithAPipe) {
  const StepPart part = part_of(plate());
  const std::size_t wall = part.select(FaceSelector{"cylinder", Vec3(9, 7, 8)});
  const std::size_t rim = part.select(EdgeSelector{"circle", Vec3(9, 7, 10)}, wall);
  expect_sound(pipe_on_edge(part, wall, rim, 1.0, 7, 7, 13, 15), 1 + 1,
               2.0 * pi * 2.0 * 6.0 + frustum(2.0, 1.0, 3.0) + 2.0 * pi * 1.0 * 2.0);
}

TEST(FaceBoundary, OuterBorderNeedNotBeTheParameterBox) {
  // A notch in a corner: the parameter box of the top is still 20 x 20.
  const TopoDS_Shape notch = BRepPrimAPI_MakeBox(gp_Pnt(-11, -11, -1), gp_Pnt(-6, -7, 5)).Shape();
  const StepPart part = part_of(BRepAlgoAPI_Cut(plate(), notch).Shape());
  expect_sound(pipe_on_circle(part, 2.5, 1.5, 7, 7, 10, 14), 6 + 1 + 1,
               400.0 - 12.0 - pi * 9.0 - pi * 6.25 + frustum(2.5, 1.5, 6.0) + 2.0 * pi * 1.5 * 4.0);
}

TEST(FaceBoundary, WallWithAWindowKeepsIt) {
  // A tube's wall, a whole turn with a seam, and a square window through one side.
  const TopoDS_Shape tube = BRepPrimAPI_MakeCylinder(z_axis(0, 0, 0), 5.0, 12.0).Shape();
  const TopoDS_Shape window = BRepPrimAPI_MakeBox(gp_Pnt(1, -3, 4), gp_Pnt(9, 3, 8)).Shape();
  const StepPart part = part_of(BRepAlgoAPI_Cut(tube, window).Shape());
  const std::size_t wall = part.select(FaceSelector{"cylinder", Vec3(-5, 0, 6)});
  const std::size_t rim = part.select(EdgeSelector{"circle", Vec3(-5, 0, 12)}, wall);
  const double window_area = 2.0 * std::asin(0.6) * 5.0 * 4.0;
  // The wall's seam passes the window, and splits its upper and lower edge in the part.
  expect_sound(pipe_on_edge(part, wall, rim, 3.0, 0, 0, 15, 18), 1 + 6 + 1,
               2.0 * pi * 5.0 * 12.0 - window_area + frustum(5.0, 3.0, 3.0) + 2.0 * pi * 3.0 * 3.0);
}

TEST(FaceBoundary, TrimlineAcrossAHoleIsSaidToLoseIt) {
  const StepPart part = part_of(plate());
  const AssemblyResult result = assemble(pipe_on_circle(part, 2.0, 1.5, 3, 0, 10, 14), tolerance);
  EXPECT_TRUE(check_shape(result.shape).valid);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("primary part: the other boundaries"), std::string::npos);
}

}  // namespace
}  // namespace blendwright::test
