#pragma once
// Private: the CAD kernel's document around a STEP file, closed when it is no longer needed; and the layers
// that tell blends from primaries.
#include <TDocStd_Document.hxx>

#include "kernel/brep/shape_impl.hpp"

namespace blendwright::detail {

class StepDocument {
 public:
  StepDocument();
  ~StepDocument();
  StepDocument(const StepDocument&) = delete;
  StepDocument& operator=(const StepDocument&) = delete;
  [[nodiscard]] const opencascade::handle<TDocStd_Document>& document() const { return document_; }

 private:
  opencascade::handle<TDocStd_Document> document_;
};

/// "primary", "blend", or "blend, free ..." for trimlines without a primary.
[[nodiscard]] const char* layer_of(const ShapeFace& face);
/// Sets `blend` and `joined`.
void apply_layer(ShapeFace& face, const std::string& layer);

}  // namespace blendwright::detail
