#include <fstream>
#include <iostream>

#include "app/cli/relation_text.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/json/json_value.hpp"
#include "app/pipeline/relate_job.hpp"
#include "app/pipeline/staging.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/point_files.hpp"

namespace blendwright {
namespace {

/// Points whose places are held at a time.
constexpr std::size_t block = 1 << 16;

void require_sensible(const RelateCommand& command) {
  if (command.scenes.size() > 2)
    throw InputError("SCENES", "are " + std::to_string(command.scenes.size()) + ", must be one or two");
  if (command.scenes.size() == 1 && command.points.empty())
    throw InputError("SCENES", "is one scene, must be two, or one with --points");
  if (command.points == "-")
    for (const std::string& scene : command.scenes)
      if (solid_place(scene).file == "-")
        throw InputError("--points", "is standard input, as a scene is; must be a file");
  if (command.output.empty()) return;
  if (lower_case_extension(command.output) != ".csv")
    throw InputError("--output", "is " + in_quotes(command.output) + ", must end in \".csv\"");
  if (!command.force) refuse_existing({command.output});
}

MembershipOptions membership_options(const RelateCommand& command) {
  using Mode = MembershipOptions::Mode;
  return {.mode = command.mode == "value"        ? Mode::value
                  : command.mode == "guaranteed" ? Mode::guaranteed
                                                 : Mode::length,
          .tolerance = command.search.tolerance,
          .confirm = command.confirm};
}

void print_places(std::ostream& out, std::span<const Body> bodies, std::span<const Vec3> points,
                  const MembershipOptions& options, const Progress& progress) {
  out << membership_header(bodies.size());
  for (std::size_t at = 0; at < points.size(); at += block) {
    progress.at(static_cast<double>(at) / static_cast<double>(points.size()), "placing points");
    const std::span<const Vec3> some = points.subspan(at, std::min(block, points.size() - at));
    std::vector<std::vector<Membership>> of_solids;
    for (const Body& body : bodies) of_solids.push_back(membership(body.scene.scene.field, some, options));
    out << membership_lines(some, of_solids);
  }
}

void write_places(const RelateCommand& command, std::span<const Body> bodies, std::span<const Vec3> points,
                  const Progress& progress) {
  StagedFiles staged({command.output});
  try {
    std::ofstream out(staged.of(command.output), std::ios::binary);
    print_places(out, bodies, points, membership_options(command), progress);
    out.close();
    if (!out) throw IoError(command.output + ": cannot be written; is the disk full?");
    static_cast<void>(staged.publish());
  } catch (const IoError& e) {
    throw staged.with_final_names(e);
  }
}

int place_points(const RelateCommand& command, std::span<const Body> bodies, const Console& console, Run& run,
                 std::string& subject) {
  const std::string scenes = subject;
  subject = shown_name(command.points);
  const std::vector<Vec3> points =
      command.points == "-" ? read_csv_points(std::cin) : read_points(command.points);
  subject = scenes;
  if (command.output.empty())
    print_places(console.out(), bodies, points, membership_options(command), run.progress());
  else
    write_places(command, bodies, points, run.progress());
  run.clear();
  if (!command.output.empty() && !command.quiet)
    console.out() << with_seconds("wrote " + command.output + ", " + counted(points.size(), "point"),
                                  run.seconds());
  return exit_done;
}

std::string relation_table(const SetRelation& relation, std::span<const Body> bodies,
                           const SearchOptions& options) {
  const std::string unit = name(bodies.front().scene.spec.unit);
  TextRows rows;
  for (const RelationStatement& s : statements(relation, bodies)) {
    const Proof& p = s.proof;
    std::string answer(name(p.answer));
    if (p.answer == Answer::refuted && p.witness) answer += " by " + shown_point(*p.witness);
    if (p.answer == Answer::undecided) answer = undecided_text(p.boxes, p.undecided, options, unit);
    rows.push_back({s.text, answer});
  }
  return aligned(rows);
}

std::size_t boxes_of(const SetRelation& r) {
  return r.first_empty.boxes + r.second_empty.boxes + r.apart.boxes + r.first_in_second.boxes +
         r.second_in_first.boxes;
}

int relate_solids(const RelateCommand& command, std::span<const Body> bodies, const Console& console,
                  Run& run) {
  const SearchOptions options = search_options_of(command.search);
  const SetRelation relation =
      set_relation(bodies[0].scene.scene.field, bodies[1].scene.scene.field, options, run.progress());
  run.clear();
  const bool decided = relation.kind != SetRelation::Kind::undecided;
  if (command.json)
    console.out() << relation_report_json(relation, bodies, options);
  else if (!command.quiet)
    console.out() << relation_text(relation, bodies) << (decided ? ", proven\n" : "\n")
                  << relation_table(relation, bodies, options)
                  << with_seconds("  " + std::to_string(boxes_of(relation)) +
                                      (boxes_of(relation) == 1 ? " box" : " boxes"),
                                  run.seconds());
  return decided ? exit_done : exit_not_verified;
}

/// Problems of the search named as the program's flags.
InputError with_flags(const InputError& error) {
  std::vector<Problem> problems = error.problems();
  for (Problem& p : problems)
    if (p.where == "tolerance" || p.where == "domain" || p.where == "points") p.where.insert(0, "--");
  return InputError(std::move(problems));
}

}  // namespace

int relate(const RelateCommand& command, const Console& console) {
  std::string subject = shown_names(command.scenes);  // whose problems are told
  return guarded(console, subject, [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    require_sensible(command);
    const std::vector<Body> bodies =
        read_bodies(command.scenes, command.convert_units, command.quiet, console, subject);
    try {
      return command.points.empty() ? relate_solids(command, bodies, console, run)
                                    : place_points(command, bodies, console, run, subject);
    } catch (const InputError& e) {
      throw with_flags(e);
    }
  });
}

}  // namespace blendwright
