#pragma once
// Private: flat drawing over a picture, in pixels from the lower left corner.
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <optional>
#include <string>
#include <vector>

#include "kernel/base/units.hpp"
#include "kernel/brep/shape.hpp"
#include "kernel/exchange/axis.hpp"
#include "kernel/exchange/render_target.hpp"

class vtkTextProperty;

namespace blendwright {

enum class Align { left, centre, right };

struct TextStyle {
  int size = 14;  ///< pixels
  Align align = Align::left;
  bool bold = false;
  bool upward = false;  ///< reads from bottom to top
  Colour colour{0.13, 0.13, 0.13};
};

struct PixelBox {
  double left = 0.0, bottom = 0.0, right = 0.0, top = 0.0;
  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return top - bottom; }
};

class Canvas {
 public:
  explicit Canvas(const Colour& background = {1.0, 1.0, 1.0});
  void fill(const PixelBox& box, const Colour& colour);
  void frame(const PixelBox& box, const Colour& colour, double width);
  /// Round joints and ends; `dash` > 0: dashes and gaps of that length. A point with a NaN interrupts the
  /// line.
  void line(const std::vector<Vec2>& points, const Colour& colour, double width, double dash = 0.0);
  /// Vertically centred on `at`. "x^-8" is drawn with a raised -8 at its end.
  void text(const Vec2& at, const std::string& text, const TextStyle& style);
  /// Width in pixels.
  [[nodiscard]] static double width_of(const std::string& text, const TextStyle& style);
  /// `text` in the largest size from style.size down to `least` that is no wider than `width`.
  [[nodiscard]] static TextStyle fitting(const std::string& text, TextStyle style, double width,
                                         int least = 9);
  /// Puts what was drawn into `target`.
  void finish(RenderTarget& target, int layer);

 private:
  void triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Colour& colour);
  void disc(const Vec2& centre, double radius, const Colour& colour);
  void segment(const Vec2& a, const Vec2& b, double width, const Colour& colour);
  void word(const Vec2& at, const std::string& text, const TextStyle& style);

  vtkNew<vtkRenderer> renderer_;
  std::vector<Vec2> corners_;    ///< three per triangle
  std::vector<Colour> colours_;  ///< one per triangle
};

}  // namespace blendwright
