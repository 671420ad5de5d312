#include "tests/bench/field_models.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/bench/numbers.hpp"
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

/// 1 - |local / radii|^2.
std::array<double, 10> quadric(const Ellipsoid& e) {
  const Eigen::Matrix3d m = e.radii.cwiseInverse().asDiagonal() * e.axes, a = m.transpose() * m;
  const Vec3 b = a * e.centre;
  return {-a(0, 0),       -a(1, 1),    -a(2, 2),    -2.0 * a(0, 1), -2.0 * a(0, 2),
          -2.0 * a(1, 2), 2.0 * b.x(), 2.0 * b.y(), 2.0 * b.z(),    1.0 - e.centre.dot(b)};
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
  Numbers numbers{count};
  const double size = std::cbrt(100.0 / static_cast<double>(count));
  std::vector<Ellipsoid> ellipsoids(count);
  for (Ellipsoid& e : ellipsoids) {
    for (int i = 0; i < 3; ++i) e.centre[i] = -10.0 + 20.0 * numbers.next();
    for (int i = 0; i < 3; ++i) e.radii[i] = size * (2.0 + 4.0 * numbers.next());
    e.axes = numbers.turn();
  }
  return ellipsoids;
}

Freeform random_freeform(std::size_t bumps, double size, std::uint64_t seed) {
  Numbers numbers{seed};
  const Vec3 base = size * Vec3(10.0, 9.0, 8.0);
  Freeform freeform{quadric({Vec3::Zero(), base, Eigen::Matrix3d::Identity()}), {}};
  for (std::size_t i = 0; i < bumps; ++i) {
    Ellipsoid e;
    e.axes = numbers.turn();
    e.centre = base.cwiseProduct(e.axes.col(0));
    for (int k = 0; k < 3; ++k) e.radii[k] = size * (2.0 + 3.0 * numbers.next());
    const double weight = 0.2 + 0.6 * numbers.next();
    freeform.bumps.push_back({quadric(e), i % 3 == 2 ? -weight : weight});
  }
  return freeform;
}

std::vector<NodeSpec> freeform_nodes(const Freeform& freeform, const std::string& name) {
  const auto node = [](const std::string& of, const std::array<double, 10>& q) {
    return NodeSpec{of, "quadric", Values{{"coefficients", std::vector<double>(q.begin(), q.end())}}};
  };
  std::vector<NodeSpec> nodes{node(name + " base", freeform.base)};
  std::vector<NodeRef> bumps;
  for (const Freeform::Bump& b : freeform.bumps) {
    const std::string id = name + " " + std::to_string(bumps.size());
    nodes.push_back(node(id + " q", b.q));
    nodes.push_back(
        {id, "perturbation", Values{{"of", NodeRef{id + " q"}}, {"weight", b.weight}, {"power", 3.0}}});
    bumps.push_back({id});
  }
  nodes.push_back({name, "freeform", Values{{"base", NodeRef{name + " base"}}, {"bumps", std::move(bumps)}}});
  return nodes;
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
  if (name.starts_with("bumps")) {
    const Freeform freeform = random_freeform(std::stoul(name.substr(5)), 1.0, 20);
    SceneSpec scene;
    scene.nodes = freeform_nodes(freeform, "body");
    scene.solid = "body";
    return {name, scene, plain_freeform(freeform)};
  }
  throw std::runtime_error("no model " + name);
}

}  // namespace blendwright::bench
