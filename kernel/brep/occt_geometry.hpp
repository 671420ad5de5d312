#pragma once
// Private: between our values and OpenCASCADE's geometry.
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Standard_Failure.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>
#include <optional>
#include <string>
#include <utility>

#include "kernel/base/error.hpp"
#include "kernel/geometry/bspline.hpp"

namespace blendwright::detail {

[[nodiscard]] inline Vec3 vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }
[[nodiscard]] inline Vec3 vec(const gp_Vec& p) { return {p.X(), p.Y(), p.Z()}; }
[[nodiscard]] inline gp_Pnt pnt(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
[[nodiscard]] inline gp_Pnt2d pnt(const Vec2& p) { return {p.x(), p.y()}; }

/// Same breaks, multiplicities, control points and periodicity.
[[nodiscard]] opencascade::handle<Geom_BSplineSurface> to_occt(const BSplineSurface& surface);
[[nodiscard]] opencascade::handle<Geom_BSplineCurve> to_occt(const BSplineCurve<3>& curve);
[[nodiscard]] opencascade::handle<Geom2d_BSplineCurve> to_occt(const BSplineCurve<2>& curve);
/// Empty when the surface is rational.
[[nodiscard]] std::optional<BSplineSurface> from_occt(
    const opencascade::handle<Geom_BSplineSurface>& surface);

/// Runs `body`; an exception of OpenCASCADE becomes an E that starts with `where`.
template <class E, class Body>
auto guarded(const std::string& where, Body&& body) -> decltype(std::forward<Body>(body)()) {
  try {
    return std::forward<Body>(body)();
  } catch (const Standard_Failure& failure) {
    throw E(where + ": the CAD kernel failed with " + failure.DynamicType()->Name() + " " +
            failure.GetMessageString());
  }
}

}  // namespace blendwright::detail
