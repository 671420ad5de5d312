// Question: what does the same gap cost, and how well is it closed, by this library and by the CAD kernel's
// fillings?
//
// The gap: a quarter of two coaxial cylinders (radius 1 below z = 0, radius 2 above z = 3), with the two side
// curves given as well, since the fillings need a closed frame. Counters: gap (mm), angle (deg) and curvature
// jump (1/mm) at the trimlines, largest of 400 places, measured the same way on every result.
#include <benchmark/benchmark.h>

#include <Adaptor3d_CurveOnSurface.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepLib.hxx>
#include <BRepOffsetAPI_MakeFilling.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Line.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomFill_BoundWithSurf.hxx>
#include <GeomFill_ConstrainedFilling.hxx>
#include <GeomFill_SimpleBound.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include "kernel/geometry/curvature.hpp"
#include "kernel/geometry/project.hpp"
#include "kernel/primitives/primary.hpp"
#include "parametric/blend.hpp"
#include "parametric/fit/blend_fit.hpp"

namespace {

using namespace blendwright;

constexpr double quarter = 1.5707963267948966;

/// A surface of the CAD kernel for measuring; fourth-order partials are not needed for that.
struct FilledSurface {
  opencascade::handle<Geom_Surface> geometry;
  [[nodiscard]] SurfaceJet jet(UV p) const {
    gp_Pnt S;
    gp_Vec u, v, uu, vv, uv;
    geometry->D2(p.u, p.v, S, u, v, uu, vv, uv);
    const auto vec = [](const auto& x) { return Vec3(x.X(), x.Y(), x.Z()); };
    return {vec(S), vec(u), vec(v), vec(uu), vec(uv), vec(vv)};
  }
  [[nodiscard]] SurfacePartials partials(UV) const { return {}; }
  [[nodiscard]] SurfaceDomain domain() const {
    double u0, u1, v0, v1;
    geometry->Bounds(u0, u1, v0, v1);
    return {{u0, u1}, {v0, v1}, false, false};
  }
};

struct Gap {
  std::array<Surface, 2> primaries;
  std::array<Trimline, 2> lines;
};

Gap make_gap() {
  const Interval angle{0.0, quarter};
  const Surface thin =
      make_primary({.kind = "cylinder", .numbers = {{"radius", 1.0}}, .u = Interval{-2.0, 0.0}, .v = angle});
  const Surface wide =
      make_primary({.kind = "cylinder", .numbers = {{"radius", 2.0}}, .u = Interval{3.0, 5.0}, .v = angle});
  return {{thin, wide},
          {isoline(thin, IsoDirection::constant_u, 0.0), isoline(wide, IsoDirection::constant_u, 3.0)}};
}

BlendSpec second_order() {
  BlendSpec spec;
  spec.sides[0].continuity = spec.sides[1].continuity = Continuity::G2;
  return spec;
}

struct Joint {
  double gap = 0.0, angle = 0.0, curvature = 0.0;
};

Joint measure(const Gap& gap, const Surface& filled) {
  Joint worst;
  for (const Trimline& line : gap.lines) {
    std::optional<UV> guess;
    for (int i = 0; i <= 200; ++i) {
      const CurveDomain domain = line.domain();
      const double v = domain.v.at(i / 200.0);
      const Vec3 point = line.jet(v).C();
      const Foot foot = guess ? closest_point(filled, point, *guess) : closest_point(filled, point);
      guess = foot.at;
      const auto at = line.pcurve().jet(v).C();
      const SurfaceJet P = line.primary().jet({at[0], at[1]}), S = filled.jet(foot.at);
      const Vec3 n = unit_normal(P), across = n.cross(line.jet(v).C1());
      worst.gap = std::max(worst.gap, foot.distance);
      worst.angle = std::max(worst.angle, plane_angle(n, unit_normal(S)).degrees());
      worst.curvature = std::max(worst.curvature,
                                 std::abs(normal_curvature(S, across, n) - normal_curvature(P, across, n)));
    }
  }
  return worst;
}

void report(benchmark::State& state, const Joint& joint, double control_points) {
  state.counters["gap_mm"] = joint.gap;
  state.counters["angle_deg"] = joint.angle;
  state.counters["curvature_jump"] = joint.curvature;
  state.counters["control_points"] = control_points;
}

/// The frame for the CAD kernel: two cylinder faces with their edges, and the two side curves of the exact
/// blend.
struct Frame {
  std::array<opencascade::handle<Geom_CylindricalSurface>, 2> cylinders;
  std::array<TopoDS_Face, 2> faces;
  std::array<TopoDS_Edge, 2> edges;
  std::array<opencascade::handle<Geom_BSplineCurve>, 2> sides;
};

Frame make_frame(const Gap& gap) {
  const Blend blend = make_blend(gap.lines[0], gap.lines[1], second_order(), 1e-6);
  Frame frame;
  const std::array<double, 2> radius{1.0, 2.0}, z{0.0, 3.0};
  for (std::size_t i = 0; i < 2; ++i) {
    frame.cylinders[i] = new Geom_CylindricalSurface(gp_Ax3(), radius[i]);
    const double low = i == 0 ? -2.0 : 3.0;
    frame.faces[i] = BRepBuilderAPI_MakeFace(frame.cylinders[i], 0.0, quarter, low, low + 2.0, 1e-7).Face();
    const opencascade::handle<Geom2d_Line> line = new Geom2d_Line(gp_Pnt2d(0.0, z[i]), gp_Dir2d(1.0, 0.0));
    frame.edges[i] = BRepBuilderAPI_MakeEdge(line, frame.cylinders[i], 0.0, quarter).Edge();
    BRepLib::BuildCurve3d(frame.edges[i], 1e-9);
    TColgp_Array1OfPnt points(1, 65);
    for (int k = 0; k <= 64; ++k) {
      const Vec3 p = blend.surface.jet({k / 64.0, blend.surface.domain().v.at(static_cast<double>(i))}).S;
      points.SetValue(k + 1, gp_Pnt(p.x(), p.y(), p.z()));
    }
    frame.sides[i] = GeomAPI_PointsToBSpline(points, 3, 8, GeomAbs_C2, 1e-7).Curve();
  }
  return frame;
}

void BlendConstruction(benchmark::State& state) {  // trimlines to exact blend
  const Gap gap = make_gap();
  for (auto _ : state) benchmark::DoNotOptimize(make_blend(gap.lines[0], gap.lines[1], second_order(), 1e-6));
  report(state, measure(gap, make_blend(gap.lines[0], gap.lines[1], second_order(), 1e-6).surface), 0.0);
}
BENCHMARK(BlendConstruction)->Unit(benchmark::kMillisecond);

void GapClosedByBlendwright(benchmark::State& state) {  // trimlines to fitted B-spline
  const Gap gap = make_gap();
  const auto close = [&] {
    return fit_blend(make_blend(gap.lines[0], gap.lines[1], second_order(), 1e-6).surface, {});
  };
  for (auto _ : state) benchmark::DoNotOptimize(close());
  const BlendFit fit = close();
  report(state, measure(gap, fit.surface), fit.report.control_points);
}
BENCHMARK(GapClosedByBlendwright)->Unit(benchmark::kMillisecond);

void GapClosedByMakeFilling(benchmark::State& state) {
  const Gap gap = make_gap();
  const Frame frame = make_frame(gap);
  const GeomAbs_Shape continuity = state.range(0) == 1 ? GeomAbs_G1 : GeomAbs_G2;
  TopoDS_Shape filled;
  for (auto _ : state) {
    try {
      BRepOffsetAPI_MakeFilling filling;
      for (std::size_t i = 0; i < 2; ++i) {
        filling.Add(frame.edges[i], frame.faces[i], continuity);
        filling.Add(BRepBuilderAPI_MakeEdge(frame.sides[i]).Edge(), GeomAbs_C0);
      }
      filling.Build();
      filled = filling.Shape();
    } catch (const Standard_Failure& failure) {
      state.SkipWithError(failure.DynamicType()->Name());
      return;
    }
  }
  const opencascade::handle<Geom_Surface> geometry =
      BRep_Tool::Surface(TopoDS::Face(TopExp_Explorer(filled, TopAbs_FACE).Current()));
  const auto spline = opencascade::handle<Geom_BSplineSurface>::DownCast(geometry);
  report(state, measure(gap, FilledSurface{geometry}),
         spline.IsNull() ? 0 : spline->NbUPoles() * spline->NbVPoles());
}
BENCHMARK(GapClosedByMakeFilling)->ArgName("G")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void GapClosedByConstrainedFilling(benchmark::State& state) {
  const Gap gap = make_gap();
  const Frame frame = make_frame(gap);
  opencascade::handle<Geom_BSplineSurface> surface;
  for (auto _ : state) {
    try {
      std::array<opencascade::handle<GeomFill_Boundary>, 4> bounds;
      for (std::size_t i = 0; i < 2; ++i) {
        const opencascade::handle<Geom2d_Line> line =
            new Geom2d_Line(gp_Pnt2d(0.0, i == 0 ? 0.0 : 3.0), gp_Dir2d(1.0, 0.0));
        const opencascade::handle<Geom2dAdaptor_Curve> pcurve = new Geom2dAdaptor_Curve(line, 0.0, quarter);
        const opencascade::handle<GeomAdaptor_Surface> surface_adaptor =
            new GeomAdaptor_Surface(frame.cylinders[i]);
        bounds[2 * i] =
            new GeomFill_BoundWithSurf(Adaptor3d_CurveOnSurface(pcurve, surface_adaptor), 1e-6, 1e-5);
        bounds[2 * i + 1] = new GeomFill_SimpleBound(new GeomAdaptor_Curve(frame.sides[1 - i]), 1e-6, 1e-5);
      }
      GeomFill_ConstrainedFilling filling(8, 60);
      filling.Init(bounds[0], bounds[1], bounds[2], bounds[3]);
      surface = filling.Surface();
    } catch (const Standard_Failure& failure) {
      state.SkipWithError(failure.DynamicType()->Name());
      return;
    }
  }
  report(state, measure(gap, FilledSurface{surface}), surface->NbUPoles() * surface->NbVPoles());
}
BENCHMARK(GapClosedByConstrainedFilling)->Unit(benchmark::kMillisecond);

}  // namespace
