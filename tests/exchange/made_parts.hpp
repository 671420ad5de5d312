#pragma once
// Parts of known geometry, written to STEP and read back.
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>

#include <stdexcept>

#include "kernel/brep/occt_session.hpp"
#include "kernel/brep/step_part.hpp"
#include "tests/exchange/scratch_folder.hpp"

namespace blendwright::test {

inline StepPart part_of(const TopoDS_Shape& shape, LengthUnit unit = LengthUnit::millimetre) {
  const ScratchFolder folder;
  {
    const detail::ExchangeSession session(LengthUnit::millimetre);
    STEPControl_Writer writer;
    // Without pcurves, as CAD systems write: with them OCCT 7.6.3 reads a drilled sphere back as its
    // complement.
    Interface_Static::SetIVal("write.surfacecurve.mode", 0);
    writer.Transfer(shape, STEPControl_AsIs);
    if (writer.Write((folder / "part.step").c_str()) != IFSelect_RetDone)
      throw std::runtime_error("no STEP file");
  }
  return StepPart::read(folder / "part.step", unit);
}

inline gp_Ax2 z_axis(double x, double y, double z) { return {gp_Pnt(x, y, z), gp::DZ()}; }

/// A box 20 x 20 x 4 with a hole of radius 3 in the middle and a post of radius 2 on one corner.
inline TopoDS_Shape plate() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(-10, -10, 0), gp_Pnt(10, 10, 4)).Shape();
  const TopoDS_Shape drilled =
      BRepAlgoAPI_Cut(box, BRepPrimAPI_MakeCylinder(z_axis(0, 0, -1), 3.0, 6.0).Shape()).Shape();
  return BRepAlgoAPI_Fuse(drilled, BRepPrimAPI_MakeCylinder(z_axis(7, 7, 2), 2.0, 8.0).Shape()).Shape();
}

}  // namespace blendwright::test
