#include "app/report/blend_page.hpp"

#include <cmath>

#include "app/json/job_reader.hpp"
#include "app/pipeline/result_pictures.hpp"
#include "app/report/json_tables.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/svg_plot.hpp"

namespace blendwright {
namespace {

using detail::cell_text;
using detail::member;
using detail::member_table;

std::string small_figure(const JsonValue& value) {
  const double* x = value.number();
  if (!x) return "not measured";
  return std::abs(*x) < 1e-18 ? "0" : scientific_text(*x, 3);
}

/// "1.7e-08 at v = 0.86".
std::string with_place(const JsonValue& deviation) {
  const double* v = member(deviation, "v").number();
  std::string text = small_figure(member(deviation, "largest"));
  if (v && text != "0") text += " at v = " + number_text(*v, 3);
  return text;
}

std::vector<std::string> seam_row(const JsonValue& blend, const JsonValue& stage, std::string_view side,
                                  const std::string& first) {
  const JsonValue& s = member(stage, side);
  const bool measured = member(s, "measured").boolean() && *member(s, "measured").boolean();
  const std::string at = cell_text(member(blend, side));
  const std::string joint = std::string(side) + " " + (at.empty() ? "(typed data)" : at);
  if (!measured) return {first, joint, cell_text(member(s, "asked")), "not measured", "", "", ""};
  return {first,
          joint,
          cell_text(member(s, "asked")),
          cell_text(member(s, "reached")),
          with_place(member(s, "gap")),
          with_place(member(s, "angle_deg")),
          with_place(member(s, "curvature"))};
}

std::vector<std::string> seam_header(const std::string& first, const JobSpec& job) {
  const std::string unit = name(job.unit);
  return {first,
          "joint",
          "asked",
          "reached",
          "gap (" + unit + ")",
          "angle (deg)",
          "curvature jump (1/" + unit + ")"};
}

const JsonValue::Array& blends_of(const JsonValue& report) {
  static const JsonValue::Array none;
  const JsonValue::Array* blends = member(report, "blends").items();
  return blends ? *blends : none;
}

/// Every joint as it is in the last stage: what is delivered.
PageSection joints(const JobResult& result, const JsonValue& report) {
  PageSection section{.title = "Joints"};
  PageTable table{"Worst figures along each trimline", {seam_header("blend", result.job)}};
  std::string stage_name;
  for (const JsonValue& blend : blends_of(report)) {
    const JsonValue::Array* stages = member(blend, "stages").items();
    if (!stages || stages->empty()) continue;
    stage_name = cell_text(member(stages->back(), "stage"));
    for (const char* side : {"from", "to"})
      table.rows.push_back(seam_row(blend, stages->back(), side, cell_text(member(blend, "name"))));
  }
  const Tolerance& t = result.job.tolerance;
  const std::string unit = name(result.job.unit);
  section.paragraphs.push_back((stage_name == "step"
                                    ? std::string("Measured on the STEP file, read back.")
                                    : std::string("Measured on the fitted B-spline surfaces, in memory.")) +
                               " Allowed: gap " + scientific_text(t.position) + " " + unit + ", angle " +
                               scientific_text(t.angle.degrees()) + " deg (G1 and G2), curvature jump " +
                               scientific_text(t.curvature) + " 1/" + unit + " (G2).");
  section.tables.push_back(std::move(table));
  return section;
}

PageSection findings(const JobResult& result, const JobOutputs* outputs, const JsonValue& report) {
  PageSection section{.title = "Findings"};
  for (const JsonValue& blend : blends_of(report)) {
    const JsonValue::Array* stages = member(blend, "stages").items();
    if (!stages || stages->empty() || !member(stages->back(), "findings").items()) continue;
    for (const JsonValue& f : *member(stages->back(), "findings").items()) {
      const bool* failed = member(f, "failed").boolean();
      section.paragraphs.push_back((failed && *failed ? "Failed: " : "Note: ") +
                                   cell_text(member(f, "text")));
    }
  }
  if (outputs)
    for (const std::string& p : shape_problems(result, *outputs))
      section.paragraphs.push_back("Failed: " + p);
  for (const std::string& w : result.warnings) section.paragraphs.push_back("Warning: " + w);
  if (outputs)
    for (const std::string& n : outputs->notes) section.paragraphs.push_back("Note: " + n);
  if (section.paragraphs.empty())
    section.paragraphs.push_back("No check failed, and there is nothing to note.");
  return section;
}

PageSection pictures(const JobResult& result, const std::string& picture) {
  PageSection section{.title = "Errors along the trimlines"};
  if (!picture.empty())
    section.figures.push_back({.png = picture,
                               .svg = {},
                               .caption = "The blend on its primaries, coloured by its gap.",
                               .alternative = error_picture(result, {}, {}, {}).title});
  std::size_t count = 0;
  for (const Plot& plot : error_plots(result))
    section.figures.push_back({.png = {},
                               .svg = svg_plot(plot, "plot-" + std::to_string(++count)),
                               .caption = {},
                               .alternative = {}});
  return section;
}

PageSection parameters(const JobResult& result, const JsonValue& report) {
  PageSection section{.title = "Shape and export"};
  for (const JsonValue& blend : blends_of(report)) {
    const std::string who = cell_text(member(blend, "name"));
    section.tables.push_back(member_table(who + ": shape parameters", member(blend, "shape"), "shape"));
    section.tables.push_back(member_table(who + ": exported B-spline", member(blend, "fit"), "fit"));
    PageTable stages{who + ": stage by stage", {seam_header("stage", result.job)}};
    if (const JsonValue::Array* all = member(blend, "stages").items())
      for (const JsonValue& stage : *all)
        for (const char* side : {"from", "to"})
          stages.rows.push_back(seam_row(blend, stage, side, cell_text(member(stage, "stage"))));
    section.tables.push_back(std::move(stages));
  }
  return section;
}

PageSection files(const JobOutputs& outputs, const JsonValue& report) {
  PageSection section{.title = "Files"};
  PageTable table{"", {{"file", "format", "bytes"}}};
  for (const WrittenFile& f : outputs.files)
    table.rows.push_back({f.path.filename().string(), f.kind, std::to_string(f.bytes)});
  section.tables.push_back(std::move(table));
  const JsonValue& step = member(report, "step");
  if (step.members()) section.tables.push_back(member_table("STEP file, read back", step, "step"));
  return section;
}

std::string summary(const JobResult& result, bool good) {
  std::size_t seams = 0, measured = 0;
  for (const BlendResult& b : result.blends)
    if (!b.stages.empty())
      for (const SeamReport& s : b.stages.back().seams) {
        ++seams;
        measured += s.measured ? 1 : 0;
      }
  std::string text = result.job.name + ": " + std::to_string(seams) + " joints of " +
                     std::to_string(result.blends.size()) +
                     (result.blends.size() == 1 ? " blend" : " blends") +
                     (good ? ", all within tolerance" : "; see the findings");
  if (measured < seams) text += " (" + std::to_string(seams - measured) + " without a primary, not measured)";
  return text + ".";
}

}  // namespace

PageSection reproduction(const std::string& program, const std::string& input, const std::string& hash,
                         const std::string& command) {
  PageSection section{.title = "How to reproduce"};
  section.paragraphs.push_back("Made by " + program + " from " + input + ", whose text has the hash " + hash +
                               " (64-bit FNV-1a). The same input gives the same figures on any number of "
                               "threads.");
  if (!command.empty()) section.commands.push_back(command);
  return section;
}

ReportPage blend_page(const JobResult& result, const JobOutputs* outputs, const std::string& picture,
                      const std::string& command) {
  const JsonValue report = parse_json(report_json(result, outputs, false));
  const bool good = verified(result, outputs);
  ReportPage page{.title = "Blend report: " + result.job.name,
                  .verdict = good ? ReportPage::Verdict::good : ReportPage::Verdict::bad,
                  .summary = summary(result, good),
                  .sections = {joints(result, report), findings(result, outputs, report),
                               pictures(result, picture), parameters(result, report)}};
  if (outputs) page.sections.push_back(files(*outputs, report));
  page.sections.push_back(
      reproduction(cell_text(member(report, "program")) + " " + cell_text(member(report, "version")),
                   result.job.name, result.job.source_hash, command));
  return page;
}

}  // namespace blendwright
