#include "kernel/exchange/step_document.hpp"

#include <XCAFApp_Application.hxx>

namespace blendwright::detail {
namespace {

constexpr std::array<std::array<const char*, 2>, 2> blend_layers{
    {{"blend, free from and to", "blend, free from"},
     {"blend, free to", "blend"}}};  // [from joined][to joined]

}  // namespace

StepDocument::StepDocument() { XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_); }
StepDocument::~StepDocument() {
  try {
    XCAFApp_Application::GetApplication()->Close(document_);
  } catch (const Standard_Failure&) {  // NOLINT: nothing is lost, the document is only in memory
  }
}

const char* layer_of(const ShapeFace& face) {
  return face.blend ? blend_layers[face.joined[0]][face.joined[1]] : "primary";
}

void apply_layer(ShapeFace& face, const std::string& layer) {
  for (const bool from : {false, true})
    for (const bool to : {false, true})
      if (layer == blend_layers[from][to]) {
        face.blend = true;
        face.joined = {from, to};
      }
}

}  // namespace blendwright::detail
