#pragma once
// Random scenes of all kinds of nodes, from a seed. Sizes are such that most of the surface lies in the box
// [-2, 2]^3. Scenes are not strict: contours may lie inside objects, erosions may cut through.
#include <algorithm>
#include <functional>

#include "implicit/scene/node.hpp"
#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

class RandomScene {
 public:
  explicit RandomScene(Rng& rng) : rng_(rng) { scene_.strict = false; }

  /// `depth`: how many operations may be put into each other.
  SceneSpec make(Level level, int depth) {
    scene_.solid = field(level, depth);
    return std::move(scene_);
  }
  SceneSpec make(int depth) {
    return make(pick<Level>({Level::half, Level::half, Level::one, Level::zero, Level::function}), depth);
  }

  /// Whether of_kind() makes scenes of this family: soft objects and what they are made of and combined by.
  static bool makes(NodeFamily family) {
    return family == NodeFamily::distance || family == NodeFamily::distance_operation ||
           family == NodeFamily::field || family == NodeFamily::operation ||
           family == NodeFamily::conversion || family == NodeFamily::placement;
  }
  /// A scene whose solid is of this kind, with random nodes below.
  SceneSpec of_kind(const NodeKind& kind, int depth = 1) {
    scene_.solid = node_of(kind, depth);
    return std::move(scene_);
  }

 private:
  template <class T>
  T pick(std::initializer_list<T> list) {
    return list.begin()[integer(rng_, 0, static_cast<int>(list.size()) - 1)];
  }
  bool chance(double p) { return uniform(rng_, 0.0, 1.0) < p; }
  double length() { return log_uniform(rng_, 0.8, 3.5); }
  double exponent() { return chance(0.5) ? pick({1.0, 2.0, 3.0, 8.0, 20.0}) : log_uniform(rng_, 0.6, 12.0); }
  std::vector<double> point(double reach) {
    return {uniform(rng_, -reach, reach), uniform(rng_, -reach, reach), uniform(rng_, -reach, reach)};
  }
  std::vector<double> direction() {
    std::vector<double> v = point(1.0);
    v[static_cast<std::size_t>(integer(rng_, 0, 2))] += 1.5;
    const double size = std::hypot(v[0], v[1], v[2]);
    for (double& x : v) x /= size;
    return v;
  }

  std::string add(const std::string& kind, Values values) {
    std::string name = kind + ' ' + std::to_string(scene_.nodes.size());
    scene_.nodes.push_back(part(name, kind, std::move(values)));
    return name;
  }
  /// Adds a node of a kind: the given values, and a random one for every other key.
  std::string add_random(const std::string& kind, Values values) {
    const NodeKind* row = find_node_kind(kind);
    if (kind == "sweep_line") set_line(values);
    for (const NodeParam& p : row->params)
      if (!values.contains(std::string(p.info.name))) random_value(p, values);
    return add(kind, std::move(values));
  }

