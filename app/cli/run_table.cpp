#include "app/cli/run_table.hpp"

#include <algorithm>
#include <cmath>

#include "app/cli/console.hpp"
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

/// One seam at the last stage measured.
struct SeamRow {
  std::string blend, side;
  Continuity asked = Continuity::G1, got = Continuity::none;
  const SeamReport* seam = nullptr;
  double size = 0.0;  ///< of the blend

  [[nodiscard]] bool missed() const { return seam->measured && got < asked; }
};

std::vector<SeamRow> seam_rows(const JobResult& result) {
  std::vector<SeamRow> rows;
  for (const BlendResult& b : result.blends) {
    if (b.stages.empty()) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const SeamReport& seam = b.stages.back().seams[i];
      rows.push_back({b.entry.name, i == 0 ? "from" : "to", b.entry.sides[i].side.continuity,
                      reached(seam, result.job.tolerance), &seam, b.stages.back().size});
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
    if (!r.seam->measured) {
      table.push_back({r.blend, r.side, name(r.asked), "not measured", "", "", "", ""});
      places.emplace_back();
      continue;
    }
    const Deviation& at = decisive(r, job.tolerance);
    places.push_back(fixed2(at.v) + " " + place_text(at.point, r.size, ","));
    table.push_back({r.blend, r.side, name(r.asked), name(r.got), figure(r.seam->gap.worst, true),
                     figure(r.seam->angle.worst * Radians(1.0).degrees(), r.asked >= Continuity::G1),
                     figure(r.seam->curvature.worst, r.asked >= Continuity::G2), places.back()});
  }
  const bool brackets = std::any_of(rows.begin(), rows.end(), [](const SeamRow& r) {
    return r.seam->measured && r.asked < Continuity::G2;
  });
  const std::string legend = brackets ? "  (...) not asked\n" : "";
  std::string text = aligned(table);
  if (widest_line(text) <= 80) return text + legend;
  // Too wide for a terminal: the places go below their rows.
  for (auto& row : table) row.pop_back();
  const std::string narrow = aligned(table);
  text.clear();
  std::size_t line = 0;
  for (std::size_t at = 0; at < narrow.size(); ++line) {
    const std::size_t end = narrow.find('\n', at) + 1;
    text += narrow.substr(at, end - at);
    if (line > 0 && !places[line - 1].empty()) text += "    worst at v = " + places[line - 1] + "\n";
    at = end;
  }
  return text + legend;
}

/// The pairs (sampled, proven) of every stage; empty when no bounds were asked for.
std::string proven_table(const JobResult& result) {
  const std::string unit = name(result.job.unit);
  TextRows table{
      {"blend", "side", "stage", "proven gap (" + unit + ")", "angle (deg)", "jump (1/" + unit + ")"}};
  for (const BlendResult& b : result.blends)
    for (const BlendReport& stage : b.stages) {
      if (!stage.proven) continue;
      for (std::size_t i = 0; i < 2; ++i) {
        const SeamCertificate& c = (*stage.proven)[i];
        const Continuity asked = b.entry.sides[i].side.continuity;
        const auto bound = [](const ProvenFigure& f, double factor, bool needed) {
          const std::string text = std::isfinite(f.proven) ? figure(f.proven * factor, needed) : "unproven";
          return f.agreed() || !std::isfinite(f.proven) ? text : text + " unproven";
        };
        table.push_back({b.entry.name, i == 0 ? "from" : "to", stage.stage, bound(c.gap, 1.0, true),
                         bound(c.angle, Radians(1.0).degrees(), asked >= Continuity::G1),
                         bound(c.curvature, 1.0, asked >= Continuity::G2)});
      }
    }
  return table.size() == 1 ? std::string() : aligned(table);
}

/// Fairness of the last stage, a line per figure; empty when it was not asked for.
std::string fairness_table(const JobResult& result) {
  const std::string unit = name(result.job.unit);
  std::string text;
  for (const BlendResult& b : result.blends) {
    if (b.stages.empty() || !b.stages.back().fairness) continue;
    const FairnessReport& f = *b.stages.back().fairness;
    const auto placed = [&](const Extreme& e, const std::string& of) {
      return number_text(e.value, 4) + " " + of + " at u = " + fixed2(e.at.u) + ", v = " + fixed2(e.at.v);
    };
    TextRows rows{
        {"fairness", b.entry.name},
        {"bending energy", number_text(f.bending, 5)},
        {"thin plate", number_text(f.thin_plate, 5) + " " + unit + "^2"},
        {"variation", number_text(f.variation, 5) + " 1/" + unit + "^2"},
        {"curvature", placed(f.largest, "1/" + unit)},
        {"", placed(f.smallest, "1/" + unit)},
        {"turns", std::to_string(f.turns.most) + " at most on a line, at v = " + fixed2(f.turns.v)}};
    if (f.draft)
      for (const Extreme& e : *f.draft) {
        Extreme angle = e;
        angle.value = Radians(e.value).degrees();
        rows.push_back({&e == &f.draft->front() ? "draft" : "", placed(angle, "deg")});
      }
    text += aligned(rows);
  }
  return text;
}

