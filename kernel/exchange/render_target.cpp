#include "kernel/exchange/render_target.hpp"

#include <vtkAutoInit.h>
#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cstdint>

#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/picture.hpp"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace blendwright {
namespace {

/// Mean of each block of oversampling x oversampling pixels, as an RGB image.
void average_down(vtkUnsignedCharArray& from, int width, int height, vtkImageData& to) {
  constexpr int k = RenderTarget::oversampling;
  to.SetDimensions(width, height, 1);
  to.AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const unsigned char* source = from.GetPointer(0);
  auto* target = static_cast<unsigned char*>(to.GetScalarPointer());
  const std::ptrdiff_t row = std::ptrdiff_t{3} * k * width;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = k * k / 2;
        for (int j = 0; j < k; ++j)
          for (int i = 0; i < k; ++i) sum += source[(k * y + j) * row + 3 * (k * x + i) + c];
        *target++ = static_cast<unsigned char>(sum / (k * k));
      }
}

}  // namespace

bool RenderTarget::works() {
  RenderTarget target(8, 8);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 0.0, 0.0);
  target.add(*renderer, 0);
  vtkNew<vtkUnsignedCharArray> pixels;
  target.draw(*pixels);
  return pixels->GetNumberOfValues() > 0 && pixels->GetValue(0) == 255 && pixels->GetValue(1) == 0;
}

void require_drawable(const std::filesystem::path& file, int width, int height, const Display& display) {
  if (!display.available()) throw IoError(file.string() + ": cannot be drawn (" + display.reason() + ")");
  constexpr int least = 64, most = 4096;
  for (const int size : {width, height})
    if (size < least || size > most)
      throw InputError(size == width ? "width" : "height", "is " + std::to_string(size) +
                                                               " pixels, must be " + std::to_string(least) +
                                                               " to " + std::to_string(most));
}

RenderTarget::RenderTarget(int width, int height) : width_(width), height_(height) {
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(0);
  window_->SetAlphaBitPlanes(1);  // depth peeling needs it
  window_->SetDPI(72);            // font sizes are pixels
  window_->SetSize(width * oversampling, height * oversampling);
}

void RenderTarget::add(vtkRenderer& renderer, int layer) {
  if (window_->GetNumberOfLayers() <= layer) window_->SetNumberOfLayers(layer + 1);
  renderer.SetLayer(layer);
  window_->AddRenderer(&renderer);
}

void RenderTarget::draw(vtkUnsignedCharArray& pixels) {
  window_->Render();
  window_->GetPixelData(0, 0, width_ * oversampling - 1, height_ * oversampling - 1, 0, &pixels);
}

void RenderTarget::write_png(const std::filesystem::path& file) {
  vtkNew<vtkUnsignedCharArray> pixels;
  draw(*pixels);
  vtkNew<vtkImageData> image;
  average_down(*pixels, width_, height_, *image);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetCompressionLevel(6);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  if (!png || writer->GetErrorCode() != 0)
    throw IoError(file.string() + ": cannot be written (no PNG was made)");
  write_text_file(file, {reinterpret_cast<const char*>(png->GetPointer(0)),
                         static_cast<std::size_t>(png->GetNumberOfValues())});
}

}  // namespace blendwright
