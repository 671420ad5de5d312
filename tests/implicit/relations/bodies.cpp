#include "tests/implicit/relations/bodies.hpp"

#include <Eigen/Geometry>
#include <numbers>

#include "tests/implicit/moving/motions.hpp"

namespace blendwright::test {
namespace {

using List = std::vector<double>;

NodeSpec half_space(const std::string& id, int axis, double sign, double half) {
  List a(10, 0.0);
  a[static_cast<std::size_t>(6 + axis)] = -sign;
  a[9] = half;
  return part(id, "quadric", {{"coefficients", a}});
}

Vec3 ellipsoid_support(const Vec3& s, const Vec3& u) {
  const Vec3 su = s.cwiseProduct(u);
  return s.cwiseProduct(su) / su.norm();
}

Vec3 box_support(const Vec3& half, const Vec3& u) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = std::copysign(half[i], u[i]);
  return p;
}

/// 1 - sum ((x_i - c_i)/s_i)^2.
std::vector<double> quadric(const Vec3& c, const Vec3& s) {
  const Vec3 a = s.cwiseProduct(s).cwiseInverse(), b = 2.0 * a.cwiseProduct(c);
  return {-a[0], -a[1], -a[2], 0.0, 0.0, 0.0, b[0], b[1], b[2], 1.0 - a.dot(c.cwiseProduct(c))};
}

struct Bump {
  std::vector<double> q;
  double weight;
  int power;
};

/// The freeform on the x axis, from the coefficients that the field has.
double on_axis(const std::vector<double>& base, const std::vector<Bump>& bumps, long double x) {
  const auto at = [&](const std::vector<double>& q) { return (q[0] * x + q[6]) * x + q[9]; };
  long double f = at(base);
  for (const Bump& b : bumps)
    if (const long double q = at(b.q); q > 0.0L)
      f += b.weight * std::pow(q, static_cast<long double>(b.power));
  return static_cast<double>(f);
}

Body sized(std::vector<NodeSpec> nodes, std::function<Vec3(const Vec3&)> support, double reach) {
  return {std::move(nodes), std::move(support), reach};
}

}  // namespace

Body ball_body(double radius) { return ellipsoid_body(Vec3::Constant(radius)); }

Body ellipsoid_body(const Vec3& s) {
  return sized(
      {part("body", "ellipsoid_quadric", {{"a", s[0]}, {"b", s[1]}, {"c", s[2]}})},
      [s](const Vec3& u) { return ellipsoid_support(s, u); }, s.maxCoeff());
}

Body exact_ellipsoid_body(const Vec3& s) {
  return sized(
      {part("body", "ellipsoid", {{"a", s[0]}, {"b", s[1]}, {"c", s[2]}})},
      [s](const Vec3& u) { return ellipsoid_support(s, u); }, s.maxCoeff());
}

Body torus_body(double ring, double tube) {
  return sized(
      {part("body", "torus", {{"ring", ring}, {"tube", tube}})},
      [=](const Vec3& u) {
        const double across = std::hypot(u.x(), u.y());
        return Vec3(ring / across * u.x() + tube * u.x(), ring / across * u.y() + tube * u.y(), tube * u.z());
      },
      ring + tube);
}

Body box_body(const Vec3& half) {
  return sized(
      {part("body", "box", {{"half", List{half[0], half[1], half[2]}}})},
      [half](const Vec3& u) { return box_support(half, u); }, half.norm());
}

Body planes_body(const Vec3& half) {
  std::vector<NodeSpec> nodes;
  std::vector<std::string> names;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      names.push_back("side " + std::to_string(names.size()));
      nodes.push_back(half_space(names.back(), axis, sign, half[axis]));
    }
  }
  nodes.push_back(part("body", "min", {{"of", refs(names)}}));
  return sized(
      std::move(nodes), [half](const Vec3& u) { return box_support(half, u); }, half.norm());
}