  /// A line, and the start of its profile across it.
  void set_line(Values& values) {
    const std::vector<double> d = direction(), other = direction();
    const Vec3 p0 = Eigen::Map<const Vec3>(point(1.0).data()), along = Eigen::Map<const Vec3>(d.data());
    const Vec3 across = along.cross(Eigen::Map<const Vec3>(other.data())).normalized();
    const Vec3 p1 = p0 + uniform(rng_, 0.5, 2.0) * along;
    const auto list = [](const Vec3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
    values["p0"] = list(p0);
    values["p1"] = list(p1);
    values["u"] = list(across);
  }

  /// A value by the name of its key; by type and bounds when the name says nothing.
  void random_value(const NodeParam& p, Values& values) {
    const std::string key(p.info.name);
    using Type = NodeParam::Type;
    switch (p.type) {
      case Type::number:
      case Type::integer:
        if (std::isnan(p.info.fallback) || chance(0.5)) values[key] = random_number(p);
        return;
      case Type::word:
        values[key] = std::string(
            p.words[static_cast<std::size_t>(integer(rng_, 0, static_cast<int>(p.words.size()) - 1))]);
        return;
      case Type::point:
        if (key == "u" || key == "through") return;  // depends on others, is instead of u
        values[key] = key == "normal" || key == "axis" ? direction() : point(1.5);
        return;
      case Type::points: {
        std::vector<std::vector<double>> list = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int i = integer(rng_, 0, 3); i > 0; --i) list.push_back(direction());
        values[key] = list;
        return;
      }
      case Type::numbers: {
        std::vector<double> list;
        for (std::size_t i = 0; i < p.count; ++i) list.push_back(length());
        if (key == "angles_deg") list = {uniform(rng_, -180.0, 0.0), uniform(rng_, 10.0, 170.0)};
        if (key == "t") list = {0.0, uniform(rng_, 1.0, 4.0)};
        if (key == "scale") list = {uniform(rng_, 0.5, 1.5), uniform(rng_, 0.5, 1.5)};
        values[key] = list;
        return;
      }
      case Type::rows:
        values[key] = matrix();
        return;
      case Type::formulas:
        values[key] = std::vector<std::string>{"2*cos(t)", "1.5*sin(t)", "t/5"};
        return;
      case Type::node:
        if (key == profile_key) values[key] = ref(profile());
        return;
      default:
        return;
    }
  }
  double random_number(const NodeParam& p) {
    const std::string_view key = p.info.name;
    if (key == "m" && p.type == NodeParam::Type::integer) return integer(rng_, 1, 3);
    if (key == "order") return integer(rng_, 1, 3);
    if (p.type == NodeParam::Type::integer) return integer(rng_, 2, 7);
    if (key.ends_with("_deg")) return uniform(rng_, -120.0, 120.0);
    if (key == "m") return std::max(exponent(), 1.2);
    if (key.front() == 'n') return std::max(exponent(), p.info.min);
    if (key == "eps") return uniform(rng_, 0.0, 0.7);
    if (key == "sigma") return uniform(rng_, 0.1, 1.2);
    if (key == "softness") return uniform(rng_, 0.0, 3.0);
    if (key == "r1" || key == "r2") return uniform(rng_, 0.2, 0.99);
    if (key == "u") return uniform(rng_, 0.05, 0.95);
    if (key == "w") return chance(0.5) ? pick({1.0, 2.0, 3.0}) : uniform(rng_, 1.0, 8.0);
    if (key == "alpha") return chance(0.3) ? pick({0.0, 1.0}) : uniform(rng_, -0.9, 1.0);
    if (key == "fade") return uniform(rng_, 0.05, 0.8);
    if (key == "scale") return log_uniform(rng_, 0.6, 1.6);
    return length();
  }
  std::vector<std::vector<double>> matrix() {
    std::vector<std::vector<double>> rows = {point(0.3), point(0.3), point(0.3), point(1.0)};
    for (std::size_t i = 0; i < 3; ++i) rows[i][i] += uniform(rng_, 0.8, 1.4);
    return rows;
  }

  std::string profile() { return add_random(pick<std::string>({"lp_profile", "rose", "star"}), {}); }

  /// Ray-linear about the scene's origin and positive off it.
  std::string gauge(int depth) {
    if (depth > 0 && chance(0.4)) {
      const std::string kind =
          pick<std::string>({"dilation", "erosion", "erosion_after_dilation", "ray_scaling"});
      return distance_operation(*find_node_kind(kind), depth);
    }
    return add_random(pick<std::string>({"lp_metric", "superquadric", "asymmetric_superellipsoid",
                                         "generalized_distance", "capsule_gauge", "polar_bar"}),
                      {});
  }
  std::string distance_operation(const NodeKind& kind, int depth) {
    Values values;
    for (const NodeParam& p : kind.params)
      if (p.type == NodeParam::Type::node) values[std::string(p.info.name)] = ref(gauge(depth - 1));
    if (kind.name == "ray_scaling") values["by"] = ref(gauge(0));  // must be finite, too
    values["n"] = kind.name == "ray_scaling" ? uniform(rng_, -1.5, 1.5) : uniform(rng_, 1.0, 3.0);
    if (kind.name == "erosion_after_dilation") {
      values.erase("n");
      values["n_dilation"] = uniform(rng_, 1.0, 3.0);
      values["n_erosion"] = uniform(rng_, 1.0, 3.0);
    }
    return add(std::string(kind.name), std::move(values));
  }
  std::string distance(int depth) {
    if (chance(0.5)) return gauge(depth);
    return add_random(pick<std::string>({"half_space", "slab", "segment_skeleton", "sweep_line", "sweep_arc",
                                         "sweep_curve"}),
                      {});
  }

