#include "app/view/window/overlay.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/number_text.hpp"
#include "kernel/exchange/axis.hpp"
#include "kernel/exchange/picture.hpp"
#include "kernel/exchange/picture_layout.hpp"

namespace blendwright {
namespace {

constexpr int normal_size = 13, small_size = 12, heading_size = 14;
constexpr double help_line = 17.0, help_gap = 10.0;

TextStyle style_of(const Colour& colour, int size = normal_size) { return {.size = size, .colour = colour}; }

double middle_y(const PixelBox& b) { return 0.5 * (b.bottom + b.top); }

/// A name at the left and what it is at the right of a box.
void draw_pair(Painter& painter, const PixelBox& box, const std::string& left, const std::string& right,
               const ViewTheme& theme, int size = normal_size) {
  TextStyle value = style_of(theme.ink, size);
  value.align = Align::right;
  const double y = middle_y(box), used = std::min(painter.width_of(right, value), 0.78 * box.width());
  painter.text({box.right, y}, right, value, 0.78 * box.width());
  painter.text({box.left, y}, left, style_of(theme.faint, size), box.width() - used - 8.0);
}

void draw_choice(Painter& painter, const SessionControl& c, const PixelBox& track, const ViewTheme& theme) {
  const auto chosen = static_cast<std::size_t>(std::lround(c.value));
  const double step = track.width() / static_cast<double>(c.choices.size());
  for (std::size_t i = 0; i < c.choices.size(); ++i) {
    const double left = track.left + step * static_cast<double>(i);
    const PixelBox cell{left, track.bottom + 1.0, left + step, track.top - 1.0};
    painter.fill(cell, i == chosen ? theme.accent : theme.background);
    painter.frame(cell, theme.line);
    TextStyle style = style_of(i == chosen ? Colour{1.0, 1.0, 1.0} : theme.ink, small_size);
    style.align = Align::centre;
    painter.text({0.5 * (cell.left + cell.right), middle_y(cell)}, c.choices[i], style, step - 6.0);
  }
}

void draw_track(Painter& painter, const SessionControl& c, const PixelBox& track, const ViewTheme& theme) {
  const double y = middle_y(track), x = Controller::pixel_of(c, track);
  painter.fill({track.left, y - 2.0, track.right, y + 2.0}, theme.track);
  painter.fill({track.left, y - 2.0, x, y + 2.0}, theme.accent);
  painter.disc({x, y}, 7.0, theme.accent);
  painter.disc({x, y}, 4.5, theme.background);
}

void draw_panel(Painter& painter, const Controller& controller, const ViewLayout& layout,
                const ViewTheme& theme) {
  if (layout.panel.width() <= 0.0) return;
  painter.fill(layout.panel, theme.panel);
  painter.fill({layout.panel.right - 1.0, layout.panel.bottom, layout.panel.right, layout.panel.top},
               theme.line);
  const std::vector<std::size_t> shown = controller.shown_controls();
  if (!shown.empty()) {
    const auto groups = controller.document().groups();
    std::string heading = controller.state().group < groups.size() ? groups[controller.state().group]
                                                                   : std::string("parameters");
    TextStyle style = style_of(theme.ink, heading_size);
    style.bold = true;
    std::string page;
    if (groups.size() > 1 || controller.documents().size() > 1) page = "Tab: next";
    if (layout.pages > 1)
      page = "N: page " + std::to_string(controller.state().page + 1) + "/" + std::to_string(layout.pages);
    TextStyle right = style_of(theme.faint, small_size);
    right.align = Align::right;
    const double used = painter.width_of(page, right);
    painter.text({layout.heading.right, middle_y(layout.heading)}, page, right, 0.5 * layout.heading.width());
    painter.text({layout.heading.left, middle_y(layout.heading)}, heading, style,
                 layout.heading.width() - used - 8.0);
  }
  for (std::size_t i = 0; i < layout.rows.size(); ++i) {
    const SessionControl& c = controller.controls()[shown[layout.first_control + i]];
    draw_pair(painter, layout.labels[i], c.label,
              c.kind == SessionControl::Kind::choice ? std::string() : value_text(c), theme);
    if (c.kind == SessionControl::Kind::choice)
      draw_choice(painter, c, layout.tracks[i], theme);
    else
      draw_track(painter, c, layout.tracks[i], theme);
  }
}

void draw_picked(Painter& painter, const Controller& controller, const ViewLayout& layout,
                 const ViewTheme& theme) {
  if (!controller.state().picked) return;
  painter.fill(layout.picked, theme.background);
  painter.frame(layout.picked, theme.line);
  const auto lines = picked_lines(*controller.state().picked, controller.document().unit());
  const double step = (layout.picked.height() - 8.0) / 11.0;  // as many as there can be
  double top = layout.picked.top - 4.0;
  for (const auto& [left, right] : lines) {
    draw_pair(painter, {layout.picked.left + 6.0, top - step, layout.picked.right - 6.0, top}, left, right,
              theme, small_size);
    top -= step;
  }
}

void draw_bar(Painter& painter, const Controller& controller, const ViewLayout& layout,
              const std::optional<ColourScale>& scale, const ViewTheme& theme) {
  if (layout.bar.width() <= 0.0) return;
  painter.fill(layout.bar, theme.background);
  if (!scale) return;
  const bool banded = controller.state().show == Show::isophotes;
  const PixelBox bar{layout.bar.left + 30.0, layout.bar.bottom + 28.0, layout.bar.left + 46.0,
                     layout.bar.top - 28.0};
  const int steps = banded ? isophote_bands : 128;
  for (int i = 0; i < steps; ++i)
    painter.fill({bar.left, bar.bottom + bar.height() * i / steps, bar.right,
                  bar.bottom + bar.height() * (i + 1) / steps},
                 colour_at(scale->map(), (i + 0.5) / steps));
  painter.frame(bar, theme.line);
  const Axis& axis = scale->axis();
  for (const Tick& tick : axis.ticks) {
    const double y = bar.bottom + bar.height() * (tick.value - axis.lo) / (axis.hi - axis.lo);
    painter.fill({bar.right, y - 0.5, bar.right + 4.0, y + 0.5}, theme.faint);
    painter.text({bar.right + 6.0, y}, tick.label, style_of(theme.ink, small_size),
                 layout.bar.right - bar.right - 8.0);
  }
  TextStyle title = style_of(theme.ink);
  title.align = Align::centre;
  title.upward = true;
  painter.text({layout.bar.left + 15.0, middle_y(bar)},
               bar_title(controller.state().show, controller.state().options), title, bar.height());
}

void draw_status(Painter& painter, const Controller& controller, const ViewLayout& layout,
                 const ViewTheme& theme) {
  const double top = layout.status.top;
  painter.fill({0.0, 0.0, static_cast<double>(controller.state().width), top}, theme.panel);
  painter.fill({0.0, top - 1.0, static_cast<double>(controller.state().width), top}, theme.line);
  TextStyle hint = style_of(theme.faint, small_size);
  hint.align = Align::right;
  const std::string keys = "H: help";
  const double used = painter.width_of(keys, hint) + 12.0;
  painter.text({layout.status.right, middle_y(layout.status)}, keys, hint, used);
  painter.text({layout.status.left, middle_y(layout.status)}, controller.document().figures(),
               style_of(theme.ink), layout.status.width() - used);
  painter.text({layout.message.left, middle_y(layout.message)}, controller.state().message,
               style_of(controller.state().warning ? theme.warning : theme.faint), layout.message.width());
}

void draw_titles(Painter& painter, const Controller& controller, const ViewLayout& layout,
                 const ViewTheme& theme) {
  for (std::size_t i = 0; i < layout.titles.size(); ++i) {
    const PixelBox& box = layout.titles[i];
    const bool active = i == controller.state().active;
    painter.fill(box, theme.panel);
    painter.fill({box.left, box.bottom, box.right, box.bottom + 2.0}, active ? theme.accent : theme.line);
    TextStyle style = style_of(active ? theme.ink : theme.faint);
    style.align = Align::centre;
    style.bold = active;
    const Document& d = *controller.documents()[i];
    painter.text({0.5 * (box.left + box.right), middle_y(box) + 1.0},
                 d.file().filename().string() + (d.changed() ? "*" : ""), style, box.width() - 16.0);
    if (i > 0) painter.fill({box.left, layout.panes[i].bottom, box.left + 1.0, box.top}, theme.line);
  }
}

struct HelpRow {
  std::string key, does;
};
std::vector<HelpRow> help_rows() {
  std::vector<HelpRow> rows;
  for (const ViewGesture& g : view_gestures()) rows.push_back({std::string(g.gesture), std::string(g.does)});
  for (const ViewKey& k : view_keys()) {
    std::string names(k.key);
    if (!k.also.empty() && k.also != "Next") names.append(" ").append(k.also);
    rows.push_back({std::move(names), std::string(k.does)});
  }
  return rows;
}

/// Two columns where they have room, else one with narrower lines.
void draw_help(Painter& painter, const ViewLayout& layout, const ViewTheme& theme) {
  const std::vector<HelpRow> rows = help_rows();
  const double inner = layout.help.width() - 3.0 * help_gap;
  const std::size_t columns = 2;
  const std::size_t per_column = (rows.size() + columns - 1) / columns;
  const double line =
      std::min(help_line * 1.35, (layout.help.height() - 5.0 * help_gap) / static_cast<double>(per_column));
  PixelBox box = layout.help;
  box.bottom = std::max(box.bottom, box.top - line * static_cast<double>(per_column) - 5.0 * help_gap);
  painter.fill(box, theme.background);
  painter.frame(box, theme.line, 2.0);
  TextStyle heading = style_of(theme.ink, heading_size);
  heading.bold = true;
  const double top = box.top - 3.2 * help_gap;
  painter.text({box.left + help_gap, box.top - 1.8 * help_gap}, "Mouse and keys", heading, inner);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double width = inner / static_cast<double>(columns), key_width = 0.30 * width;
    const double left = box.left + help_gap + (width + help_gap) * static_cast<double>(i / per_column);
    const double y = top - line * (static_cast<double>(i % per_column) + 0.5);
    TextStyle key = style_of(theme.ink, small_size);
    key.bold = true;
    painter.text({left, y}, rows[i].key, key, key_width - 6.0);
    painter.text({left + key_width, y}, rows[i].does, style_of(theme.ink, small_size), width - key_width);
  }
}

}  // namespace

