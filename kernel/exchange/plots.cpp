#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/exchange/canvas.hpp"
#include "kernel/exchange/colour_map.hpp"
#include "kernel/exchange/picture.hpp"
#include "kernel/exchange/picture_layout.hpp"
#include "kernel/exchange/vtk_messages.hpp"

namespace blendwright {
namespace {

constexpr int plot_decades = 12;
const Colour limit_colour{0.80, 0.12, 0.12};

/// Sizes and colours of a panel: small panels have small letters.
struct PanelStyle {
  double scale = 1.0;
  Colour ink{0.25, 0.25, 0.28}, grid{0.90, 0.90, 0.91}, text{0.13, 0.13, 0.13};
  [[nodiscard]] TextStyle sized(double size, Align align = Align::left, bool bold = false) const {
    return {
        .size = static_cast<int>(std::lround(size * scale)), .align = align, .bold = bold, .colour = text};
  }
};

PanelStyle panel_style(const PixelBox& area, bool dark) {
  PanelStyle style;
  style.scale = std::clamp(std::min(area.width() / 420.0, area.height() / 400.0), 0.64, 1.0);
  if (dark) {
    style.ink = {0.72, 0.72, 0.74};
    style.grid = {0.22, 0.23, 0.26};
    style.text = theme_of(true).ink;
  }
  return style;
}

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

Axes axes_of(const Plot& plot, const PixelBox& box, double scale) {
  std::vector<double> xs, ys;
  for (const PlotCurve& curve : plot.curves) {
    xs.insert(xs.end(), curve.x.begin(), curve.x.end());
    ys.insert(ys.end(), curve.y.begin(), curve.y.end());
  }
  if (plot.limit) ys.push_back(*plot.limit);
  const int rows = std::max(2, static_cast<int>(box.height() / (34.0 * scale)));
  const int columns = std::max(2, static_cast<int>(box.width() / (65.0 * scale)));
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
  Panel(Canvas& canvas, const Plot& plot, const PixelBox& area, bool dark)
      : canvas_(canvas), plot_(plot), area_(area), style_(panel_style(area, dark)) {
    box_ = {area.left + px(84), area.bottom + px(62), area.right - px(22), area.top - px(84)};
    axes_ = axes_of(plot, box_, style_.scale);
  }

  void draw() {
    draw_scales();
    draw_curves();
    draw_legend();
    const double middle = 0.5 * (box_.left + box_.right);
    const TextStyle title = style_.sized(18, Align::centre, true), label = style_.sized(16, Align::centre);
    canvas_.text({middle, area_.top - px(24)}, plot_.title,
                 Canvas::fitting(plot_.title, title, 2.0 * (area_.right - middle) - 8));
    canvas_.text({middle, area_.bottom + px(18)}, plot_.x_label,
                 Canvas::fitting(plot_.x_label, label, box_.width()));
    TextStyle upward = label;
    upward.upward = true;
    canvas_.text({area_.left + px(18), 0.5 * (box_.bottom + box_.top)}, plot_.y_label,
                 Canvas::fitting(plot_.y_label, upward, box_.height()));
  }

 private:
  [[nodiscard]] double px(double size) const { return size * style_.scale; }
  [[nodiscard]] double x_at(double t) const { return box_.left + t * box_.width(); }
  [[nodiscard]] double y_at(double t) const { return box_.bottom + t * box_.height(); }
  [[nodiscard]] Vec2 at(double x, double y) const {
    return {x_at(axes_.x.position(x)), y_at(axes_.y.position(y))};
  }

  void draw_scales() {
    const TextStyle below = style_.sized(14, Align::centre), beside = style_.sized(14, Align::right);
    const Colour &ink = style_.ink, &grid = style_.grid;
    for (const Tick& tick : axes_.y.ticks) {
      const double y = y_at((tick.value - axes_.y.lo) / (axes_.y.hi - axes_.y.lo));
      if (!tick.label.empty()) canvas_.line({{box_.left, y}, {box_.right, y}}, grid, 1.0);
      canvas_.line({{box_.left - 5, y}, {box_.left, y}}, ink, 1.0);
      canvas_.text({box_.left - px(9), y}, tick.label, beside);
    }
    for (const Tick& tick : axes_.x.ticks) {
      const double x = x_at((tick.value - axes_.x.lo) / (axes_.x.hi - axes_.x.lo));
      canvas_.line({{x, box_.bottom}, {x, box_.top}}, grid, 1.0);
      canvas_.line({{x, box_.bottom - 5}, {x, box_.bottom}}, ink, 1.0);
      canvas_.text({x, box_.bottom - px(17)}, tick.label, below);
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
      canvas_.line(points, curve_colour(c), dense ? 1.0 : 2.0 * style_.scale, curve.dash);
    }
  }

  struct Entry {
    std::string label;
    Colour colour;
    double dash;
  };
  using Row = std::vector<Entry>;

  [[nodiscard]] double width_of(const Row& row, const TextStyle& style) const {
    double sum = px(between) * (static_cast<double>(row.size()) - 1.0);
    for (const Entry& e : row) sum += px(sample + space) + Canvas::width_of(e.label, style);
    return sum;
  }

  /// Above the frame, so that no curve runs through it; in two rows where one would be too wide.
  void draw_legend() {
    std::vector<Row> rows(1);
    for (std::size_t c = 0; c < plot_.curves.size(); ++c)
      if (!plot_.curves[c].label.empty())
        rows[0].push_back({plot_.curves[c].label, curve_colour(c), plot_.curves[c].dash});
    if (plot_.limit) rows[0].push_back({"tolerance " + quantity_text(*plot_.limit), limit_colour, 7.0});
    const double room = area_.width() - 8;
    TextStyle style = style_.sized(14);
    if (rows[0].size() > 1 && width_of(rows[0], style) > room) {
      const auto half = rows[0].begin() + static_cast<std::ptrdiff_t>((rows[0].size() + 1) / 2);
      rows.push_back({half, rows[0].end()});
      rows[0].erase(half, rows[0].end());
    }
    for (const Row& row : rows)
      while (style.size > 8 && width_of(row, style) > room) --style.size;
    double y = box_.top + (rows.size() > 1 ? px(38) : px(22));
    for (const Row& row : rows) {
      draw_row(row, style, y);
      y -= px(22);
    }
  }

  void draw_row(const Row& row, const TextStyle& style, double y) {
    const double width = width_of(row, style);
    double x = std::max(area_.left + 4, 0.5 * (box_.left + box_.right - width));
    x = std::min(x, std::max(area_.left + 4, area_.right - 4 - width));
    for (const Entry& e : row) {
      canvas_.line({{x, y}, {x + px(sample), y}}, e.colour, 2.2, e.dash);
      canvas_.text({x + px(sample + space), y}, e.label, style);
      x += px(sample + space + between) + Canvas::width_of(e.label, style);
    }
  }

  static constexpr double sample = 24.0, space = 6.0, between = 18.0;  // of a legend

  Canvas& canvas_;
  const Plot& plot_;
  PixelBox area_, box_;
  PanelStyle style_;
  Axes axes_;
};

}  // namespace

void write_plots(const std::filesystem::path& png, const PlotSheet& sheet, const Display& display) {
  require_drawable(png, sheet.width, sheet.height, display);
  for (const Plot& plot : sheet.plots) require_consistent(plot);
  const VtkMessages messages;
  RenderTarget target(sheet.width, sheet.height);
  const PictureTheme theme = theme_of(sheet.dark);
  Canvas canvas(theme.background);
  double top = sheet.height;
  if (!sheet.title.empty()) {
    const TextStyle style = Canvas::fitting(sheet.title,
                                            {.size = std::clamp(sheet.height / 34, 15, 60),
                                             .align = Align::centre,
                                             .bold = true,
                                             .colour = theme.ink},
                                            0.96 * sheet.width);
    top -= 2.0 * style.size;
    canvas.text({0.5 * sheet.width, 0.5 * (top + sheet.height)}, sheet.title, style);
  }
  const std::size_t count = std::max<std::size_t>(sheet.plots.size(), 1);
  const std::size_t columns = sheet.columns == 0 ? count : std::min(sheet.columns, count);
  const std::size_t rows = (count + columns - 1) / columns;
  const double width = static_cast<double>(sheet.width) / static_cast<double>(columns),
               height = top / static_cast<double>(rows);
  for (std::size_t i = 0; i < sheet.plots.size(); ++i) {
    const auto x = static_cast<double>(i % columns), y = static_cast<double>(i / columns);
    Panel(canvas, sheet.plots[i], {width * x, top - height * (y + 1.0), width * (x + 1.0), top - height * y},
          sheet.dark)
        .draw();
  }
  canvas.finish(target, 0);
  target.write_png(png);
}

void write_plots(const std::filesystem::path& png, const std::vector<Plot>& plots, const Display& display,
                 int width, int height) {
  write_plots(png, PlotSheet{.title = {}, .plots = plots, .columns = 0, .width = width, .height = height},
              display);
}

}  // namespace blendwright