  std::string soft_object(int depth) {
    Values values = {{"distance", ref(distance(depth))}};
    const std::string potential = pick<std::string>({"blanc", "wyvill", "gaussian", "gaussian_windowed"});
    values["potential"] = potential;
    if (potential == "blanc" && chance(0.5)) values["softness"] = uniform(rng_, 0.0, 3.0);
    if (chance(0.3)) {
      values["distance"] = ref(gauge(depth));
      values["w1"] = ref(gauge(0));
      const bool coupled = chance(0.3);
      values["inner"] = std::string(coupled ? "coupled" : "decoupled");
      values["w_floor"] = uniform(rng_, 0.02, 0.2);
      values["w2"] = coupled ? 0.04 : uniform(rng_, 0.2, 1.0);
    } else if (chance(0.5)) {
      const double w1 = uniform(rng_, 0.3, 1.5);
      values["w1"] = w1;
      values["w2"] = uniform(rng_, 0.1, std::min(1.0, 2.0 * w1));
    }
    return add("soft_object", std::move(values));
  }

  std::string operation(const NodeKind& kind, Level level, int depth) {
    Values values;
    for (const NodeParam& p : kind.params) {
      const std::string key(p.info.name);
      if (p.type == NodeParam::Type::nodes) {
        std::vector<NodeRef> list;
        const bool two = kind.name.find("difference") != std::string_view::npos || of_two(kind);
        for (int k = two ? 2 : integer(rng_, 2, 4); k > 0; --k) list.push_back(ref(field(level, depth - 1)));
        if (find_key(kind, "r") && find_key(kind, "w")) values["r"] = reaches(list.size());
        values[key] = list;
      } else if (p.type == NodeParam::Type::node) {
        values[key] = ref(field(level, depth - 1));
      }
    }
    if (find_key(kind, "r1")) {
      const double r1 = uniform(rng_, 0.2, 0.99), r2 = uniform(rng_, 0.2, 0.99);
      values["r1"] = r1;
      values["r2"] = r2;
      values["p"] = uniform(rng_, -r1 * r2, 0.9 * r1 * r2);
    }
    if (const NodeParam* a = find_key(kind, "a"); a && a->type == NodeParam::Type::numbers) {
      std::vector<double> amounts{uniform(rng_, -0.6, 0.6)};
      while (amounts.size() < a->count) amounts.push_back(uniform(rng_, 0.2, 1.5));
      values["a"] = amounts;
    }
    return add_random(std::string(kind.name), std::move(values));
  }
  static const NodeParam* find_key(const NodeKind& kind, std::string_view key) {
    for (const NodeParam& p : kind.params)
      if (p.info.name == key) return &p;
    return nullptr;
  }
  /// One number for every operand, or one for all.
  std::vector<double> reaches(std::size_t operands) {
    std::vector<double> r{uniform(rng_, 0.2, 1.2)};
    if (chance(0.7))
      while (r.size() < operands) r.push_back(uniform(rng_, 0.2, 1.2));
    return r;
  }
  static bool of_two(const NodeKind& kind) {
    return kind.name.starts_with("liming") || kind.name.starts_with("pasko") ||
           kind.name.starts_with("bounded");
  }
  /// Whether an operation works in a level, by its name; min, max and complement work in all.
  static bool of_level(const NodeKind& kind, Level level) {
    for (const std::string_view start : {"r_", "r0m_", "rockwood_", "local_"})
      if (kind.name.starts_with(start)) return level == Level::function;
    if (kind.name.ends_with("_function") || of_two(kind)) return level == Level::function;
    if (kind.name.ends_with("_one")) return level == Level::one;
    if (kind.name.ends_with("_half") || kind.name.starts_with("soft_")) return level == Level::half;
    if (kind.name.ends_with("_zero")) return level == Level::zero;
    return true;
  }

  // ---- Solids, f >= 0 ----------------------------------------------------------------------------------

