#pragma once
// Pictures by VTK: a shaded view with a colour bar, and line plots. They need an X display: one that is there
// is used, else Xvfb is started for the run.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/brep/shape.hpp"
#include "kernel/exchange/colour_scale.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// While it lives, DISPLAY names a working display. `available` false: neither a display nor Xvfb; `reason`
/// says so. The display that DISPLAY names is tried in a child process first, since VTK aborts where it
/// cannot draw. Changes the environment: make it before other threads read that, and keep the thread that
/// made it, as Xvfb ends with it.
class Display {
 public:
  Display();
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  [[nodiscard]] bool available() const { return available_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  bool available_ = false;
  std::string reason_;
  int xvfb_ = -1;  ///< process id, -1: none started
  std::string previous_;
};

struct PictureMesh {
  TriMesh mesh;
  Colour colour;
  double opacity = 1.0;
  bool coloured = false;  ///< by Picture::column
  /// Drawn as lines of `edge_colour`, `edge_width` pixels wide; none: the border of a plain mesh, thin.
  std::vector<std::array<std::uint32_t, 2>> edges{};
  Colour edge_colour{0.10, 0.10, 0.12};
  double edge_width = 1.0;
  bool unlit = false;  ///< colours exactly as on the bar
};

/// An entry of a legend.
struct PictureKey {
  std::string label;
  Colour colour;
};

/// One of several views.
struct PictureView {
  std::string label;
  Vec3 direction;  ///< from the object to the eye
};

/// Drawn on the coloured meshes per pixel, from their interpolated normals; n is the unit normal and e the
/// direction to the eye.
enum class SurfacePattern {
  none,
  zebra,     ///< reflections of strips of light that run from left to right: stripes arccos(r.up) / pi with
             ///< r = 2 (n.e) n - e is light where its fraction is below 1/2
  isophotes  ///< bands of equal arccos |n.to_light|, coloured by Picture::scale in degrees
};

/// A line of known length beside the caption.
struct LengthBar {
  double length = 1.0;  ///< model units
  std::string label;
};

struct Picture {
  std::string title;  ///< with the worst figure
  std::vector<PictureMesh> meshes;
  std::vector<PolyLine> lines;     ///< drawn as tubes, dark
  std::string column;              ///< of the coloured meshes, one component; empty: plain shading
  std::string bar_title;           ///< with the unit
  bool logarithmic = false;        ///< at most five decades; what lies below, and zero, has the lowest colour
  std::vector<PictureKey> keys{};  ///< a legend right of the object, instead of a colour bar
  std::optional<Vec3> view;        ///< direction from the object to the eye; default (1, -1.2, 0.8)
  int width = 1000, height = 760;  ///< 64 to 4096 pixels
  std::optional<ColourScale> scale{};             ///< instead of one over the values of the column
  std::vector<PictureView> views{};               ///< instead of `view`
  SurfacePattern pattern = SurfacePattern::none;  ///< instead of the column's colours
  double stripes = 16.0;                          ///< zebra: light and dark pairs over half a turn
  std::optional<Vec3> to_light{};                 ///< isophotes; default: the eye
  bool dark = false;                              ///< background
  std::string caption{};                          ///< below the object
  std::optional<LengthBar> length_bar{};
};
/// Bands of isophotes between 0 and 90 degrees.
inline constexpr int isophote_bands = 9;

/// Parallel projection, each view fitted to the object, perceptually uniform colours, grey for NaN. The focus
/// (lines, coloured and opaque meshes) stays visible beside translucent meshes that are much larger: these
/// are cut off then. Throws IoError (no display; the file), InputError (a column that is missing, a pattern
/// on a mesh without normals, a view without direction, a mesh that contradicts itself).
void write_picture(const std::filesystem::path& png, const Picture& picture, const Display& display);

struct PlotCurve {
  std::string label;
  std::vector<double> x, y;
  double dash = 0.0;  ///< > 0: dashes of that length, pixels, so that a curve below shows through
};
struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotCurve> curves;
  bool logarithmic =
      false;  ///< of y: at most twelve decades; what lies below, and zero, is drawn at the bottom
  std::optional<double> limit;  ///< drawn as a dashed line: the tolerance
};
struct PlotSheet {
  std::string title{};  ///< above all plots
  std::vector<Plot> plots;
  std::size_t columns = 0;  ///< plots side by side; 0: all of them
  int width = 1500, height = 460;
  bool dark = false;
};
/// Throws IoError (no display; the file), InputError.
void write_plots(const std::filesystem::path& png, const PlotSheet& sheet, const Display& display);
/// Plots side by side in one picture.
void write_plots(const std::filesystem::path& png, const std::vector<Plot>& plots, const Display& display,
                 int width = 1500, int height = 460);

}  // namespace blendwright
