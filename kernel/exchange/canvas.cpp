#include "kernel/exchange/canvas.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace blendwright {
namespace {

constexpr int k = RenderTarget::oversampling;
constexpr double raised_size = 0.72, raised_by = 0.38;  // of the font size
constexpr int disc_sides = 12;

void apply(const TextStyle& style, double scale, vtkTextProperty& property) {
  property.SetFontFamilyToArial();
  property.SetFontSize(static_cast<int>(std::lround(style.size * scale)));
  property.SetBold(style.bold);
  property.SetColor(style.colour.r, style.colour.g, style.colour.b);
  property.SetOrientation(style.upward ? 90.0 : 0.0);
  property.SetJustificationToLeft();
  // A baseline common to all words of a size: centring each by its own box would let "1x" and "xyz" jump.
  property.SetVerticalJustificationToBottom();
}

struct Split {
  std::string base, raised;
};
Split split_exponent(const std::string& text) {
  const std::size_t mark = text.find('^');
  return mark == std::string::npos ? Split{text, ""} : Split{text.substr(0, mark), text.substr(mark + 1)};
}

/// Left, right, bottom, top in window pixels of text drawn horizontally at the origin.
std::array<int, 4> extent(const std::string& text, const TextStyle& style) {
  TextStyle flat = style;
  flat.upward = false;
  vtkNew<vtkTextProperty> property;
  apply(flat, k, *property);
  std::array<int, 4> box{};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, text, box.data(), 72);
  return box;
}

double word_width(const std::string& text, const TextStyle& style) {
  if (text.empty()) return 0.0;
  const auto box = extent(text, style);
  return static_cast<double>(box[1] - box[0] + 1) / k;
}

TextStyle raised(TextStyle style) {
  style.size = std::max(7, static_cast<int>(std::lround(raised_size * style.size)));
  return style;
}

unsigned char byte_of(double x) {
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(x, 0.0, 1.0)));
}

}  // namespace

Canvas::Canvas(const Colour& background) {
  renderer_->SetBackground(background.r, background.g, background.b);
  renderer_->InteractiveOff();
}

void Canvas::triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Colour& colour) {
  corners_.insert(corners_.end(), {a, b, c});
  colours_.push_back(colour);
}

void Canvas::fill(const PixelBox& b, const Colour& colour) {
  const Vec2 p(b.left, b.bottom), q(b.right, b.bottom), r(b.right, b.top), s(b.left, b.top);
  triangle(p, q, r, colour);
  triangle(p, r, s, colour);
}

void Canvas::frame(const PixelBox& b, const Colour& colour, double width) {
  line({{b.left, b.bottom}, {b.right, b.bottom}, {b.right, b.top}, {b.left, b.top}, {b.left, b.bottom}},
       colour, width);
}

void Canvas::disc(const Vec2& centre, double radius, const Colour& colour) {
  const auto rim = [&](int i) {
    const double angle = 2.0 * std::numbers::pi * i / disc_sides;
    return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  };
  for (int i = 0; i < disc_sides; ++i) triangle(centre, rim(i), rim(i + 1), colour);
}

void Canvas::segment(const Vec2& a, const Vec2& b, double width, const Colour& colour) {
  const Vec2 along = b - a;
  if (along.norm() == 0.0) return;
  const Vec2 side = 0.5 * width * Vec2(-along.y(), along.x()).normalized();
  triangle(a + side, a - side, b - side, colour);
  triangle(a + side, b - side, b + side, colour);
}

void Canvas::line(const std::vector<Vec2>& points, const Colour& colour, double width, double dash) {
  double phase = 0.0;  // how far the line is into a dash and its gap
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    if (dash == 0.0 && width > 1.0) disc(points[i], 0.5 * width, colour);
    if (i == 0 || !points[i - 1].allFinite()) continue;
    const Vec2 a = points[i - 1], step = points[i] - a;
    const double length = step.norm();
    if (dash == 0.0) {
      segment(a, points[i], width, colour);
      continue;
    }
    for (double s = -phase; s < length; s += 2.0 * dash) {
      const double from = std::max(s, 0.0), to = std::min(s + dash, length);
      if (from < to) segment(a + step * (from / length), a + step * (to / length), width, colour);
    }
    phase = std::fmod(phase + length, 2.0 * dash);
  }
}

void Canvas::word(const Vec2& at, const std::string& text, const TextStyle& style) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  apply(style, k, *actor->GetTextProperty());
  actor->SetPosition(k * at.x(), k * at.y());
  actor->SetLayerNumber(1);
  renderer_->AddActor2D(actor);
}

double Canvas::width_of(const std::string& text, const TextStyle& style) {
  const Split split = split_exponent(text);
  return word_width(split.base, style) + word_width(split.raised, raised(style));
}

TextStyle Canvas::fitting(const std::string& text, TextStyle style, double width, int least) {
  while (style.size > least && width_of(text, style) > width) --style.size;
  return style;
}

void Canvas::text(const Vec2& at, const std::string& text, const TextStyle& style) {
  if (text.empty()) return;
  const Split split = split_exponent(text);
  const double width = width_of(text, style);
  const double back = style.align == Align::left ? 0.0 : (style.align == Align::centre ? 0.5 * width : width);
  const auto digits = extent("0", style);  // capitals and digits are centred on `at`
  const double height = static_cast<double>(digits[3] - digits[2]) / k;
  const Vec2 along = style.upward ? Vec2(0.0, 1.0) : Vec2(1.0, 0.0);
  const Vec2 up = style.upward ? Vec2(-1.0, 0.0) : Vec2(0.0, 1.0);
  const Vec2 origin = at - back * along - 0.5 * height * up;
  word(origin, split.base, style);
  if (!split.raised.empty())
    word(origin + word_width(split.base, style) * along + raised_by * style.size * up, split.raised,
         raised(style));
}

void Canvas::finish(RenderTarget& target, int layer) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const Vec2& p : corners_) points->InsertNextPoint(k * p.x(), k * p.y(), 0.0);
  for (std::size_t t = 0; t < colours_.size(); ++t) {
    const auto first = static_cast<vtkIdType>(3 * t);
    cells->InsertNextCell({first, first + 1, first + 2});
    const std::array<unsigned char, 3> rgb{byte_of(colours_[t].r), byte_of(colours_[t].g),
                                           byte_of(colours_[t].b)};
    for (int corner = 0; corner < 3; ++corner) colours->InsertNextTypedTuple(rgb.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  renderer_->AddActor2D(actor);
  target.add(*renderer_, layer);
}

}  // namespace blendwright
