#include "app/pipeline/offset_job.hpp"

#include <algorithm>

#include "app/json/json_value.hpp"
#include "app/pipeline/progress_part.hpp"
#include "implicit/relations/set_relation.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using Kind = OffsetRequest::Kind;

constexpr double measuring_cells = 96.0;              // along the longest side of the original
constexpr std::size_t most_checked = 2000;            // points of the original surface
constexpr std::size_t most_boxes_for_proof = 20'000;  // that nothing is left
constexpr double proving = 0.1, meshed = 0.85;        // of the progress

/// Row of node_kinds(), its values, and the flag that each of its keys comes from.
struct OffsetNode {
  std::string kind;
  std::map<std::string, NodeValue> values;
  std::map<std::string, std::string> flags;
};

OffsetNode node_of(const OffsetRequest& r) {
  const auto node = [&](const char* kind, std::map<std::string, NodeValue> values, const char* flag) {
    OffsetNode made{kind, std::move(values), {{"tolerance", "--tolerance"}}};
    for (const auto& [key, value] : made.values) made.flags[key] = flag;
    if (r.tolerance) made.values["tolerance"] = *r.tolerance;
    return made;
  };
  switch (r.kind) {
    case Kind::ball:
      return node("ball_offset", {{"distance", r.distance}}, "--distance");
    case Kind::normal:
      return node("normal_offset", {{"distance", r.distance}}, "--distance");
    case Kind::iso:
      return node("iso_offset", {{"value", r.distance}}, "--distance");
    case Kind::shell:
      return node("shell", {{"inner", r.inner}, {"outer", r.outer}}, "--shell");
    case Kind::round:
      return node("opening", {{"radius", r.radius}}, "--round");
    case Kind::fillet:
      return node("closing", {{"radius", r.radius}}, "--fillet");
  }
  return {};
}

/// Problems of the node that was added, named as the program's flags; `where` is its pointer.
std::vector<Problem> with_flags(std::vector<Problem> problems, const std::string& where,
                                const OffsetNode& node) {
  for (Problem& p : problems) {
    if (p.where.rfind(where + "/", 0) != 0) continue;
    const auto flag = node.flags.find(p.where.substr(where.size() + 1));
    p.where = flag == node.flags.end() ? "--solid" : flag->second;
  }
  return problems;
}

/// In the box where the solid may be; the offset's own bounds are not known when it is empty.
std::optional<Box> domain_of(const SceneFile& original, const SceneFile& offset, const MeshJob& job) {
  if (offset.scene.field.bounds()) return offset.scene.field.bounds();
  if (original.scene.field.bounds()) return original.scene.field.bounds();
  return job.box;
}

/// Whether something may vanish.
bool shrinks(const OffsetRequest& r) { return r.kind == Kind::round || r.distance < 0.0; }

void refuse_empty(const SceneFile& original, const SceneFile& offset, const OffsetRequest& request,
                  const MeshJob& job, const Progress& progress) {
  if (!shrinks(request)) return;  // nothing vanishes by growing
  SearchOptions options;
  options.max_boxes = most_boxes_for_proof;
  options.domain = domain_of(original, offset, job);
  if (!options.domain) return;
  const Proof proof = is_empty(offset.scene.field, options, progress);
  if (proof.answer == Answer::proven)
    throw GeometryError(offset_text(request, original.spec.unit) + " leaves nothing of " +
                        (original.spec.solid.front() == '/' ? "the solid" : in_quotes(original.spec.solid)) +
                        ": proven with " + std::to_string(proof.boxes) +
                        (proof.boxes == 1 ? " box" : " boxes"));
}

/// " of body"; a node in place has no name that people know.
std::string solid_text(const SceneFile& scene) {
  return scene.spec.solid.front() == '/' ? "" : " of " + scene.spec.solid;
}

/// Points of the original's surface: vertices of a mesh of it, at most `most_checked` of them.
std::vector<Vec3> surface_points(const SceneFile& original, const MeshJob& job, const Progress& progress) {
  const std::optional<Box>& around = job.box ? job.box : original.scene.field.bounds();
  if (!around) throw GeometryError("the original has no bounds");
  MeshOptions options;
  options.box = job.box;
  options.cell = around->size().maxCoeff() / measuring_cells;
  options.at_box = MeshOptions::AtBox::open;
  options.columns = false;
  const FieldMesh mesh = polygonize(original.scene.field, options, progress);
  const std::size_t step = (mesh.mesh.points.size() + most_checked - 1) / most_checked;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < mesh.mesh.points.size(); i += std::max<std::size_t>(step, 1))
    points.push_back(mesh.mesh.points[i]);
  return points;
}

