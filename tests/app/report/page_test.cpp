// The text of pages and of their plots.
#include "app/report/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "kernel/base/error.hpp"
#include "kernel/exchange/svg_plot.hpp"
#include "tests/app/report/xml_reading.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64(std::string("\xFF\x00\xFE", 3)), "/wD+");
}

TEST(XmlText, KeepsWhatIsAllowedAndReplacesTheRest) {
  EXPECT_EQ(xml_text("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(xml_text("\xC3\xA4 \xE2\x9C\x93 \xF0\x9F\x98\x80"), "\xC3\xA4 \xE2\x9C\x93 \xF0\x9F\x98\x80");
  const std::string bad = "\xEF\xBF\xBD";
  for (const char* wrong : {"\x01", "\xFF", "\xC0\xAF", "\xED\xA0\x80", "\xEF\xBF\xBF", "\xE2\x9C"})
    EXPECT_THAT(xml_text(wrong), HasSubstr(bad)) << wrong;
}

ReportPage page_with(const std::string& text) {
  PageSection section{.title = text, .paragraphs = {text}, .commands = {text}};
  section.tables.push_back({text, {{text, "value"}, {text, "-1.5e-08"}}});
  section.figures.push_back({.png = "not really", .svg = {}, .caption = text, .alternative = text});
  return {.title = text, .verdict = ReportPage::Verdict::bad, .summary = text, .sections = {section}};
}

// Names from files may hold anything.
TEST(Page, IsWellFormedWhateverItsTextsAre) {
  for_all([](Rng& rng) {
    std::string text;
    for (int i = integer(rng, 0, 40); i > 0; --i) text += static_cast<char>(integer(rng, 0, 255));
    if (integer(rng, 0, 3) == 0) text += "<script>alert(1)</script>\"'>]]>&amp;";
    const std::string page = html(page_with(text));
    const auto root = read_xml(page);
    ASSERT_NE(root, nullptr) << page;
    EXPECT_TRUE(elements(root, "script").empty());
    EXPECT_EQ(elements(root, "h2").size(), 1u);
    EXPECT_EQ(elements(root, "td").size(), 2u);
  });
  EXPECT_EQ(read_xml("<p>open"), nullptr);  // the parser would see it
}

TEST(Page, AsksForNothingFromOutside) {
  const std::string page = html(page_with("plain"));
  const auto root = read_xml(page);
  visit(root, [](vtkXMLDataElement& e) {
    for (const char* name : {"src", "href"}) {
      const std::string value = attribute(&e, name);
      EXPECT_TRUE(value.empty() || value.rfind("data:", 0) == 0) << e.GetName() << " " << value;
    }
  });
  EXPECT_THAT(page, Not(HasSubstr("url(")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
}

TEST(Page, TellsItsVerdictInWords) {
  ReportPage page = page_with("x");
  EXPECT_THAT(html(page), HasSubstr("not verified</strong>"));
  page.verdict = ReportPage::Verdict::good;
  EXPECT_THAT(html(page), HasSubstr("\xE2\x9C\x93 verified</strong>"));
}

TEST(Page, FiguresStandToTheRight) {
  const auto root = read_xml(html(page_with("word")));
  std::vector<std::string> classes;
  for (vtkXMLDataElement* cell : elements(root, "td")) classes.push_back(attribute(cell, "class"));
  EXPECT_EQ(classes, (std::vector<std::string>{"", "figure"}));
}

Plot wave(std::size_t samples) {
  Plot plot{"gap", "v", "gap (mm)", {}, true, 1e-6};
  PlotCurve curve{"a/from", {}, {}};
  for (std::size_t i = 0; i < samples; ++i) {
    const double v = static_cast<double>(i) / static_cast<double>(samples - 1);
    curve.x.push_back(v);
    curve.y.push_back(1e-8 * (1.5 + std::sin(20.0 * v)));
  }
  plot.curves = {curve, curve};
  plot.curves[1].label = "a/to";
  return plot;
}

std::size_t points_of(const std::string& path) {
  return static_cast<std::size_t>(
      std::count_if(path.begin(), path.end(), [](char c) { return c == 'M' || c == 'L'; }));
}

TEST(SvgPlot, SaysInWordsWhatItShows) {
  const std::string svg = svg_plot(wave(100), "p1");
  const auto root = read_xml(svg);
  ASSERT_NE(root, nullptr);
  EXPECT_EQ(attribute(root, "role"), "img");
  EXPECT_EQ(attribute(root, "aria-labelledby"), "p1-title p1-text");
  EXPECT_EQ(text_of(elements(root, "title").at(0)), "gap");
  const std::string words = text_of(elements(root, "desc").at(0));
  EXPECT_THAT(words, HasSubstr("gap (mm) against v."));
  EXPECT_THAT(words, HasSubstr("a/from: largest 2.5e-08 at v ="));
  EXPECT_THAT(words, HasSubstr("Limit 1.0e-06."));
}

TEST(SvgPlot, CurvesDifferWithoutColour) {
  const auto root = read_xml(svg_plot(wave(100), "p"));
  std::set<std::string> dashes;
  for (vtkXMLDataElement* path : elements(root, "path")) dashes.insert(attribute(path, "stroke-dasharray"));
  EXPECT_EQ(dashes.size(), 2u);
}

TEST(SvgPlot, StaysInsideItsFrame) {
  for_all([](Rng& rng) {
    Plot plot = wave(50);
    for (double& y : plot.curves[0].y) y = std::pow(10.0, uniform(rng, -30.0, 5.0));
    plot.curves[0].y[7] = 0.0;
    plot.logarithmic = integer(rng, 0, 1) == 1;
    const auto root = read_xml(svg_plot(plot, "p", 640, 300));
    for (vtkXMLDataElement* path : elements(root, "path")) {
      std::string d = attribute(path, "d");
      for (char& c : d)
        if (c == 'M' || c == 'L') c = ' ';
      std::istringstream numbers(d);
      for (double x = 0, y = 0; numbers >> x >> y;) {
        EXPECT_GE(x, 77.9);
        EXPECT_LE(x, 626.1);
        EXPECT_GE(y, 29.9);
        EXPECT_LE(y, 258.1);
      }
    }
  });
}

TEST(SvgPlot, LongCurvesAreThinnedWithoutLosingTheirPeak) {
  Plot plot = wave(200000);
  plot.curves[0].y[123456] = 3e-3;
  const auto root = read_xml(svg_plot(plot, "p"));
  const std::string d = attribute(elements(root, "path").at(0), "d");
  EXPECT_LT(points_of(d), 2500u);
  // 3e-3 is the largest value: the top decade's line is 10^-2, the peak lies within the highest two of its
  // seven.
  double highest = 1e9;
  std::string numbers = d;
  for (char& c : numbers)
    if (c == 'M' || c == 'L') c = ' ';
  std::istringstream in(numbers);
  for (double x = 0, y = 0; in >> x >> y;) highest = std::min(highest, y);
  EXPECT_LT(highest, 90.0);
}

TEST(SvgPlot, WhatIsNoNumberIsAGap) {
  Plot plot = wave(10);
  plot.curves.resize(1);
  plot.curves[0].y[4] = std::numeric_limits<double>::quiet_NaN();
  const auto root = read_xml(svg_plot(plot, "p"));
  const std::string d = attribute(elements(root, "path").at(0), "d");
  EXPECT_EQ(std::count(d.begin(), d.end(), 'M'), 2);
  EXPECT_EQ(points_of(d), 9u);
  plot.curves[0].y.assign(10, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(svg_plot(plot, "p"), HasSubstr("a/from: not measured."));
  plot.curves[0].y.pop_back();
  EXPECT_THROW((void)svg_plot(plot, "p"), InputError);
  EXPECT_NE(read_xml(svg_plot({"empty", "v", "y", {}, false, {}}, "p")), nullptr);
}

}  // namespace
}  // namespace blendwright::test
