#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/exchange/canvas.hpp"
#include "kernel/exchange/colour_map.hpp"
#include "kernel/exchange/picture.hpp"
#include "kernel/exchange/vtk_messages.hpp"

namespace blendwright {
namespace {

constexpr int plot_decades = 12;
const Colour ink{0.25, 0.25, 0.28}, grid{0.90, 0.90, 0.91}, limit_colour{0.80, 0.12, 0.12};
const TextStyle tick_style{.size = 14}, label_style{.size = 16, .align = Align::centre},
    title_style{.size = 18, .align = Align::centre, .bold = true}, legend_style{.size = 14};

void require_consistent(const Plot& plot) {
  for (const PlotCurve& curve : plot.curves)
    if (curve.x.size() != curve.y.size())
      throw InputError("plots/" + plot.title + "/" + curve.label,
                       "has " + std::to_string(curve.x.size()) + " x and " + std::to_string(curve.y.size()) +
                           " y, must have as many");
}

struct Axes {
  Axis x, y;
};

Axes axes_of(const Plot& plot, const PixelBox& box) {
  std::vector<double> xs, ys;
  for (const PlotCurve& curve : plot.curves) {
    xs.insert(xs.end(), curve.x.begin(), curve.x.end());
    ys.insert(ys.end(), curve.y.begin(), curve.y.end());
  }
  if (plot.limit) ys.push_back(*plot.limit);
  const int rows = std::max(2, static_cast<int>(box.height() / 34.0));
  const int columns = std::max(2, static_cast<int>(box.width() / 65.0));
  ValueRange y = range_of(ys);
  // Headroom: a limit on the uppermost line of the frame would not be seen as a line.
  if (plot.logarithmic) {
    y.most *= 2.0;
  } else {
    y.most += 0.05 * (y.most - y.least);
    y.least = std::min(y.least, 0.0);
  }
  return {linear_axis(range_of(xs), columns, true),
          plot.logarithmic ? log_axis(y, plot_decades, rows) : linear_axis(y, rows)};
}

class Panel {
 public:
  Panel(Canvas& canvas, const Plot& plot, const PixelBox& area) : canvas_(canvas), plot_(plot), area_(area) {
    box_ = {area.left + 84, area.bottom + 62, area.right - 22, area.top - 84};
    axes_ = axes_of(plot, box_);
  }

  void draw() {
    draw_scales();
    draw_curves();
    draw_legend();
    const double middle = 0.5 * (box_.left + box_.right);
    canvas_.text({middle, area_.top - 24}, plot_.title,
                 Canvas::fitting(plot_.title, title_style, area_.width() - 16));
    canvas_.text({middle, area_.bottom + 18}, plot_.x_label,
                 Canvas::fitting(plot_.x_label, label_style, box_.width()));
    TextStyle upward = label_style;
    upward.upward = true;
    canvas_.text({area_.left + 18, 0.5 * (box_.bottom + box_.top)}, plot_.y_label,
                 Canvas::fitting(plot_.y_label, upward, box_.height()));
  }

 private:
  [[nodiscard]] double x_at(double t) const { return box_.left + t * box_.width(); }
  [[nodiscard]] double y_at(double t) const { return box_.bottom + t * box_.height(); }
  [[nodiscard]] Vec2 at(double x, double y) const {
    return {x_at(axes_.x.position(x)), y_at(axes_.y.position(y))};
  }

  void draw_scales() {
    TextStyle below = tick_style, beside = tick_style;
    below.align = Align::centre;
    beside.align = Align::right;
    for (const Tick& tick : axes_.y.ticks) {
      const double y = y_at((tick.value - axes_.y.lo) / (axes_.y.hi - axes_.y.lo));
      if (!tick.label.empty()) canvas_.line({{box_.left, y}, {box_.right, y}}, grid, 1.0);
      canvas_.line({{box_.left - 5, y}, {box_.left, y}}, ink, 1.0);
      canvas_.text({box_.left - 9, y}, tick.label, beside);
    }
    for (const Tick& tick : axes_.x.ticks) {
      const double x = x_at((tick.value - axes_.x.lo) / (axes_.x.hi - axes_.x.lo));
      canvas_.line({{x, box_.bottom}, {x, box_.top}}, grid, 1.0);
      canvas_.line({{x, box_.bottom - 5}, {x, box_.bottom}}, ink, 1.0);
      canvas_.text({x, box_.bottom - 17}, tick.label, below);
    }
    canvas_.frame(box_, ink, 1.0);
  }

  void draw_curves() {
    if (plot_.limit) {
      const double y = y_at(axes_.y.position(*plot_.limit));
      canvas_.line({{box_.left, y}, {box_.right, y}}, limit_colour, 1.6, 7.0);
    }
    for (std::size_t c = 0; c < plot_.curves.size(); ++c) {
      const PlotCurve& curve = plot_.curves[c];
      std::vector<Vec2> points;
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        points.push_back(std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])
                             ? at(curve.x[i], curve.y[i])
                             : Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
      // Points closer than pixels are an oscillation: thick lines would make a solid band of it.
      const bool dense = static_cast<double>(points.size()) > box_.width();
      canvas_.line(points, curve_colour(c), dense ? 1.0 : 2.0);
    }
  }

  /// One row above the frame, so that no curve runs through it.
  void draw_legend() {
    struct Entry {
      std::string label;
      Colour colour;
      double dash;
    };
    std::vector<Entry> entries;
    for (std::size_t c = 0; c < plot_.curves.size(); ++c)
      if (!plot_.curves[c].label.empty()) entries.push_back({plot_.curves[c].label, curve_colour(c), 0.0});
    if (plot_.limit) entries.push_back({"tolerance " + quantity_text(*plot_.limit), limit_colour, 7.0});
    constexpr double sample = 24.0, space = 6.0, between = 18.0;
    const auto width = [&](const TextStyle& style) {
      double sum = between * (static_cast<double>(entries.size()) - 1.0);
      for (const Entry& e : entries) sum += sample + space + Canvas::width_of(e.label, style);
      return sum;
    };
    TextStyle style = legend_style;
    while (style.size > 9 && width(style) > area_.width() - 16) --style.size;
    double x = std::max(area_.left + 8, 0.5 * (box_.left + box_.right - width(style)));
    x = std::min(x, std::max(area_.left + 8, area_.right - 8 - width(style)));
    const double y = box_.top + 22;
    for (const Entry& e : entries) {
      canvas_.line({{x, y}, {x + sample, y}}, e.colour, 2.2, e.dash);
      canvas_.text({x + sample + space, y}, e.label, style);
      x += sample + space + Canvas::width_of(e.label, style) + between;
    }
  }

  Canvas& canvas_;
  const Plot& plot_;
  PixelBox area_, box_;
  Axes axes_;
};

}  // namespace

void write_plots(const std::filesystem::path& png, const std::vector<Plot>& plots, const Display& display,
                 int width, int height) {
  require_drawable(png, width, height, display);
  for (const Plot& plot : plots) require_consistent(plot);
  const VtkMessages messages;
  RenderTarget target(width, height);
  Canvas canvas;
  const double each =
      static_cast<double>(width) / static_cast<double>(std::max<std::size_t>(plots.size(), 1));
  for (std::size_t i = 0; i < plots.size(); ++i)
    Panel(
        canvas, plots[i],
        {each * static_cast<double>(i), 0.0, each * static_cast<double>(i + 1), static_cast<double>(height)})
        .draw();
  canvas.finish(target, 0);
  target.write_png(png);
}

}  // namespace blendwright