OffsetCheck check_of(const SceneFile& original, const std::string& of, double distance,
                     const ScalarField& offset, std::span<const Vec3> points) {
  return {of, distance, offset_error(original.scene.field, offset, distance, points)};
}

std::vector<OffsetCheck> checks_of(const SceneFile& original, const SceneFile& offset,
                                   const OffsetRequest& request, std::span<const Vec3> points) {
  if (request.kind == Kind::round || request.kind == Kind::fillet) return {};
  if (request.kind != Kind::shell) {
    if (request.distance == 0.0) return {};
    return {check_of(original, "offset", request.distance, offset.scene.field, points)};
  }
  std::vector<OffsetCheck> checks;
  for (const auto& [of, distance] :
       {std::pair("inner offset", -request.inner), {"outer offset", request.outer}})
    if (distance != 0.0) {
      const SceneFile side = offset_scene(original, {.kind = Kind::ball, .distance = distance});
      checks.push_back(check_of(original, of, distance, side.scene.field, points));
    }
  return checks;
}

}  // namespace

std::string_view name(Kind kind) {
  switch (kind) {
    case Kind::ball:
      return "ball";
    case Kind::normal:
      return "normal";
    case Kind::iso:
      return "iso";
    case Kind::shell:
      return "shell";
    case Kind::round:
      return "round";
    case Kind::fillet:
      return "fillet";
  }
  return "";
}

std::string offset_text(const OffsetRequest& r, LengthUnit unit) {
  const std::string length = std::string(" ") + name(unit);
  switch (r.kind) {
    case Kind::ball:
      return "the offset by " + number_text(r.distance) + length;
    case Kind::normal:
      return "the offset along the normal by " + number_text(r.distance) + length;
    case Kind::iso:
      return "the offset by the field value " + number_text(r.distance);
    case Kind::shell:
      return "the shell of " + number_text(r.inner) + " inward and " + number_text(r.outer) + length +
             " outward";
    case Kind::round:
      return "the rounding by " + number_text(r.radius) + length;
    case Kind::fillet:
      return "the fillet of " + number_text(r.radius) + length;
  }
  return "";
}

SceneFile offset_scene(const SceneFile& scene, const OffsetRequest& request) {
  OffsetNode node = node_of(request);
  const std::string added = "/" + node.kind;  // people's names do not start with "/"
  node.values["of"] = NodeRef{scene.spec.solid};
  SceneFile result{scene.name, scene.source_hash, scene.spec, scene.scene};
  result.spec.nodes.push_back({added, node.kind, node.values, added});
  result.spec.solid = added;
  try {
    result.scene = build_scene(result.spec);
  } catch (const InputError& e) {
    throw InputError(with_flags(e.problems(), added, node));
  }
  result.scene.warnings = with_flags(std::move(result.scene.warnings), added, node);
  result.spec.solid = offset_text(request, scene.spec.unit) + solid_text(scene);
  return result;
}

OffsetResult run_offset_job(const SceneFile& original, const OffsetRequest& request, const MeshJob& job,
                            const Progress& progress) {
  SceneFile scene = offset_scene(original, request);
  refuse_empty(original, scene, request, job, part_of(progress, 0.0, proving));
  MeshResult mesh = run_mesh_job(scene, job, part_of(progress, proving, meshed));
  OffsetResult result{std::move(scene), std::move(mesh), {}, {}};
  StopWatch watch;
  try {
    const std::vector<Vec3> points = surface_points(original, job, part_of(progress, meshed, 1.0));
    progress.at(1.0, "measuring the offset");
    result.checks = checks_of(original, result.scene, request, points);
  } catch (const GeometryError&) {
    result.notes.emplace_back(
        "the offset is not measured: nothing of the original surface is in the box, or its bounds are not "
        "known");
  }
  result.mesh.times.push_back({"measuring", watch.lap()});
  return result;
}

}  // namespace blendwright
