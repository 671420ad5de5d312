#include "tests/implicit/offset/offset_samples.hpp"

#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using List = std::vector<double>;
const Box two{Vec3::Constant(-2.0), Vec3::Constant(2.0)};

SceneSpec with(SceneSpec solid, const std::string& kind, Values values) {
  values["of"] = ref(solid.solid);
  solid.nodes.push_back(part("offset", kind, std::move(values)));
  solid.solid = "offset";
  return solid;
}
SceneSpec on(NodeSpec solid, const std::string& kind, Values values) {
  return with(scene_of({std::move(solid)}), kind, std::move(values));
}

NodeSpec torus() { return part("solid", "torus", {{"ring", 1.0}, {"tube", 0.4}}); }
NodeSpec box() { return part("solid", "box", {{"half", List{1.0, 0.8, 0.6}}}); }
NodeSpec egg() { return part("solid", "ellipsoid_quadric", {{"a", 1.4}, {"b", 1.0}, {"c", 0.7}}); }
NodeSpec saddle() {
  return part(
      "solid", "quadric",
      {{"coefficients", List{-1.586, 1.356, -1.174, -1.272, -0.961, 0.639, -0.998, 1.069, 0.105, 1.618}}});
}
SceneSpec turned(const NodeSpec& solid) {
  return scene_of({solid, part("turned", "place",
                               {{"of", ref("solid")},
                                {"move", List{0.3, -0.2, 0.1}},
                                {"axis", List{1, 2, 3}},
                                {"turn_deg", 40.0},
                                {"scale", 1.2}})});
}
/// Two eggs: the smallest or the largest, or one without the other.
SceneSpec two_eggs(const std::string& how) {
  return scene_of(
      {egg(),
       part("moved", "place", {{"of", ref("solid")}, {"move", List{0.9, 0.3, 0.0}}, {"turn_deg", 60.0}}),
       part("not", "complement", {{"of", ref("moved")}}),
       part("both", how == "without" ? "min" : how,
            {{"of", refs({"solid", how == "without" ? "not" : "moved"})}})});
}
SceneSpec corner() {
  const auto plane = [](const char* name, List a) {
    return part(name, "quadric", {{"coefficients", std::move(a)}});
  };
  return scene_of({plane("a", {0, 0, 0, 0, 0, 0, 1, 0.2, 0, 0.5}),
                   plane("b", {0, 0, 0, 0, 0, 0, -0.3, 2, 0, 0.7}),
                   plane("c", {0, 0, 0, 0, 0, 0, 0.1, 0.1, 1, 0.4}),
                   part("min", "min", {{"of", refs({"a", "b", "c"})}})});
}
SceneSpec soft_bar() {
  return scene_of({part("d", "superquadric", {{"a", 1.0}, {"b", 0.7}, {"c", 0.8}, {"n1", 2.0}, {"n2", 2.0}}),
                   soft("soft", "d")});
}
SceneSpec zero_ball() { return scene_of({ball("d", 1.2), part("zero", "zero_level", {{"of", ref("d")}})}); }

