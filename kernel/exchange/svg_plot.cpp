#include "kernel/exchange/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/axis.hpp"
#include "kernel/exchange/colour_map.hpp"

namespace blendwright {
namespace {

constexpr int left = 78, right = 14, top = 30, below_axis = 42, legend_line = 18;
constexpr std::array<std::string_view, 4> dashes{"", "7 3", "2 2", "9 3 2 3"};

struct Frame {
  double x0, y0, x1, y1;  ///< corners of the plot area, y0 at its bottom
};

std::string pixel(double x) { return number_text(std::round(x * 10.0) / 10.0); }

std::string hex_colour(const Colour& colour) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (const double channel : {colour.r, colour.g, colour.b}) {
    const auto byte = static_cast<unsigned>(std::lround(std::clamp(channel, 0.0, 1.0) * 255.0));
    text += digits[byte / 16];
    text += digits[byte % 16];
  }
  return text;
}

/// "10^-8" with its exponent raised.
std::string raised(const std::string& label) {
  const std::size_t at = label.find('^');
  if (at == std::string::npos) return xml_text(label);
  return xml_text(label.substr(0, at)) + "<tspan dy=\"-5\" font-size=\"9\">" +
         xml_text(label.substr(at + 1)) + "</tspan>";
}

std::string line(double x0, double y0, double x1, double y1, std::string_view style) {
  return "<line x1=\"" + pixel(x0) + "\" y1=\"" + pixel(y0) + "\" x2=\"" + pixel(x1) + "\" y2=\"" +
         pixel(y1) + "\" " + std::string(style) + "/>\n";
}

std::string label(double x, double y, std::string_view attributes, const std::string& content) {
  return "<text x=\"" + pixel(x) + "\" y=\"" + pixel(y) + "\" " + std::string(attributes) + ">" + content +
         "</text>\n";
}

std::vector<double> all_values(const Plot& plot, bool x) {
  std::vector<double> values;
  for (const PlotCurve& c : plot.curves) {
    const std::vector<double>& from = x ? c.x : c.y;
    values.insert(values.end(), from.begin(), from.end());
  }
  if (!x && plot.limit) values.push_back(*plot.limit);
  return values;
}

/// Which samples are drawn: of each pixel column the first, least, largest and last; every one that is not
/// finite.
std::vector<std::size_t> drawn_samples(const PlotCurve& curve, const Axis& axis, double pixels) {
  std::vector<std::size_t> drawn;
  if (static_cast<double>(curve.y.size()) <= 2.0 * pixels) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) drawn.push_back(i);
    return drawn;
  }
  const auto column = [&](std::size_t i) { return std::floor(axis.position(curve.x[i]) * pixels); };
  for (std::size_t begin = 0; begin < curve.y.size();) {
    std::size_t end = begin + 1, least = begin, most = begin;
    while (end < curve.y.size() && std::isfinite(curve.y[begin]) && std::isfinite(curve.y[end]) &&
           column(end) == column(begin)) {
      if (curve.y[end] < curve.y[least]) least = end;
      if (curve.y[end] > curve.y[most]) most = end;
      ++end;
    }
    std::array picked{begin, std::min(least, most), std::max(least, most), end - 1};
    for (const std::size_t i : picked)
      if (drawn.empty() || drawn.back() != i) drawn.push_back(i);
    begin = end;
  }
  return drawn;
}

std::string path_of(const PlotCurve& curve, const Axis& x, const Axis& y, const Frame& frame) {
  std::string path;
  bool pen_down = false;
  for (const std::size_t i : drawn_samples(curve, x, frame.x1 - frame.x0)) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
      pen_down = false;
      continue;
    }
    path += pen_down ? 'L' : 'M';
    path += pixel(frame.x0 + x.position(curve.x[i]) * (frame.x1 - frame.x0)) + " " +
            pixel(frame.y0 + y.position(curve.y[i]) * (frame.y1 - frame.y0));
    pen_down = true;
  }
  return path;
}

/// What the plot shows, in words.
std::string description(const Plot& plot) {
  std::string text = plot.y_label + " against " + plot.x_label + ".";
  for (const PlotCurve& c : plot.curves) {
    std::size_t most = c.y.size();
    for (std::size_t i = 0; i < c.y.size(); ++i)
      if (std::isfinite(c.y[i]) && (most == c.y.size() || c.y[i] > c.y[most])) most = i;
    text += " " + c.label + ": ";
    text += most == c.y.size() ? std::string("not measured.")
                               : "largest " + scientific_text(c.y[most]) + " at " + plot.x_label + " = " +
                                     number_text(c.x[most], 3) + ".";
  }
  if (plot.limit) text += " Limit " + scientific_text(*plot.limit) + ".";
  return text;
}

