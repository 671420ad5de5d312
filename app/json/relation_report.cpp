// What `relate` and `collide` found, as JSON.
#include "app/json/json_value.hpp"
#include "app/pipeline/collide_job.hpp"
#include "app/pipeline/relate_job.hpp"

namespace blendwright {
namespace {

using Value = JsonValue;

Value point(const Vec3& p) { return Value::array({p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}); }  // no -0
Value point(const std::optional<Vec3>& p) { return p ? point(*p) : Value(); }
Value box(const std::optional<Box>& b) {
  return b ? Value::object({{"lo", point(b->lo)}, {"hi", point(b->hi)}}) : Value();
}

Value bodies_json(std::span<const Body> bodies) {
  Value::Array all;
  for (const Body& body : bodies) {
    Value::Array warnings;
    for (const Problem& p : body.scene.scene.warnings)
      warnings.push_back(Value::object({{"where", p.where}, {"message", p.message}}));
    all.push_back(Value::object({{"name", body.name},
                                 {"scene", body.scene.name},
                                 {"source_hash", body.scene.source_hash},
                                 {"solid", body.scene.spec.solid},
                                 {"unit", name(body.scene.spec.unit)},
                                 {"warnings", std::move(warnings)}}));
  }
  return all;
}

Value head(std::span<const Body> bodies, const SearchOptions& options) {
  Value report = Value::object({{"program", "blendwright " BLENDWRIGHT_VERSION},
                                {"bodies", bodies_json(bodies)},
                                {"unit", name(bodies.front().scene.spec.unit)},
                                {"tolerance", options.tolerance},
                                {"max_boxes", options.max_boxes}});
  if (options.domain) report.add("domain", box(options.domain));
  return report;
}

Value pair_json(std::span<const Body> bodies, const BodyPair& pair) {
  const Collision& c = pair.collision;
  return Value::object({{"first", bodies[pair.first].name},
                        {"second", bodies[pair.second].name},
                        {"verdict", name(c.contact)},
                        {"point", point(c.point)},
                        {"normal", point(c.normal)},
                        {"gap", c.gap ? Value(*c.gap) : Value()},
                        {"undecided", box(c.undecided)},
                        {"boxes", c.boxes}});
}

}  // namespace

std::string relation_report_json(const SetRelation& relation, std::span<const Body> bodies,
                                 const SearchOptions& options) {
  Value report = head(bodies, options);
  report.add("relation", name(relation.kind));
  Value::Array all;
  for (const RelationStatement& s : statements(relation, bodies))
    all.push_back(Value::object({{"statement", s.text},
                                 {"answer", name(s.proof.answer)},
                                 {"witness", point(s.proof.witness)},
                                 {"undecided", box(s.proof.undecided)},
                                 {"boxes", s.proof.boxes}}));
  report.add("statements", std::move(all));
  return json_text(report);
}

std::string collision_report_json(std::span<const Body> bodies, const CollideJob& job,
                                  const CollideResult& result, bool times) {
  Value report = head(bodies, job.search);
  if (job.projected) report.add("projected", std::string(1, "xyz"[*job.projected]));
  report.add("answer", name(result.answer));
  report.add("contacts", result.contacts);
  report.add("undecided", result.undecided);
  Value::Array steps;
  for (const CollideStep& step : result.steps) {
    Value::Array pairs;
    for (const BodyPair& pair : step.pairs) pairs.push_back(pair_json(bodies, pair));
    Value one{Value::Object()};
    if (job.motion) one.add(job.motion->at_name, step.at);
    one.add("pairs", std::move(pairs));
    steps.push_back(std::move(one));
  }
  report.add("steps", std::move(steps));
  Value::Array files;
  for (const WrittenFile& f : result.files)
    files.push_back(Value::object({{"path", f.path.string()}, {"kind", f.kind}, {"bytes", f.bytes}}));
  report.add("files", std::move(files));
  if (times) {
    Value seconds{Value::Object()};
    for (const StageTime& t : result.times) seconds.add(t.stage, t.seconds);
    report.add("times", std::move(seconds));
  }
  return json_text(report);
}

}  // namespace blendwright
