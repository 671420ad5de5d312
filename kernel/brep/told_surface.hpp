#pragma once
// Private: one of our surfaces as the CAD kernel's algorithms ask for surfaces.
#include <Adaptor3d_Surface.hxx>

#include "kernel/brep/occt_geometry.hpp"

namespace blendwright::detail {

/// Points and derivatives to second order on `bounds`, which may reach beyond the surface's domain.
class ToldSurface final : public Adaptor3d_Surface {
 public:
  ToldSurface(const Surface& surface, const SurfaceDomain& bounds) : surface_(surface), bounds_(bounds) {}
  Standard_Real FirstUParameter() const override { return bounds_.u.lo; }
  Standard_Real LastUParameter() const override { return bounds_.u.hi; }
  Standard_Real FirstVParameter() const override { return bounds_.v.lo; }
  Standard_Real LastVParameter() const override { return bounds_.v.hi; }
  Standard_Boolean IsUClosed() const override { return false; }
  Standard_Boolean IsVClosed() const override { return false; }
  Standard_Boolean IsUPeriodic() const override { return false; }
  Standard_Boolean IsVPeriodic() const override { return false; }
  GeomAbs_SurfaceType GetType() const override { return GeomAbs_OtherSurface; }
  gp_Pnt Value(double u, double v) const override { return pnt(surface_.point({u, v})); }
  void D0(double u, double v, gp_Pnt& p) const override { p = Value(u, v); }
  void D1(double u, double v, gp_Pnt& p, gp_Vec& du, gp_Vec& dv) const override {
    const SurfaceJet jet = surface_.jet({u, v});
    p = pnt(jet.S), du = gp_Vec(pnt(jet.Su).XYZ()), dv = gp_Vec(pnt(jet.Sv).XYZ());
  }
  void D2(double u, double v, gp_Pnt& p, gp_Vec& du, gp_Vec& dv, gp_Vec& duu, gp_Vec& dvv,
          gp_Vec& duv) const override {
    const SurfaceJet jet = surface_.jet({u, v});
    p = pnt(jet.S), du = gp_Vec(pnt(jet.Su).XYZ()), dv = gp_Vec(pnt(jet.Sv).XYZ());
    duu = gp_Vec(pnt(jet.Suu).XYZ()), dvv = gp_Vec(pnt(jet.Svv).XYZ()), duv = gp_Vec(pnt(jet.Suv).XYZ());
  }

 private:
  Surface surface_;
  SurfaceDomain bounds_;
};

}  // namespace blendwright::detail
