#include "app/json/mesh_report.hpp"

namespace blendwright {
namespace {

using Value = JsonValue;

Value point(const Vec3& p) { return Value::array({p[0], p[1], p[2]}); }

Value problems_json(const std::vector<Problem>& problems) {
  Value::Array all;
  for (const Problem& p : problems)
    all.push_back(Value::object({{"where", p.where}, {"message", p.message}}));
  return all;
}

Value figures_json(const MeshFacts& f) {
  return Value::object({{"cells", Value::array({f.cells[0], f.cells[1], f.cells[2]})},
                        {"live_blocks", f.live_blocks},
                        {"evaluated_points", f.evaluated_points},
                        {"vertices", f.vertices},
                        {"triangles", f.triangles},
                        {"area", f.area},
                        {"volume", f.volume},
                        {"euler_characteristic", static_cast<double>(f.euler_characteristic)},
                        {"components", f.components},
                        {"largest_distance", f.largest_distance},
                        {"mean_distance", f.mean_distance},
                        {"without_normal", f.without_normal},
                        {"cut_by_box", f.cut_by_box}});
}

}  // namespace

JsonValue mesh_report(const SceneFile& scene, const MeshResult& result, bool times) {
  Value report = Value::object({{"program", "blendwright " BLENDWRIGHT_VERSION},
                                {"scene", scene.name},
                                {"source_hash", scene.source_hash},
                                {"solid", scene.spec.solid},
                                {"unit", name(scene.spec.unit)},
                                {"level", name(scene.scene.field.level())},
                                {"nodes", scene.scene.nodes},
                                {"steps", scene.scene.steps},
                                {"cell", result.options.cell}});
  if (const auto& box = result.options.box)
    report.add("box", Value::object({{"lo", point(box->lo)}, {"hi", point(box->hi)}}));
  const Value figures = figures_json(result.made.facts);
  for (const JsonMember& m : *figures.members()) report.add(m.key, m.value);
  report.add("warnings", problems_json(scene.scene.warnings));
  Value::Array files;
  for (const WrittenFile& f : result.files)
    files.push_back(Value::object({{"path", f.path.string()}, {"kind", f.kind}, {"bytes", f.bytes}}));
  report.add("files", std::move(files));
  if (times) {
    Value seconds{Value::Object()};
    for (const StageTime& t : result.times) seconds.add(t.stage, t.seconds);
    report.add("times", std::move(seconds));
  }
  return report;
}

std::string mesh_report_json(const SceneFile& scene, const MeshResult& result, bool times) {
  return json_text(mesh_report(scene, result, times));
}

}  // namespace blendwright
