#include "app/pipeline/compare_job.hpp"

#include <algorithm>
#include <cmath>

#include "app/json/json_value.hpp"
#include "app/pipeline/bodies.hpp"
#include "app/pipeline/picture_input.hpp"
#include "app/pipeline/progress_part.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/mesh_files.hpp"

namespace blendwright {
namespace {

/// A surface in other units of length.
struct ScaledSurface {
  Surface surface;
  double factor = 1.0;
  [[nodiscard]] SurfaceJet jet(UV p) const {
    SurfaceJet j = surface.jet(p);
    for (Vec3* d : {&j.S, &j.Su, &j.Sv, &j.Suu, &j.Suv, &j.Svv}) *d *= factor;
    return j;
  }
  [[nodiscard]] SurfacePartials partials(UV p) const {
    SurfacePartials all = surface.partials(p);
    for (Vec3& d : all.d) d *= factor;
    return all;
  }
  [[nodiscard]] SurfaceDomain domain() const { return surface.domain(); }
};

double in_millimetres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::centimetre:
      return 10.0;
    case LengthUnit::metre:
      return 1000.0;
    case LengthUnit::inch:
      return 25.4;
    default:
      return 1.0;
  }
}

struct Read {
  std::string name;
  std::optional<LengthUnit> unit;
  std::vector<ResultPiece> pieces;
};

std::string listed_names(const std::vector<ResultPiece>& pieces) {
  std::string text;
  for (const ResultPiece& p : pieces)
    if (!p.mesh.name.empty()) text += (text.empty() ? "" : ", ") + in_quotes(p.mesh.name);
  return text.empty() ? "none has a name" : text;
}

bool is_scene(const PictureInput& input) { return input.kind == PictureInput::Kind::scene; }

Read read_result(const std::string& file, const Progress& progress) {
  const SolidPlace place = solid_place(file);
  PictureInput input = read_picture_input(place.file, {.solid = place.solid}, progress);
  Read read{input.name, input.unit, {}};
  for (PicturePart& part : input.parts) {
    if (input.job && part.role != PicturePart::Role::blend) continue;
    if (!part.mesh.triangles.empty()) read.pieces.push_back({std::move(part.mesh), std::move(part.surface)});
  }
  if (read.pieces.empty())
    throw InputError("", "has no surface and no triangles, must have some to be compared");
  if (place.solid.empty() || is_scene(input)) return read;
  std::vector<ResultPiece> wanted;
  for (const ResultPiece& p : read.pieces)
    if (p.mesh.name == place.solid) wanted.push_back(p);
  if (wanted.empty())
    throw InputError(
        "", "has no piece " + in_quotes(place.solid) + ", must be one of: " + listed_names(read.pieces));
  read.pieces = std::move(wanted);
  read.name.append(1, '#').append(place.solid);
  return read;
}

bool has_name(const std::vector<ResultPiece>& pieces, const std::string& name) {
  return !name.empty() &&
         std::any_of(pieces.begin(), pieces.end(), [&](const ResultPiece& p) { return p.mesh.name == name; });
}

/// Leaves the pieces whose names both have, when there are such.
void pair_by_name(Read& a, Read& b) {
  const auto common = [](const std::vector<ResultPiece>& mine, const std::vector<ResultPiece>& others) {
    std::vector<ResultPiece> kept;
    for (const ResultPiece& p : mine)
      if (has_name(others, p.mesh.name)) kept.push_back(p);
    return kept;
  };
  std::vector<ResultPiece> first = common(a.pieces, b.pieces), second = common(b.pieces, a.pieces);
  if (first.empty()) return;
  a.pieces = std::move(first);
  b.pieces = std::move(second);
}

