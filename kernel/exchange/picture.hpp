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
};

/// An entry of a legend.
struct PictureKey {
  std::string label;
  Colour colour;
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
};
/// Parallel projection fitted to the object, white background, perceptually uniform colours, grey for NaN.
/// The focus (lines, coloured and opaque meshes) stays visible beside translucent meshes that are much
/// larger: these are cut off then. Throws IoError (no display; the file), InputError (a column that is
/// missing, a view without direction, a mesh that contradicts itself).
void write_picture(const std::filesystem::path& png, const Picture& picture, const Display& display);

struct PlotCurve {
  std::string label;
  std::vector<double> x, y;
};
struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotCurve> curves;
  bool logarithmic =
      false;  ///< of y: at most twelve decades; what lies below, and zero, is drawn at the bottom
  std::optional<double> limit;  ///< drawn as a dashed line: the tolerance
};
/// Plots side by side in one picture. Throws IoError (no display; the file), InputError.
void write_plots(const std::filesystem::path& png, const std::vector<Plot>& plots, const Display& display,
                 int width = 1500, int height = 460);

}  // namespace blendwright
