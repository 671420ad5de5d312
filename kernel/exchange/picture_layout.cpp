#include "kernel/exchange/picture_layout.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright {
namespace {

constexpr int least_title = 13;  // pixels: smaller titles are told in two lines
constexpr double key_swatch = 18.0, key_space = 9.0;
constexpr double bar_margin = 10.0, bar_width = 20.0, tick_space = 9.0;

double widest(const std::vector<Tick>& ticks, const TextStyle& style) {
  double width = 0.0;
  for (const Tick& tick : ticks) width = std::max(width, Canvas::width_of(tick.label, style));
  return width;
}

/// Both halves of a title, cut behind the comma or colon, or before the parenthesis, nearest to the middle.
std::vector<std::string> halves(const std::string& title) {
  std::size_t best = std::string::npos;
  const auto off = [&](std::size_t at) {
    return std::abs(2.0 * static_cast<double>(at) - static_cast<double>(title.size()));
  };
  for (std::size_t i = 1; i + 1 < title.size(); ++i) {
    const bool cut = title[i] == ' ' && (title[i - 1] == ',' || title[i - 1] == ':' || title[i + 1] == '(');
    if (cut && (best == std::string::npos || off(i) < off(best))) best = i;
  }
  if (best == std::string::npos) return {title};
  return {title.substr(0, best), title.substr(best + 1)};
}

void lay_title(const Picture& picture, double font, PictureLayout& layout) {
  const double width = 0.96 * picture.width;
  layout.title_lines = {picture.title};
  TextStyle style = layout.title_style;
  style.size = static_cast<int>(std::lround(23.0 * font));
  layout.title_style = Canvas::fitting(picture.title, style, width);
  if (layout.title_style.size < std::min(least_title, style.size)) {
    layout.title_lines = halves(picture.title);
    style.size = std::min(style.size, static_cast<int>(std::lround(17.0 * font)));
    for (const std::string& line : layout.title_lines) style = Canvas::fitting(line, style, width);
    layout.title_style = style;
  }
  const double height = picture.title.empty() ? 0.0
                                              : 1.45 * layout.title_style.size *
                                                        static_cast<double>(layout.title_lines.size()) +
                                                    0.55 * 23.0 * font;
  layout.title = {0.0, picture.height - height, static_cast<double>(picture.width),
                  static_cast<double>(picture.height)};
}

/// How much of the worst view's area its object fills when the views stand in so many columns.
double worst_fill(const std::vector<ViewExtents>& extents, const PixelBox& area, std::size_t columns,
                  double label) {
  const std::size_t rows = (extents.size() + columns - 1) / columns;
  const PixelBox cell{0.0, 0.0, area.width() / static_cast<double>(columns),
                      area.height() / static_cast<double>(rows) - label};
  if (cell.height() <= 0.0) return 0.0;
  double worst = cell.width() * cell.height();
  for (const ViewExtents& e : extents) {
    if (e.all.empty()) continue;
    const double scale = window_of(e, cell).pixels_per_unit(cell);
    const Vec3 size = scale * (e.all.hi - e.all.lo);
    worst = std::min(worst, std::min(size.x(), cell.width()) * std::min(size.y(), cell.height()));
  }
  return worst;
}

void lay_views(const Picture& picture, const PixelBox& area, PictureLayout& layout) {
  std::vector<ViewExtents> extents;
  for (const PictureView& view : views_of(picture))
    extents.push_back(extents_of(picture, frame_of(view.direction)));
  const double label = extents.size() > 1 ? 1.9 * layout.small_style.size : 0.0;
  std::size_t columns = 1;
  for (std::size_t c = 2; c <= extents.size(); ++c)
    if (worst_fill(extents, area, c, label) > 1.001 * worst_fill(extents, area, columns, label)) columns = c;
  const std::size_t rows = (extents.size() + columns - 1) / columns;
  const double width = area.width() / static_cast<double>(columns),
               height = area.height() / static_cast<double>(rows);
  for (std::size_t i = 0; i < extents.size(); ++i) {
    const double left = area.left + width * static_cast<double>(i % columns);
    const double bottom = area.top - height * static_cast<double>(i / columns + 1);
    layout.views.push_back({left, bottom + label, left + width, bottom + height});
    if (label > 0.0) layout.labels.push_back({left, bottom, left + width, bottom + label});
  }
}

}  // namespace

PictureTheme theme_of(bool dark) {
  if (!dark) return {};
  return {{0.09, 0.10, 0.12}, {0.90, 0.90, 0.90}, {0.62, 0.64, 0.68}};
}

PictureLayout layout_of(const Picture& picture, const std::optional<ColourScale>& scale) {
  PictureLayout layout;
  const double font = std::clamp(std::min(picture.width / 1000.0, picture.height / 760.0), 0.8, 4.0);
  const auto sized = [&](double size) { return static_cast<int>(std::lround(size * font)); };
  const Colour ink = theme_of(picture.dark).ink;
  layout.title_style = {.size = sized(23), .align = Align::centre, .bold = true, .colour = ink};
  layout.tick_style = {.size = sized(15), .colour = ink};
  layout.bar_style = {.size = sized(16), .align = Align::centre, .upward = true, .colour = ink};
  layout.key_style = {.size = sized(15), .colour = ink};
  layout.small_style = {.size = sized(15), .align = Align::centre, .colour = ink};
  lay_title(picture, font, layout);

  const double w = picture.width, top = layout.title.bottom;
  double right = w;
  if (scale) {
    const double ticks = widest(scale->axis().ticks, layout.tick_style);
    right -= font * (bar_margin + bar_width + tick_space) + ticks + 2.2 * layout.bar_style.size;
    layout.bar = {right, 0.0, w, top};
  } else if (!picture.keys.empty()) {
    double label = 0.0;
    for (const PictureKey& key : picture.keys)
      label = std::max(label, Canvas::width_of(key.label, layout.key_style));
    right -= label + std::max(1.0, font) * (key_swatch + 3.0 * key_space);
    layout.keys = {right, 0.0, w, top};
  }
  double bottom = 0.0;
  if (!picture.caption.empty() || picture.length_bar) {
    bottom = 2.0 * layout.small_style.size;
    layout.caption = {0.0, 0.0, right, bottom};
  }
  lay_views(picture, {0.0, bottom, right, top}, layout);
  return layout;
}

BarPlace bar_place(const PictureLayout& layout, const ColourScale& scale) {
  const PixelBox& column = layout.bar;
  const double font = layout.tick_style.size / 15.0;
  const double height = std::min(0.78 * column.height(), 560.0 * font);
  const double bottom = column.bottom + 0.5 * (column.height() - height);
  BarPlace place;
  place.bar = {column.left + bar_margin * font, bottom, column.left + (bar_margin + bar_width) * font,
               bottom + height};
  place.labels = place.bar.right + tick_space * font;
  place.title = place.labels + widest(scale.axis().ticks, layout.tick_style) + 1.2 * layout.bar_style.size;
  return place;
}

}  // namespace blendwright
