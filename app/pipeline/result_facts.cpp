#include "app/pipeline/result_facts.hpp"

namespace blendwright {
namespace {

Column number(const char* name, double value, const std::string& unit = "") {
  return {name, unit, 1, {value}};
}

Column choice(const std::string& name, double index, std::vector<std::string> labels) {
  return {name, "", 1, {index}, std::move(labels)};
}

std::vector<Column> shape_facts(const OdeBlend& surface) {
  const BlendShape& shape = surface.shape();
  std::vector<Column> facts{
      choice("mode", static_cast<double>(shape.mode),
             {name(BlendMode::origin), name(BlendMode::anchor), name(BlendMode::chord)})};
  if (surface.order() == 6) {
    facts.push_back(number("tension", shape.tension));
  } else if (shape.repeated_root) {
    facts.push_back(number("q", *shape.repeated_root));
  } else {
    Column b{"b", "", 1, {}}, c{"c", "", 1, {}}, d{"d", "", 1, {}};
    for (std::size_t x = 0; x < (shape.isotropic() ? 1u : 3u); ++x) {
      b.values.push_back(shape.ode[x].b);
      c.values.push_back(shape.ode[x].c);
      d.values.push_back(shape.ode[x].d);
    }
    facts.insert(facts.end(), {b, c, d});
  }
  return facts;
}

void append(std::vector<Column>& facts, const SideSpec& side, const std::string& end) {
  Column factor{"factor " + end, "", 2, {}};
  for (const LawPoint& p : side.factor) factor.values.insert(factor.values.end(), {p.t, p.value});
  facts.push_back(choice("continuity " + end, static_cast<double>(side.continuity), {"G0", "G1", "G2"}));
  facts.push_back(std::move(factor));
  facts.push_back({"tangent angle " + end, "deg", 1, {side.tangent_angle.degrees()}});
}

void append(std::vector<Column>& facts, const SeamReport& seam, const std::string& end,
            const std::string& length) {
  facts.push_back({"worst gap " + end, length, 1, {seam.gap.worst}});
  facts.push_back({"worst angle " + end, "deg", 1, {Radians(seam.angle.worst).degrees()}});
  facts.push_back({"worst curvature jump " + end, "1/" + length, 1, {seam.curvature.worst}});
}

/// The numbers of a node's value; none for words and references.
struct NumbersOf {
  Column fact;
  void operator()(double x) { fact.values = {x}; }
  void operator()(const std::vector<double>& list) { fact.values = list; }
  void operator()(const std::vector<std::vector<double>>& rows) {
    if (rows.empty()) return;
    fact.components = static_cast<int>(rows.front().size());
    for (const auto& row : rows) fact.values.insert(fact.values.end(), row.begin(), row.end());
  }
  template <class Other>
  void operator()(const Other&) {}
};

}  // namespace

std::vector<Column> blend_facts(const BlendResult& blend, const JobSpec& job) {
  const std::string length = name(job.unit);
  std::vector<Column> facts = shape_facts(blend.blend.surface);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string end = i == 0 ? "from" : "to";
    if (!blend.entry.literal()) append(facts, blend.entry.sides[i].side, end);
    if (blend.stages.empty() || !blend.stages.back().seams[i].measured) continue;
    append(facts, blend.stages.back().seams[i], end, length);
  }
  facts.push_back(number("tolerance of gap", job.tolerance.position, length));
  facts.push_back(number("tolerance of angle", job.tolerance.angle.degrees(), "deg"));
  facts.push_back(number("tolerance of curvature jump", job.tolerance.curvature, "1/" + length));
  for (Column& fact : facts) fact.name.insert(0, blend.entry.name + ": ");
  return facts;
}

std::string curvature_unit(const std::string& column, LengthUnit unit) {
  const std::string length = name(unit);
  if (column == "mean_curvature") return "1/" + length;
  return column == "gaussian_curvature" ? "1/" + length + "^2" : "";
}

std::vector<Column> scene_facts(const SceneSpec& scene) {
  std::vector<Column> facts;
  for (const NodeSpec& node : scene.nodes)
    for (const auto& [key, value] : node.values) {
      NumbersOf numbers{{node.name + ": " + key, "", 1, {}}};
      std::visit(numbers, value);
      if (!numbers.fact.values.empty()) facts.push_back(std::move(numbers.fact));
    }
  return facts;
}

}  // namespace blendwright
