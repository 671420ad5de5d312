#pragma once
// Private: draws what lies around and over the objects: sliders, what was picked, the colour bar, the status
// and the help.
#include "app/view/window/controller.hpp"
#include "app/view/window/painter.hpp"

namespace blendwright {

/// Colours of the parts.
struct ViewTheme {
  Colour background, panel, line, ink, faint, accent, warning, track;
};
[[nodiscard]] ViewTheme view_theme(bool dark);

/// `scale`: of the colours on the surfaces; none: plain.
void draw_overlay(Painter& painter, const Controller& controller, const std::optional<ColourScale>& scale);

/// Lines of the panel about a picked point, a name and what it is each.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> picked_lines(const PickedPoint& picked,
                                                                            LengthUnit unit);
/// The value of a slider as text.
[[nodiscard]] std::string value_text(const SessionControl& control);

}  // namespace blendwright
