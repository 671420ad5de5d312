#include <cmath>

#include "app/cli/relation_text.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/pipeline/collide_job.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

constexpr std::size_t most_rows = 40;  // of the table

CollideJob job_of(const CollideCommand& command, const Motion* motion) {
  CollideJob job;
  job.search = search_options_of(command.search);
  if (!command.projected.empty()) job.projected = command.projected.front() - 'x';
  job.motion = motion;
  job.all = command.all;
  job.cells.assign(command.cells.begin(), command.cells.end());
  if (!command.output.empty()) job.outputs = {command.output};
  job.overwrite = command.force;
  return job;
}

std::string gap_text(double gap, const std::string& unit) {
  const std::string length = scientific_text(std::abs(gap), 3) + " " + unit + " to first order";
  return gap > 0.0 ? "gap " + length : gap < 0.0 ? "penetration " + length : "touching, to first order";
}

/// "disjoint, proven", "in contact, witness point (1, 0, 0)", "undecided below 1e-09 mm".
std::string verdict_text(const Collision& c, const SearchOptions& options, const std::string& unit) {
  switch (c.contact) {
    case Contact::disjoint:
      return "disjoint, proven";
    case Contact::contact:
      return "in contact, witness point " + (c.point ? shown_point(*c.point) : std::string("not told"));
    case Contact::undecided:
      break;
  }
  return undecided_text(c.boxes, c.undecided, options, unit);
}

std::string pair_text(std::span<const Body> bodies, const BodyPair& pair, const CollideJob& job) {
  const std::string unit = name(bodies.front().scene.spec.unit);
  const Collision& c = pair.collision;
  std::string text = bodies[pair.first].name + " and " + bodies[pair.second].name + ": " +
                     verdict_text(c, job.search, unit) + "\n";
  TextRows rows;
  if (c.point && c.contact != Contact::contact)
    rows.push_back({c.contact == Contact::disjoint ? "nearest place" : "place", shown_point(*c.point)});
  if (c.normal) rows.push_back({"normal", shown_point(*c.normal)});
  if (c.gap) rows.push_back({"distance", gap_text(*c.gap, unit)});
  if (bodies.size() > 2) rows.push_back({"boxes examined", std::to_string(c.boxes)});
  return text + aligned(rows);
}

/// One line per pair of a motion that is not disjoint.
std::string motion_table(std::span<const Body> bodies, const CollideJob& job, const CollideResult& result) {
  const std::string unit = name(bodies.front().scene.spec.unit);
  TextRows rows;
  std::size_t left = 0;
  for (const CollideStep& step : result.steps)
    for (const BodyPair& pair : step.pairs) {
      const Collision& c = pair.collision;
      if (c.contact == Contact::disjoint && !job.all) continue;
      if (rows.size() >= most_rows) {
        ++left;
        continue;
      }
      rows.push_back({job.motion->at_name + " " + number_text(step.at), bodies[pair.first].name,
                      bodies[pair.second].name, std::string(name(c.contact)),
                      c.point ? shown_point(*c.point) : "", c.gap ? gap_text(*c.gap, unit) : ""});
    }
  std::string text = aligned(rows);
  if (left > 0) text += "  and " + counted(left, "other line") + "; -o file.csv has all\n";
  return text;
}

std::string head_line(std::span<const Body> bodies, const CollideResult& result, bool moved) {
  std::string text = counted(bodies.size(), "bodie");
  text.replace(text.find("bodie"), std::string::npos, "bodies");
  if (moved) text += ", " + counted(result.steps.size(), "step");
  text += ": " + counted(result.contacts, "contact");
  if (result.undecided > 0) text += ", " + std::to_string(result.undecided) + " undecided";
  return text + "\n";
}

std::string answer_text(std::span<const Body> bodies, const CollideJob& job, const CollideResult& result) {
  if (job.motion) return head_line(bodies, result, true) + motion_table(bodies, job, result);
  std::string text = bodies.size() > 2 ? head_line(bodies, result, false) : "";
  for (const BodyPair& pair : result.steps.front().pairs) text += pair_text(bodies, pair, job);
  return text;
}

std::string last_line(const CollideResult& result) {
  std::string text =
      "  " + std::to_string(result.boxes) + (result.boxes == 1 ? " box" : " boxes") + " examined";
  if (result.files.empty()) return text;
  return text + "\n" + written_files(result.files, [](const WrittenFile& f) { return size_text(f.bytes); });
}

int exit_code(const CollideCommand& command, const CollideResult& result) {
  if (command.expect.empty()) return result.undecided > 0 ? exit_not_verified : exit_done;
  const Contact expected = command.expect == "contact" ? Contact::contact : Contact::disjoint;
  return result.answer == expected ? exit_done : exit_not_verified;
}

std::vector<std::string> names_of(std::span<const Body> bodies) {
  std::vector<std::string> names;
  for (const Body& body : bodies) names.push_back(body.name);
  return names;
}

}  // namespace

int collide(const CollideCommand& command, const Console& console) {
  std::string subject = shown_names(command.scenes);  // whose problems are told
  return guarded(console, subject, [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    const std::vector<Body> bodies =
        read_bodies(command.scenes, command.convert_units, command.quiet, console, subject);
    std::optional<Motion> motion;
    if (!command.motion.empty()) {
      const std::string scenes = subject;
      subject = shown_name(command.motion);
      motion = read_motion_file(command.motion, names_of(bodies));
      subject = scenes;
    }
    const CollideJob job = job_of(command, motion ? &*motion : nullptr);
    const CollideResult result = run_collide_job(bodies, job, run.progress());
    run.clear();
    if (!command.quiet)
      for (const std::string& n : result.notes) console.err() << n << '\n';
    if (command.json)
      console.out() << collision_report_json(bodies, job, result, command.times);
    else if (!command.quiet)
      console.out() << answer_text(bodies, job, result) << with_seconds(last_line(result), run.seconds());
    return exit_code(command, result);
  });
}

}  // namespace blendwright