Body freeform_body(Rng& rng) {
  const Vec3 s(uniform(rng, 0.7, 1.5), uniform(rng, 0.5, 1.5), uniform(rng, 0.5, 1.5));
  const std::vector<double> base = quadric(Vec3::Zero(), s);
  std::vector<Bump> bumps;
  const int ends = integer(rng, 1, 3), sides = integer(rng, 0, 4);
  double farthest = s[0];
  for (int i = 0; i < ends; ++i) {
    const Vec3 size(uniform(rng, 0.3, 0.7), uniform(rng, 0.25, 0.7), uniform(rng, 0.25, 0.7));
    const double at = uniform(rng, 0.7, 1.1) * s[0];
    bumps.push_back({quadric({at, 0.0, 0.0}, size), uniform(rng, 0.2, 1.0), integer(rng, 2, 3)});
    farthest = std::max(farthest, at + size[0]);
  }
  for (int i = 0; i < sides; ++i) {  // within x < 0.5 s_x, where nothing reaches the end
    const Vec3 size(uniform(rng, 0.2, 0.5), uniform(rng, 0.2, 0.5), uniform(rng, 0.2, 0.5));
    const double angle = uniform(rng, 0.0, 2.0 * std::numbers::pi);
    const Vec3 c(0.5 * s[0] - size[0] - uniform(rng, 0.0, 0.5), s[1] * std::cos(angle),
                 s[2] * std::sin(angle));
    bumps.push_back(
        {quadric(c, size), (i % 2 == 0 ? 1.0 : -1.0) * uniform(rng, 0.2, 0.8), integer(rng, 2, 3)});
  }
  // Going inward from outside everything, the first place that is not outside: on the axis all bumps there
  // are > 0 towards their centres, and the field falls with |y| and |z|.
  double lo = 0.0, hi = farthest + 0.1;
  const int steps = 4000;
  for (int i = 1; i <= steps; ++i) {
    const double x = hi * (steps - i) / steps;
    if (on_axis(base, bumps, x) < 0.0) continue;
    lo = x;
    hi = hi * (steps - i + 1) / steps;
    break;
  }
  while (0.5 * (lo + hi) > lo && 0.5 * (lo + hi) < hi)
    (on_axis(base, bumps, 0.5 * (lo + hi)) < 0.0 ? hi : lo) = 0.5 * (lo + hi);

  Body body;
  body.nodes.push_back(part("base", "quadric", {{"coefficients", base}}));
  std::vector<std::string> names;
  for (const Bump& b : bumps) {
    names.push_back("bump " + std::to_string(names.size()));
    body.nodes.push_back(part(names.back() + " q", "quadric", {{"coefficients", b.q}}));
    body.nodes.push_back(part(
        names.back(), "perturbation",
        {{"of", ref(names.back() + " q")}, {"weight", b.weight}, {"power", static_cast<double>(b.power)}}));
  }
  body.nodes.push_back(part("body", "freeform", {{"base", ref("base")}, {"bumps", refs(names)}}));
  body.support = [lo](const Vec3&) { return Vec3(lo, 0.0, 0.0); };
  body.reach = 4.0;
  return body;
}

ScalarField field_of(const Body& body, const RigidMotion& at) {
  SceneSpec scene = scene_of(body.nodes);
  const Eigen::AngleAxisd turn(at.R);
  const Vec3 axis = turn.axis();
  scene.nodes.push_back(part("placed", "place",
                             {{"of", ref(scene.solid)},
                              {"move", List{at.t[0], at.t[1], at.t[2]}},
                              {"axis", List{axis[0], axis[1], axis[2]}},
                              {"turn_deg", turn.angle() * 180.0 / std::numbers::pi}}));
  scene.solid = "placed";
  return build_scene(scene).field;
}

const char* name(Family family) {
  constexpr const char* names[] = {"spheres",     "ellipsoids",      "exact ellipsoids", "tori",
                                   "exact boxes", "boxes of planes", "freeforms"};
  return names[static_cast<std::size_t>(family)];
}

namespace {

Body random_body(Rng& rng, Family family) {
  const auto length = [&] { return log_uniform(rng, 0.3, 3.0); };
  const auto lengths = [&] {
    const double x = length(), y = length();
    return Vec3(x, y, length());
  };
  switch (family) {
    case Family::spheres:
      return ball_body(length());
    case Family::ellipsoids:
      return ellipsoid_body(lengths());
    case Family::exact_ellipsoids:
      return exact_ellipsoid_body(lengths());
    case Family::tori: {
      const double ring = length();
      return torus_body(ring, ring * uniform(rng, 0.15, 0.8));
    }
    case Family::boxes:
      return box_body(lengths());
    case Family::planes:
      return planes_body(lengths());
    case Family::freeforms:
      break;
  }
  return freeform_body(rng);
}

/// A turn that takes x to u.
Eigen::Matrix3d taking_x_to(const Vec3& u, double about) {
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), u).toRotationMatrix() *
         Eigen::AngleAxisd(about, Vec3::UnitX()).toRotationMatrix();
}

/// The body turned so that its support along u is known, and moved so that this is at `end`.
RigidMotion placement(Rng& rng, const Body& body, Family family, const Vec3& u, const Vec3& end) {
  const double about = uniform(rng, 0.0, 2.0 * std::numbers::pi);
  const Eigen::Matrix3d turn = family == Family::freeforms ? taking_x_to(u, about) : random_turn(rng);
  return {turn, end - turn * body.support(turn.transpose() * u)};
}

}  // namespace

PlantedPair planted_pair(Rng& rng, Family family, double gap) {
  const Body a = random_body(rng, family), b = random_body(rng, family);
  const Vec3 u = random_turn(rng).col(0), middle = random_vector(rng, 2.0);
  const RigidMotion at_a = placement(rng, a, family, u, middle - 0.5 * gap * u);
  const RigidMotion at_b = placement(rng, b, family, -u, middle + 0.5 * gap * u);
  const Vec3 reach = Vec3::Constant(1.001 * a.reach);
  return {field_of(a, at_a), field_of(b, at_b), {at_a.t - reach, at_a.t + reach}, middle, u};
}

}  // namespace blendwright::test
