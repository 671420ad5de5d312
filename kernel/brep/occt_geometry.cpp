#include "kernel/brep/occt_geometry.hpp"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>

namespace blendwright::detail {
namespace {

struct Knots {
  explicit Knots(const BSplineBasis& basis)
      : values(1, static_cast<int>(basis.breaks().size())),
        mults(1, static_cast<int>(basis.breaks().size())) {
    for (int i = 1; i <= values.Length(); ++i) {
      values(i) = basis.breaks()[static_cast<std::size_t>(i - 1)];
      mults(i) = basis.multiplicities()[static_cast<std::size_t>(i - 1)];
    }
  }
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger mults;
};

BSplineBasis basis_of(const TColStd_Array1OfReal& knots, const TColStd_Array1OfInteger& mults, int degree,
                      bool periodic) {
  return {degree, std::vector<double>(knots.begin(), knots.end()),
          std::vector<int>(mults.begin(), mults.end()), periodic};
}

}  // namespace

opencascade::handle<Geom_BSplineSurface> to_occt(const BSplineSurface& surface) {
  const BSplineBasis &bu = surface.basis_u(), &bv = surface.basis_v();
  TColgp_Array2OfPnt poles(1, bu.count(), 1, bv.count());
  for (int i = 0; i < bu.count(); ++i)
    for (int j = 0; j < bv.count(); ++j) poles(i + 1, j + 1) = pnt(surface.control(i, j));
  const Knots u(bu), v(bv);
  return new Geom_BSplineSurface(poles, u.values, v.values, u.mults, v.mults, bu.degree(), bv.degree(),
                                 bu.periodic(), bv.periodic());
}

opencascade::handle<Geom_BSplineCurve> to_occt(const BSplineCurve<3>& curve) {
  const BSplineBasis& b = curve.basis();
  TColgp_Array1OfPnt poles(1, b.count());
  for (int i = 0; i < b.count(); ++i) poles(i + 1) = pnt(curve.control()[static_cast<std::size_t>(i)]);
  const Knots k(b);
  return new Geom_BSplineCurve(poles, k.values, k.mults, b.degree(), b.periodic());
}

opencascade::handle<Geom2d_BSplineCurve> to_occt(const BSplineCurve<2>& curve) {
  const BSplineBasis& b = curve.basis();
  TColgp_Array1OfPnt2d poles(1, b.count());
  for (int i = 0; i < b.count(); ++i) poles(i + 1) = pnt(curve.control()[static_cast<std::size_t>(i)]);
  const Knots k(b);
  return new Geom2d_BSplineCurve(poles, k.values, k.mults, b.degree(), b.periodic());
}

std::optional<BSplineSurface> from_occt(const opencascade::handle<Geom_BSplineSurface>& surface) {
  if (surface->IsURational() || surface->IsVRational()) return std::nullopt;
  std::vector<Vec3> control;
  control.reserve(static_cast<std::size_t>(surface->NbUPoles() * surface->NbVPoles()));
  for (int i = 1; i <= surface->NbUPoles(); ++i)
    for (int j = 1; j <= surface->NbVPoles(); ++j) control.push_back(vec(surface->Pole(i, j)));
  return BSplineSurface(
      basis_of(surface->UKnots(), surface->UMultiplicities(), surface->UDegree(), surface->IsUPeriodic()),
      basis_of(surface->VKnots(), surface->VMultiplicities(), surface->VDegree(), surface->IsVPeriodic()),
      std::move(control));
}

}  // namespace blendwright::detail
