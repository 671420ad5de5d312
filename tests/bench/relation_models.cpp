#include "tests/bench/relation_models.hpp"

namespace blendwright::bench {
namespace {

using Values = std::map<std::string, NodeValue>;

ScalarField field_of(NodeSpec node) {
  SceneSpec scene;
  scene.solid = node.name;
  scene.nodes.push_back(std::move(node));
  return build_scene(scene).field;
}

}  // namespace

ScalarField Convex::field() const {
  if (shape == Shape::box)
    return field_of({"box", "box", Values{{"half", std::vector<double>{size.x(), size.y(), size.z()}}}});
  return field_of(
      {"ellipsoid", "ellipsoid_quadric", Values{{"a", size.x()}, {"b", size.y()}, {"c", size.z()}}});
}

Vec3 Convex::support(const Vec3& direction) const {
  const Vec3 n = at.R.transpose() * direction;
  if (shape == Shape::box)
    return at(
        Vec3(std::copysign(size.x(), n.x()), std::copysign(size.y(), n.y()), std::copysign(size.z(), n.z())));
  const Vec3 scaled = size.cwiseProduct(n);
  return at(size.cwiseProduct(scaled) / scaled.norm());
}

Pair planted_pair(Numbers& numbers, Shape shape, double gap) {
  Pair pair;
  for (Convex* body : {&pair.first, &pair.second}) {
    body->shape = shape;
    for (int i = 0; i < 3; ++i) body->size[i] = numbers.uniform(0.5, 1.5);
    if (shape == Shape::sphere) body->size = Vec3::Constant(body->size.x());
    body->at = {numbers.turn(), numbers.vector(3.0)};
  }
  const Vec3 n = numbers.direction();
  pair.second.at.t += pair.first.support(n) + gap * n - pair.second.support(-n);
  return pair;
}

ScalarField freeform(std::size_t bumps, std::uint64_t seed) {
  SceneSpec scene;
  scene.nodes = freeform_nodes(random_freeform(bumps, 0.1, seed), "body");
  scene.solid = "body";
  return build_scene(scene).field;
}

Crowd::Crowd(std::size_t count, double half_box, std::uint64_t seed) : half_box_(half_box) {
  Numbers numbers{seed};
  for (std::size_t i = 0; i < count; ++i) {
    placements_.push_back({numbers.turn(), numbers.vector(half_box)});
    velocity_.push_back(numbers.vector(2.0));
    spin_.push_back(numbers.vector(2.0));
  }
}

void Crowd::step(double length) {
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    RigidMotion& m = placements_[i];
    m.t += length * velocity_[i];
    for (int k = 0; k < 3; ++k)
      if (std::abs(m.t[k]) > half_box_) velocity_[i][k] = -std::copysign(velocity_[i][k], m.t[k]);
    const double angle = length * spin_[i].norm();
    const Eigen::Quaterniond q(m.R);
    m.R = (Eigen::AngleAxisd(angle, spin_[i].normalized()) * q).normalized().toRotationMatrix();
  }
}

}  // namespace blendwright::bench
