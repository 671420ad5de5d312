#include "kernel/exchange/step_file.hpp"

#include <APIHeaderSection_MakeHeader.hxx>
#include <HeaderSection_FileDescription.hxx>
#include <HeaderSection_FileName.hxx>
#include <Interface_HArray1OfHAsciiString.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_Label.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "kernel/base/text_file.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/occt_session.hpp"
#include "kernel/brep/shape_impl.hpp"
#include "kernel/exchange/step_document.hpp"

namespace blendwright {
namespace {

using opencascade::handle;

/// Seconds since 1970 as ISO 8601 in UTC: from SOURCE_DATE_EPOCH when it is set, else now.
std::string time_stamp() {
  std::time_t now = std::time(nullptr);
  if (const char* fixed = std::getenv("SOURCE_DATE_EPOCH")) now = static_cast<std::time_t>(std::atoll(fixed));
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  return text.data();
}

handle<TCollection_HAsciiString> ascii(const std::string& text) {
  return new TCollection_HAsciiString(text.c_str());
}

void set_name(const TDF_Label& label, const std::string& text) {
  TDataStd_Name::Set(label, TCollection_ExtendedString(text.c_str(), true));
}

void fill(const detail::StepDocument& document, const Shape::Impl& shape, const StepOptions& options) {
  const TDF_Label main = document.document()->Main();
  XCAFDoc_DocumentTool::SetLengthUnit(document.document(), detail::millimetres(options.unit) / 1000.0);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(main);
  const auto colours = XCAFDoc_DocumentTool::ColorTool(main);
  const auto layers = XCAFDoc_DocumentTool::LayerTool(main);
  const TDF_Label part = shapes->AddShape(shape.shape, false);
  set_name(part, options.product);
  for (const ShapeFace& face : shape.faces) {
    const TDF_Label label = shapes->AddSubShape(part, face.face);
    if (label.IsNull()) continue;
    set_name(label, face.name);
    layers->SetLayer(label, detail::layer_of(face));
    if (face.colour)
      colours->SetColor(label,
                        Quantity_Color(face.colour->r, face.colour->g, face.colour->b, Quantity_TOC_sRGB),
                        XCAFDoc_ColorSurf);
  }
}

handle<Interface_HArray1OfHAsciiString> one_text(const std::string& text) {
  const handle<Interface_HArray1OfHAsciiString> texts = new Interface_HArray1OfHAsciiString(1, 1);
  texts->SetValue(1, ascii(text));
  return texts;
}

void set_header(STEPCAFControl_Writer& writer, const std::string& file_name, const std::string& note) {
  const APIHeaderSection_MakeHeader header(writer.ChangeWriter().Model());
  handle<HeaderSection_FileName> name = header.FnValue();
  name->SetName(ascii(file_name));
  name->SetTimeStamp(ascii(time_stamp()));
  name->SetOriginatingSystem(ascii("blendwright"));
  for (const auto& set : {&HeaderSection_FileName::SetAuthor, &HeaderSection_FileName::SetOrganization})
    ((*name).*set)(one_text(""));  // the CAD kernel would put its own
  if (note.empty()) return;
  header.FdValue()->SetDescription(one_text(note));
}

/// Throws IoError unless the file is there whole: a full disk is not always noticed by the writer.
void check_complete(const std::filesystem::path& file, const std::filesystem::path& shown) {
  static constexpr std::string_view end = "END-ISO-10303-21;";
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const auto size = in ? static_cast<std::streamoff>(in.tellg()) : std::streamoff(0);
  const std::streamoff tail = std::min<std::streamoff>(size, 64);
  std::string text(static_cast<std::size_t>(tail), '\0');
  in.seekg(size - tail);
  in.read(text.data(), tail);
  if (!in || text.find(end) == std::string::npos)
    throw IoError(shown.string() + ": could not be written whole (" + std::to_string(size) +
                  " bytes arrived); free some space on the disk or choose another folder");
}

}  // namespace

const char* name(StepSchema s) { return s == StepSchema::AP214 ? "AP214" : "AP242"; }

void write_step(const std::filesystem::path& file, const Shape& shape, const StepOptions& options) {
  UnfinishedFile unfinished(file);
  const detail::ExchangeSession session(options.unit);
  detail::guarded<IoError>(file.string(), [&] {
    STEPCAFControl_Controller::Init();  // the names of faces are a setting that exists only after this
    Interface_Static::SetCVal("write.step.schema",
                              options.schema == StepSchema::AP214 ? "AP214IS" : "AP242DIS");
    Interface_Static::SetCVal("write.step.unit", detail::occt_unit_name(options.unit));
    Interface_Static::SetCVal("write.step.product.name", options.product.c_str());
    // Without parameter curves a file is a tenth smaller, and readers find them again to 1e-9.
    Interface_Static::SetIVal("write.surfacecurve.mode", 0);
    Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
    const detail::StepDocument document;
    fill(document, shape.impl(), options);
    STEPCAFControl_Writer writer;
    if (!writer.Transfer(document.document(), STEPControl_AsIs))
      throw IoError(file.string() + ": the CAD kernel cannot translate the shape to STEP");
    set_header(writer, file.filename().string(), options.note);
    if (writer.Write(unfinished.path().c_str()) != IFSelect_RetDone)
      throw IoError(file.string() + ": cannot be written; check that the folder exists and is writable");
  });
  check_complete(unfinished.path(), file);
  unfinished.publish();
}

}  // namespace blendwright
