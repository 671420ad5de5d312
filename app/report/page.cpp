#include "app/report/page.hpp"

#include <cstdint>

#include "kernel/exchange/svg_plot.hpp"

namespace blendwright {
namespace {

/// Ink on paper first: no colour carries meaning alone, and print drops the backgrounds.
constexpr std::string_view style = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; color: #1b1b1f; background: #fff;
  max-width: 62rem; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.6rem; margin-bottom: .4rem; }
h2 { font-size: 1.15rem; border-bottom: 1px solid #c8c8d0; padding-bottom: .2rem; margin-top: 2.2rem; }
.verdict { border: 2px solid #1b1b1f; border-left-width: .8rem; padding: .5rem .9rem; font-size: 1.05rem; }
.good { border-color: #1a6e3c; } .bad { border-color: #b00020; }
.verdict strong { text-transform: uppercase; letter-spacing: .04em; margin-right: .5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: .8rem 0 1.4rem; font-size: .87rem; }
caption { text-align: left; font-weight: bold; padding: .3rem 0; }
th, td { border-bottom: 1px solid #d8d8e0; padding: .25rem .7rem; text-align: left; vertical-align: top; }
th { border-bottom-color: #1b1b1f; }
td.figure, th.figure { text-align: right; font-variant-numeric: tabular-nums; }
figure { margin: 1rem 0; } figcaption { font-size: .87rem; color: #44444e; }
img, svg { max-width: 100%; height: auto; }
figure svg { width: 40rem; }
pre { background: #f3f3f6; padding: .7rem .9rem; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .85rem; }
@media print {
  body { margin: 0; max-width: none; font-size: 10pt; }
  h2 { break-after: avoid; } figure, tr { break-inside: avoid; } pre { background: none; border: 1px solid #999; }
}
)";

bool starts_as_figure(const std::string& text) {
  const std::size_t at = text.find_first_not_of("+-(");
  return at != std::string::npos && text[at] >= '0' && text[at] <= '9';
}

std::string element(std::string_view name, const std::string& text) {
  std::string all("<");
  all.append(name).append(">").append(xml_text(text)).append("</").append(name).append(">");
  return all;
}

/// A column stands to the right when each of its cells starts with a figure or is empty.
bool figures_only(const PageTable& table, std::size_t column) {
  for (std::size_t r = 1; r < table.rows.size(); ++r)
    if (column < table.rows[r].size() && !table.rows[r][column].empty() &&
        !starts_as_figure(table.rows[r][column]))
      return false;
  return true;
}

std::string table_html(const PageTable& table) {
  std::string text = "<div class=\"wide\"><table>\n";
  if (!table.caption.empty()) text += element("caption", table.caption) + "\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += "<tr>";
    for (std::size_t c = 0; c < table.rows[r].size(); ++c) {
      const std::string cell = xml_text(table.rows[r][c]);
      const std::string_view name = r == 0 ? "th" : "td";
      text.append("<").append(name);
      if (r == 0) text += " scope=\"col\"";
      if (figures_only(table, c)) text += " class=\"figure\"";
      text.append(">").append(cell).append("</").append(name).append(">");
    }
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string figure_html(const PageFigure& figure) {
  std::string text = "<figure>\n";
  if (!figure.png.empty())
    text += "<img src=\"data:image/png;base64," + base64(figure.png) + "\" alt=\"" +
            xml_text(figure.alternative) + "\" />\n";
  text += figure.svg;
  if (!figure.caption.empty()) text += element("figcaption", figure.caption) + "\n";
  return text + "</figure>\n";
}

std::string section_html(const PageSection& section) {
  std::string text = "<section>\n" + element("h2", section.title) + "\n";
  for (const std::string& p : section.paragraphs) text += element("p", p) + "\n";
  for (const std::string& c : section.commands) text += element("pre", c) + "\n";
  for (const PageTable& t : section.tables) text += table_html(t);
  for (const PageFigure& f : section.figures) text += figure_html(f);
  return text + "</section>\n";
}

std::string verdict_html(const ReportPage& page) {
  using Verdict = ReportPage::Verdict;
  if (page.verdict == Verdict::none) return element("p", page.summary) + "\n";
  const bool good = page.verdict == Verdict::good;
  return std::string("<p class=\"verdict ") + (good ? "good" : "bad") + "\"><strong>" +
         (good ? "\xE2\x9C\x93 verified" : "\xE2\x9C\x97 not verified") + "</strong>" +
         xml_text(page.summary) + "</p>\n";
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (i < left ? static_cast<unsigned char>(bytes[at + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i) text += i <= left ? digits[group >> (18 - 6 * i) & 63u] : '=';
  }
  return text;
}

std::string html(const ReportPage& page) {
  std::string text =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\" "
      "xml:lang=\"en\">\n<head>\n<meta "
      "charset=\"utf-8\" />\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" "
      "/>\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'\" />\n";
  // Nothing may be loaded or run, whatever names a file holds; an empty icon keeps browsers from asking for
  // one.
  text += element("title", page.title) + "\n<link rel=\"icon\" href=\"data:,\" />\n<style>" +
          std::string(style) + "</style>\n</head>\n<body>\n<main>\n";
  text += element("h1", page.title) + "\n" + verdict_html(page);
  for (const PageSection& s : page.sections) text += section_html(s);
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace blendwright
