#include "tests/implicit/primitives/made_primitive.hpp"

#include <algorithm>
#include <stdexcept>

#include "implicit/scene/node_values.hpp"
#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/soft_golden.hpp"

namespace blendwright::test {
namespace {

const NodeSpec& find_node(const SceneSpec& scene, const std::string& name) {
  for (const NodeSpec& node : scene.nodes)
    if (node.name == name) return node;
  throw std::runtime_error("no node " + name);
}

MadePrimitive make(const SceneSpec& scene, const std::string& name) {
  const NodeSpec& spec = find_node(scene, name);
  const NodeKind* kind = find_node_kind(spec.kind);
  if (kind == nullptr) throw std::runtime_error("no kind " + spec.kind);
  MadePrimitive made;
  detail::ValueCheck check = detail::check_values(spec, *kind);
  made.problems = std::move(check.problems);
  if (!made.problems.empty()) return made;
  std::vector<detail::CheckedInputs::Link> links;
  for (const detail::NodeLink& link : check.links)
    links.push_back({link.key, std::make_shared<const Node>(make(scene, link.name).node)});
  detail::CheckedInputs inputs(spec, *kind, std::move(links), scene.strict);
  made.node = kind->make(inputs);
  made.problems = inputs.problems();
  made.warnings = inputs.warnings();
  if (!made.problems.empty() || !made.node.emit) return made;
  TapeBuilder builder;
  made.tape = builder.finish(made.node.emit(builder, Frame()));
  return made;
}

/// Where the golden points of a primitive are: all of them lie within twice its d = 1 or so.
Box around(const std::vector<SoftPoint>& points) {
  double reach = 1.0;
  for (const SoftPoint& p : points)
    for (const double x : p.at) reach = std::max(reach, std::abs(x));
  return {Vec3::Constant(-reach), Vec3::Constant(reach)};
}

/// Unit normals spread over the sphere (a Fibonacci lattice), more than any fixed-size loop would expect.
std::vector<std::vector<double>> forty_normals() {
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < 40; ++i) {
    const double z = (i + 0.5) / 40.0, angle = 2.399963229728653 * i, r = std::sqrt(1.0 - z * z);
    const Vec3 n = Vec3(r * std::cos(angle), r * std::sin(angle), z).normalized();
    rows.push_back({n.x(), n.y(), n.z()});
  }
  return rows;
}

/// What the golden data lack: rows without a case, exponents at and below 1, more or fewer normals than
/// dimensions, capsules that are balls or have one end in the origin.
std::vector<PrimitiveSample> further_samples() {
  using List = std::vector<double>;
  using Rows = std::vector<std::vector<double>>;
  const Box ten{Vec3::Constant(-10.0), Vec3::Constant(10.0)},
      three{Vec3::Constant(-3.0), Vec3::Constant(3.0)};
  const auto one = [](const char* id, const char* kind, const Box& box, Values values) {
    return PrimitiveSample{id, scene_of({part("case", kind, std::move(values))}), box};
  };
  const List tilted{2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0};
  const Rows axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return {
      one("half-space", "half_space", ten, {{"normal", tilted}, {"a", 2.5}}),
      one("half-space-axis", "half_space", ten, {{"normal", List{0, -1, 0}}, {"a", 1e3}}),
      one("slab-tilted", "slab", ten, {{"normal", tilted}, {"a", 0.01}}),
      one("lp-octahedron", "lp_metric", ten, {{"a", 3.0}, {"b", 5.0}, {"c", 7.0}, {"n", 1.0}}),
      one("lp-steep", "lp_metric", three, {{"a", 1.0}, {"b", 2.0}, {"c", 1.5}, {"n", 100.0}}),
      one("lp-cusps", "lp_metric", three, {{"a", 1.0}, {"b", 2.0}, {"c", 1.5}, {"n", 0.05}}),
      one("superquadric-cone", "superquadric", ten,
          {{"a", 4.0}, {"b", 6.0}, {"c", 7.0}, {"n1", 2.0}, {"n2", 1.0}}),
      one("superquadric-cusps", "superquadric", ten,
          {{"a", 4.0}, {"b", 6.0}, {"c", 7.0}, {"n1", 1.0}, {"n2", 0.5}}),
      one("asymmetric-n1.3", "asymmetric_superellipsoid", ten,
          {{"x", List{5, 3}}, {"y", List{2, 8}}, {"z", List{6, 6}}, {"n", 1.3}}),
      one("asymmetric-n0.7", "asymmetric_superellipsoid", ten,
          {{"x", List{5, 3}}, {"y", List{2, 8}}, {"z", List{6, 6}}, {"n", 0.7}}),
      one("gdf-octahedron", "generalized_distance", three, {{"normals", axes}, {"n", 1.0}}),
      one("gdf-n1.5", "generalized_distance", three, {{"normals", forty_normals()}, {"n", 1.5}}),
      one("gdf-forty", "generalized_distance", three, {{"normals", forty_normals()}, {"n", 64.0}}),
      one("gdf-slab", "generalized_distance", three, {{"normals", Rows{tilted}}, {"n", 3.0}}),
      one("gdf-bar", "generalized_distance", three, {{"normals", Rows{{1, 0, 0}, tilted}}, {"n", 3.0}}),
      one("segment-far", "segment_skeleton", {Vec3::Constant(90.0), Vec3::Constant(110.0)},
          {{"p0", List{100, 98, 101}}, {"p1", List{103, 98, 97}}, {"radius", 2.0}}),
      one("capsule-ball", "capsule_gauge", three, {{"below", 0.0}, {"above", 0.0}, {"radius", 2.0}}),
      one("capsule-one-end", "capsule_gauge", ten, {{"below", 0.0}, {"above", 9.0}, {"radius", 1.0}}),
  };
}

/// One sweep along a helix; the other sweeps have golden cases.
PrimitiveSample helix() {
  SceneSpec scene = scene_of({part("round", "lp_profile", {{"a", 1.5}, {"b", 1.0}, {"n", 2.0}}),
                              part("case", "sweep_curve",
                                   {{"curve", std::vector<std::string>{"4*cos(t)", "4*sin(t)", "t"}},
                                    {"t", std::vector<double>{0.0, 3.0}},
                                    {"profile", ref("round")},
                                    {"scale", std::vector<double>{1.0, 0.7}},
                                    {"twist_deg", 20.0},
                                    {"cap", 1.0},
                                    {"m", 2.0}})});
  return {"helix", std::move(scene), {Vec3(-7, -4, -3), Vec3(7, 7, 6)}};
}

std::vector<PrimitiveSample> all_samples() {
  std::vector<PrimitiveSample> all;
  for (const SoftCase& c : read_soft_golden(golden_folder())) {
    const NodeKind* kind = c.kind == "distance" ? find_node_kind(c.function) : nullptr;
    if (kind != nullptr && kind->family == NodeFamily::distance)
      all.push_back({c.id, c.scene, around(c.points)});
  }
  for (PrimitiveSample& s : further_samples()) all.push_back(std::move(s));
  if (find_node_kind("sweep_curve") != nullptr) all.push_back(helix());
  return all;
}

}  // namespace

MadePrimitive make_primitive(const SceneSpec& scene) { return make(scene, scene.solid); }

const std::vector<PrimitiveSample>& primitive_samples() {
  static const std::vector<PrimitiveSample> all = all_samples();
  return all;
}

const NodeSpec& solid_of(const SceneSpec& scene) { return find_node(scene, scene.solid); }

std::vector<double> values_at(const Tape& tape, const std::vector<Vec3>& points) {
  std::vector<double> x, y, z, out(points.size());
  for (const Vec3& p : points) {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
  }
  tape.evaluate(Order::value, {x, y, z}, out);
  return out;
}

double value_at(const Tape& tape, const Vec3& point) { return values_at(tape, {point})[0]; }

Vec3 gradient_at(const Tape& tape, const Vec3& p) {
  const double x[] = {p.x()}, y[] = {p.y()}, z[] = {p.z()};
  double out[4];
  tape.evaluate(Order::gradient, {x, y, z}, out);
  return {out[1], out[2], out[3]};
}

}  // namespace blendwright::test
