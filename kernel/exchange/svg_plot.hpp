#pragma once
// Plots as SVG text, for pages: sharp at any size, printable, readable without colour and by screen readers.
#include <string>

#include "kernel/exchange/picture.hpp"

namespace blendwright {

/// `id`: unique in the page. The svg element has a title and a description in words (largest value of each
/// curve and where, the limit); curves differ by dashes as well as by colour; a value that is not finite is a
/// gap in its curve. Long curves are thinned to what a pixel column can show, extremes kept. Throws
/// InputError when x and y of a curve differ in length.
[[nodiscard]] std::string svg_plot(const Plot& plot, const std::string& id, int width = 640,
                                   int height = 300);

/// Text for the content of an XML element or attribute: & < > " ' escaped; characters that XML does not
/// allow, and bytes that are not UTF-8, become U+FFFD.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace blendwright
