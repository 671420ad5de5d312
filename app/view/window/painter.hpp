#pragma once
// Private: flat drawing over the panes of a window, in pixels from the lower left corner; each frame is drawn
// anew into the same objects. Fonts and text places are those of pictures (canvas.hpp).
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "kernel/exchange/canvas.hpp"

namespace blendwright {

class Painter {
 public:
  Painter();
  [[nodiscard]] vtkRenderer& renderer() { return *renderer_; }
  void begin();
  void fill(const PixelBox& box, const Colour& colour);
  void frame(const PixelBox& box, const Colour& colour, double width = 1.0);
  void line(const Vec2& a, const Vec2& b, const Colour& colour, double width);
  void disc(const Vec2& centre, double radius, const Colour& colour);
  /// Vertically centred on `at`; no wider than `room`: smaller letters first, then "..." for the rest.
  void text(const Vec2& at, const std::string& text, TextStyle style, double room);
  void end();
  /// Width in pixels.
  [[nodiscard]] double width_of(const std::string& text, const TextStyle& style);

 private:
  void triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Colour& colour);
  void word(const Vec2& left_bottom, const std::string& text, const TextStyle& style);
  /// Left, right, bottom, top of text at the origin.
  [[nodiscard]] std::array<int, 4> extent(const std::string& text, const TextStyle& style);

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkPolyData> shapes_;
  std::vector<Vec2> corners_;
  std::vector<Colour> colours_;
  std::vector<vtkSmartPointer<vtkTextActor>> words_;
  std::size_t used_ = 0;
  std::map<std::string, std::array<int, 4>> extents_;
};

}  // namespace blendwright
