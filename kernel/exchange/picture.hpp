#pragma once
// Pictures by VTK: a shaded view with a colour bar, and line plots. They need an X display: one that is there is used,
// else Xvfb is started for the run.
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/brep/shape.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// While it lives, DISPLAY names a working display. `available` false: neither a display nor Xvfb; `reason` says so.
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
};

struct Picture {
  std::string title;            ///< with the worst figure
  std::vector<PictureMesh> meshes;
  std::vector<PolyLine> lines;  ///< drawn as tubes, dark
  std::string column;           ///< of the coloured meshes; empty: plain shading
  std::string bar_title;        ///< with the unit
  bool logarithmic = false;
  std::optional<Vec3> view;     ///< direction from the object to the eye; default isometric
  int width = 1000, height = 760;
};
/// Camera fitted to the object, white background, perceptually uniform colours. Throws IoError.
void write_picture(const std::filesystem::path& png, const Picture& picture, const Display& display);

struct PlotCurve {
  std::string label;
  std::vector<double> x, y;
};
struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotCurve> curves;
  bool logarithmic = false;
  std::optional<double> limit;  ///< drawn as a dashed line: the tolerance
};
/// Plots side by side in one picture.
void write_plots(const std::filesystem::path& png, const std::vector<Plot>& plots, const Display& display, int width = 1500,
                 int height = 460);

}  // namespace blendwright