ViewTheme view_theme(bool dark) {
  const PictureTheme picture = theme_of(dark);
  if (dark)
    return {picture.background, {0.17, 0.18, 0.20}, {0.36, 0.38, 0.42}, picture.ink,
            {0.70, 0.72, 0.75}, {0.25, 0.52, 0.86}, {1.00, 0.62, 0.35}, {0.34, 0.36, 0.40}};
  return {picture.background, {0.945, 0.95, 0.957}, {0.76, 0.78, 0.81}, picture.ink,
          {0.36, 0.38, 0.42}, {0.13, 0.40, 0.70},   {0.72, 0.22, 0.05}, {0.80, 0.82, 0.85}};
}

std::string value_text(const SessionControl& control) {
  if (control.kind == SessionControl::Kind::number) return number_text(control.value, 4);
  return control.choices.at(static_cast<std::size_t>(std::lround(control.value)));
}

std::vector<std::pair<std::string, std::string>> picked_lines(const PickedPoint& p, LengthUnit unit) {
  const std::string length = std::string(" ") + name(unit), per = std::string(" 1/") + name(unit);
  std::vector<std::pair<std::string, std::string>> lines{{"on", p.object}};
  const auto triple = [](const Vec3& x, int digits) {
    return number_text(x.x(), digits) + ", " + number_text(x.y(), digits) + ", " + number_text(x.z(), digits);
  };
  lines.emplace_back("point", triple(p.point, 4));
  if (p.uv) lines.emplace_back("u, v", number_text(p.uv->u, 5) + ", " + number_text(p.uv->v, 5));
  lines.emplace_back("normal", triple(p.normal, 3));
  const auto figure = [&](const char* what, const std::optional<double>& x, const std::string& of) {
    if (x && std::isfinite(*x)) lines.emplace_back(what, number_text(*x, 4) + of);
  };
  figure("mean curv.", p.mean_curvature, per);
  figure("Gaussian", p.gaussian_curvature, per + "^2");
  figure("least radius", p.least_radius, length);
  figure("gap", p.gap, length);
  figure("angle", p.angle_deg, " deg");
  figure("curv. jump", p.curvature_jump, per);
  return lines;
}

void draw_overlay(Painter& painter, const Controller& controller, const std::optional<ColourScale>& scale) {
  const ViewLayout layout = controller.layout();
  const ViewTheme theme = view_theme(controller.state().dark);
  painter.begin();
  if (!controller.state().help || !layout.help_over_all) {
    draw_panel(painter, controller, layout, theme);
    draw_picked(painter, controller, layout, theme);
    draw_bar(painter, controller, layout, scale, theme);
    draw_titles(painter, controller, layout, theme);
  }
  draw_status(painter, controller, layout, theme);
  if (controller.state().help) draw_help(painter, layout, theme);
  painter.end();
}

}  // namespace blendwright