/// The result in another unit; says so.
void convert(Read& read, LengthUnit unit, std::vector<std::string>& notes) {
  if (!read.unit || *read.unit == unit) return;
  const double factor = in_millimetres(*read.unit) / in_millimetres(unit);
  notes.push_back(read.name + " is in " + name(*read.unit) + ": its lengths are multiplied by " +
                  number_text(factor, 6));
  for (ResultPiece& piece : read.pieces) {
    for (Vec3& p : piece.mesh.points) p *= factor;
    if (piece.surface) piece.surface = Surface(ScaledSurface{*piece.surface, factor});
  }
}

ComparedResult described(const Read& read, const ResultBody& body) {
  ComparedResult result{read.name, {}, body.has_surfaces(), body.sag(), body.tree().mesh().triangles.size()};
  for (const ResultPiece& p : read.pieces) result.pieces.push_back(p.mesh.name);
  return result;
}

void write_deviation(const CompareJob& job, const ResultBody& first, CompareResult& result) {
  TriMesh mesh = first.tree().mesh();
  mesh.name = result.results[0].name;
  mesh.note = "deviation of " + result.results[0].name + " from " + result.results[1].name;
  mesh.columns = {{"deviation", name(result.unit), 1, result.ways[0].at_points}};
  mesh.shown = "deviation";
  StagedFiles staged({job.output});
  try {
    write_vtp(staged.of(job.output), mesh);
    result.files = staged.publish();
  } catch (const IoError& e) {
    throw staged.with_final_names(e);
  }
}

void require_output(const CompareJob& job) {
  if (job.output.empty()) return;
  if (lower_case_extension(job.output) != ".vtp")
    throw InputError("--output", "is " + in_quotes(job.output.string()) + ", must end in \".vtp\"");
  if (!job.overwrite) refuse_existing({job.output});
  StagingFolder::require_places({job.output});
}

}  // namespace

double CompareResult::largest() const {
  const double a = ways[0].largest, b = ways[1].largest;
  return std::isnan(a) || a >= b ? a : b;
}

std::optional<double> CompareResult::proven() const {
  if (!ways[0].proven || !ways[1].proven) return std::nullopt;
  return std::max(*ways[0].proven, *ways[1].proven);
}

std::optional<bool> CompareResult::within() const {
  if (!limit) return true;
  if (!(largest() <= *limit)) return false;
  if (proven() && *proven() > *limit) return std::nullopt;
  return true;
}

CompareResult run_compare(const CompareJob& job, std::string& subject, const Progress& progress) {
  require_output(job);
  if (job.files[0] == "-" && job.files[1] == "-")
    throw InputError("", "both results are standard input, must be one of them at most");
  const std::string whole = subject;
  std::array<Read, 2> reads;
  for (std::size_t i = 0; i < 2; ++i) {
    subject = job.files[i] == "-" ? "<stdin>" : std::filesystem::path(job.files[i]).filename().string();
    reads[i] = read_result(job.files[i],
                           part_of(progress, 0.2 * static_cast<double>(i), 0.2 * static_cast<double>(i + 1)));
  }
  CompareResult result;
  result.limit = job.limit;
  result.unit = reads[0].unit.value_or(reads[1].unit.value_or(LengthUnit::millimetre));
  pair_by_name(reads[0], reads[1]);
  convert(reads[1], result.unit, result.notes);
  std::vector<ResultBody> bodies;
  for (std::size_t i = 0; i < 2; ++i) {
    subject = job.files[i] == "-" ? "<stdin>" : std::filesystem::path(job.files[i]).filename().string();
    bodies.emplace_back(reads[i].pieces);
    result.results[i] = described(reads[i], bodies[i]);
  }
  subject = whole;
  const DeviationOptions options{.limit = job.limit};
  result.ways[0] = deviation(bodies[0], bodies[1], options, part_of(progress, 0.4, 0.7));
  result.ways[1] = deviation(bodies[1], bodies[0], options, part_of(progress, 0.7, 1.0));
  if (!job.output.empty()) write_deviation(job, bodies[0], result);
  return result;
}

}  // namespace blendwright
