#include "tests/exchange/read_png.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <stdexcept>

namespace blendwright::test {

Pixels read_png(const std::filesystem::path& file) {
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(file.c_str())) throw std::runtime_error(file.string() + " is not a PNG");
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  if (image.GetNumberOfScalarComponents() != 3) throw std::runtime_error(file.string() + " is not RGB");
  Pixels pixels{image.GetDimensions()[0], image.GetDimensions()[1], {}};
  for (int y = pixels.height - 1; y >= 0; --y) {  // VTK counts rows from below
    const auto* row = static_cast<const unsigned char*>(image.GetScalarPointer(0, y, 0));
    pixels.rgb.insert(pixels.rgb.end(), row, row + 3 * pixels.width);
  }
  return pixels;
}

}  // namespace blendwright::test
