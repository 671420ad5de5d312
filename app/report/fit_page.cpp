#include "app/report/fit_page.hpp"

#include <cmath>

#include "app/pipeline/write_outputs.hpp"
#include "app/report/blend_page.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/svg_plot.hpp"

namespace blendwright {
namespace {

std::string figure(double x) { return std::isfinite(x) ? number_text(x, 5) : "not determined"; }

std::string with_unit(const ObjectiveChange& o) {
  return o.unit.empty() ? o.measure : std::string(o.measure).append(" (").append(o.unit).append(")");
}

PageTable objectives(const FittedBlend& blend) {
  PageTable table{"What is wanted", {{"objective", "weight", "measure", "before", "after", "target"}}};
  for (const ObjectiveChange& o : blend.fit.objectives)
    table.rows.push_back({o.name, number_text(o.weight), with_unit(o), figure(o.before), figure(o.after),
                          o.fulfilled ? "met" : "not met"});
  return table;
}

PageTable parameters(const FittedBlend& blend) {
  PageTable table{"What changed",
                  {{"parameter", "before", "after", "change", "deviation", "bounds", "held"}}};
  for (const FittedParameter& p : blend.fit.parameters)
    table.rows.push_back({p.name, figure(p.start), figure(p.value), figure(p.value - p.start),
                          figure(p.deviation),
                          std::string("[")
                              .append(number_text(p.bounds.lo, 4))
                              .append(", ")
                              .append(number_text(p.bounds.hi, 4))
                              .append("]"),
                          p.at_bound ? "by a bound" : ""});
  return table;
}

PageSection section_of(const FittedBlend& blend, std::size_t index) {
  PageSection section{.title = "Blend " + blend.name};
  section.tables = {objectives(blend), parameters(blend)};
  const std::size_t steps = blend.fit.costs.empty() ? 0 : blend.fit.costs.size() - 1;
  section.paragraphs.push_back((blend.fit.converged ? "Converged after " : "Stopped after ") +
                               std::to_string(steps) + (steps == 1 ? " iteration" : " iterations") +
                               "; condition " + figure(blend.fit.condition) + ".");
  for (const std::string& s : blend.fit.not_unique) section.paragraphs.push_back("Not unique: " + s);
  for (const std::string& w : blend.warnings) section.paragraphs.push_back("Warning: " + w);
  if (blend.fit.costs.size() > 1) {
    Plot plot{.title = "Convergence",
              .x_label = "iteration",
              .y_label = "cost",
              .curves = {{blend.name, {}, blend.fit.costs}},
              .logarithmic = true,
              .limit = {}};
    for (std::size_t i = 0; i < blend.fit.costs.size(); ++i)
      plot.curves[0].x.push_back(static_cast<double>(i));
    section.figures.push_back({.png = {},
                               .svg = svg_plot(plot, "convergence-" + std::to_string(index)),
                               .caption = "What was minimised, at the start and after each iteration.",
                               .alternative = {}});
  }
  return section;
}

}  // namespace

ReportPage fit_page(const JobSpec& job, const FitJobResult& result, const std::vector<WrittenFile>& files,
                    const std::string& picture, const std::string& command) {
  const bool met = result.fulfilled(), joined = verified(result.verified);
  ReportPage page{
      .title = "Fit report: " + job.name,
      .verdict = met && joined ? ReportPage::Verdict::good : ReportPage::Verdict::bad,
      .summary = std::string(met ? "Every target is met" : "Not every target is met") +
                 (joined ? "; the fitted blends reach the continuity that was asked of them."
                         : "; the fitted blends do not reach the continuity that was asked of them."),
      .sections = {}};
  if (!picture.empty())
    page.sections.push_back(
        {.title = "Shape",
         .figures = {{.png = picture,
                      .svg = {},
                      .caption =
                          "The fitted blends, coloured by how far they are from where the fit started, "
                          "positive outwards.",
                      .alternative = "Picture of the fitted shape and its deviation from the start"}}});
  for (std::size_t i = 0; i < result.blends.size(); ++i)
    page.sections.push_back(section_of(result.blends[i], i));
  if (!files.empty()) {
    PageSection section{.title = "Files"};
    PageTable list{"", {{"file", "what", "bytes"}}};
    for (const WrittenFile& f : files)
      list.rows.push_back({f.path.filename().string(), f.kind, std::to_string(f.bytes)});
    section.tables.push_back(std::move(list));
    page.sections.push_back(std::move(section));
  }
  page.sections.push_back(
      reproduction("blendwright " BLENDWRIGHT_VERSION, job.name, job.source_hash, command));
  return page;
}

}  // namespace blendwright
