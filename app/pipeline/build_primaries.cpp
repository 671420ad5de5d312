#include "app/pipeline/build_primaries.hpp"

#include "app/pipeline/curve_of_formulas.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using Parts = std::map<std::filesystem::path, StepPart>;

const StepPart& part_of(const StepFaceSpec& spec, const JobSpec& job, Parts& parts) {
  const auto path = spec.file.is_absolute() ? spec.file : job.folder / spec.file;
  const auto known = parts.find(path);
  if (known != parts.end()) return known->second;
  return parts.emplace(path, StepPart::read(path, job.unit)).first->second;
}

BuiltPrimary build(const PrimaryEntry& entry, const JobSpec& job, Parts& parts) {
  if (const auto* formula = std::get_if<PrimarySpec>(&entry.spec))
    return {entry.name, make_primary(*formula), std::nullopt, 0, {}};
  const auto& face = std::get<StepFaceSpec>(entry.spec);
  const StepPart& part = part_of(face, job, parts);
  const std::size_t index = part.select(face.select);
  return {entry.name, placed(part.surface(index), face.placement), part, index, face.placement};
}

BuiltTrimline from_edges(const TrimlineSpec& spec, const BuiltPrimary& primary) {
  if (!primary.part)
    throw InputError("kind",
                     "takes an edge of a STEP face, but primary \"" + primary.name +
                         "\" is not of kind step_face; use an isoline, parameters or projected trimline");
  const std::size_t edge = primary.part->select(spec.edge, primary.face);
  const EdgeTrimline e =
      primary.part->trimline(primary.face, edge, spec.kind == TrimlineSpec::Kind::edge_chain);
  return {Trimline(placed(e.surface, primary.placement), e.pcurve, primary.part->tolerance()),
          e.kept_left ? SideSpec::Keep::left : SideSpec::Keep::right, e.edge_deviation};
}

BuiltTrimline unshifted(const TrimlineSpec& spec, const BuiltPrimary& primary,
                        const std::map<std::string, double>& constants) {
  using Kind = TrimlineSpec::Kind;
  switch (spec.kind) {
    case Kind::isoline:
      return {isoline(primary.surface, spec.direction, spec.value, spec.range), std::nullopt, 0.0};
    case Kind::parameters:
      return {Trimline(primary.surface, make_curve<2>(spec.curve, constants)), std::nullopt, 0.0};
    case Kind::projected:
      return {projected(primary.surface, make_curve<3>(spec.curve, constants), spec.along), std::nullopt,
              0.0};
    case Kind::edge:
    case Kind::edge_chain:
      return from_edges(spec, primary);
  }
  throw InputError("kind", "is not a trimline kind");
}

}  // namespace

std::vector<BuiltPrimary> build_primaries(const JobSpec& job) {
  Parts parts;
  std::vector<BuiltPrimary> built;
  std::vector<Problem> problems;
  for (const PrimaryEntry& entry : job.primaries) {
    const std::string pointer = "/primaries/" + entry.name;
    try {
      built.push_back(build(entry, job, parts));
    } catch (const InputError& e) {
      const InputError placed_error = e.under(pointer);
      problems.insert(problems.end(), placed_error.problems().begin(), placed_error.problems().end());
    } catch (const IoError& e) {
      throw IoError(pointer + "/file: " + e.what());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return built;
}

BuiltTrimline build_trimline(const TrimlineSpec& spec, const BuiltPrimary& primary,
                             const std::map<std::string, double>& constants, const std::string& pointer) try {
  BuiltTrimline built = unshifted(spec, primary, constants);
  built.line = shifted(built.line, spec.shift, primary.part ? primary.part->tolerance() : 0.0);
  return built;
} catch (const InputError& e) {
  throw e.under(pointer);
} catch (const GeometryError& e) {
  throw GeometryError(pointer + ": " + e.what());
}

}  // namespace blendwright
