#include "app/view/window/layout.hpp"

#include <algorithm>

namespace blendwright {
namespace {

constexpr double line_height = 22.0, margin = 8.0;
constexpr double panel_part = 0.24, least_panel = 190.0, most_panel = 290.0;
constexpr double heading_height = 26.0, row_height = 44.0, label_height = 20.0;
constexpr double picked_height = 186.0, bar_width = 96.0, title_height = 24.0;
constexpr double help_width = 700.0, least_help_width = 600.0;

/// Rows of the page between the heading and what was picked.
void place_rows(ViewLayout& layout, const LayoutRequest& request, double top, double bottom) {
  const auto fit = static_cast<std::size_t>(std::max(1.0, (top - bottom) / row_height));
  layout.pages = std::max<std::size_t>(1, (request.controls + fit - 1) / fit);
  layout.first_control = std::min(request.page, layout.pages - 1) * fit;
  const std::size_t count = std::min(fit, request.controls - layout.first_control);
  const double left = layout.panel.left + margin, right = layout.panel.right - margin;
  for (std::size_t i = 0; i < count; ++i) {
    const double row_top = top - row_height * static_cast<double>(i);
    layout.rows.push_back({left, row_top - row_height, right, row_top});
    layout.labels.push_back({left, row_top - label_height, right, row_top});
    layout.tracks.push_back({left, row_top - row_height + 4.0, right, row_top - label_height});
  }
}

void place_panel(ViewLayout& layout, const LayoutRequest& request, double height) {
  const double width = std::clamp(panel_part * request.width, least_panel, most_panel);
  layout.panel = {0.0, layout.status.top, width, height};
  double top = height - margin, bottom = layout.panel.bottom + margin;
  if (request.picked) {
    layout.picked = {margin, bottom, width - margin, bottom + picked_height};
    bottom += picked_height + margin;
  }
  if (request.controls == 0) return;
  layout.heading = {margin, top - heading_height, width - margin, top};
  top -= heading_height;
  place_rows(layout, request, top, bottom);
}

void place_panes(ViewLayout& layout, const LayoutRequest& request, double left, double right, double height) {
  const double strip = request.panes > 1 ? title_height : 0.0;
  const double width = (right - left) / static_cast<double>(request.panes);
  for (std::size_t i = 0; i < request.panes; ++i) {
    const double from = left + width * static_cast<double>(i), to = from + width;
    layout.panes.push_back({from, layout.status.top, to, height - strip});
    if (request.panes > 1) layout.titles.push_back({from, height - strip, to, height});
  }
}

}  // namespace

ViewLayout layout_of(const LayoutRequest& request) {
  ViewLayout layout;
  const double width = std::max(request.width, least_window_width);
  const double height = std::max(request.height, least_window_height);
  layout.message = {margin, 2.0, width - margin, line_height};
  layout.status = {margin, line_height, width - margin, 2.0 * line_height};
  if (request.controls > 0 || request.picked) place_panel(layout, request, height);
  const double left = layout.panel.right;
  double right = width;
  if (request.bar) {
    right -= bar_width;
    layout.bar = {right, layout.status.top, width, height};
  }
  place_panes(layout, request, left, right, height);
  layout.help_over_all = right - left < least_help_width + 2.0 * margin;
  const double from = layout.help_over_all ? 0.0 : left, to = layout.help_over_all ? width : right;
  const double middle = 0.5 * (from + to), half = 0.5 * std::min(help_width, to - from - 2.0 * margin);
  layout.help = {middle - half, layout.status.top + margin, middle + half, height - margin};
  return layout;
}

bool contains(const PixelBox& box, const Vec2& at) {
  return at.x() >= box.left && at.x() < box.right && at.y() >= box.bottom && at.y() < box.top;
}

}  // namespace blendwright
