#pragma once
// Private: an off-screen window, drawn larger than asked and averaged down, and its PNG.
#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <filesystem>

class vtkRenderer;
class vtkUnsignedCharArray;

namespace blendwright {

class Display;

/// Throws IoError without a display, InputError when the size cannot be drawn.
void require_drawable(const std::filesystem::path& file, int width, int height, const Display& display);

class RenderTarget {
 public:
  /// Samples per pixel and direction. Smooth edges without multisampling, which depth peeling cannot use.
  static constexpr int oversampling = 2;

  /// True when VTK draws on the display named by DISPLAY. When it cannot, VTK may abort the process: ask in a
  /// child.
  [[nodiscard]] static bool works();

  RenderTarget(int width, int height);
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Renderers of higher layers are drawn over lower ones.
  void add(vtkRenderer& renderer, int layer);
  /// Draws and writes. Throws IoError.
  void write_png(const std::filesystem::path& file);

 private:
  void draw(vtkUnsignedCharArray& pixels);

  int width_, height_;
  vtkNew<vtkRenderWindow> window_;
};

}  // namespace blendwright
