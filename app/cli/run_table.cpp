#include "app/cli/run_table.hpp"

#include <algorithm>
#include <cmath>

#include "app/cli/text_table.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

/// Two decimals as in "1.57", never "-0.00".
std::string fixed2(double x) {
  const double rounded = std::round(x * 100.0) / 100.0;
  std::string text = number_text(rounded == 0.0 ? 0.0 : rounded);
  if (text.find('e') != std::string::npos) return text;
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos) return text + ".00";
  return text.size() - dot < 3 ? text + "0" : text;
}

std::string coordinates(const Vec3& p) {
  const double negligible = 1e-9 * p.cwiseAbs().maxCoeff();
  std::string text = "(";
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (i > 0) text += ',';
    text += std::abs(p[i]) <= negligible ? "0" : number_text(p[i], 3);
  }
  return text + ")";
}

/// One seam at the last stage measured.
struct SeamRow {
  std::string blend, side;
  Continuity asked = Continuity::G1, got = Continuity::none;
  const SeamReport* seam = nullptr;
};

std::vector<SeamRow> seam_rows(const JobResult& result) {
  std::vector<SeamRow> rows;
  for (const BlendResult& b : result.blends) {
    if (b.stages.empty()) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const SeamReport& seam = b.stages.back().seams[i];
      rows.push_back({b.entry.name, i == 0 ? "from" : "to", b.entry.sides[i].side.continuity,
                      reached(seam, result.job.tolerance), &seam});
    }
  }
  return rows;
}

/// The place that uses most of what it was allowed.
const Deviation& decisive(const SeamRow& row, const Tolerance& tolerance) {
  const SeamReport& s = *row.seam;
  const Deviation* worst = &s.gap;
  double most = s.gap.worst / tolerance.position;
  const auto consider = [&](const Deviation& d, double limit) {
    if (d.worst / limit > most) {
      most = d.worst / limit;
      worst = &d;
    }
  };
  if (row.asked >= Continuity::G1) consider(s.angle, tolerance.angle.value);
  if (row.asked >= Continuity::G2) consider(s.curvature, tolerance.curvature);
  return *worst;
}

/// A figure that was not asked for stands in brackets; what is far below rounding is 0.
std::string figure(double x, bool asked) {
  const std::string text = std::abs(x) < 1e-18 ? "0" : scientific_text(x);
  return asked ? text : "(" + text + ")";
}

std::string seam_table(const std::vector<SeamRow>& rows, const JobSpec& job) {
  const std::string unit = name(job.unit);
  TextRows table{{"blend", "side", "asked", "reached", "gap (" + unit + ")", "angle (deg)",
                  "jump (1/" + unit + ")", "worst at v"}};
  std::vector<std::string> places;
  for (const SeamRow& r : rows) {
    const Deviation& at = decisive(r, job.tolerance);
    places.push_back(fixed2(at.v) + " " + coordinates(at.point));
    table.push_back({r.blend, r.side, name(r.asked), name(r.got), figure(r.seam->gap.worst, true),
                     figure(r.seam->angle.worst * Radians(1.0).degrees(), r.asked >= Continuity::G1),
                     figure(r.seam->curvature.worst, r.asked >= Continuity::G2), places.back()});
  }
  std::string text = aligned(table);
  if (widest_line(text) <= 80) return text;
  // Too wide for a terminal: the places go below their rows.
  for (auto& row : table) row.pop_back();
  const std::string narrow = aligned(table);
  text.clear();
  std::size_t line = 0;
  for (std::size_t at = 0; at < narrow.size(); ++line) {
    const std::size_t end = narrow.find('\n', at) + 1;
    text += narrow.substr(at, end - at);
    if (line > 0) text += "    worst at v = " + places[line - 1] + "\n";
    at = end;
  }
  return text;
}

std::string failed_checks(const JobResult& result) {
  std::string text;
  for (const BlendResult& b : result.blends) {
    if (b.stages.empty()) continue;
    const std::array asked{b.entry.sides[0].side.continuity, b.entry.sides[1].side.continuity};
    for (const Finding& f : judge(b.stages.back(), asked, result.job.tolerance, result.job.unit))
      if (f.failed) text += "  " + f.text + "\n";
  }
  return text;
}

std::string size_text(std::size_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + " B";
  const bool mega = bytes >= 1000 * 1000;
  return number_text(std::round(static_cast<double>(bytes) / (mega ? 1e5 : 1e3)) / (mega ? 10.0 : 1.0)) +
         (mega ? " MB" : " kB");
}

}  // namespace

std::string run_table(const JobResult& result, const JobOutputs* outputs, const std::string& job_file) {
  const std::vector<SeamRow> rows = seam_rows(result);
  const auto missed = static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const SeamRow& r) { return r.got < r.asked; }));
  std::string text =
      job_file + ": " + counted(result.blends.size(), "blend") + ", " + counted(rows.size(), "seam") + ", ";
  const bool good = verified(result, outputs);
  if (missed > 0)
    text += std::to_string(missed) + " not within tolerance\n";
  else
    text += good ? "all within tolerance\n" : "all within tolerance, but a check failed\n";
  text += seam_table(rows, result.job);
  text += failed_checks(result);
  if (outputs && outputs->step) {
    const ShapeCheck& c = outputs->step->check;
    if (!c.valid) text += "  the STEP file's shape is not valid\n";
    for (const std::string& p : c.problems) text += "    " + p + "\n";
    if (c.unexpected_free_edges > 0)
      text += "  " + counted(c.unexpected_free_edges, "trimline edge") +
              " of the STEP file not shared by two faces\n";
    for (const WrittenFile& f : outputs->files)
      if (f.kind == "step") text += "  measured on " + f.path.string() + ", read back\n";
  } else {
    text += "  measured on the fitted B-spline surfaces, in memory\n";
  }
  return text;
}

std::string written_files(const JobOutputs& outputs, StepSchema schema) {
  std::string text = "wrote ";
  std::vector<std::string> kinds;
  for (const WrittenFile& f : outputs.files)
    if (std::find(kinds.begin(), kinds.end(), f.kind) == kinds.end()) kinds.push_back(f.kind);
  for (const std::string& kind : kinds) {
    const auto of_kind = [&](const WrittenFile& f) { return f.kind == kind; };
    const auto first = std::find_if(outputs.files.begin(), outputs.files.end(), of_kind);
    const auto count = std::count_if(outputs.files.begin(), outputs.files.end(), of_kind);
    if (kind != kinds.front()) text += ", ";
    const bool whole = kind == kinds.front();  // the first one with its folder, the others by extension
    if (whole)
      text += first->path.string();
    else if (kind == "report")
      text += "report.json";
    else
      text += "." + kind;
    if (count > 1) text += " x" + std::to_string(count);
    if (kind == "step") text += std::string(" (") + name(schema) + ", " + size_text(first->bytes) + ")";
  }
  return text;
}

}  // namespace blendwright
