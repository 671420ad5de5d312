#pragma once
// Private: where the parts of the viewer's window lie, in pixels from the lower left corner. No display is
// needed.
#include <cstddef>
#include <vector>

#include "kernel/exchange/canvas.hpp"

namespace blendwright {

struct LayoutRequest {
  int width = 1280, height = 960;
  std::size_t panes = 1;     ///< files side by side
  std::size_t controls = 0;  ///< of the blend that is shown; 0: no panel of sliders
  std::size_t page = 0;
  bool bar = false;     ///< a colour bar
  bool picked = false;  ///< what was picked
};

/// Nothing overlaps, but the help, which covers the panes on demand.
struct ViewLayout {
  PixelBox panel;                ///< left column: heading, sliders, what was picked; empty without any
  PixelBox heading;              ///< which blend; which page
  std::vector<PixelBox> rows;    ///< one per slider of the page: its label, then its track
  std::vector<PixelBox> labels;  ///< upper half of the rows
  std::vector<PixelBox> tracks;  ///< lower half
  PixelBox picked;
  PixelBox bar;                  ///< right column
  std::vector<PixelBox> titles;  ///< above the panes, when there are two
  std::vector<PixelBox> panes;   ///< the objects
  PixelBox status, message;      ///< the two lines at the bottom
  PixelBox help;                 ///< over the panes, or over everything in a small window
  bool help_over_all = false;
  std::size_t first_control = 0;  ///< of the page
  std::size_t pages = 1;
};
[[nodiscard]] ViewLayout layout_of(const LayoutRequest& request);

inline constexpr int least_window_width = 480, least_window_height = 360;

[[nodiscard]] bool contains(const PixelBox& box, const Vec2& at);

}  // namespace blendwright