  /// An ellipsoid with its centre in [-reach, reach]^3 as ten coefficients, or any quadric.
  std::vector<double> coefficients(double reach, bool ellipsoid) {
    std::vector<double> a(10);
    if (!ellipsoid) {
      for (double& x : a) x = uniform(rng_, -1.0, 1.0);
      return a;
    }
    const std::vector<double> c = point(reach);
    a[9] = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double s = uniform(rng_, 0.4, 1.6);
      a[i] = -1.0 / (s * s);
      a[6 + i] = 2.0 * c[i] / (s * s);
      a[9] -= c[i] * c[i] / (s * s);
    }
    return a;
  }
  std::string quadric(bool ellipsoid) {
    return add("quadric", {{"coefficients", coefficients(1.5, ellipsoid)}});
  }
  std::string perturbation(int depth) {
    const std::string q = depth > 0 && chance(0.2) ? field(Level::function, depth - 1) : quadric(chance(0.9));
    const double weight = uniform(rng_, 0.2, 1.2) * (chance(0.3) ? -1.0 : 1.0);
    Values values = {{"of", ref(q)}, {"weight", weight}, {"power", double(integer(rng_, 2, 5))}};
    if (chance(0.3)) values["free_term"] = uniform(rng_, -0.4, 0.4);
    return add("perturbation", std::move(values));
  }
  std::string freeform(int depth) {
    Values values = {{"base", ref(depth > 0 ? field(Level::function, depth - 1) : quadric(true))}};
    std::vector<NodeRef> bumps;
    for (int i = integer(rng_, 0, 4); i > 0; --i) {
      const std::string bump = perturbation(depth);
      bumps.push_back(ref(chance(0.2) ? add_random("place", {{"of", ref(bump)}}) : bump));
    }
    if (!bumps.empty()) values["bumps"] = bumps;
    return add("freeform", std::move(values));
  }
  std::string solid(const NodeKind& kind, int depth) {
    if (kind.name == "quadric") return quadric(chance(0.5));
    if (kind.name == "perturbation") return perturbation(depth);
    if (kind.name == "freeform") return freeform(depth);
    if (kind.name == "torus")
      return add("torus", {{"ring", uniform(rng_, 0.9, 1.5)}, {"tube", uniform(rng_, 0.2, 0.8)}});
    return add_random(std::string(kind.name), {});
  }
  std::string any_solid(int depth) {
    const auto rows = solid_kinds();
    return solid(rows[static_cast<std::size_t>(integer(rng_, 0, static_cast<int>(rows.size()) - 1))], depth);
  }
  std::string convert(int depth) {
    const Level from = pick<Level>({Level::half, Level::one, Level::zero, Level::function});
    return add_random("convert", {{"of", ref(field(from, depth - 1))}, {"adapter", std::string("linear")}});
  }

  std::string leaf(Level level, int depth) {
    if (level == Level::half) return soft_object(depth);
    if (level == Level::one) return distance(depth);
    if (level == Level::function) return any_solid(depth);
    return add("zero_level", {{"of", ref(chance(0.2) ? add_random("plane", {}) : distance(depth))},
                              {"form", std::string(chance(0.5) ? "difference" : "logarithm")}});
  }
  std::string field(Level level, int depth) {
    if (depth <= 0) return leaf(level, 0);
    if (chance(0.25))
      return add_random(pick<std::string>({"affine", "place"}), {{"of", ref(field(level, depth - 1))}});
    std::vector<const NodeKind*> rows;
    for (const NodeKind& kind : operation_kinds())
      if (of_level(kind, level)) rows.push_back(&kind);
    if (rows.empty() || chance(0.2)) return leaf(level, depth - 1);
    return operation(*rows[static_cast<std::size_t>(integer(rng_, 0, static_cast<int>(rows.size()) - 1))],
                     level, depth);
  }

  std::string node_of(const NodeKind& kind, int depth) {
    switch (kind.family) {
      case NodeFamily::distance:
        return add_random(std::string(kind.name), {});
      case NodeFamily::distance_operation:
        return distance_operation(kind, depth);
      case NodeFamily::field:
        return soft_object(depth);
      case NodeFamily::solid:
        return solid(kind, depth);
      case NodeFamily::offset:
        return add_random(std::string(kind.name), {{"of", ref(field(Level::function, depth))}});
      case NodeFamily::conversion:
        return kind.name == "convert" ? convert(depth) : leaf(Level::zero, depth);
      case NodeFamily::placement:
        return add_random(std::string(kind.name), {{"of", ref(field(Level::half, depth))}});
      default:
        break;
    }
    for (const Level level : {Level::half, Level::one, Level::zero, Level::function})
      if (of_level(kind, level)) return operation(kind, level, depth);
    return {};
  }

  Rng& rng_;
  SceneSpec scene_;
};

inline SceneSpec random_scene(Rng& rng, int depth = 3) { return RandomScene(rng).make(depth); }
inline SceneSpec random_scene(Rng& rng, Level level, int depth = 3) {
  return RandomScene(rng).make(level, depth);
}
/// How well vector and scalar values of a scene agree: differences of products of fields lose the digits that
/// their terms have in common.
inline double agreement_of(const SceneSpec& scene) {
  for (const NodeSpec& node : scene.nodes)
    if (node.kind.starts_with("liming") || node.kind.starts_with("r0m_") || node.kind == "rockwood_raw")
      return 1e-9;
  return 1e-12;
}
inline SceneSpec random_scene_of(Rng& rng, const NodeKind& kind) { return RandomScene(rng).of_kind(kind); }

}  // namespace blendwright::test
