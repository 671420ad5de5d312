#include <algorithm>
#include <cmath>

#include "app/cli/relation_text.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/compare_report.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

std::string figure(double x) { return x == 0.0 ? "0" : scientific_text(x, 4); }

/// "reducer, thin"; many are counted.
std::string pieces_text(const ComparedResult& r) {
  std::string names;
  for (const std::string& p : r.pieces) names += (names.empty() ? "" : ", ") + (p.empty() ? "unnamed" : p);
  if (names.size() > 60) names = counted(r.pieces.size(), "piece");
  return names + (r.surfaces ? " (surfaces)" : " (" + counted(r.triangles, "triangle") + ")");
}

std::string verdict(const CompareResult& result) {
  const std::string unit = name(result.unit), largest = figure(result.largest()) + " " + unit;
  if (std::isnan(result.largest())) return "not a number";
  const std::string apart = "at most " + largest + " apart" + (result.proven() ? ", proven" : "");
  if (!result.limit) return apart;
  const std::string limit = number_text(*result.limit, 6) + " " + unit;
  const auto within = result.within();
  if (!within) return largest + " apart, not proven to stay within the limit " + limit;
  return apart + (*within ? ", within the limit " : ", beyond the limit ") + limit;
}

std::string compare_table(const CompareResult& result) {
  const BodyDeviation &a = result.ways[0], &b = result.ways[1];
  const std::string unit = name(result.unit);
  TextRows rows{{"(" + unit + ")", "first to second", "second to first"}};
  const auto add = [&](const char* what, double BodyDeviation::*value) {
    rows.push_back({what, figure(a.*value), figure(b.*value)});
  };
  add("largest", &BodyDeviation::largest);
  if (a.proven || b.proven)
    rows.push_back({"proven below", a.proven ? figure(*a.proven) : "", b.proven ? figure(*b.proven) : ""});
  add("mean", &BodyDeviation::mean);
  add("root mean square", &BodyDeviation::rms);
  add("95 % below", &BodyDeviation::percentile95);
  const auto sign = [&](double BodyDeviation::*value) {
    return std::vector<std::string>{a.signs ? figure(a.*value) : "no sides",
                                    b.signs ? figure(b.*value) : "no sides"};
  };
  for (const auto& [what, value] :
       {std::pair{"signed, least", &BodyDeviation::least}, std::pair{"signed, most", &BodyDeviation::most}}) {
    const auto both = sign(value);
    rows.push_back({what, both[0], both[1]});
  }
  std::string text =
      "  first   " + pieces_text(result.results[0]) + "\n  second  " + pieces_text(result.results[1]) + "\n";
  text += aligned(rows);
  for (const auto& [what, way] : {std::pair{"first", &a}, std::pair{"second", &b}})
    text += std::string("  largest of the ") + what + " at " + shown_point(way->at) + "\n";
  return text;
}

}  // namespace

int compare(const CompareCommand& command, const Console& console) {
  std::string subject = shown_name(command.first) + " and " + shown_name(command.second);
  return guarded(console, subject, [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> threads;
    if (command.threads) threads.emplace(*command.threads);
    const CompareResult result = run_compare({.files = {command.first, command.second},
                                              .limit = command.limit,
                                              .output = command.output,
                                              .overwrite = command.force},
                                             subject, run.progress());
    run.clear();
    if (!command.quiet)
      for (const std::string& n : result.notes) console.err() << n << '\n';
    if (command.json) {
      console.out() << compare_report_json(result);
    } else if (!command.quiet) {
      const std::string files =
          result.files.empty()
              ? std::string("nothing written")
              : written_files(result.files, [](const WrittenFile& f) { return size_text(f.bytes); });
      console.out() << subject << ": " << verdict(result) << "\n"
                    << compare_table(result) << with_seconds(files, run.seconds());
    }
    const bool number = std::isfinite(result.largest());
    return number && result.within().value_or(false) ? exit_done : exit_not_verified;
  });
}

}  // namespace blendwright
