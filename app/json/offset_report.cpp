// What `offset` made, as JSON.
#include "app/json/mesh_report.hpp"
#include "app/pipeline/offset_job.hpp"

namespace blendwright {
namespace {

using Value = JsonValue;

Value request_json(const OffsetRequest& r) {
  using Kind = OffsetRequest::Kind;
  Value request = Value::object({{"kind", name(r.kind)}});
  if (r.kind == Kind::shell) {
    request.add("inner", r.inner);
    request.add("outer", r.outer);
  } else if (r.kind == Kind::round || r.kind == Kind::fillet) {
    request.add("radius", r.radius);
  } else {
    request.add("distance", r.distance);
  }
  if (r.tolerance) request.add("tolerance", *r.tolerance);
  return request;
}

Value check_json(const OffsetCheck& c) {
  return Value::object({{"of", c.of},
                        {"distance", c.distance},
                        {"worst", c.error.worst},
                        {"rms", c.error.rms},
                        {"where", Value::array({c.error.where[0], c.error.where[1], c.error.where[2]})},
                        {"samples", c.error.samples},
                        {"without_root", c.error.without_root}});
}

}  // namespace

std::string offset_report_json(const OffsetRequest& request, const OffsetResult& result, bool times) {
  Value report = mesh_report(result.scene, result.mesh, times);
  Value offset = request_json(request);
  Value::Array checks;
  for (const OffsetCheck& c : result.checks) checks.push_back(check_json(c));
  offset.add("errors", std::move(checks));
  report.add("offset", std::move(offset));
  return json_text(report);
}

}  // namespace blendwright
