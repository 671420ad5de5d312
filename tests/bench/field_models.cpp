#include "tests/bench/field_models.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/bench/plain_fields.hpp"

namespace blendwright::bench {
namespace {

using Values = std::map<std::string, NodeValue>;

NodeSpec superquadric(const std::string& name, double ab, double c, double n1, double n2) {
  return {name, "superquadric", Values{{"a", ab}, {"b", ab}, {"c", c}, {"n1", n1}, {"n2", n2}}};
}
NodeSpec soft_object(const std::string& name, const std::string& distance) {
  return {name, "soft_object", Values{{"distance", NodeRef{distance}}}};
}
NodeSpec soft_blend(const std::string& name, std::vector<NodeRef> of) {
  return {name, "soft_blend", Values{{"of", std::move(of)}}};
}

SceneSpec bar_on_plate(std::vector<NodeSpec> bar) {
  SceneSpec scene;
  scene.nodes = std::move(bar);
  scene.nodes.push_back(superquadric("prism", 8, 24, 1, 20));
  scene.nodes.push_back({"plate", "lp_metric", Values{{"a", 30.0}, {"b", 30.0}, {"c", 12.0}, {"n", 20.0}}});
  scene.nodes.push_back(soft_object("soft plate", "plate"));
  scene.nodes.push_back(soft_blend("body", {{"bar"}, {"soft plate"}}));
  scene.solid = "body";
  return scene;
}

SceneSpec blend() { return bar_on_plate({soft_object("bar", "prism")}); }

SceneSpec vir(double n) {
  NodeSpec bar = soft_object("bar", "prism");
  bar.values["w1"] = NodeRef{"contour"};
  return bar_on_plate({superquadric("contour", 8, 24, n, 20), bar});
}

SceneSpec ring() {
  SceneSpec scene;
  scene.nodes = {superquadric("upright", 5, 14, 2, 20)};
  std::vector<NodeRef> cylinders;
  for (int k = 0; k < 6; ++k) {
    const double t = std::numbers::pi / 6.0 + std::numbers::pi / 3.0 * k, apothem = 6.0 * std::numbers::sqrt3;
    const double c = std::cos(t), s = std::sin(t);
    // Local coordinates: across the side in the plane, across it along z, along it.
    const std::string name = "side " + std::to_string(k);
    scene.nodes.push_back({name, "affine",
                           Values{{"of", NodeRef{"upright"}},
                                  {"matrix", std::vector<std::vector<double>>{
                                                 {c, 0, -s}, {s, 0, c}, {0, 1, 0}, {-apothem, 0, 0}}}}});
    scene.nodes.push_back(soft_object("soft " + name, name));
    cylinders.push_back({"soft " + name});
  }
  scene.nodes.push_back(
      {"ring", "scale_union_half", Values{{"of", cylinders}, {"r1", 0.5}, {"r2", 0.5}, {"p", 0.0}}});
  scene.solid = "ring";
  return scene;
}

SceneSpec sixball() {
  const auto ball = [](const char* name, double a, double n) {
    return NodeSpec{name, "lp_metric", Values{{"a", a}, {"b", a}, {"c", a}, {"n", n}}};
  };
  SceneSpec scene;
  scene.nodes = {
      ball("sphere", 30, 2),
      ball("tool", 1, 7),
      {"scaled", "ray_scaling", Values{{"of", NodeRef{"sphere"}}, {"by", NodeRef{"tool"}}, {"n", 3.0}}},
      soft_object("six balls", "scaled")};
  scene.solid = "six balls";
  return scene;
}

SceneSpec soft_sum(const std::vector<Ellipsoid>& ellipsoids) {
  SceneSpec scene;
  std::vector<NodeRef> members;
  for (std::size_t i = 0; i < ellipsoids.size(); ++i) {
    const Ellipsoid& e = ellipsoids[i];
    const std::string name = std::to_string(i);
    std::vector<std::vector<double>> matrix;  // y = x * matrix: columns are the axes
    for (int row = 0; row < 3; ++row) matrix.push_back({e.axes(0, row), e.axes(1, row), e.axes(2, row)});
    const Vec3 t = -(e.axes * e.centre);
    matrix.push_back({t.x(), t.y(), t.z()});
    scene.nodes.push_back({"e" + name, "lp_metric",
                           Values{{"a", e.radii.x()}, {"b", e.radii.y()}, {"c", e.radii.z()}, {"n", 2.0}}});
    scene.nodes.push_back({"p" + name, "affine", Values{{"of", NodeRef{"e" + name}}, {"matrix", matrix}}});
    scene.nodes.push_back(soft_object("s" + name, "p" + name));
    members.push_back({"s" + name});
  }
  scene.nodes.push_back(soft_blend("sum", std::move(members)));
  scene.solid = "sum";
  return scene;
}

}  // namespace

std::vector<Ellipsoid> random_ellipsoids(std::size_t count) {
  std::uint64_t state = count;
  const auto next = [&] {  // splitmix64, top 53 bits
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  };
  const double size = std::cbrt(100.0 / static_cast<double>(count));
  std::vector<Ellipsoid> ellipsoids(count);
  for (Ellipsoid& e : ellipsoids) {
    for (int i = 0; i < 3; ++i) e.centre[i] = -10.0 + 20.0 * next();
    for (int i = 0; i < 3; ++i) e.radii[i] = size * (2.0 + 4.0 * next());
    const double u = next(), v = 2.0 * std::numbers::pi * next(), w = 2.0 * std::numbers::pi * next();
    const double a = std::sqrt(1.0 - u), b = std::sqrt(u);
    e.axes = Eigen::Quaterniond(b * std::cos(w), a * std::sin(v), a * std::cos(v), b * std::sin(w))
                 .toRotationMatrix();
  }
  return ellipsoids;
}

FieldModel field_model(const std::string& name) {
  if (name == "blend") return {name, blend(), plain_blend()};
  if (name == "vir06") return {name, vir(0.6), plain_vir(0.6)};
  if (name == "vir2") return {name, vir(2.0), plain_vir(2.0)};
  if (name == "ring") return {name, ring(), plain_ring()};
  if (name == "sixball") return {name, sixball(), plain_sixball()};
  if (name.starts_with("soft")) {
    const std::vector<Ellipsoid> ellipsoids = random_ellipsoids(std::stoul(name.substr(4)));
    return {name, soft_sum(ellipsoids), plain_soft_sum(ellipsoids)};
  }
  throw std::runtime_error("no model " + name);
}

}  // namespace blendwright::bench
