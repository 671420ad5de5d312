#include "app/view/window/view_state_json.hpp"

#include "app/json/json_value.hpp"

namespace blendwright {
namespace {

JsonValue triple(const Vec3& p) { return JsonValue::array({p.x(), p.y(), p.z()}); }

JsonValue control_json(const SessionControl& c) {
  if (c.kind == SessionControl::Kind::choice) return c.choices.at(static_cast<std::size_t>(c.value));
  return c.value;
}

JsonValue picked_json(const PickedPoint& p) {
  JsonValue json = JsonValue::object({{"object", p.object}, {"point", triple(p.point)}});
  if (p.uv) json.add("uv", JsonValue::array({p.uv->u, p.uv->v}));
  json.add("normal", triple(p.normal));
  const auto figure = [&](const char* key, const std::optional<double>& x) {
    if (x) json.add(key, *x);
  };
  figure("mean_curvature", p.mean_curvature);
  figure("gaussian_curvature", p.gaussian_curvature);
  figure("least_radius", p.least_radius);
  figure("gap", p.gap);
  figure("angle_deg", p.angle_deg);
  figure("curvature_jump", p.curvature_jump);
  return json;
}

/// On one line: line breaks and the blanks after them stand between values only, texts have none.
std::string one_line(const std::string& text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\n') {
      line += text[i];
      continue;
    }
    while (i + 1 < text.size() && text[i + 1] == ' ') ++i;
    if (!line.empty() && line.back() == ',') line += ' ';
  }
  return line;
}

}  // namespace

std::string view_state_line(const Controller& controller, const std::string& after,
                            const WindowTimes* times) {
  const ViewState& state = controller.state();
  JsonValue json = JsonValue::object({{"after", after},
                                      {"title", controller.window_title()},
                                      {"file", controller.document().file().filename().string()},
                                      {"changed", controller.document().changed()},
                                      {"width", state.width},
                                      {"height", state.height},
                                      {"colours", row_of(state.show).name},
                                      {"message", state.message},
                                      {"warning", state.warning}});
  JsonValue controls{JsonValue::Object{}};
  for (const SessionControl& c : controller.controls()) controls.add(c.name, control_json(c));
  json.add("controls", std::move(controls));
  JsonValue::Array handles;
  for (const SessionHandle& h : controller.handles())
    if (h.blend == state.group) handles.push_back(triple(h.position));
  json.add("handles", std::move(handles));
  if (const auto worst = controller.document().errors()) {
    json.add("worst_gap", worst->gap);
    json.add("worst_angle_deg", worst->angle_deg);
    json.add("worst_curvature_jump", worst->curvature_jump);
  }
  if (state.picked) json.add("picked", picked_json(*state.picked));
  if (times)
    json.add("times", JsonValue::object({{"reshapes", times->reshapes},
                                         {"reshape_ms", 1e3 * times->reshape_seconds},
                                         {"draws", times->draws},
                                         {"draw_ms", 1e3 * times->draw_seconds}}));
  return one_line(json_text(json));
}

}  // namespace blendwright