std::vector<OffsetSample> all_samples() {
  std::vector<OffsetSample> all;
  const auto add = [&](const char* id, SceneSpec scene, double share = 0.1, bool slow = false,
                       bool edges = false) {
    const std::string kind = scene.nodes.back().kind;
    scene.strict = false;
    all.push_back({id, kind, std::move(scene), two, share, slow, edges});
  };
  add("iso-freeform", with(bumpy(4), "iso_offset", {{"value", 0.3}}));
  add("iso-zero", with(zero_ball(), "iso_offset", {{"value", -0.2}}));
  add("normal-freeform", with(bumpy(4), "normal_offset", {{"distance", 0.2}}));
  add("normal-egg-inward", on(egg(), "normal_offset", {{"distance", -0.25}}));
  add("normal-zero", with(zero_ball(), "normal_offset", {{"distance", 0.3}}), 0.3);
  add("normal-soft", with(soft_bar(), "normal_offset", {{"distance", 0.1}}), 0.5);
  add("normal-placed", with(turned(egg()), "normal_offset", {{"distance", 0.2}}));
  add("ball-torus", on(torus(), "ball_offset", {{"distance", 0.2}}), 0.3);
  add("ball-box-inward", on(box(), "ball_offset", {{"distance", -0.2}}), 0.3);
  add("ball-egg", on(egg(), "ball_offset", {{"distance", 0.3}}), 0.3);
  add("ball-egg-inward", on(egg(), "ball_offset", {{"distance", -0.3}}), 0.3);
  add("ball-saddle", on(saddle(), "ball_offset", {{"distance", 0.3}}), 0.3);
  add("ball-saddle-inward", on(saddle(), "ball_offset", {{"distance", -0.3}}), 0.3);
  add("ball-turned-box", with(turned(box()), "ball_offset", {{"distance", 0.2}}), 0.3);
  add("ball-turned-saddle", with(turned(saddle()), "ball_offset", {{"distance", 0.2}}), 0.3);
  add("ball-sheared-egg",
      with(scene_of(
               {egg(), part("sheared", "affine",
                            {{"of", ref("solid")},
                             {"matrix",
                              std::vector<List>{{1, 0.3, 0}, {0, 1, 0.2}, {0, 0, 1.5}, {0.1, 0.2, -0.3}}}})}),
           "ball_offset", {{"distance", 0.2}}),
      0.3);
  add("ball-union", with(two_eggs("max"), "ball_offset", {{"distance", 0.2}}), 0.3);
  add("ball-intersection-inward", with(two_eggs("min"), "ball_offset", {{"distance", -0.2}}), 0.3);
  add("ball-difference-inward", with(two_eggs("without"), "ball_offset", {{"distance", -0.1}}), 0.3);
  add("ball-freeform", with(bumpy(4), "ball_offset", {{"distance", 0.2}, {"tolerance", 1e-12}}), 0.4);
  add("ball-freeform-inward", with(bumpy(4), "ball_offset", {{"distance", -0.15}, {"tolerance", 1e-12}}),
      0.4);
  add("ball-zero", with(zero_ball(), "ball_offset", {{"distance", 0.2}}), 0.4);
  // Values may jump by the tolerance, where differences would see it.
  add("ball-soft", with(soft_bar(), "ball_offset", {{"distance", 0.2}, {"tolerance", 1e-12}}), 0.6);
  add("ball-intersection", with(two_eggs("min"), "ball_offset", {{"distance", 0.2}}), 0.4, false, true);
  add("shell-box", on(box(), "shell", {{"inner", 0.1}, {"outer", 0.2}}), 0.3);
  add("shell-soft", with(soft_bar(), "shell", {{"inner", 0.1}, {"outer", 0.0}}), 0.6);
  add("opening-box", on(box(), "opening", {{"radius", 0.25}}), 0.3);
  add("opening-corner", with(corner(), "opening", {{"radius", 0.3}}), 0.3);
  add("closing-torus", on(torus(), "closing", {{"radius", 0.3}}), 0.3);
  add("closing-boxes",
      with(scene_of({box(), part("moved", "place", {{"of", ref("solid")}, {"move", List{0.8, 0.8, 0.0}}}),
                     part("both", "max", {{"of", refs({"solid", "moved"})}})}),
           "closing", {{"radius", 0.2}}),
      0.6, true);
  return all;
}

}  // namespace

SceneSpec bumpy(int bumps) {
  Rng rng(20);
  std::vector<NodeSpec> nodes{part("base", "ellipsoid_quadric", {{"a", 1.5}, {"b", 1.2}, {"c", 1.0}})};
  std::vector<std::string> names;
  for (int i = 0; i < bumps; ++i) {
    const Vec3 d = Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)).normalized();
    const Vec3 c = d.cwiseProduct(Vec3(1.5, 1.2, 1.0));
    Vec3 a;
    for (int k = 0; k < 3; ++k) a[k] = std::pow(uniform(rng, 0.35, 0.6), -2.0);
    const std::string name = "bump " + std::to_string(i);
    nodes.push_back(
        part(name + " q", "quadric",
             {{"coefficients", List{-a[0], -a[1], -a[2], 0, 0, 0, 2 * a[0] * c[0], 2 * a[1] * c[1],
                                    2 * a[2] * c[2], 1.0 - a.dot(c.cwiseProduct(c))}}}));
    nodes.push_back(part(name, "perturbation",
                         {{"of", ref(name + " q")},
                          {"weight", (i % 4 == 3 ? -0.3 : 0.4)},
                          {"power", i % 2 == 0 ? 3.0 : 2.0}}));
    names.push_back(name);
  }
  nodes.push_back(part("solid", "freeform", {{"base", ref("base")}, {"bumps", refs(names)}}));
  return scene_of(std::move(nodes));
}

const std::vector<OffsetSample>& offset_samples() {
  static const std::vector<OffsetSample> all = all_samples();
  return all;
}

}  // namespace blendwright::test
