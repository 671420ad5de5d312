// Reading back what was written: faces in the order of the file, with names, colours and layers.
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_WorkSession.hxx>
#include <fstream>

#include "kernel/brep/extrema_impl.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/occt_session.hpp"
#include "kernel/brep/occt_surface.hpp"
#include "kernel/brep/step_guard.hpp"
#include "kernel/exchange/step_document.hpp"
#include "kernel/exchange/step_file.hpp"
#include "kernel/exchange/step_shape.hpp"

namespace blendwright {
namespace {

using opencascade::handle;

/// What the document says of one face: its own label, or one that shows the same face.
class Labels {
 public:
  explicit Labels(const handle<TDocStd_Document>& document)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colours_(XCAFDoc_DocumentTool::ColorTool(document->Main())),
        layers_(XCAFDoc_DocumentTool::LayerTool(document->Main())) {
    shapes_->GetFreeShapes(parts_);
  }
  [[nodiscard]] const TDF_LabelSequence& parts() const { return parts_; }

  [[nodiscard]] ShapeFace describe(const TDF_Label& part, const TopoDS_Face& face) const {
    ShapeFace result;
    result.face = face;
    Quantity_Color colour;
    if (colours_->GetColor(face, XCAFDoc_ColorSurf, colour) ||
        colours_->GetColor(face, XCAFDoc_ColorGen, colour)) {
      double r = 0, g = 0, b = 0;
      colour.Values(r, g, b, Quantity_TOC_sRGB);
      result.colour = Colour{r, g, b};
    }
    TDF_Label label;
    if (!shapes_->FindSubShape(part, face, label)) return result;
    handle<TDataStd_Name> name;
    if (label.FindAttribute(TDataStd_Name::GetID(), name)) result.name = text(name->Get());
    handle<TColStd_HSequenceOfExtendedString> on = new TColStd_HSequenceOfExtendedString;
    if (layers_->GetLayers(label, on))
      for (int i = 1; i <= on->Length(); ++i) detail::apply_layer(result, text(on->Value(i)));
    return result;
  }

 private:
  static std::string text(const TCollection_ExtendedString& s) {
    return TCollection_AsciiString(s).ToCString();
  }
  handle<XCAFDoc_ShapeTool> shapes_;
  handle<XCAFDoc_ColorTool> colours_;
  handle<XCAFDoc_LayerTool> layers_;
  TDF_LabelSequence parts_;
};

StepFace step_face(const ShapeFace& face) {
  const detail::FaceGeometry g = detail::face_geometry(face.face);
  const auto spline = handle<Geom_BSplineSurface>::DownCast(g.geometry);
  std::optional<BSplineSurface> ours;
  if (spline) ours = detail::from_occt(spline);
  return {face.name,
          ours ? Surface(*ours) : Surface(detail::OcctSurface(g.geometry, false, g.box)),
          g.reversed,
          face.colour,
          spline ? static_cast<std::size_t>(spline->NbUPoles() * spline->NbVPoles()) : 0,
          extrema_surface(g.geometry, g.box)};
}

/// The text between the first pair of `open` ... `close` after `key`.
std::string after(const std::string& text, const std::string& key, char open, char close) {
  const auto k = text.find(key);
  if (k == std::string::npos) return "";
  const auto a = text.find(open, k + key.size()), b = text.find(close, a + 1);
  return a == std::string::npos || b == std::string::npos ? "" : text.substr(a + 1, b - a - 1);
}

std::string length_unit(const std::string& text) {
  if (text.find("LENGTH_UNIT") == std::string::npos) return {};
  if (after(text, "CONVERSION_BASED_UNIT", '\'', '\'') == "INCH") return name(LengthUnit::inch);
  if (text.find("SI_UNIT(.MILLI.,.METRE.)") != std::string::npos) return name(LengthUnit::millimetre);
  if (text.find("SI_UNIT(.CENTI.,.METRE.)") != std::string::npos) return name(LengthUnit::centimetre);
  if (text.find("SI_UNIT($,.METRE.)") != std::string::npos) return name(LengthUnit::metre);
  return {};
}

/// Schema and length unit as the file itself states them.
void read_statements(const std::filesystem::path& file, StepContent& content) {
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  content.bytes = text.size();
  const std::string schema = after(text, "FILE_SCHEMA", '\'', '\'');
  content.schema = schema.substr(0, schema.find_first_of(" .{\n"));
  content.unit = length_unit(text);
}

void require_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw IoError(file.string() + ": is not a file that can be read; give the path of a STEP file");
}

/// The first part of the file, or all of them as one shape, with what the document says of the faces.
std::shared_ptr<Shape::Impl> read_document(const std::filesystem::path& file, LengthUnit unit, bool all) {
  auto shape = std::make_shared<Shape::Impl>();
  const detail::ExchangeSession session(unit);
  detail::read_guarded(file, [&] {
    STEPCAFControl_Controller::Init();  // the names of faces are a setting that exists only after this
    Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
    const detail::StepDocument document;
    XCAFDoc_DocumentTool::SetLengthUnit(document.document(), detail::millimetres(unit) / 1000.0);
    STEPCAFControl_Reader reader;
    reader.SetColorMode(true);
    reader.SetNameMode(true);
    reader.SetLayerMode(true);
    if (reader.ReadFile(file.c_str()) != IFSelect_RetDone)
      throw IoError(file.string() + ": is not a STEP file (ISO 10303-21) that can be read");
    detail::require_whole_entities(reader.Reader().WS()->Model(), file);
    handle<TDocStd_Document> target = document.document();
    if (!reader.Transfer(target)) throw IoError(file.string() + ": contains no shape");
    const Labels labels(document.document());
    if (labels.parts().IsEmpty()) throw IoError(file.string() + ": contains no shape");
    TopoDS_Compound compound;
    const BRep_Builder builder;
    builder.MakeCompound(compound);
    for (const TDF_Label& part : labels.parts()) {
      const TopoDS_Shape one = XCAFDoc_ShapeTool::GetShape(part);
      for (TopExp_Explorer f(one, TopAbs_FACE); f.More(); f.Next())
        shape->faces.push_back(labels.describe(part, TopoDS::Face(f.Current())));
      builder.Add(compound, one);
      shape->shape = one;
      if (!all) return;
    }
    if (labels.parts().Size() > 1) shape->shape = compound;
  });
  return shape;
}

}  // namespace

StepContent read_step(const std::filesystem::path& file, LengthUnit unit) {
  require_file(file);
  StepContent content;
  read_statements(file, content);
  const std::shared_ptr<const Shape::Impl> shape = read_document(file, unit, false);
  for (const ShapeFace& f : shape->faces) content.faces.push_back(step_face(f));
  content.check = check_shape(Shape(shape));
  return content;
}

StepShape read_step_shape(const std::filesystem::path& file, LengthUnit unit) {
  require_file(file);
  const std::shared_ptr<const Shape::Impl> shape = read_document(file, unit, true);
  if (shape->faces.empty()) throw IoError(file.string() + ": contains no face");
  StepShape result{Shape(shape), {}};
  for (const ShapeFace& f : shape->faces) result.surfaces.push_back(step_face(f).surface);
  return result;
}

}  // namespace blendwright
