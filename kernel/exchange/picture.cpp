#include "kernel/exchange/picture.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/exchange/mesh_formats.hpp"
#include "kernel/exchange/picture_layout.hpp"
#include "kernel/exchange/picture_scene.hpp"
#include "kernel/exchange/vtk_messages.hpp"

namespace blendwright {
namespace {

const Column& coloured_column(const Picture& picture, const TriMesh& mesh) {
  for (const Column& c : mesh.columns)
    if (c.name == picture.column && c.components == 1) return c;
  throw InputError("column",
                   "is \"" + picture.column + "\", which the mesh \"" + mesh.name + "\" does not have");
}

/// The scale of the bar: the picture's, or one over the values that are shown.
std::optional<ColourScale> bar_scale(const Picture& picture) {
  std::vector<double> all;
  bool any = false;
  for (const PictureMesh& m : picture.meshes) {
    if (!m.coloured || picture.column.empty()) continue;
    any = true;
    const Column& column = coloured_column(picture, m.mesh);
    all.insert(all.end(), column.values.begin(), column.values.end());
  }
  if (picture.scale) return picture.scale;
  if (!any) return std::nullopt;
  return ColourScale::over(all, picture.logarithmic ? ScaleRule::logarithmic : ScaleRule::linear);
}

void require_drawable(const Picture& picture) {
  for (const PictureMesh& m : picture.meshes) {
    require_consistent(m.mesh);
    for (const auto& edge : m.edges)
      if (std::max(edge[0], edge[1]) >= m.mesh.points.size())
        throw InputError("edges", "names point " + std::to_string(std::max(edge[0], edge[1])) +
                                      ", must be below " + std::to_string(m.mesh.points.size()));
    if (m.coloured && picture.pattern != SurfacePattern::none && m.mesh.normals.empty() &&
        !m.mesh.triangles.empty())
      throw InputError("pattern", "needs normals, which the mesh \"" + m.mesh.name + "\" does not have");
  }
  for (const PolyLine& line : picture.lines) require_consistent(line);
}

/// The colour bar with its scale and its title, in the column right of the object.
void draw_bar(Canvas& canvas, const Picture& picture, const PictureLayout& layout, const ColourScale& scale,
              const PictureTheme& theme) {
  const auto [bar, labels, title_at] = bar_place(layout, scale);
  const bool banded = picture.pattern == SurfacePattern::isophotes;
  const int steps = banded ? isophote_bands : 128;
  for (int i = 0; i < steps; ++i)
    canvas.fill({bar.left, bar.bottom + bar.height() * i / steps, bar.right,
                 bar.bottom + bar.height() * (i + 1) / steps},
                colour_at(scale.map(), (i + 0.5) / steps));
  canvas.frame(bar, theme.thin, 1.0);
  const Axis& axis = scale.axis();
  for (const Tick& tick : axis.ticks) {
    const double y = bar.bottom + bar.height() * (tick.value - axis.lo) / (axis.hi - axis.lo);
    canvas.line({{bar.right, y}, {bar.right + 5, y}}, theme.thin, 1.0);
    canvas.text({labels, y}, tick.label, layout.tick_style);
  }
  const std::string& title = picture.bar_title.empty() ? picture.column : picture.bar_title;
  canvas.text({title_at, 0.5 * (bar.bottom + bar.top)}, title,
              Canvas::fitting(title, layout.bar_style, layout.bar.height() - 20));
}

/// The legend, in the middle of its column, first entry on top.
void draw_keys(Canvas& canvas, const Picture& picture, const PictureLayout& layout,
               const PictureTheme& theme) {
  const PixelBox& column = layout.keys;
  const double font = layout.key_style.size / 15.0, swatch_size = 18.0 * std::max(1.0, font),
               line = 30.0 * font;
  const double height = line * static_cast<double>(picture.keys.size());
  double y = 0.5 * (column.bottom + column.top) + 0.5 * height - 0.5 * line;
  for (const PictureKey& key : picture.keys) {
    const PixelBox swatch{column.left, y - 0.5 * swatch_size, column.left + swatch_size,
                          y + 0.5 * swatch_size};
    canvas.fill(swatch, key.colour);
    canvas.frame(swatch, theme.thin, 1.0);
    canvas.text({swatch.right + 9.0 * font, y}, key.label, layout.key_style);
    y -= line;
  }
}

/// The caption in the middle of its strip, behind the bar of known length in the scale of the first view.
void draw_caption(Canvas& canvas, const Picture& picture, const PictureLayout& layout,
                  const PictureTheme& theme) {
  const PixelBox& strip = layout.caption;
  const double y = 0.5 * (strip.bottom + strip.top);
  TextStyle style = layout.small_style;
  style.align = Align::left;
  double left = strip.left + 12.0;
  if (picture.length_bar && !layout.views.empty()) {
    const ViewFrame frame = frame_of(views_of(picture).front().direction);
    const PixelBox& view = layout.views.front();
    const double pixels =
        picture.length_bar->length * window_of(extents_of(picture, frame), view).pixels_per_unit(view);
    canvas.line({{left, y - 5}, {left, y + 5}}, theme.ink, 2.0);
    canvas.line({{left, y}, {left + pixels, y}}, theme.ink, 2.0);
    canvas.line({{left + pixels, y - 5}, {left + pixels, y + 5}}, theme.ink, 2.0);
    left += pixels + 8.0;
    canvas.text({left, y}, picture.length_bar->label, style);
    left += Canvas::width_of(picture.length_bar->label, style) + 24.0;
  }
  canvas.text({left, y}, picture.caption, Canvas::fitting(picture.caption, style, strip.right - left - 8.0));
}

void draw_texts(Canvas& canvas, const Picture& picture, const PictureLayout& layout,
                const PictureTheme& theme) {
  const double lines = static_cast<double>(layout.title_lines.size());
  const double step = layout.title.height() / (lines + 0.35);
  double y = layout.title.top - 0.5 * (layout.title.height() - (lines - 1.0) * step);
  for (const std::string& line : layout.title_lines) {
    canvas.text({0.5 * picture.width, y}, line, layout.title_style);
    y -= step;
  }
  const std::vector<PictureView> views = views_of(picture);
  for (std::size_t i = 0; i < layout.labels.size(); ++i) {
    const PixelBox& box = layout.labels[i];
    canvas.text({0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top)}, views[i].label,
                layout.small_style);
  }
  draw_caption(canvas, picture, layout, theme);
}

}  // namespace

void write_picture(const std::filesystem::path& png, const Picture& picture, const Display& display) {
  require_drawable(png, picture.width, picture.height, display);
  require_drawable(picture);
  const std::optional<ColourScale> scale = bar_scale(picture);
  const PictureTheme theme = theme_of(picture.dark);
  const VtkMessages messages;
  const PictureLayout layout = layout_of(picture, scale);
  RenderTarget target(picture.width, picture.height);
  Canvas canvas(theme.background);
  draw_texts(canvas, picture, layout, theme);
  if (scale)
    draw_bar(canvas, picture, layout, *scale, theme);
  else
    draw_keys(canvas, picture, layout, theme);
  canvas.finish(target, 0);
  const std::vector<PictureView> views = views_of(picture);
  std::vector<vtkSmartPointer<vtkRenderer>> scenes;
  for (std::size_t i = 0; i < views.size(); ++i) {
    scenes.push_back(view_scene(picture, scale, frame_of(views[i].direction), layout.views[i]));
    target.add(*scenes.back(), 1);
  }
  target.write_png(png);
}

}  // namespace blendwright
