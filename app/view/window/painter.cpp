#include "app/view/window/painter.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blendwright {
namespace {

constexpr int disc_sides = 20, least_size = 10;
constexpr double raised_size = 0.74, raised_by = 0.38;  // of the font size
constexpr double above = 0.15;  // of the font size: how far letters stand above the middle of their box
constexpr std::size_t most_extents = 4096;

void apply(const TextStyle& style, vtkTextProperty& property) {
  property.SetFontFamilyToArial();
  property.SetFontSize(style.size);
  property.SetBold(style.bold);
  property.SetColor(style.colour.r, style.colour.g, style.colour.b);
  property.SetOrientation(style.upward ? 90.0 : 0.0);
  property.SetJustificationToLeft();
  property.SetVerticalJustificationToBottom();
}

unsigned char byte_of(double x) {
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(x, 0.0, 1.0)));
}

TextStyle raised(TextStyle style) {
  style.size = std::max(8, static_cast<int>(std::lround(raised_size * style.size)));
  return style;
}

}  // namespace

Painter::Painter() {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shapes_);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  renderer_->AddActor2D(actor);
  renderer_->InteractiveOff();
}

void Painter::begin() {
  corners_.clear();
  colours_.clear();
  used_ = 0;
}

void Painter::triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Colour& colour) {
  corners_.insert(corners_.end(), {a, b, c});
  colours_.push_back(colour);
}

void Painter::fill(const PixelBox& b, const Colour& colour) {
  const Vec2 p(b.left, b.bottom), q(b.right, b.bottom), r(b.right, b.top), s(b.left, b.top);
  triangle(p, q, r, colour);
  triangle(p, r, s, colour);
}

void Painter::frame(const PixelBox& b, const Colour& colour, double width) {
  fill({b.left, b.bottom, b.right, b.bottom + width}, colour);
  fill({b.left, b.top - width, b.right, b.top}, colour);
  fill({b.left, b.bottom, b.left + width, b.top}, colour);
  fill({b.right - width, b.bottom, b.right, b.top}, colour);
}

void Painter::line(const Vec2& a, const Vec2& b, const Colour& colour, double width) {
  const Vec2 along = b - a;
  if (along.norm() == 0.0) return;
  const Vec2 side = 0.5 * width * Vec2(-along.y(), along.x()).normalized();
  triangle(a + side, a - side, b - side, colour);
  triangle(a + side, b - side, b + side, colour);
}

void Painter::disc(const Vec2& centre, double radius, const Colour& colour) {
  const auto rim = [&](int i) {
    const double angle = 2.0 * std::numbers::pi * i / disc_sides;
    return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  };
  for (int i = 0; i < disc_sides; ++i) triangle(centre, rim(i), rim(i + 1), colour);
}

std::array<int, 4> Painter::extent(const std::string& text, const TextStyle& style) {
  const std::string key = std::to_string(style.size) + (style.bold ? "b" : "n") + text;
  if (const auto found = extents_.find(key); found != extents_.end()) return found->second;
  TextStyle flat = style;
  flat.upward = false;
  vtkNew<vtkTextProperty> property;
  apply(flat, *property);
  std::array<int, 4> box{};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, text, box.data(), 72);
  if (extents_.size() > most_extents) extents_.clear();
  return extents_[key] = box;
}

double Painter::width_of(const std::string& text, const TextStyle& style) {
  if (text.empty()) return 0.0;
  const std::size_t mark = text.find('^');
  if (mark != std::string::npos)
    return width_of(text.substr(0, mark), style) + width_of(text.substr(mark + 1), raised(style));
  const auto box = extent(text, style);
  return box[1] - box[0] + 1;
}

void Painter::word(const Vec2& at, const std::string& text, const TextStyle& style) {
  if (used_ == words_.size()) {
    words_.push_back(vtkSmartPointer<vtkTextActor>::New());
    words_.back()->SetLayerNumber(1);
    renderer_->AddActor2D(words_.back());
  }
  vtkTextActor& actor = *words_[used_++];
  actor.SetVisibility(true);
  actor.SetInput(text.c_str());
  apply(style, *actor.GetTextProperty());
  actor.SetPosition(std::round(at.x()), std::round(at.y()));
}

void Painter::text(const Vec2& at, const std::string& whole, TextStyle style, double room) {
  while (style.size > least_size && width_of(whole, style) > room) --style.size;
  std::string shown = whole;
  for (std::size_t keep = whole.size(); keep > 0 && width_of(shown, style) > room;)
    shown = whole.substr(0, --keep) + "...";
  if (shown.empty()) return;
  const double width = width_of(shown, style);
  const double back = style.align == Align::left ? 0.0 : (style.align == Align::centre ? 0.5 * width : width);
  const auto digits = extent("0", style);  // capitals and digits are centred on `at`
  const Vec2 along = style.upward ? Vec2(0.0, 1.0) : Vec2(1.0, 0.0);
  const Vec2 up = style.upward ? Vec2(-1.0, 0.0) : Vec2(0.0, 1.0);
  const Vec2 origin = at - back * along - (0.5 * (digits[3] - digits[2]) + above * style.size) * up;
  const std::size_t mark = shown.find('^');
  const std::string base = shown.substr(0, mark);
  word(origin, base, style);
  if (mark != std::string::npos && mark + 1 < shown.size())
    word(origin + width_of(base, style) * along + raised_by * style.size * up, shown.substr(mark + 1),
         raised(style));
}

void Painter::end() {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const Vec2& p : corners_) points->InsertNextPoint(p.x(), p.y(), 0.0);
  for (std::size_t t = 0; t < colours_.size(); ++t) {
    const auto first = static_cast<vtkIdType>(3 * t);
    cells->InsertNextCell({first, first + 1, first + 2});
    const std::array<unsigned char, 3> rgb{byte_of(colours_[t].r), byte_of(colours_[t].g),
                                           byte_of(colours_[t].b)};
    for (int corner = 0; corner < 3; ++corner) colours->InsertNextTypedTuple(rgb.data());
  }
  shapes_->SetPoints(points);
  shapes_->SetPolys(cells);
  shapes_->GetPointData()->SetScalars(colours);
  for (std::size_t i = used_; i < words_.size(); ++i) words_[i]->SetVisibility(false);
}

}  // namespace blendwright
