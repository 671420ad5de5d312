// The rows of operators of level function, in scenes: their bounds, and what they do to solids.
#include <gtest/gtest.h>

#include <numbers>

#include "implicit/operators/operation_rows.hpp"
#include "tests/implicit/primitives/made_primitive.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/random_scene.hpp"

namespace blendwright::test {
namespace {

using Numbers = std::vector<double>;

/// An ellipsoid somewhere in [-1.5, 1.5]^3, as a field or an exact distance.
void add_solid(Rng& rng, SceneSpec& scene, const std::string& name) {
  const char* kind = integer(rng, 0, 1) == 0 ? "ellipsoid_quadric" : "ellipsoid";
  scene.nodes.push_back(
      part(name + " body", kind,
           {{"a", uniform(rng, 0.4, 1.5)}, {"b", uniform(rng, 0.4, 1.5)}, {"c", uniform(rng, 0.4, 1.5)}}));
  scene.nodes.push_back(
      part(name, "place",
           {{"of", ref(name + " body")},
            {"move", Numbers{uniform(rng, -1.5, 1.5), uniform(rng, -1.5, 1.5), uniform(rng, -1.5, 1.5)}}}));
}

/// A node of this kind, of solids.
SceneSpec of_solids(Rng& rng, const NodeKind& kind) {
  // The random scene of a kind has the values; its operands are replaced.
  SceneSpec scene = random_scene_of(rng, kind);
  NodeSpec node = scene.nodes.back();
  scene.nodes.clear();
  int count = 0;
  for (auto& [key, value] : node.values) {
    if (auto* one = std::get_if<NodeRef>(&value)) {
      one->name = "n" + std::to_string(count++);
      add_solid(rng, scene, one->name);
    } else if (auto* list = std::get_if<std::vector<NodeRef>>(&value)) {
      for (NodeRef& r : *list) {
        r.name = "n" + std::to_string(count++);
        add_solid(rng, scene, r.name);
      }
    }
  }
  scene.solid = node.name;
  scene.nodes.push_back(std::move(node));
  return scene;
}

/// Every point where the field has a value lies in the region of that value.
TEST(FunctionKinds, KnowHowFarTheirSolidsReach) {
  std::size_t inside = 0, cut = 0, known = 0;
  for (const auto group :
       {detail::function_set_kinds(), detail::function_blend_kinds(), detail::function_material_kinds()})
    for (const NodeKind& kind : group)
      for_all(
          [&](Rng& rng) {
            const SceneSpec scene = of_solids(rng, kind);
            const MadePrimitive made = make_primitive(scene);
            ASSERT_TRUE(made.problems.empty()) << kind.name << ": " << made.problems.front().message;
            // Liming's curve is positive where both fields are negative.
            EXPECT_EQ(made.node.region(0.0).has_value(), kind.name != "liming") << kind.name;
            std::vector<Vec3> points;
            for (int i = 0; i < 400; ++i) {
              const double reach = i % 2 == 0 ? 3.0 : 6.0;
              points.emplace_back(uniform(rng, -reach, reach), uniform(rng, -reach, reach),
                                  uniform(rng, -reach, reach));
            }
            const std::vector<double> values = values_at(*made.tape, points);
            for (const double level : {0.0, 0.2, -0.1, -1.0, -3.0}) {
              const std::optional<Box> box = made.node.region(level);
              if (!box) continue;
              ++known;
              const Box smaller{box->lo + 0.2 * box->size(), box->hi - 0.2 * box->size()};
              for (std::size_t i = 0; i < points.size(); ++i) {
                if (values[i] < level) continue;
                ++inside;
                if (!smaller.contains(points[i])) ++cut;
                ASSERT_TRUE(box->contains(points[i]))
                    << kind.name << " " << level << " " << points[i].transpose();
              }
            }
          },
          30);
  EXPECT_GT(known, 1500u);
  EXPECT_GT(inside, 20000u);
  EXPECT_GT(cut, 2000u);  // boxes that are too small would have been noticed
}

// ---- Two half-spaces at right angles

NodeSpec plane(std::string name, double x, double y, double z, double free) {
  return part(std::move(name), "quadric", {{"coefficients", Numbers{0, 0, 0, 0, 0, 0, x, y, z, free}}});
}
/// Solids x <= 0 and y <= 0, a corner solid x >= 1 or so, and a node of two of them.
SceneSpec corner(std::string kind, Values values) {
  values["of"] = refs({"left", "below"});
  return scene_of({plane("left", -1, 0, 0, 0), plane("below", 0, -1, 0, 0), plane("above", 0, 0, 1, 0),
                   plane("chord", -1, -1, 0, 1), part("x", std::move(kind), std::move(values))});
}
Vec3 any_point(Rng& rng) { return {uniform(rng, -2, 2), uniform(rng, -2, 2), uniform(rng, -2, 2)}; }

TEST(LimingNode, GoesThroughAPoint) {
  for_all([](Rng& rng) {
    // On the line of symmetry t = 1/(2 + sqrt((1 - u)/u)); A and B are positive outside the solids.
    const double u = uniform(rng, 0.05, 0.95), t = 1.0 / (2.0 + std::sqrt((1.0 - u) / u));
    SceneSpec scene = corner("liming", {{"blend", ref("chord")}, {"through", Numbers{t, t, 0.3}}});
    for (NodeSpec& node : scene.nodes)
      if (node.name == "left" || node.name == "below")
        for (double& c : std::get<Numbers>(node.values["coefficients"])) c = -c;
    const ScalarField field = build_scene(scene).field;
    EXPECT_NEAR(field.value({t, t, 0.0}), 0.0, 1e-15);
    find(scene, "x")->values.erase("through");
    find(scene, "x")->values["u"] = u;
    const ScalarField direct = build_scene(scene).field;
    const Vec3 p = any_point(rng);
    EXPECT_NEAR(field.value(p), direct.value(p), 1e-13);
  });
}

/// Scene 5: a circle of radius 1 around (1, 1).
TEST(LimingNode, OfPlanesAtRightAnglesIsACircle) {
  const ScalarField field =
      build_scene(corner("liming_clipped", {{"c_a", 1.0}, {"c_b", 1.0}, {"r", 1.0}, {"u", 1.0 / 3.0}})).field;
  for_all([&](Rng& rng) {
    const double angle = uniform(rng, std::numbers::pi * 1.02, 1.48 * std::numbers::pi);
    // The zero along the ray from the circle's centre, by bisection.
    const Vec3 along(std::cos(angle), std::sin(angle), 0.0), centre(1.0, 1.0, uniform(rng, -2, 2));
    double lo = 0.5, hi = 1.2;
    for (int i = 0; i < 60; ++i)
      (field.value(centre + 0.5 * (lo + hi) * along) < 0.0 ? lo : hi) = 0.5 * (lo + hi);
    EXPECT_NEAR(hi, 1.0, 1e-12);
  });
}

TEST(LocalBlend, IsTheSharpUnionAwayFromItsEdge) {
  const Values values{{"r", Numbers{0.7, 0.5}}, {"w", 2.0}, {"around", ref("above")}, {"fade", 0.4}};
  const ScalarField local = build_scene(corner("local_blend", values)).field;
  const ScalarField sharp = build_scene(corner("max", {})).field;
  const ScalarField whole =
      build_scene(corner("rockwood_union", {{"r", Numbers{0.7, 0.5}}, {"w", 2.0}})).field;
  int blended = 0;
  for_all(
      [&](Rng& rng) {
        const Vec3 p = any_point(rng);
        const double value = local.value(p);
        if (p.z() <= 0.0) {
          EXPECT_EQ(value, sharp.value(p));
        } else if (p.z() >= 0.4) {
          EXPECT_EQ(value, whole.value(p));
        } else {
          EXPECT_GE(value, sharp.value(p) - 1e-15);
          EXPECT_LE(value, whole.value(p) + 1e-15);
        }
        if (value != sharp.value(p)) ++blended;
      },
      1000);
  EXPECT_GT(blended, 50);
  // Over a box below the blend adds nothing to the range but what rounding can.
  const Box below{{-1, -1, -1}, {-0.6, 1, -0.1}};
  EXPECT_NEAR(local.range(below).lo, sharp.range(below).lo, 1e-12);
  EXPECT_NEAR(local.range(below).hi, sharp.range(below).hi, 1e-12);
}

TEST(BoundedBlend, IsTheOperationOutsideItsBounds) {
  const Values values{{"within", ref("above")}, {"a", Numbers{0.6, 0.5, 0.5, 0.5}}};
  for (const std::string join : {"union", "intersection", "difference"}) {
    const ScalarField bounded_field = build_scene(corner("bounded_blend_" + join, values)).field;
    const ScalarField plain = build_scene(corner("r_" + join, {})).field;
    for_all([&](Rng& rng) {
      const Vec3 p = any_point(rng);
      if (p.z() <= 0.0) {
        EXPECT_EQ(bounded_field.value(p), plain.value(p));
      } else {
        EXPECT_GE(bounded_field.value(p), plain.value(p));
      }
    });
    const Box below{{-1, -1, -1}, {1, 1, -0.1}};
    EXPECT_EQ(bounded_field.range(below), plain.range(below));
  }
}

TEST(PaskoSavchenko, AddsAndTakesMaterial) {
  for (const double a0 : {0.4, -0.4}) {
    const ScalarField field =
        build_scene(corner("pasko_savchenko_union", {{"a", Numbers{a0, 0.5, 0.7}}})).field;
    const ScalarField plain = build_scene(corner("r_union", {})).field;
    EXPECT_NEAR(field.value(Vec3::Zero()) - plain.value(Vec3::Zero()), a0, 1e-15);
    for_all([&](Rng& rng) {
      const Vec3 p = any_point(rng);
      EXPECT_EQ(field.value(p) > plain.value(p), a0 > 0.0);
    });
  }
}

/// k operands in one step: all meet in one corner, in any order.
TEST(RockwoodNode, BlendsACornerAlikeInAnyOrder) {
  const auto scene = [](const std::vector<std::string>& order) {
    SceneSpec s = corner("rockwood_union", {{"r", Numbers{0.6}}, {"w", 2.5}});
    find(s, "x")->values["of"] = refs(order);
    return build_scene(s).field;
  };
  const ScalarField one = scene({"left", "below", "above"}), other = scene({"above", "left", "below"});
  for_all([&](Rng& rng) {
    const Vec3 p = any_point(rng);
    EXPECT_NEAR(one.value(p), other.value(p), 1e-14);
  });
}

TEST(FunctionKinds, AreOfLevelFunctionAndTakeEachOther) {
  SceneSpec scene = corner("rockwood_union", {{"r", Numbers{0.6}}});
  scene.nodes.push_back(part("y", "r0m_intersection", {{"of", refs({"x", "above"})}, {"m", 2.0}}));
  scene.nodes.push_back(part("z", "ricci_difference_function", {{"of", refs({"y", "chord"})}, {"n", 8.0}}));
  scene.solid = "z";
  EXPECT_EQ(build_scene(scene).field.level(), Level::function);
}

}  // namespace
}  // namespace blendwright::test
