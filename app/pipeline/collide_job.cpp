#include "app/pipeline/collide_job.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include "app/json/json_value.hpp"
#include "app/pipeline/cell_pictures.hpp"
#include "app/pipeline/progress_part.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/csv_text.hpp"
#include "kernel/exchange/mesh_files.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

constexpr double searched = 0.9;  // of the progress, before anything is written

void require_extension(const char* flag, const fs::path& file, std::initializer_list<const char*> known) {
  const std::string extension = lower_case_extension(file);
  std::string text;
  for (const char* e : known) {
    if (extension == e) return;
    text += (text.empty() ? "\"" : " or \"") + std::string(e) + "\"";
  }
  throw InputError(flag, "is " + in_quotes(file.string()) + ", must end in " + text);
}

std::vector<fs::path> files_of(const CollideJob& job) {
  std::vector<fs::path> files = job.outputs;
  files.insert(files.end(), job.cells.begin(), job.cells.end());
  return files;
}

void require_sensible(std::span<const Body> bodies, const CollideJob& job) {
  if (bodies.size() < 2)
    throw InputError("SCENES", "is one scene, must be at least two; one may be given twice");
  for (const fs::path& file : job.outputs) require_extension("--output", file, {".csv"});
  for (const fs::path& file : job.cells) require_extension("--cells", file, {".vtu", ".png"});
  if (!job.cells.empty() && bodies.size() > 2)
    throw InputError("--cells", "is given with " + std::to_string(bodies.size()) +
                                    " scenes, must be with two: it shows one subdivision");
  if (!job.overwrite) refuse_existing(files_of(job));
}

/// Problems of the search named as the program's flags.
InputError with_flags(const InputError& error) {
  std::vector<Problem> problems = error.problems();
  for (Problem& p : problems)
    for (const char* flag : {"tolerance", "domain"})
      if (p.where == flag) p.where = std::string("--") + flag;
  return InputError(std::move(problems));
}

CollideStep standing(std::span<const Body> bodies, const CollideJob& job, const Progress& progress) {
  SearchOptions options = job.search;
  options.keep_cells = !job.cells.empty();
  const double pairs = 0.5 * static_cast<double>(bodies.size() * (bodies.size() - 1));
  CollideStep step;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const auto done = static_cast<double>(step.pairs.size());
      const Progress part = part_of(progress, searched * done / pairs, searched * (done + 1.0) / pairs);
      const ScalarField &a = bodies[i].scene.scene.field, &b = bodies[j].scene.scene.field;
      Collision found = job.projected ? collide_projected(a, b, *job.projected, options, part)
                                      : collide(a, b, options, std::nullopt, part);
      step.pairs.push_back({i, j, with_nearest_place(std::move(found), a, b)});
    }
  return step;
}

std::vector<CollideStep> moving(std::span<const Body> bodies, const CollideJob& job,
                                const Progress& progress) {
  std::vector<ScalarField> fields;
  for (const Body& body : bodies) fields.push_back(body.scene.scene.field);
  MovingBodies moved(std::move(fields), job.search);
  std::vector<RigidMotion> placements(bodies.size());
  std::vector<CollideStep> steps;
  const std::vector<MotionStep>& motion = job.motion->steps;
  for (const MotionStep& step : motion) {
    for (const auto& [body, placement] : step.placed) placements[body] = placement;
    const auto done = static_cast<double>(steps.size()), all = static_cast<double>(motion.size());
    progress.at(searched * done / all, job.motion->at_name + " " + number_text(step.at));
    const bool two = bodies.size() == 2;
    steps.push_back(
        {step.at, moved.at(placements, job.all || two,
                           part_of(progress, searched * done / all, searched * (done + 1.0) / all))});
    if (two && steps.back().pairs.empty()) {  // their bounds do not meet
      Collision apart;
      apart.contact = Contact::disjoint;
      steps.back().pairs.push_back({0, 1, apart});
    }
  }
  return steps;
}

void summarise(CollideResult& result) {
  for (const CollideStep& step : result.steps)
    for (const BodyPair& pair : step.pairs) {
      result.boxes += pair.collision.boxes;
      if (pair.collision.contact == Contact::contact) ++result.contacts;
      if (pair.collision.contact == Contact::undecided) ++result.undecided;
    }
  result.answer = result.contacts > 0    ? Contact::contact
                  : result.undecided > 0 ? Contact::undecided
                                         : Contact::disjoint;
}

void write_csv(const fs::path& file, const fs::path& final_name, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw IoError(final_name.string() + ": cannot be written; is the disk full?");
}

void write_files(CollideResult& result, std::span<const Body> bodies, const CollideJob& job,
                 const Progress& progress) {
  StagedFiles staged(files_of(job));
  try {
    for (const fs::path& file : job.outputs) {
      progress.at(searched, "writing " + file.filename().string());
      write_csv(staged.of(file), file, collision_csv(bodies, job, result));
    }
    for (const fs::path& file : job.cells) {
      progress.at(searched, "writing " + file.filename().string());
      const Collision& collision = result.steps.front().pairs.front().collision;
      if (lower_case_extension(file) == ".png")
        write_cells_picture(staged.of(file), bodies, collision, job.projected, result.notes,
                            part_of(progress, searched, 1.0));
      else
        write_vtu(staged.of(file), cells_of(bodies, collision));
    }
    result.files = staged.publish();
  } catch (const IoError& e) {
    throw staged.with_final_names(e);
  }
}

}  // namespace

CollideResult run_collide_job(std::span<const Body> bodies, const CollideJob& job, const Progress& progress) {
  require_sensible(bodies, job);
  CollideResult result;
  StopWatch watch;
  try {
    if (job.motion)
      result.steps = moving(bodies, job, progress);
    else
      result.steps.push_back(standing(bodies, job, progress));
  } catch (const InputError& e) {
    throw with_flags(e);
  }
  summarise(result);
  result.times.push_back({"searching", watch.lap()});
  if (!files_of(job).empty()) {
    write_files(result, bodies, job, progress);
    result.times.push_back({"writing", watch.lap()});
  }
  return result;
}

std::string collision_csv(std::span<const Body> bodies, const CollideJob& job, const CollideResult& result) {
  std::string text = job.motion ? job.motion->at_name + "," : "";
  text += "first,second,verdict,x,y,z,nx,ny,nz,gap,boxes\n";
  const auto add = [&](const std::optional<Vec3>& p) {
    for (int k = 0; k < 3; ++k) text.append(p ? number_text((*p)[k] + 0.0) : "").append(1, ',');  // no -0
  };
  for (const CollideStep& step : result.steps) {
    const std::string at = job.motion ? number_text(step.at) + "," : "";
    if (step.pairs.empty())
      text.append(at).append(",,").append(name(Contact::disjoint)).append(",,,,,,,,0\n");
    for (const BodyPair& pair : step.pairs) {
      const Collision& c = pair.collision;
      text.append(at).append(csv_field(bodies[pair.first].name)).append(1, ',');
      text.append(csv_field(bodies[pair.second].name)).append(1, ',').append(name(c.contact)).append(1, ',');
      add(c.point);
      add(c.normal);
      text.append(c.gap ? number_text(*c.gap + 0.0) : "").append(1, ',');
      text.append(std::to_string(c.boxes)).append(1, '\n');
    }
  }
  return text;
}

}  // namespace blendwright
