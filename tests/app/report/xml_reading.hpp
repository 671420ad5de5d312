#pragma once
// An independent reading of pages: a strict XML parser.
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <functional>
#include <string>
#include <vector>

namespace blendwright::test {

/// Null when the text is not well-formed.
inline vtkSmartPointer<vtkXMLDataElement> read_xml(const std::string& text) {
  vtkXMLDataElement* root = vtkXMLUtilities::ReadElementFromString(text.c_str());
  return vtkSmartPointer<vtkXMLDataElement>::Take(root);
}

inline void visit(vtkXMLDataElement* element, const std::function<void(vtkXMLDataElement&)>& see) {
  see(*element);
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) visit(element->GetNestedElement(i), see);
}

inline std::vector<vtkXMLDataElement*> elements(vtkXMLDataElement* root, const std::string& name) {
  std::vector<vtkXMLDataElement*> found;
  visit(root, [&](vtkXMLDataElement& e) {
    if (e.GetName() == name) found.push_back(&e);
  });
  return found;
}

inline std::string text_of(vtkXMLDataElement* element) {
  const char* text = element->GetCharacterData();
  return text ? text : "";
}
inline std::string attribute(vtkXMLDataElement* element, const char* name) {
  const char* text = element->GetAttribute(name);
  return text ? text : "";
}

}  // namespace blendwright::test
