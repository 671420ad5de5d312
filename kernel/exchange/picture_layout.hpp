#pragma once
// Private: where a picture's title, views, colour bar, legend and caption lie. No display is needed.
#include <optional>
#include <string>
#include <vector>

#include "kernel/exchange/picture_view.hpp"

namespace blendwright {

/// Background and ink of a picture.
struct PictureTheme {
  Colour background{1.0, 1.0, 1.0}, ink{0.13, 0.13, 0.13}, thin{0.42, 0.44, 0.48};
};
[[nodiscard]] PictureTheme theme_of(bool dark);

/// Boxes in pixels from the lower left corner; those of parts that a picture does not have are empty.
struct PictureLayout {
  PixelBox title, bar, keys, caption;
  std::vector<PixelBox> views, labels;   ///< labels: below their views, when there are several
  std::vector<std::string> title_lines;  ///< one, or two when one would be too small to read
  TextStyle title_style, tick_style, bar_style, key_style, small_style;
};
[[nodiscard]] PictureLayout layout_of(const Picture& picture, const std::optional<ColourScale>& scale);

/// The bar itself within its column.
struct BarPlace {
  PixelBox bar;
  double labels = 0.0, title = 0.0;  ///< x of the left end of the labels, of the title's middle
};
[[nodiscard]] BarPlace bar_place(const PictureLayout& layout, const ColourScale& scale);

}  // namespace blendwright