/// How well the two measurements of gaps and angles agree over all stages, or that the program is wrong.
std::string second_lines(const JobResult& result) {
  double gap = 0.0, angle = 0.0;
  std::size_t places = 0;
  const auto take = [&](double& largest, const SecondFigure& f) {
    largest = std::max(largest, f.difference);
    places += f.places;
  };
  for (const BlendResult& b : result.blends)
    for (const BlendReport& stage : b.stages) {
      if (!stage.second) continue;
      for (const SecondSeam& seam : stage.second->seams) {
        for (const SecondFigure& f : {seam.gap, seam.surface_gap}) take(gap, f);
        take(angle, seam.angle);
      }
      if (!stage.second->closing) continue;
      take(gap, stage.second->closing->gap);
      take(angle, stage.second->closing->angle);
    }
  const std::vector<std::string> defects = program_defects(result);
  if (defects.empty() && places == 0) return "";
  std::string text;
  if (defects.empty()) {
    text = "  measured twice: gaps agree to " + figure(gap, true) + " " + name(result.job.unit);
    return text + ", angles to " + figure(angle * Radians(1.0).degrees(), true) + " deg\n";
  }
  text =
      "  DEFECT OF THE PROGRAM: two measurements of one figure disagree. The figures above\n"
      "  cannot be trusted; please report this with the job file.\n";
  for (const std::string& defect : defects) text += "    " + defect + "\n";
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

/// "all within tolerance", "1 not within tolerance, 1 not measured (no primary)", ...
std::string verdict(const std::vector<SeamRow>& rows, bool good) {
  const auto count = [&](auto is) {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), is));
  };
  const std::size_t missed = count([](const SeamRow& r) { return r.missed(); });
  const std::size_t unmeasured = count([](const SeamRow& r) { return !r.seam->measured; });
  const std::string left = std::to_string(unmeasured) + " not measured (no primary)";
  std::string text;
  if (missed > 0)
    text = std::to_string(missed) + " not within tolerance";
  else if (unmeasured == 0)
    text = "all within tolerance";
  else if (unmeasured < rows.size())
    text = std::to_string(rows.size() - unmeasured) + " within tolerance";
  if (unmeasured > 0) text += (text.empty() ? "" : ", ") + left;
  return missed > 0 || good ? text : text + ", but a check failed";
}

/// Words separated by commas, on lines of at most 80 columns.
class WrappedList {
 public:
  explicit WrappedList(std::string start) : text_(std::move(start)), column_(text_.size()) {}
  void add(const std::string& word) {
    if (!first_) put(",");
    // The comma or the seconds that may follow need a column.
    if (!first_ && column_ + 1 + word.size() + 1 > 80) {
      text_ += "\n ";
      column_ = 1;
    }
    if (!first_) put(" ");
    put(word);
    first_ = false;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void put(const std::string& more) {
    text_ += more;
    column_ += more.size();
  }
  std::string text_;
  std::size_t column_ = 0;
  bool first_ = true;
};

}  // namespace

std::string run_table(const JobResult& result, const JobOutputs* outputs, const std::string& job_file) {
  const std::vector<SeamRow> rows = seam_rows(result);
  std::string text = job_file + ": " + counted(result.blends.size(), "blend") + ", " +
                     counted(rows.size(), "seam") + ", " + verdict(rows, verified(result, outputs)) + "\n";
  text += seam_table(rows, result.job);
  text += proven_table(result);
  text += fairness_table(result);
  text += failed_checks(result);
  text += second_lines(result);
  if (outputs)
    for (const std::string& p : shape_problems(result, *outputs)) text += "  " + p + "\n";
  if (outputs && outputs->step) {
    for (const WrittenFile& f : outputs->files)
      if (f.kind == "step") text += "  measured on " + f.path.string() + ", read back\n";
  } else {
    text += "  measured on the fitted B-spline surfaces, in memory\n";
  }
  return text;
}

int exit_code_of(const JobResult& result, const JobOutputs* outputs) {
  if (!program_defects(result).empty()) return exit_defect;
  return verified(result, outputs) ? exit_done : exit_not_verified;
}

std::string size_text(std::size_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + " B";
  const bool mega = bytes >= 1000 * 1000;
  return number_text(std::round(static_cast<double>(bytes) / (mega ? 1e5 : 1e3)) / (mega ? 10.0 : 1.0)) +
         (mega ? " MB" : " kB");
}

std::string written_files(std::span<const WrittenFile> files,
                          const std::function<std::string(const WrittenFile&)>& remark) {
  WrappedList list("wrote ");
  for (const WrittenFile& f : files) {
    // Those in the folder of the first one need only their name.
    const bool named = &f != &files.front() && f.path.parent_path() == files.front().path.parent_path();
    std::string word = named ? f.path.filename().string() : f.path.string();
    const std::string text = remark(f);
    if (!text.empty()) word.append(" (").append(text).append(1, ')');
    list.add(word);
  }
  return list.text();
}

std::string written_files(const JobOutputs& outputs, StepSchema schema) {
  return written_files(outputs.files, [&](const WrittenFile& f) {
    return f.kind == "step" ? name(schema) + (", " + size_text(f.bytes)) : std::string();
  });
}

std::string with_seconds(std::string text, double seconds) {
  const std::string time = number_text(seconds, 2) + " s\n";
  const std::size_t start = text.rfind('\n') + 1;  // 0 when there is one line
  return text + (text.size() - start + 3 + time.size() <= 81 ? "   " : "\n  ") + time;
}

}  // namespace blendwright
