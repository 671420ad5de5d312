// Makes examples/specs/parts/two-bodies.step: a housing with a round boss, and a pipe above it, as an assembly of two
// bodies. The example step-transition joins the boss with the pipe.
//   make_two_bodies FILE.step
#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Ax2.hxx>
#include <iostream>

namespace {

TopoDS_Shape housing() {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(-5, -4, -2), gp_Pnt(5, 4, 0)).Shape();
  const TopoDS_Shape boss = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -1), gp_Dir(0, 0, 1)), 2.5, 3.0).Shape();
  ShapeUpgrade_UnifySameDomain unify(BRepAlgoAPI_Fuse(block, boss).Shape());
  unify.Build();
  return unify.Shape();
}

TopoDS_Shape pipe() {  // leans a little, so that the transition is not a body of revolution
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.5, 0, 6), gp_Dir(0.2, 0, 1)), 1.2, 4.0).Shape();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_two_bodies FILE.step\n";
    return 2;
  }
  Message::DefaultMessenger()->ChangePrinters().Clear();
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  opencascade::handle<TDocStd_Document> document = new TDocStd_Document("MDTV-XCAF");
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  BRep_Builder builder;
  TopoDS_Compound assembly;
  builder.MakeCompound(assembly);
  const TopoDS_Shape body1 = housing(), body2 = pipe();
  builder.Add(assembly, body1);
  builder.Add(assembly, body2);
  TDataStd_Name::Set(shapes->AddShape(assembly, true), "two bodies");
  TDF_Label label;
  if (shapes->FindShape(body1, label)) TDataStd_Name::Set(label, "housing");
  if (shapes->FindShape(body2, label)) TDataStd_Name::Set(label, "pipe");
  STEPCAFControl_Writer writer;
  writer.SetNameMode(true);
  if (!writer.Transfer(document)) return 4;
  APIHeaderSection_MakeHeader header(writer.ChangeWriter().Model());
  header.SetTimeStamp(new TCollection_HAsciiString("2023-11-14T22:13:20"));
  return writer.Write(argv[1]) == IFSelect_RetDone ? 0 : 5;
}