std::string axes(const Plot& plot, const Axis& x, const Axis& y, const Frame& frame) {
  std::string text;
  for (const Tick& t : y.ticks) {
    const double at = frame.y0 + (t.value - y.lo) / (y.hi - y.lo) * (frame.y1 - frame.y0);
    if (t.label.empty()) continue;
    text += line(frame.x0, at, frame.x1, at, "stroke=\"#ddd\"");
    text += label(frame.x0 - 6, at + 4, "text-anchor=\"end\"", raised(t.label));
  }
  for (const Tick& t : x.ticks) {
    const double at = frame.x0 + (t.value - x.lo) / (x.hi - x.lo) * (frame.x1 - frame.x0);
    if (t.label.empty()) continue;
    text += line(at, frame.y0, at, frame.y0 + 5, "stroke=\"#333\"");
    text += label(at, frame.y0 + 18, "text-anchor=\"middle\"", raised(t.label));
  }
  text += line(frame.x0, frame.y0, frame.x1, frame.y0, "stroke=\"#333\"");
  text += line(frame.x0, frame.y0, frame.x0, frame.y1, "stroke=\"#333\"");
  text += label(0.5 * (frame.x0 + frame.x1), frame.y0 + 35, "text-anchor=\"middle\"", xml_text(plot.x_label));
  const std::string middle = pixel(0.5 * (frame.y0 + frame.y1));
  text += label(14, 0.5 * (frame.y0 + frame.y1),
                "text-anchor=\"middle\" transform=\"rotate(-90 14 " + middle + ")\"", xml_text(plot.y_label));
  text += label(frame.x0, 18, "font-weight=\"bold\"", xml_text(plot.title));
  return text;
}

/// Bytes of the UTF-8 character that starts at `at`; 0 when there is none, or XML does not allow it.
std::size_t character_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(at);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  const std::size_t length = first >= 0xF0 && first < 0xF5 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 0;
  if (first >= 0xF5 || length == 0) return 0;
  unsigned long code = first & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return 0;
    code = code << 6 | (byte(at + i) & 0x3Fu);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool forbidden =
      (code >= 0xD800 && code < 0xE000) || code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
  return overlong || forbidden ? 0 : length;
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string safe;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(text, at);
    switch (length == 0 ? '\0' : text[at]) {
      case '\0':
        safe += "\xEF\xBF\xBD";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += text.substr(at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  return safe;
}

std::string svg_plot(const Plot& plot, const std::string& id, int width, int height) {
  for (const PlotCurve& c : plot.curves)
    if (c.x.size() != c.y.size())
      throw InputError(c.label, "has " + std::to_string(c.x.size()) + " places and " +
                                    std::to_string(c.y.size()) + " values, must have as many");
  const ValueRange range = range_of(all_values(plot, false));
  const Axis x = linear_axis(range_of(all_values(plot, true)), 6, true);
  const Axis y = plot.logarithmic ? log_axis(range, 12, 6) : linear_axis(range, 6);
  const auto keys = static_cast<int>(plot.curves.size()) + (plot.limit ? 1 : 0);
  const int whole = height + legend_line * keys;
  const Frame frame{left, static_cast<double>(height - below_axis), static_cast<double>(width - right), top};
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + std::to_string(width) + " " +
                    std::to_string(whole) + "\" role=\"img\" aria-labelledby=\"" + id + "-title " + id +
                    "-text\" font-family=\"sans-serif\" font-size=\"12\">\n<title id=\"" + id + "-title\">" +
                    xml_text(plot.title) + "</title>\n<desc id=\"" + id + "-text\">" +
                    xml_text(description(plot)) + "</desc>\n";
  svg += axes(plot, x, y, frame);
  double key = height + 6;
  const auto add_key = [&](const std::string& style, const std::string& text) {
    svg += line(frame.x0, key, frame.x0 + 40, key, style);
    svg += label(frame.x0 + 48, key + 4, "", xml_text(text));
    key += legend_line;
  };
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const std::string_view dash = dashes[i % dashes.size()];
    std::string style = "fill=\"none\" stroke-width=\"1.6\" stroke=\"" + hex_colour(curve_colour(i)) + "\"";
    if (!dash.empty()) style += " stroke-dasharray=\"" + std::string(dash) + "\"";
    svg += "<path d=\"" + path_of(plot.curves[i], x, y, frame) + "\" " + style + "/>\n";
    add_key(style, plot.curves[i].label);
  }
  if (plot.limit) {
    const std::string style = "stroke=\"#b00020\" stroke-width=\"1.2\" stroke-dasharray=\"1 3\"";
    const double at = frame.y0 + y.position(*plot.limit) * (frame.y1 - frame.y0);
    svg += line(frame.x0, at, frame.x1, at, style);
    add_key(style, "limit " + scientific_text(*plot.limit));
  }
  return svg + "</svg>\n";
}

}  // namespace blendwright
